"""What the report measures, and how it is kept: a step that was measured by the same program of the same texts is not
measured again."""
import datetime
import hashlib
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import time

REPOSITORY = pathlib.Path(__file__).resolve().parent.parent.parent
# Modest: nine scenes are to be done within 40 minutes of two idle cores. Errors do not depend on how many
# frames are timed, and hardly on the size. Seconds are of timing a tweak; a search has four times as many.
# What is to beat a preset is sought in a picture that is large enough: in a small one most of a frame is work that is the
# same for all settings, such as maps and simulations, and what is found there is slower where it is used.
JOINT = {"--ms": "own", "--size": "320x180", "--seconds": "5"}
NEAR = {"--flip": "own", "--size": "320x180", "--seconds": "4"}   # from the same truth: the least time
OVER = {"--ms": "own", "--over": "presets", "--size": "96x54", "--seconds": "2"}
ALONE = {"--size": "96x54", "--seconds": "2"}
FEATURES = {"--metric": "time", "--size": "96x54", "--seconds": "1"}
# Where else a tweak changes the picture that changes none of the main preset's. In a small picture a march meets the same
# pixels whatever its stride is.
ELSEWHERE = {"--metric": "error", "--size": "320x180"}
MOST_SECONDS = 400   # of one step of a scene, which then goes on at the next call; on two idle cores none takes half of that
# Rays through a pixel, which are the most of an error at this size, so that the truth needs many: it is to be ten
# times nearer than one ray is. Each adds rays of shadow of its own, of which it then needs few. llvmpipe ends the
# loops of a pixel after 65,535 turns together, which all references at once would need.
TRUTHS = {"analytic": ["antialiasing=64", "bounces=48", "shadowSamples=2"],
          "boat": ["antialias=192", "sunSamples=2", "substeps=16"],
          "caustics": ["settle=63"],   # frames of photons, of which each takes eight times that of any other method
          "christmas": ["mirrorBlur=10000"],   # never
          "deep_ocean": ["antialias=32", "shaftSamples=128"],
          "water": ["antialias=128"]}
TRUTHS_ALONE = {"analytic": ["antialiasing=128"], "boat": ["antialias=64"], "caustics": ["settle=63"],
                "deep_ocean": ["antialias=64"], "water": ["antialias=128"]}
# Under caustics' low sun a frame of photons takes four seconds. Every setting that is compared there is one of `area`, whose
# own limit is the truth of its cells and samples; beside photons it stands alone.
TRUTHS_OVER = {**TRUTHS, "caustics": ["method=area"],
               "christmas": ["mirrorBlur=10000", "acceleration=hierarchy"],   # else 1,024 ornaments take all turns
               "sea": ["mirrorRays=32", "sunSamples=32"]}
# What a search turns where that is not all of it. The loop of `periodic` is made for half a minute at each try, and each
# method is compiled for seconds; to be as near as `area`, no other comes into question ("methods" has them all).
TURNED = {"joint": {"caustics": ["method=snell,area", "cells", "shaftSamples"]},
          "near": {"caustics": ["method=area", "cells", "shaftSamples"]}}


def scenes(folder, names):
    """(name, main preset or scene) of each scene of a tree, or of the named ones."""
    files = sorted((folder / "fragments").glob("*.frag"))
    unknown = set(names) - {file.stem for file in files}
    if unknown:
        sys.exit(f"There is no scene {', '.join(sorted(unknown))} in fragments/.")
    for file in files:
        preset = folder / "presets" / (file.stem + ".toml")
        if not names or file.stem in names:
            yield file.stem, preset if preset.exists() else file


MEASURED = ["host", "fragments", "presets"]   # what figures hang on
UNSEEN = "host/window"                        # but for this


def git(*words):
    try:
        return subprocess.run(["git", "-C", REPOSITORY, *words], capture_output=True, text=True).stdout.strip()
    except FileNotFoundError:   # a machine without git
        return ""


def commit():
    """What is measured, "+" where it is not committed as it stands."""
    return (git("rev-parse", "--short", "HEAD") or "unknown") + ("+" if git("status", "--porcelain", "--", *MEASURED) else "")


def program(repository=REPOSITORY):
    """A digest of the program's text, which figures hang on as well: the commit alone would say that they are old
    when a page was edited."""
    digest = hashlib.sha256()
    for file in sorted((repository / "host").rglob("*")):
        if file.is_file() and repository / UNSEEN not in file.parents:
            digest.update(file.relative_to(repository).as_posix().encode() + b"\n" + file.read_bytes())
    return digest.hexdigest()[:12]


def processor_since(before):
    """Seconds of all calls since then."""
    return sum(os.times()[2:4]) - sum(before[2:4])


def taken(before, began):
    """What a step took since then, and beside what."""
    return {"load": os.getloadavg()[0], "wall_s": time.monotonic() - began, "processor_s": processor_since(before)}


def failed(reason):
    return {"failed": reason, "studies": [], "svgs": []}


