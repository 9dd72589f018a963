"""The corpus: Shadertoys of our own, each drawn as `glint` and as the site would.

shaders/NAME.glsl is a text of one tab; NAME.toml beside it is its preset: channels, time, date, events. A folder
holds several tabs, as `glint import` reads them; with an inputs.json, which says what each tab reads, it
is imported through the site's JSON instead, its two dialects in turn. Its preset is preset.toml.
"""
import dataclasses
import json
import os
import pathlib
import shutil
import subprocess
import tomllib

SHADERS = pathlib.Path(__file__).resolve().parent / "shaders"
WIDTH, HEIGHT = 128, 72
FPS = 60
FRAME = 20                                    # where a preset names no time

TABS = ["common", "bufferA", "bufferB", "bufferC", "bufferD", "cubeA", "image"]   # as the site draws them
IDS = {"bufferA": (257, "4dXGR8"), "bufferB": (258, "XsXGR8"), "bufferC": (259, "4sXGR8"),
       "bufferD": (260, "XdfGR8"), "cubeA": (41, "4dX3Rr"), "keyboard": (33, "4dXGRr"), "image": (37, "4dfGRr")}


@dataclasses.dataclass
class Toy:
    name: str
    file: pathlib.Path                        # what glint draws
    tabs: list                                # {"name", "code", "inputs"} in the order of TABS
    frame: int
    preset: dict


class Failed(Exception):
    """A command of ours that should have worked."""


def run_glint(glint, *arguments, env=None):
    done = subprocess.run([glint, *map(str, arguments)], capture_output=True, env={**os.environ, **(env or {})})
    if done.returncode != 0:
        raise Failed(f"glint {arguments[0]} ended with {done.returncode}: {done.stderr.decode(errors='replace')}")
    return done.stdout


def picture(glint, file, frame, env=None):
    """The bytes of one frame, RGB, rows from the top."""
    pixels = run_glint(glint, "sequence", file, "-o", "-", "--frames", f"{frame}:{frame}", "--fps", FPS,
                       "--size", f"{WIDTH}x{HEIGHT}", env=env)
    if len(pixels) != WIDTH * HEIGHT * 3:
        raise Failed(f"{len(pixels)} bytes are no picture of {WIDTH}x{HEIGHT}")
    return pixels


def toys(glint, folder):
    """All of them, copied into the folder; those of several tabs are imported there."""
    shutil.copytree(SHADERS, folder, dirs_exist_ok=True)
    folders = sorted(path for path in folder.iterdir() if path.is_dir())
    singles = sorted(folder.glob("*.glsl"))
    return ([single_tab(file) for file in singles] +
            [several_tabs(glint, path, dialect=i % 2) for i, path in enumerate(folders)])


def read_preset(file):
    return tomllib.loads(file.read_text()) if file.exists() else {}


def frame_of(preset):
    return round(preset["time"] * FPS) if "time" in preset else FRAME


def read_code(file):
    with open(file, encoding="utf-8-sig", newline="") as text:
        return text.read()


def single_tab(file):
    preset_file = file.with_suffix(".toml")
    preset = read_preset(preset_file)
    inputs = [channel_input(int(name[-1]), channel) for name, channel in preset.get("channels", {}).items()]
    return Toy(name=file.stem, file=preset_file if preset else file, frame=frame_of(preset), preset=preset,
               tabs=[{"name": "image", "code": read_code(file), "inputs": inputs}])


def channel_input(number, channel):
    """A channel of a preset, with the defaults of the site."""
    kind = next(kind for kind in ("image", "noise", "keyboard") if kind in channel)
    keyboard = kind == "keyboard"
    return {"channel": number, "ctype": kind, "what": channel[kind],
            "filter": channel.get("filter", "nearest" if keyboard else "mipmap"),
            "wrap": channel.get("wrap", "clamp" if keyboard else "repeat"),
            "vflip": channel.get("vflip", True)}


def tab_name(file):
    words = file.stem.lower().replace(" ", "")
    return next(tab for tab in TABS if tab.lower() == words)


def tabs_of(folder):
    """The tabs in the order of TABS; without an inputs.json, iChannel0 to 3 are the buffers A to D."""
    codes = {tab_name(file): read_code(file) for file in folder.glob("*.glsl")}
    buffers = [tab for tab in codes if tab.startswith("buffer")]
    by_letter = [{"channel": ord(tab[-1]) - ord("A"), "ctype": "buffer", "id": tab, "filter": "linear",
                  "wrap": "clamp"} for tab in buffers]
    inputs_file = folder / "inputs.json"
    inputs = json.loads(inputs_file.read_text()) if inputs_file.exists() else dict.fromkeys(codes, by_letter)
    return [{"name": tab, "code": codes[tab], "inputs": inputs.get(tab, [])} for tab in TABS if tab in codes]


def several_tabs(glint, folder, dialect):
    tabs = tabs_of(folder)
    source = folder
    if (folder / "inputs.json").exists():
        source = folder.with_suffix(".json")
        source.write_text(json.dumps(site_json(folder.name, tabs, dialect)))
    scene = folder.with_suffix(".frag")
    run_glint(glint, "import", source, "-o", scene)
    preset_file = folder / "preset.toml"
    preset = read_preset(preset_file)
    file = scene
    if preset:
        file = folder.with_suffix(".toml")
        file.write_text(f'scene = "{scene.name}"\n' + preset_file.read_text())
    return Toy(name=folder.name, file=file, tabs=tabs, frame=frame_of(preset), preset=preset)


def site_json(title, tabs, dialect):
    """The site's file of a shader: dialect 0 is that of its interface for programs, 1 that of its downloads."""
    def source(one):
        what = one.get("id", one["ctype"])
        sampler = {"filter": one["filter"], "wrap": one["wrap"], "vflip": "true", "srgb": "false", "internal": "byte"}
        names = ("ctype", "src") if dialect == 0 else ("type", "filepath")
        return {"id": IDS[what][dialect], names[0]: one["ctype"], names[1]: "", "channel": one["channel"],
                "sampler": sampler}

    def render_pass(tab):
        kind = {"b": "buffer", "i": "image", "cu": "cubemap", "co": "common"}
        name = tab["name"]
        outputs = [{"id": IDS[name][dialect], "channel": 0}] if name in IDS else []
        return {"name": name, "type": kind.get(name[0]) or kind[name[:2]], "code": tab["code"],
                "inputs": [source(one) for one in tab["inputs"]], "outputs": outputs}

    # Buffers are drawn in the order of the file, and the image last, wherever it stands.
    shader = {"ver": "0.1", "info": {"id": "", "name": title, "username": "", "description": ""},
              "renderpass": [render_pass(tab) for tab in sorted(tabs, key=lambda tab: tab["name"] != "image")]}
    return {"Shader": shader} if dialect == 0 else {"shaders": [shader]}


def differences():
    """differences.toml: by whom: why: names"""
    return tomllib.loads((SHADERS.parent / "differences.toml").read_text())


def reason_of(table):
    """name: why"""
    return {name: why for why, names in table.items() for name in names}


def in_parallel(work, items):
    """The results in order; as many at a time as there are processors."""
    from concurrent.futures import ThreadPoolExecutor
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        return list(pool.map(work, items))
