"""One page, written twice: as Markdown, and as HTML that needs no other file and no network."""
import html
import re

HEAD = """<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<link rel="icon" href="data:,">
<title>{title}</title>
<style>
body {{ font: 15px/1.5 system-ui, sans-serif; color: #222; background: #fff; margin: 2em auto; max-width: 76em; padding: 0 1em; }}
h1, h2, h3 {{ font-weight: 600; overflow-wrap: anywhere; }} h2 {{ margin-top: 2.5em; border-top: 1px solid #ddd; padding-top: 1em; }}
.table {{ overflow-x: auto; margin: 1em 0; }}
table {{ border-collapse: collapse; font-variant-numeric: tabular-nums; }}
th, td {{ padding: .15em .8em; border-bottom: 1px solid #eee; text-align: left; vertical-align: top; }} th {{ color: #666; font-weight: 500; }}
td.number {{ text-align: right; white-space: nowrap; }} tr.star td {{ background: #fff6e0; }}
svg {{ max-width: 100%; height: auto; }}
</style>
"""


def marked(text):
    """As HTML, with what stands between backticks as code."""
    return re.sub(r"`([^`]+)`", r"<code>\1</code>", html.escape(text))


def is_number(text):
    return re.fullmatch(r"[~=]?[-+.e\d]+( ?%)?( – [-+.e\d]+)?", text) is not None


class Page:
    """Headings, paragraphs, lists, tables and diagrams, in order."""

    def __init__(self, title):
        self.title, self.markdown, self.body = title, [f"# {title}\n"], [f"<h1>{html.escape(title)}</h1>"]

    def heading(self, text, level=2):
        self.markdown.append(f"{'#' * level} {text}\n")
        self.body.append(f"<h{level}>{html.escape(text)}</h{level}>")

    def text(self, text):
        self.markdown.append(text + "\n")
        self.body.append(f"<p>{marked(text)}</p>")

    def sentences(self, list_):
        self.markdown.append("".join(f"{i}. {text}\n" for i, text in enumerate(list_, 1)))
        self.body.append("<ol>" + "".join(f"<li>{marked(text)}" for text in list_) + "</ol>")

    def table(self, names, rows):
        """Rows of texts; one that begins with * is a star's, and shaded."""
        if not rows:
            return
        lines = [names, ["---"] * len(names), *rows]
        self.markdown.append("".join(f"| {' | '.join(line)} |\n" for line in lines))
        body = "<div class=table><table><tr>" + "".join(f"<th>{html.escape(name)}" for name in names)
        for row in rows:
            body += "\n<tr class=star>" if row[0] == "*" else "\n<tr>"
            for text in row:
                body += f"<td{' class=number' if is_number(text) else ''}>{html.escape(text)}"
        self.body.append(body + "\n</table></div>")

    def diagram(self, what, svg, link):
        """`link`: its file, seen from the pages."""
        self.markdown.append(f"![{what}]({link})\n")
        # Two diagrams in one page must not share names.
        prefix = re.sub(r"\W", "-", link)
        svg = re.sub(r"\b(id=['\"]|href=['\"]#|url\(#)", rf"\g<1>{prefix}-", svg)
        self.body.append(f"<figure>{svg}</figure>")

    def as_markdown(self, next_page):
        return "\n".join(self.markdown) + f"\nNext: {next_page}.\n"

    def as_html(self):
        return HEAD.format(title=html.escape(self.title)) + "\n".join(self.body) + "\n</html>\n"
