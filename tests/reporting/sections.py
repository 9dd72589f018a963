"""The sections of the report: what of the figures stands where."""
import pathlib
import re

from findings import alone as studies_alone
from findings import changed_by, joints, number, turned
from measures import chosen, commit, compared, is_idle, nearest, own_row, quickest

DIAGRAMS = pathlib.Path("pictures/studies")   # as pages link to it
CLEAR = 0.02   # of a frame's time: what a quiet machine's median wavers by from call to call
SHOWN = ["caustics-quality", "magic-quality", "terrain-quality", "deep_ocean-quality"]
BUDGETS = ["scene", "own: ms", "RMSE", "FLIP", "beaten", "ms", "time", "RMSE", "FLIP", "by", "over all presets"]


def interval(row):
    return f"{row['ms_low']:.3g} – {row['ms_high']:.3g}"


def steps_of(found):
    return [step for steps in found.values() for step in steps.values() if step["studies"]]


def when(found):
    """Of all that was measured: dates, commits, machine, load."""
    steps = steps_of(found)
    study = steps[0]["studies"][0]
    dates = sorted({step["date"] for step in steps})
    load = sorted(step["load"] for step in steps)
    return (f"{' to '.join(dict.fromkeys((dates[0], dates[-1])))}, commit {commit()}, {study['machine']}, "
            f"{study['renderer']}, load {load[0]:.1f} to {load[-1]:.1f}")


def head(page, found):
    steps = [step for steps in found.values() for step in steps.values() if "wall_s" in step]
    page.text(f"Made by tests/report: {when(found)}. It took {sum(step['processor_s'] for step in steps) / 60:.0f} "
              f"minutes of processor time, and {sum(step['wall_s'] for step in steps) / 60:.0f} of the clock.")
    page.text("Errors are RMSE in linear light and FLIP (what a person sees, 0 to 1), to the reference. A time is the "
              "median of rounds in random order, its interval holds it in 95 of 100 cases, and “faster” and “slower” are "
              "beside the preset's own setting. Stars (*): every setting with less error is told to be slower, by more "
              "than 2.5 %, and it is told to be nearer to the truth than every faster star. ~: within ten times the "
              "reference's own error, and so uncertain. "
              "A machine that others use makes intervals wider and verdicts fewer; at most one study in twenty has a "
              "false one.")
    for step, what in (("joint", "joint frontiers"), ("near", "less time at the same error"), ("over", "over all presets"),
                       ("alone", "every tweak alone"), ("features", "features")):
        missing = [name for name, steps in found.items() if not steps.get(step, {}).get("studies")]
        if missing:
            page.text(f"Not measured here, {what}: {', '.join(missing)}.")


def stars_and_own(study):
    return [row for row in study["rows"] if row["pareto"] or row["is_preset"]]


def setting(row, own):
    return "the preset's own" if row["is_preset"] else turned(row, own) or row["value"]


def frontiers(page, found):
    page.heading("Joint frontiers")
    page.text("All quality tweaks of a scene together, at its main preset. The truth is the picture with all references "
              "at once. Its own error is what each number leaves, by the order that half and a quarter of it show. Diagrams name "
              "the stars and the preset's own.")
    for name, study, own in joints(found):
        page.heading(name, 3)
        options = found[name]["joint"].get("options", [])
        page.text(f"{study['size'][0]}x{study['size'][1]}, `glint study PRESET {' '.join(options)}`. The truth's own error: "
                  f"{number(study['own_error'])}. Clock: {study['clock']}.")
        for text in study["findings"] + study["notes"]:
            page.text(text[:1].upper() + text[1:] + ".")
        page.text(f"The preset's own: {own['value']}.")
        rows = [["*" if row["pareto"] else "", setting(row, own), f"{row['ms']:.3g}", interval(row),
                 row["verdict"] or "", ("~" if row["near_reference"] else "") + number(row["rmse"]), number(row["flip"])]
                for row in sorted(compared(study), key=lambda row: row["ms"])]
        page.table(["", "setting", "ms", "95 of 100 within", "time", "RMSE", "FLIP"], rows)
        svg = found[name]["joint"]["svgs"][0]
        if svg:
            page.diagram(f"{name}: error against time of all quality tweaks", svg, link_of(name, study))


