"""Drives the animation of a report.html in headless Chromium, over its DevTools.

    python tools/check_report.py runs/duck_st-1/report.html [--pictures FOLDER]

It plays, scrubs by keyboard and by mouse, points at track and strip, turns the script off, and opens the page as a
telephone and on a dark desktop. Needs the package `websockets` (scenarios/clients/requirements-report.txt). Where there
is no Chromium it says so and ends well; RHEOTAXIS_CHROMIUM names another program.
"""

import argparse
import base64
import itertools
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
import urllib.request
from pathlib import Path

FLAGS = [
    "--headless=new", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-quic",
    "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync",
    "--remote-debugging-port=0", "--window-size=1100,1000", "about:blank",
]
NAMES = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome"]


class Page:
    """A page under the control of DevTools."""

    def __init__(self, socket):
        self.socket, self.numbers = socket, itertools.count(1)

    def call(self, method, **params):
        number = next(self.numbers)
        self.socket.send(json.dumps({"id": number, "method": method, "params": params}))
        until = time.monotonic() + 30
        while time.monotonic() < until:
            answer = json.loads(self.socket.recv(timeout=30))
            if answer.get("method") == "Runtime.exceptionThrown":
                sys.exit(f"the page threw: {answer['params']['exceptionDetails']}")
            if answer.get("id") == number:
                if "error" in answer:
                    sys.exit(f"{method}: {answer['error']}")
                return answer["result"]
        sys.exit(f"{method}: no answer in 30 s")

    def value(self, script):
        result = self.call("Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in result:
            sys.exit(f"{script}: {result['exceptionDetails']}")
        return result["result"].get("value")

    def wait(self, script, what, seconds=20):
        until = time.monotonic() + seconds
        while time.monotonic() < until:
            if self.value(script):
                return
            time.sleep(0.05)
        sys.exit(f"not in {seconds} s: {what}")

    def open(self, address):
        self.call("Page.navigate", url=address)
        self.wait("document.readyState === 'complete' && location.protocol === 'file:'", "the page is loaded")

    def key(self, key, code=None):
        keys = {"key": key, "code": code or key, "windowsVirtualKeyCode": KEYS[key]}
        self.call("Input.dispatchKeyEvent", type="keyDown", **keys)
        self.call("Input.dispatchKeyEvent", type="keyUp", **keys)
        self.settle()

    def mouse(self, kind, x, y, **more):
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, **more)

    def settle(self):
        self.value("new Promise(r => requestAnimationFrame(() => requestAnimationFrame(() => r(true))))")

    def time(self):
        return float(self.value(f"{FILM}.dataset.t"))

    def ink(self, canvas):
        """What stands for the picture on a canvas."""
        return self.value(
            f"(() => {{ const c = {FILM}.querySelector('canvas.{canvas}');"
            "const d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;"
            # Means of 24 by 24 blocks: what a browser rounds differently from time to time does not count.
            "const sums = new Array(576).fill(0), n = new Array(576).fill(0);"
            "for (let y = 0; y < c.height; y++) for (let x = 0; x < c.width; x++) {"
            "const b = Math.floor(y * 24 / c.height) * 24 + Math.floor(x * 24 / c.width), k = 4 * (y * c.width + x);"
            "sums[b] += d[k] + d[k + 1] + d[k + 2]; n[b]++; }"
            "return sums.map((s, k) => s / Math.max(1, 3 * n[k])); })()"
        )

    def picture(self, folder, name):
        if folder:
            shot = self.call("Page.captureScreenshot", format="png")
            folder.mkdir(parents=True, exist_ok=True)
            (folder / f"{name}.png").write_bytes(base64.b64decode(shot["data"]))


FILM = "document.querySelector('section.film')"
KEYS = {" ": 32, "End": 35, "Home": 36, "ArrowLeft": 37, "ArrowRight": 39}


def check(true, what):
    if not true:
        sys.exit(f"failed: {what}")
    print(f"  {what}")


def same(one, other):
    return max(abs(a - b) for a, b in zip(one, other)) < 3


def show(page):
    page.value(f"{FILM}.scrollIntoView()")
    page.settle()


