"""Tables of docs/web.md that programs write, each between marks that name the program."""
import pathlib

PAGE = pathlib.Path(__file__).resolve().parents[2] / "docs/web.md"


def put(program, text):
    begin, end = f"<!-- {program} -->\n", f"<!-- end of {program.removesuffix(' --write')} -->\n"
    head, rest = PAGE.read_text().split(begin)
    PAGE.write_text(head + begin + text + end + rest.split(end)[1])