def over(page, found):
    rows = []
    for name, steps in found.items():
        for study in steps.get("over", {}).get("studies", []):
            own = own_row(study)
            for row in compared(study) if own else []:
                worst = row.get("worst", {"rmse": None, "view": ""})
                rows.append(["*" if row["pareto"] else "", name, setting(row, own), f"{row['ms']:.3g}",
                             row["verdict"] or "", number(row["rmse"]), number(worst["rmse"]), worst["view"]])
    if not rows:
        return
    page.heading("Over all presets")
    page.text("The main preset's own setting, what beat it there, and what lies between, in all presets of the scene: the root "
              "mean square of their errors, the mean of their times, and where the error is the worst.")
    page.table(["", "scene", "setting", "ms", "time", "RMSE", "worst", "in"], rows)


def better(rows, own):
    """What beats the preset's own value, most of all in error."""
    beats = [row for row in rows if row["rmse"] is not None and row is not own
             and row["verdict"] in ("faster", "not told apart") and row["rmse"] <= own["rmse"]]
    best = min(beats, key=lambda row: (row["rmse"], row["ms"]), default=None)
    return f"no: {best['value']} has {number(best['rmse'])} in {number(best['ms'])} ms" if best else "no"


def alone(page, found):
    rows = []
    for name, study in studies_alone(found):
        own = own_row(study)
        if own is None or is_idle(study):
            continue
        star = "yes" if own["pareto"] else better(study["rows"], own)
        rows.append([name, study["knob"], own["value"], ("~" if own["near_reference"] else "") + number(own["rmse"]),
                     number(own["flip"]), number(study["own_error"] if study["reference_error"] else None), f"{own['ms']:.3g}", interval(own), star,
                     number(study["order"])])
    if rows:
        page.heading("Every tweak alone")
        page.text("The main preset's value of each quality tweak, all else as the preset has it.")
        page.table(["scene", "tweak", "value", "RMSE", "FLIP", "own error of the reference", "ms", "95 of 100 within",
                    "on the frontier", "order"], rows)


def told_times(study):
    """The values that are told to take another time than the preset's own."""
    told = [f"{row['value']} is {row['verdict']}" for row in compared(study) if row["verdict"] in ("faster", "slower")]
    return ", ".join(told) or "not told apart"


def idle(page, found):
    rows = [[name, study["knob"], ", ".join(row["value"] for row in compared(study)), told_times(study),
             ", ".join(changed_by(found[name], study["knob"])) if "elsewhere" in found[name] else "not measured"]
            for name, study in studies_alone(found) if is_idle(study)]
    if rows:
        page.heading("Tweaks that change nothing here")
        page.text("None of these values changes a pixel of the main preset's picture; what may change is its time. The last column is "
                  "where they do: other presets of the scene, or else the main one with another value of a menu.")
        page.table(["scene", "tweak", "values", "time", "changes the picture of"], rows)


def nearest_other(studies):
    """Of a scene's menus, how far from the reference its nearest other method stays: "cone of shadows, 0.0004"."""
    found = [(row["rmse"], f"{row['value']} of {study['knob']}, {number(row['rmse'])}") for study in studies
             for row in compared(study) if not re.fullmatch(r"[-+.e\d]+", row["value"]) and row["rmse"] > 0]
    return min(found)[1] if found else None


# Why two ways to one truth differ, where that is known: looked into, picture by picture.
DIFFER = {
    ("analytic", "bounces"): "The textbook is wrong, as the scene is there to show: its quartic meets the ring where there is "
                             "none, and rays that start a fixed 1 mm off what they leave still meet it. With the robust form "
                             "of these two alone the pictures differ by 3e-4 instead of 0.02.",
    ("deep_ocean", "marchSteps"): "The march takes steps of no less than a third of a pixel, and passes by what is thinner; "
                                  "without that the two agree to 1e-6.",
    ("sea", "seaSteps"): "The march goes a fifth farther than the slope of the waves allows at worst, and passes by some "
                         "crests; without that the two agree to 1e-6.",
    ("water", "marchSteps"): "The march goes 1.4 times as far as is safe (overstep), however many steps it has; that is all of "
                             "the difference: alone, overstep has the same error.",
}