class Kept:
    """A folder of what was measured, with one in it for each program, so that no report is of two. Each step of a scene
    stands in a file of its own, whole or not at all; within a step `glint study -o` goes on where it was stopped. `more`:
    options that win over those of a step. After so many `minutes` nothing more is begun."""

    def __init__(self, folder, glint, tree, more=None, minutes=math.inf):
        self.folder, self.glint, self.tree, self.more = folder / program(), glint, tree, more or {}
        self.end = time.monotonic() + 60 * minutes
        self.folder.mkdir(parents=True, exist_ok=True)

    def texts(self, name):
        """What a scene's figures hang on, beside the program: its text and its presets."""
        presets = sorted((self.tree / "presets").glob(name + "*.toml"))
        return b"".join(file.read_bytes() for file in [self.tree / "fragments" / (name + ".frag"), *presets])

    def step(self, name, file, step, options, only_kept):
        """Its studies, with when and how they were measured; why there are none, as "failed"; None where nothing is
        kept, and nothing else is wanted."""
        key = hashlib.sha256(self.texts(name) + repr(options).encode()).hexdigest()
        kept = self.folder / f"{name}-{step}.json"
        try:
            found = json.loads(kept.read_text())
            if found["key"] == key:
                return found
        except (OSError, ValueError, KeyError):
            pass
        if only_kept or time.monotonic() > self.end:
            return None
        print(f"{name}, {step}", flush=True)
        folder = self.folder / f"{name}-{'joint' if step in ('near', 'over') else step}"   # one truth
        found = {"key": key, "date": str(datetime.date.today()), "options": options,
                 **(self.elsewhere if step == "elsewhere" else self.measure)(folder, file, options)}
        if "failed" not in found:
            being_written = kept.with_suffix(".part")
            being_written.write_text(json.dumps(found))
            being_written.replace(kept)
        return found

    def study(self, *words):
        """What `glint study` tells of these, and why it tells nothing."""
        try:
            result = subprocess.run([self.glint, "study", *words, "--json"], capture_output=True, text=True, timeout=MOST_SECONDS)
        except subprocess.TimeoutExpired:
            return None, f"ended after {MOST_SECONDS} s; another call goes on from there"
        if result.returncode != 0:
            return None, (result.stderr.strip().splitlines() or ["no reason is given"])[-1]
        return json.loads(result.stdout), None

    def measure(self, folder, file, options):
        before, began = os.times(), time.monotonic()
        told, reason = self.study(file, "-o", folder, *options)
        if reason:
            return failed(reason)
        sections = re.split(r"<h2 id=s\d+>", (folder / "index.html").read_text())[1:]
        svgs = [re.search(r"<svg.*?</svg>", section, re.S) for section in sections]
        return {"studies": told["studies"], "svgs": [svg and svg.group() for svg in svgs], **taken(before, began)}

    def elsewhere(self, _, file, options):
        """Where tweaks change the picture, by tweak: presets of the scene, or, where no preset does, menus of the main one."""
        changes, before, began = {}, os.times(), time.monotonic()
        for views in (self.other_presets(file), self.other_menus(file)):
            left = [word for word in options if word.split("=")[0] != "--vary" or word.split("=")[1] not in changes]
            for view, words in views if any(word.startswith("--vary=") for word in left) else []:
                told, reason = self.study(*words, *left)
                if reason:
                    return failed(reason)
                for study in told["studies"]:
                    if not is_idle(study):
                        changes.setdefault(study["knob"], []).append(view)
        return {"studies": [], "svgs": [], "changes": changes, **taken(before, began)}

    def other_presets(self, file):
        """(name, words for study) of the scene's presets but the main one."""
        return [(preset.stem, [preset]) for preset in sorted((self.tree / "presets").glob(file.stem + "*.toml")) if preset != file]

    def other_menus(self, file):
        """As other_presets() of the main preset with another value of one menu of its quality."""
        return [(f"{tweak['name']}={name}", [file, f"--tweak={tweak['name']}={name}"])
                for tweak in self.tweaks(file) if tweak.get("quality")
                for value, name in enumerate(tweak.get("names") or []) if value != tweak["value"]]

    def tweaks(self, file):
        info = subprocess.run([self.glint, "info", file, "--json"], capture_output=True, text=True, check=True)
        return json.loads(info.stdout)["tweaks"]

    def off(self, file):
        """Tweaks with a value that says off, and are not off: "NAME=own,off". Not the camera's: another view is
        no feature less."""
        for tweak in self.tweaks(file):
            value, names = tweak["value"], tweak.get("names")
            if tweak["group"] == "Camera":
                continue
            if tweak["type"] == "bool" and value:
                yield f"{tweak['name']}=on,off"
            elif names and names[0] in ("off", "none") and value:
                yield f"{tweak['name']}={names[value]},{names[0]}"
            elif not names and tweak["type"] in ("float", "int") and tweak["min"] == 0 and value:
                yield f"{tweak['name']}={value},0"

    def options(self, name, file, step, found):
        """What a step of a scene is measured with, or None where there is nothing to measure."""
        truth, alone, all_ = ([f"--reference={item}" for item in list_.get(name, [])]
                              for list_ in (TRUTHS, TRUTHS_ALONE, TRUTHS_OVER))
        if step != "features" and not any(tweak.get("quality") for tweak in self.tweaks(file)):
            return None
        turned = [f"--vary={item}" for item in TURNED.get(step, {}).get(name, [])]
        if step == "joint":
            return self.words(JOINT) + truth + turned
        if step == "near":
            return self.words(NEAR) + truth + turned
        if step == "alone":
            return self.words(ALONE) + alone
        if step == "over":
            few = [f"--vary={item}" for item in few_settings(found)]
            return self.words(OVER) + all_ + few if few else None
        if step == "elsewhere":
            idle = [f"--vary={item}" for item in idle_tweaks(found)]
            return self.words(ELSEWHERE) + idle if idle else None
        off = [f"--vary={item}" for item in self.off(file)]
        return self.words(FEATURES) + off if off else None

    def words(self, options):
        return [word for pair in {**options, **self.more}.items() for word in pair]