def desktop(page, address, folder):
    page.open(address)
    page.wait(f"{FILM} && {FILM}.dataset.ready === 'true'", "the animation is ready")
    show(page)
    page.picture(folder, "desktop")
    # A run without machine has no series.
    for canvas in page.value(f"[...{FILM}.querySelectorAll('canvas:not([hidden])')].map(c => c.className)"):
        seen = page.value(
            f"(() => {{ const c = {FILM}.querySelector('canvas.{canvas}');"
            "const d = new Uint32Array(c.getContext('2d').getImageData(0, 0, c.width, c.height).data.buffer);"
            "return new Set(d).size; })()"
        )
        check(seen > 20, f"{canvas}: a picture of {seen} colours")
    ends = page.time()
    whole = page.ink("plan")
    # Keys.
    page.value(f"{FILM}.querySelector('.stage').focus()")
    page.key("Home")
    begins = page.time()
    check(begins < ends and not same(page.ink("plan"), whole), "Home goes to the beginning, and the plan changes")
    page.key("ArrowRight")
    step = page.time() - begins
    check(abs(step - 0.01 * (ends - begins)) < 0.02, f"an arrow goes on by {step:.2f} s")
    page.key("ArrowLeft")
    check(abs(page.time() - begins) < 0.01, "and back")
    page.key(" ", "Space")
    page.wait(f"Number({FILM}.dataset.t) > {begins} + 0.3", "the animation plays")
    check(page.value(f"{FILM}.dataset.playing") == "true", "Space plays")
    page.key(" ", "Space")
    stopped = page.time()
    time.sleep(0.3)
    check(page.time() == stopped, "and pauses")
    page.key("End")
    check(page.time() == ends, "End goes to the end")
    check(same(page.ink("plan"), whole), "and shows the same picture as at first")
    # The range and the button.
    page.value(f"(() => {{ const r = {FILM}.querySelector('input[type=range]');"
               "r.value = (Number(r.min) + Number(r.max)) / 2; r.dispatchEvent(new Event('input')); })()")
    page.settle()
    check(abs(page.time() - 0.5 * (begins + ends)) < 0.01 * (ends - begins), "the slider goes to the middle")
    middle = page.ink("plan")
    # The mouse on the strip.
    box = page.value(f"(() => {{ const b = {FILM}.querySelector('canvas.series').getBoundingClientRect();"
                     "return [b.left, b.top, b.width, b.height]; })()")
    if box[3] > 50:
        at = [box[0] + 52 + 0.25 * (box[2] - 64), box[1] + 50]
        page.mouse("mousePressed", *at, button="left", clickCount=1)
        page.mouse("mouseReleased", *at, button="left", clickCount=1)
        page.settle()
        share = (page.time() - begins) / (ends - begins)
        check(abs(share - 0.25) < 0.02, f"a press on the strip goes to {100 * share:.0f} % of the time")
        check(not same(page.ink("plan"), middle), "the plan shows another moment")
        page.mouse("mouseMoved", box[0] + 52 + 0.6 * (box[2] - 64), box[1] + 50)
        page.settle()
        said = page.value(f"{FILM}.querySelector('.says').innerText")
        check("pointed at" in said and " s " in said, f"under the pointer: {said[:100]}")
    page.value(f"{FILM}.querySelector('button').click()")
    page.wait(f"{FILM}.dataset.playing === 'true'", "the button plays")
    page.value(f"{FILM}.querySelector('button').click()")
    page.wait(f"{FILM}.dataset.playing === 'false'", "the button pauses")
    plumed = page.ink("plan")
    boxes = page.value(f"(() => {{ const b = {FILM}.querySelector('input[type=checkbox]');"
                       "if (!b || !b.closest('.controls')) return false; b.click(); return true; })()")
    page.settle()
    if boxes:
        check(not same(page.ink("plan"), plumed), "a tick takes something off the plan")


def dark(page, address, folder):
    page.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark"}])
    page.open(address)
    page.wait(f"{FILM} && {FILM}.dataset.ready === 'true'", "the animation is ready")
    show(page)
    page.picture(folder, "dark")
    tone = page.value("getComputedStyle(document.body).backgroundColor.match(/\\d+/g).slice(0, 3).map(Number)")
    check(sum(tone) < 200, f"dark: a page of {tone}")
    page.call("Emulation.setEmulatedMedia", media="print", features=[])
    hidden = page.value(f"getComputedStyle({FILM}).display")
    check(hidden == "none" and page.value("document.querySelectorAll('figure svg, figure img').length > 0"), "print: pictures only")
    page.call("Emulation.setEmulatedMedia", media="", features=[])


