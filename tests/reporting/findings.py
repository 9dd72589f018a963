"""What the report says at its head: sentences that follow from the figures."""
import math
import statistics

from measures import chosen, compared, is_idle, nearest, own_row, quickest


def number(value):
    return "" if value is None else f"{value:.3g}"


def listed(names, most=6):
    names = list(names)
    return ", ".join(names[:most]) + (f" and {len(names) - most} more" if len(names) > most else "")


def turned(row, own):
    """What differs from the preset's own setting."""
    before, after = own["value"].split(), row["value"].split()
    return ", ".join(a for a, b in zip(after, before) if a != b)


def joints(found):
    """(scene, joint study, own row) of those that have one."""
    for name, steps in found.items():
        for study in steps.get("joint", {}).get("studies", []):
            if own_row(study):
                yield name, study, own_row(study)


def alone(found):
    """(scene, study of one tweak)."""
    for name, steps in found.items():
        for study in steps.get("alone", {}).get("studies", []):
            yield name, study


def changed_by(steps, knob):
    """The views, beside the main preset's, that an idle tweak changes."""
    return steps.get("elsewhere", {}).get("changes", {}).get(knob, [])


def gains(found):
    fast, near, stars, all_ = {}, {}, [], []
    for name, study, own in joints(found):
        all_.append(name)
        if own["pareto"]:
            stars.append(name)
        for ways, (share, row, _) in ((fast, nearest(found[name])), (near, quickest(found[name]))):
            if row:
                ways[name] = share, turned(row, own)
    yield (f"Of {len(all_)} scenes, {len(stars)} ship with a setting on the joint frontier of their quality tweaks"
           + (f": {listed(stars, 9)}." if stars else "."))
    for ratios, what, of in ((fast, "an error that is told to be less, in a time that is not told to be more", "error"),
                             (near, "the same error in a time that is told to be less", "time")):
        if ratios:
            best = min(ratios, key=lambda name: ratios[name])
            share, by = ratios[best]
            yield (f"Scenes for which the search found a joint setting with {what}: {len(ratios)} ({listed(ratios, 9)}); most "
                   f"of all {best}, with {share:.0%} of its {of} by {by}.")
        else:
            yield f"For no scene the search found a joint setting with {what}."


def eyes(found):
    own = {name: row for name, _, row in joints(found)}
    if len(own) == 1:
        yield "To the eye (FLIP) " + "".join(f"{name}'s own setting is {number(row['flip'])} from its truth." for name, row in own.items())
    elif own:
        most, least = max(own, key=lambda n: own[n]["flip"]), min(own, key=lambda n: own[n]["flip"])
        yield (f"To the eye (FLIP) {most}'s own setting is the farthest from its truth, with {number(own[most]['flip'])}, "
               f"and {least}'s the nearest, with {number(own[least]['flip'])}.")
    pairs = other = 0
    for _, study, _ in joints(found):
        rows = compared(study)
        for i, a in enumerate(rows):
            for b in rows[:i]:
                pairs += 1
                other += (a["rmse"] - b["rmse"]) * (a["flip"] - b["flip"]) < 0
    yield f"Of {pairs} pairs of joint settings, FLIP and RMSE order {pairs - other} alike, and {other} the other way round."


def truth(found):
    studies = list(alone(found))
    if not studies:
        return
    idle = [(name, study["knob"]) for name, study in studies if is_idle(study)]
    nowhere = [(name, knob) for name, knob in idle if not changed_by(found[name], knob)]
    yield (f"Of {len(studies)} quality tweaks, {len(idle)} change nothing in the picture of the main preset, and "
           f"{len(nowhere)} in no other view that was tried"
           + (f": {listed(f'{name} by {knob}' for name, knob in nowhere)}." if nowhere else "."))
    rivals = [(name, study) for name, study in studies if study["rival"]]
    wrong = [f"{name}'s {study['knob']}" for name, study in rivals if study["rival"]["disagrees"]]
    yield (f"Tweaks with a second, independent way to their truth: {len(rivals)}; of these, {len(wrong)} have two that differ "
           "by more than both claim" + (f": {listed(wrong)}; why is told below." if wrong else "."))
    own = [own_row(study) for _, study in studies if own_row(study)]
    near = sum(row["near_reference"] for row in own)
    stars = sum(row["pareto"] for row in own)
    yield (f"Of the presets' own values of {len(own)} tweaks, each alone, {stars} stand on the frontier, and {near} lie within ten "
           "times of their reference's own error, so that their error is uncertain.")


def times(found):
    rows = [row for steps in found.values() for step in ("joint", "alone") for study in
            steps.get(step, {}).get("studies", []) for row in study["rows"] if row["verdict"]]
    told = sum(row["verdict"] != "not told apart" for row in rows)
    widths = [(row["ms_high"] - row["ms_low"]) / row["ms"] for row in rows if row["ms"]]
    load = [step["load"] for steps in found.values() for step in steps.values() if "load" in step]
    if rows and widths:
        yield (f"{told} of {len(rows)} values are told to be faster or slower than the preset's own; the interval of a time "
               f"is {statistics.median(widths):.1%} wide at the median, on a machine whose load was "
               f"{statistics.median(load):.1f}.")


def views(found):
    worst, kept, others = None, [], []
    for name, steps in found.items():
        for study in steps.get("over", {}).get("studies", []):
            own, best = own_row(study), chosen(study)
            if not own or not best:
                continue
            (others if best["rmse"] < own["rmse"] else kept).append(name)
            if own["rmse"] and "worst" in own:
                ratio = own["worst"]["rmse"] / own["rmse"]
                if math.isfinite(ratio) and (not worst or ratio > worst[0]):
                    worst = ratio, name, own["worst"]
    text = f"Over all presets of a scene the own setting stays the choice of {len(kept)}" + (f" ({listed(kept, 9)})" if kept else "")
    text += f"; {len(others)} would do better with another" + (f" ({listed(others, 9)})" if others else "")
    if worst:
        text += (f"; the least even is {worst[1]}'s own setting: in {worst[2]['view']} its error is {number(worst[2]['rmse'])}, "
                 f"{worst[0]:.1f} times that of all together")
    yield text + "."


def sentences(found):
    return [*gains(found), *views(found), *eyes(found), *truth(found), *times(found)]