STEPS = ["joint", "near", "alone", "over", "elsewhere", "features"]   # what is worth most for its time is measured first, of all scenes


def measured(kept, names, only_kept):
    """By scene, its steps by name."""
    found = {name: {} for name, _ in scenes(kept.tree, names)}
    for step in STEPS:
        for name, file in scenes(kept.tree, names):
            options = kept.options(name, file, step, found[name])
            result = kept.step(name, file, step, options, only_kept) if options else None
            if result is None:
                continue
            if "failed" in result:
                print(f"{name}, {step}: {result['failed']}", file=sys.stderr)
            found[name][step] = result
    return found


def own_row(study):
    """The preset's own setting, if it has an error."""
    return next((row for row in study["rows"] if row["is_preset"] and row["rmse"] is not None), None)


def compared(study):
    return [row for row in study["rows"] if row["rmse"] is not None]


def is_idle(study):
    """Whether no value of the tweak changes the picture."""
    rows = compared(study)
    return bool(rows) and all(row["max"] == 0 for row in rows)


def idle_tweaks(found):
    """The least and the most of each tweak that is idle in the main preset, as "NAME=a,b"."""
    for study in found.get("alone", {}).get("studies", []):
        if is_idle(study):
            rows = compared(study)
            yield f"{study['knob']}={rows[0]['value']},{rows[-1]['value']}"


def is_no_farther(row, than, *measures):
    """Whether nobody would tell it from the other by these errors, or it has less: 1 % is nothing to see."""
    return all(row[measure] <= 1.01 * than[measure] for measure in measures)


def as_fast(study, own):
    """The least error, told to be less and to the eye no more, that is not told to take longer than the preset's own
    setting. On a busy machine much is not told apart; whose median is longer by more than 2.5 %, which study asks no further
    for, is no gain."""
    rows = [row for row in compared(study) if row["verdict"] in ("faster", "not told apart") and row["ms"] <= 1.025 * own["ms"]
            and row["nearer"] and 1.01 * row["rmse"] < own["rmse"] and is_no_farther(row, own, "flip")]
    return min(rows, key=lambda row: (row["rmse"], row["ms"]), default=None)


def as_near(study, own):
    """The least time that is told to be less, at the same error; less than a percent, told or not, is no gain."""
    rows = [row for row in compared(study) if row["verdict"] == "faster" and row["ms"] <= 0.99 * own["ms"]
            and is_no_farther(row, own, "rmse", "flip")]
    return min(rows, key=lambda row: row["ms"], default=None)


def best_of(steps, choose, what):
    """The row that `choose` takes, of either search, with the least share of what the preset's own setting has in the
    same one; that share, and that own row."""
    found = [(row[what] / own[what], row, own) for step in ("joint", "near") for study in steps.get(step, {}).get("studies", [])
             for own in [own_row(study)] if own for row in [choose(study, own)] if row]
    return min(found, key=lambda one: one[0], default=(1.0, None, None))


def nearest(steps):
    """The least share of the preset's own error that comes in its time, by either search: as best_of()."""
    return best_of(steps, as_fast, "rmse")


def quickest(steps):
    """The least share of the preset's own time that has its error, by either search: as best_of()."""
    return best_of(steps, as_near, "ms")


def chosen(study):
    """The row that a budget of the own time has chosen, if any."""
    best = study.get("best")
    return study["rows"][best["row"]] if best else None


def few_settings(found):
    """The values of the preset's own setting and of the one that beats it, as "NAME=a,b"; of one tweak at least."""
    study = next(iter(found.get("joint", {}).get("studies", [])), None)
    own = own_row(study) if study else None
    if not own:
        return []
    values = {}
    for row in (own, nearest(found)[1] or quickest(found)[1]):
        for part in (row["value"].split() if row else []):
            name, value = part.split("=")
            values.setdefault(name, [])
            if value not in values[name]:
                values[name].append(value)
    return [f"{name}={','.join(list_)}" for name, list_ in values.items()]