def calm(page, address):
    page.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-reduced-motion", "value": "reduce"}])
    page.open(address)
    page.wait(f"{FILM} && {FILM}.dataset.ready === 'true'", "the animation is ready")
    changes = page.value(
        f"new Promise(done => {{ const seen = new Set(); {FILM}.querySelector('button').click();"
        f"const from = performance.now(); const look = () => {{ seen.add({FILM}.dataset.t);"
        "performance.now() - from < 1600 ? requestAnimationFrame(look) : done(seen.size); }; look(); })"
    )
    check(2 <= changes <= 6, f"reduced motion: {changes} pictures in 1.6 s")
    page.call("Emulation.setEmulatedMedia", features=[])


def telephone(page, address, folder):
    page.call("Emulation.setDeviceMetricsOverride", width=390, height=844, deviceScaleFactor=3, mobile=True)
    page.call("Emulation.setTouchEmulationEnabled", enabled=True)
    page.open(address)
    page.wait(f"{FILM} && {FILM}.dataset.ready === 'true'", "the animation is ready")
    show(page)
    page.picture(folder, "telephone")
    check(page.value("document.documentElement.scrollWidth <= innerWidth + 1"), "telephone: nothing beside the screen")
    check(page.value(f"(() => {{ const c = {FILM}.querySelector('canvas.plan');"
                     "return c.width >= 2.9 * c.clientWidth; })()"), "telephone: as many pixels as its screen has")
    page.value(f"{FILM}.querySelector('canvas.series').scrollIntoView({{block: 'center'}})")
    x, y, w, h = page.value(f"(() => {{ const b = {FILM}.querySelector('canvas.series').getBoundingClientRect();"
                            "return [b.left, b.top, b.width, b.height]; })()")
    if h > 50:
        before = page.time()
        at = [{"x": x + 52 + 0.4 * (w - 64), "y": y + 50}]
        page.call("Input.dispatchTouchEvent", type="touchStart", touchPoints=at)
        page.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])
        page.settle()
        check(page.time() < before, "telephone: a finger on the strip changes the time")
    page.call("Emulation.clearDeviceMetricsOverride")
    page.call("Emulation.setTouchEmulationEnabled", enabled=False)


def without_script(page, address, folder):
    page.call("Emulation.setScriptExecutionDisabled", value=True)
    page.call("Page.navigate", url=address)
    time.sleep(1.5)
    page.picture(folder, "without_script")
    # DevTools still evaluates; the page's own scripts have not run.
    state = page.value(f"[{FILM}.hidden, !{FILM}.dataset.ready, document.querySelector('figure svg, figure img') !== null]")
    check(state == [True, True, True], "without script: no animation, but its pictures")
    page.call("Emulation.setScriptExecutionDisabled", value=False)


def main():
    words = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    words.add_argument("reports", nargs="+", type=Path)
    words.add_argument("--pictures", type=Path, help="keep screenshots in this folder")
    args = words.parse_args()
    program = os.environ.get("RHEOTAXIS_CHROMIUM") or next(filter(None, map(shutil.which, NAMES)), None)
    if program is None:
        print("SKIPPED: no Chromium here, so the animation of report.html is not tried in a browser")
        return
    from websockets.sync.client import connect

    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as home:
        browser = subprocess.Popen([program, f"--user-data-dir={home}", *FLAGS], stderr=subprocess.DEVNULL)
        try:
            port_file = Path(home) / "DevToolsActivePort"
            until = time.monotonic() + 60
            while not (port_file.exists() and port_file.read_text().count("\n")):
                if browser.poll() is not None or time.monotonic() > until:
                    sys.exit(f"{program} opens no DevTools port within 60 s")
                time.sleep(0.1)
            port = int(port_file.read_text().splitlines()[0])
            with urllib.request.urlopen(f"http://127.0.0.1:{port}/json/list", timeout=20) as listed:
                target = next(t for t in json.load(listed) if t["type"] == "page")
            with connect(target["webSocketDebuggerUrl"], max_size=None) as socket:
                page = Page(socket)
                page.call("Page.enable")
                page.call("Runtime.enable")
                for report in args.reports:
                    print(report)
                    address = report.resolve().as_uri()
                    folder = args.pictures and args.pictures / report.resolve().parent.name
                    desktop(page, address, folder)
                    dark(page, address, folder)
                    calm(page, address)
                    telephone(page, address, folder)
                    without_script(page, address, folder)
        finally:
            browser.terminate()
            browser.wait(timeout=20)
    print("the animation does what it should")


main()