def seconds(page, found):
    studies = {name: steps["alone"]["studies"] for name, steps in found.items() if steps.get("alone", {}).get("studies")}
    if not studies:
        return
    rows = [[name, s["knob"], s["reference"], s["rival"]["value"], number(s["rival"]["rmse"]), number(s["own_error"]),
             number(s["rival"]["own_error"]), "no" if s["rival"]["disagrees"] else "yes"]
            for name, list_ in studies.items() for s in list_ if s["rival"]]
    page.heading("Second references")
    page.text("Where a scene has two independent ways to one truth, both are drawn. They agree when they differ by no more "
              "than both claim as their own errors.")
    page.table(["scene", "tweak", "reference", "second", "differ by", "the one claims", "the other", "agree"], rows)
    for name, list_ in studies.items():
        for study in list_:
            why = DIFFER.get((name, study["knob"]))
            if why and study["rival"] and study["rival"]["disagrees"]:
                page.text(f"{name}'s {study['knob']}: {why}")
    for name in studies.keys() - {row[0] for row in rows}:
        other = nearest_other(studies[name])
        page.text(f"{name} has none: its tweaks count samples and steps of one method, whose reference is measured by twice "
                  "the work" + (f"; the nearest other method is no way to the same truth ({other})." if other else "."))


def methods(page, found):
    rows = []
    for name, study in studies_alone(found):
        if all(re.fullmatch(r"[-+.e\d]+", row["value"]) for row in study["rows"]):
            continue
        for row in study["rows"]:
            error = row.get("failed") or ("~" if row["near_reference"] else "") + number(row["rmse"])
            rows.append([name, study["knob"], row["value"] + (", the reference" if row["is_reference"] else ""), error,
                         number(row["flip"]), f"{row['ms']:.3g}", interval(row)])
    if rows:
        page.heading("Methods")
        page.text("The menus of methods, whole.")
        page.table(["scene", "tweak", "method", "RMSE", "FLIP", "ms", "95 of 100 within"], rows)


def features(page, found):
    rows, hidden = [], []
    for name, steps in found.items():
        costs = []
        for study in steps.get("features", {}).get("studies", []):
            with_it, without = study["rows"][:2]
            if with_it["ms"] and without["ms"]:
                costs.append((1 - without["ms"] / with_it["ms"], study["knob"], with_it, without))
        for share, knob, with_it, without in sorted(costs, key=lambda cost: -cost[0]):
            if share > CLEAR and without["verdict"] == "faster":
                rows.append([name, knob, with_it["value"], f"{with_it['ms']:.3g}", f"{without['ms']:.3g}", f"{share:.0%}"])
            else:
                hidden.append(f"{name}'s {knob}")
    if rows:
        page.heading("What each feature costs")
        page.text("The frame at the main preset, and with this one tweak off: what is switched off is compiled out.")
        page.table(["scene", "feature", "value", "ms", "ms without", "gives back"], rows)
        page.text(f"Not told to give back more than {CLEAR:.0%}: {', '.join(hidden)}." if hidden else "")


def link_of(name, study):
    return (DIAGRAMS / f"{name}-{study['knob']}.svg").as_posix()


def diagrams(found):
    """(link, SVG) of all that have one."""
    for name, steps in found.items():
        for step in ("joint", "alone"):
            for study, svg in zip(steps.get(step, {}).get("studies", []), steps.get(step, {}).get("svgs", [])):
                if svg:
                    yield link_of(name, study), svg


def gallery(page, found):
    shown = [(name, study, svg) for name, steps in found.items()
             for study, svg in zip(steps.get("alone", {}).get("studies", []), steps.get("alone", {}).get("svgs", [])) if svg]
    if shown:
        page.heading("Diagrams of every tweak alone")
    for name, study, svg in shown:
        page.heading(f"{name}: {study['knob']}", 3)
        page.diagram(f"{name}: error of {study['knob']} against time", svg, link_of(name, study))


