"""A headless Chromium, driven by its own protocol over a pipe: a page, its console, keys, mouse, touch."""
import base64
import json
import os
import pathlib
import select
import shutil
import subprocess
import tempfile
import time

from ended import Ended

BROWSERS = ["chromium-headless-shell", "chromium"]
FLAGS = ["--headless", "--no-sandbox", "--disable-dev-shm-usage", "--disable-gpu-watchdog", "--use-gl=angle",
         "--autoplay-policy=no-user-gesture-required", "--hide-scrollbars", "--no-first-run", "--remote-debugging-pipe"]
DRIVERS = {"swiftshader": ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
           "llvmpipe": ["--use-angle=gl-egl", "--ignore-gpu-blocklist"]}

KEYS = {"Tab": 9, "Enter": 13, "Escape": 27, " ": 32, "Home": 36, "ArrowLeft": 37, "ArrowUp": 38, "ArrowRight": 39, "ArrowDown": 40, "a": 65}


def program():
    """The browser's name, or None."""
    return next(filter(shutil.which, BROWSERS), None)


class Failed(Exception):
    """The browser, or a page in it, did what it should not."""


class Browser:
    def __init__(self, driver="llvmpipe"):
        self.folder = tempfile.TemporaryDirectory()
        to_them, self.to = os.pipe()
        self.of, from_them = os.pipe()

        def place():  # where the browser looks for them
            os.dup2(to_them, 103), os.dup2(from_them, 104)
            os.dup2(103, 3), os.dup2(104, 4)
        self.process = Ended(
            [program(), *FLAGS, *DRIVERS[driver], f"--user-data-dir={self.folder.name}/data"], preexec_fn=place,
            pass_fds=(to_them, from_them, 3, 4), env={**os.environ, "HOME": self.folder.name},
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_them), os.close(from_them)
        self.driver, self.number, self.rest, self.told = driver, 0, b"", []

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.close()
        os.close(self.to), os.close(self.of)
        for _ in range(20):  # its children may still write
            try:
                return self.folder.cleanup()
            except OSError:
                time.sleep(0.1)

    def messages(self, seconds):
        """Those that have come, waiting at most so long for the first."""
        if b"\0" not in self.rest and select.select([self.of], [], [], seconds)[0]:
            self.rest += os.read(self.of, 1 << 20) or self.lost()
        *whole, self.rest = self.rest.split(b"\0")
        return map(json.loads, whole)

    def lost(self):
        raise Failed("the browser ended")

    def ask(self, method, session=None, seconds=120, **parameters):
        self.number += 1
        message = {"id": self.number, "method": method, "params": parameters}
        if session:
            message["sessionId"] = session
        data = json.dumps(message).encode() + b"\0"
        while data:
            data = data[os.write(self.to, data):]
        answer, end = None, time.monotonic() + seconds
        while answer is None:
            if time.monotonic() > end:
                raise Failed(f"{method}: no answer within {seconds} s")
            for one in self.messages(1):
                if one.get("id") == self.number:
                    answer = one
                elif "method" in one:
                    self.told.append(one)
        if "error" in answer:
            raise Failed(f"{method}: {answer['error']['message']}")
        return answer["result"]

    def page(self, file, size=(1280, 800), ratio=1, touch=False, hash="", before=""):
        return Page(self, pathlib.Path(file).resolve().as_uri() + hash, size, ratio, touch, before)