def over_line(name, study):
    """Whether what a budget chooses over all presets is the main preset's own setting."""
    best, own = chosen(study), own_row(study)
    if not best or not own:
        return ""
    if best is own or best["rmse"] >= own["rmse"]:
        return "its own"
    return f"{turned(best, own)}: {best['rmse'] / own['rmse']:.0%} of the error"


def why_not(steps, own):
    """Why nothing beats the preset's own setting, as far as the figures tell."""
    alone_ = [(row["rmse"], study, row) for study in steps.get("alone", {}).get("studies", []) for row in [own_row(study)] if row]
    why = ["on the frontier"] if own["pareto"] else []
    share, study, row = max(alone_, key=lambda one: one[0], default=(0.0, None, None))
    more = [other for other in study["rows"] if other["rmse"] is not None and other["rmse"] < row["rmse"]] if study else []
    next_ = max(more, key=lambda other: other["rmse"], default=None)
    if next_ and next_["verdict"] == "slower" and share > 0.5 * own["rmse"]:
        why.append(f"its error is that of {study['knob']}={row['value']}, and {next_['value']} takes longer")
    return f"no: {'; '.join(why)}" if why else "no"


def budget_lines(found):
    """A line for each way in which a scene's own setting is beaten, or one that says that it is not."""
    for name, study, joint_own in joints(found):
        over = next((over_line(name, s) for s in found[name].get("over", {}).get("studies", [])), "")
        ways = [(f"{share:.0%} of the {what}", row, own)
                for what, (share, row, own) in (("error", nearest(found[name])), ("time", quickest(found[name]))) if row]
        for how, row, own in ways or [(why_not(found[name], joint_own), None, joint_own)]:
            begin = [name, f"{own['ms']:.3g}", number(own["rmse"]), number(own["flip"]), how]
            told = [f"{row['ms']:.3g}", row["verdict"], number(row["rmse"]), number(row["flip"]), turned(row, own)] if row else [""] * 5
            yield [*begin, *told, over]


def beaten(page, found):
    lines = list(budget_lines(found))
    if not lines:
        return
    page.heading("Beside the presets' own settings")
    page.text("A joint setting of its quality tweaks beats a preset's own with an error that is told to "
              "be less (wherever the truth lies within its own error: by what two settings have in common both are off "
              "alike), and no more FLIP, in a time that is not told to be more, nor is its median by 2.5%, or in a time that "
              "is told to be less, and by 1%, with the same error, to 1% of RMSE and of FLIP; “no”: none of those that were "
              "tried does, with what the figures say of it. The last column is what has the least error over all presets "
              "of the scene in no more time, of the own setting and those that beat it.")
    page.table(BUDGETS, lines)


def between(text, name, content):
    """The text with this between its marks; without them as it is."""
    begin, end = (text.find(mark) for mark in (f"<!-- {name} -->\n", f"<!-- end of {name} -->\n"))
    if begin < 0 or end < begin:
        return text
    return text[:begin] + f"<!-- {name} -->\n" + content + text[end:]


def budgets(found):
    """What beats the presets' own settings, as a table."""
    lines = [BUDGETS, ["---"] * len(BUDGETS), *budget_lines(found)]
    return (f"`tests/report`, {when(found)}, `glint study PRESET {' '.join(next(joint_options(found), []))}`:\n\n"
            + "".join(f"| {' | '.join(line)} |\n" for line in lines))


def joint_options(found):
    for name, study, own in joints(found):
        yield [word for word in found[name]["joint"].get("options", []) if not word.startswith("--reference")]


def update_performance(page, found):
    """What a budget finds, and some diagrams; a page without the marks stays as it is."""
    if not page.exists():
        return
    pictures = "".join(f"![{name}: error against time]({DIAGRAMS.as_posix()}/{name}.svg)\n"
                       for name in SHOWN if (page.parent / DIAGRAMS / f"{name}.svg").exists())
    text = between(page.read_text(), "tests/report", f"`tests/report`, {when(found)}:\n\n{pictures}")
    page.write_text(between(text, "tests/report: budgets", budgets(found)))