class Page:
    """One tab. `before` is a script that runs before those of the page."""

    def __init__(self, browser, address, size, ratio, touch, before):
        self.browser = browser
        self.target = browser.ask("Target.createTarget", url="about:blank")["targetId"]
        self.session = browser.ask("Target.attachToTarget", targetId=self.target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.ask(f"{domain}.enable")
        self.resize(size, ratio, touch)
        if before:
            self.ask("Page.addScriptToEvaluateOnNewDocument", source=before)
        self.ask("Page.navigate", url=address)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.browser.ask("Target.closeTarget", targetId=self.target)

    def ask(self, method, **parameters):
        return self.browser.ask(method, self.session, **parameters)

    def resize(self, size, ratio=1, touch=False):
        self.ask("Emulation.setDeviceMetricsOverride", width=size[0], height=size[1], deviceScaleFactor=ratio, mobile=touch)
        if touch:
            self.ask("Emulation.setTouchEmulationEnabled", enabled=True)

    def run(self, script, seconds=120):
        """The value of an expression, awaited."""
        result = self.ask("Runtime.evaluate", expression=script, awaitPromise=True, returnByValue=True, seconds=seconds)
        if "exceptionDetails" in result:
            details = result["exceptionDetails"]
            raise Failed(details.get("exception", {}).get("description", details["text"]))
        return result["result"].get("value")

    def wait(self, condition, seconds=60):
        end = time.monotonic() + seconds
        while not self.run(f"!!(document.readyState === 'complete' && window.glint && ({condition}))"):
            if time.monotonic() > end:
                raise Failed(f"waited {seconds} s for {condition}; the page says: {self.run('document.body.innerText')[:2000]}")
            time.sleep(0.05)

    def errors(self):
        """What the page complained of, and what it asked the network for."""
        found = []
        for one in self.browser.told:
            if one.get("sessionId") != self.session:
                continue
            what, of = one["method"], one["params"]
            if what == "Runtime.exceptionThrown":
                found.append(of["exceptionDetails"].get("exception", {}).get("description", "?"))
            if what == "Runtime.consoleAPICalled" and of["type"] in ("error", "warning"):
                found.append(" ".join(str(a.get("value", a.get("description"))) for a in of["args"]))
            if what == "Log.entryAdded" and of["entry"]["level"] in ("error", "warning"):
                found.append(of["entry"]["text"])
            if what == "Network.requestWillBeSent" and not of["request"]["url"].startswith(("data:", "file:", "blob:")):
                found.append(f"asks for {of['request']['url']}")
        # Reading pixels is the tests' own.
        return [text for text in found if "stall due to ReadPixels" not in text]

    def mouse(self, kind, x, y):
        self.ask("Input.dispatchMouseEvent", type=f"mouse{kind}", x=x, y=y, button="left", clickCount=1,
                 buttons=0 if kind == "Released" else 1)

    def click(self, selector):
        x, y = self.middle(selector)
        self.mouse("Pressed", x, y)
        self.mouse("Released", x, y)

    def middle(self, selector):
        return self.run(f"(() => {{ const b = document.querySelector({json.dumps(selector)}).getBoundingClientRect();"
                        " return [b.x + b.width / 2, b.y + b.height / 2]; })()")

    def key(self, kind, name, **more):
        self.ask("Input.dispatchKeyEvent", type=f"key{kind}", windowsVirtualKeyCode=KEYS[name], key=name, **more)

    def tap(self, *names):
        for name in names:
            self.key("Down", name)
            self.key("Up", name)

    def type(self, selector, text):
        """In place of what stands in a field, which is left for the next one."""
        self.click(selector)
        self.key("Down", "a", modifiers=2, commands=["selectAll"])  # what Ctrl and A do is the system's to say, and there is none
        self.key("Up", "a")
        self.ask("Input.insertText", text=text)
        self.tap("Tab")

    def choose(self, selector, index):
        """Opens a menu and takes the entry of this number."""
        self.click(selector)
        self.tap("Home", *["ArrowDown"] * index, "Enter")

    def show(self, is_shown):
        """The window, or nothing of it: the page is hidden while it is the smallest."""
        window = self.ask("Browser.getWindowForTarget")["windowId"]
        self.browser.ask("Browser.setWindowBounds", windowId=window, bounds={"windowState": "normal" if is_shown else "minimized"})
        self.wait(f"document.hidden === {json.dumps(not is_shown)}")

    def touch(self, kind, *points):
        self.ask("Input.dispatchTouchEvent", type=f"touch{kind}", touchPoints=[{"x": x, "y": y} for x, y in points])

    def screenshot(self, file):
        kind = {"format": "jpeg", "quality": 85} if pathlib.Path(file).suffix == ".jpg" else {"format": "png"}
        data = self.ask("Page.captureScreenshot", **kind)["data"]
        pathlib.Path(file).write_bytes(base64.b64decode(data))

    def pixels(self, time, size):
        """The page's own picture at a time, drawn as a still is: RGB, rows from the top."""
        data = self.run(PIXELS.format(time=json.dumps(time), w=size[0], h=size[1]), seconds=300)
        rgba = base64.b64decode(data)
        row = size[0] * 4
        return b"".join(bytes(rgba[y * row + i] for i in range(row) if i % 4 != 3) for y in range(size[1] - 1, -1, -1))


PIXELS = """(async () => {{
    const {{player, seek, plan}} = glint, {{gl}} = player, canvas = gl.canvas;
    [canvas.width, canvas.height] = [{w}, {h}];
    player.resize([{w}, {h}]);
    await seek({time} ?? plan.time, true);
    const bytes = new Uint8Array({w} * {h} * 4);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.readPixels(0, 0, {w}, {h}, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
    let text = "";
    for (let i = 0; i < bytes.length; i += 8192) text += String.fromCharCode(...bytes.subarray(i, i + 8192));
    return btoa(text);
}})()"""

# A page has drawn its first picture, or has said why not.
READY = ("document.body?.classList.contains('drawn') || document.getElementById('says').className === 'error'")
