"""How fast charts follow a slider, here: python -m tests.benchmarks.live [--minutes 2]

Starts a bare page and the app, each in a server process of its own with the project's settings,
opens them in a real Chromium, and prints a table. Both sides of a ratio are measured in turns.
"""

import argparse
import contextlib
import os
import shutil
import socket
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from urllib.error import URLError
from urllib.request import urlopen

from playwright.sync_api import Browser, Page, sync_playwright

from tests.browser.app_page import PATHS
from tests.browser.conftest import CHROMIUM_ARGS

ROOT = Path(__file__).resolve().parents[2]
REPEATS = 30

# From letting go of the slider's thumb until the line of every chart is another.
_REDRAWN = """(charts) => new Promise(resolve => {
  const lines = () => [...document.querySelectorAll('.js-plotly-plot path.js-line')]
    .map(line => line.getAttribute('d'));
  const before = new Set(lines());
  window.addEventListener('pointerup', () => {
    const start = performance.now();
    const look = () => {
      const now = lines();
      const done = now.length === charts && now.every(line => !before.has(line));
      if (done || performance.now() - start > 5000) resolve(done ? performance.now() - start : NaN);
      else requestAnimationFrame(look);
    };
    requestAnimationFrame(look);
  }, {once: true, capture: true});
})"""

# Drags a live slider up and down by itself for some milliseconds, a step a frame, and lets go.
DRAG = """([label, duration]) => new Promise(resolve => {
  const range = document.querySelector(`input[type=range][aria-label^="${label}"]`);
  const charts = [...document.querySelectorAll('.live-chart')];
  const before = charts.map(chart => Number(chart.dataset.drawn));
  const [low, high] = [Number(range.min), Number(range.max)];
  const start = performance.now();
  let blanks = 0;
  const step = now => {
    const phase = (now - start) / 4000 % 1;
    const share = 0.3 + 0.4 * Math.abs(1 - 2 * phase);
    const going = now - start < duration;
    range.value = low + share * (high - low);
    range.dispatchEvent(new Event(going ? 'input' : 'change', {bubbles: true}));
    blanks += charts.some(
      chart => !chart.querySelector('.overplot path, .annotation, .shapelayer path'));
    if (going) { requestAnimationFrame(step); return; }
    const released = performance.now();
    const wanted = range.ariaValueText;
    const look = () => {
      const app = document.querySelector('[data-testid="stApp"]');
      const slider = range.closest('.live-slider');
      const rest = app.dataset.testScriptState === 'notRunning' && !window.rotorcalcDrawing
        && slider.dataset.shown === wanted;
      if (!rest && performance.now() - released < 20000) { requestAnimationFrame(look); return; }
      const now = [...document.querySelectorAll('.live-chart')];
      resolve({
        settled: performance.now() - released,
        updates: now.map((chart, i) => Number(chart.dataset.drawn) - before[i]),
        seconds: (released - start) / 1000,
        same: now.every((chart, i) => chart === charts[i]),
        blanks,
      });
    };
    requestAnimationFrame(look);
  };
  requestAnimationFrame(step);
})"""


_RANGE = "() => [...document.querySelectorAll('.live-chart')].at(-1).layout.xaxis.range"


class Traffic:
    """What a tab's websocket has received [bytes]."""

    def __init__(self, page: Page) -> None:
        self.received = 0
        page.on("websocket", lambda socket: socket.on("framereceived", self._received))

    def _received(self, frame: bytes | str) -> None:
        self.received += len(frame)


def main() -> None:
    """Measure, and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--minutes", type=float, default=2.0, help="of the long drag")
    minutes = parser.parse_args().minutes
    with (
        tempfile.TemporaryDirectory() as folder,
        served(beside_static(folder)) as (bare, _),
        served(ROOT / "app.py") as (app, server),
        served(ROOT / "app.py", live="off") as (plain, _),
        sync_playwright() as playwright,
    ):
        browser = playwright.chromium.launch(
            executable_path=shutil.which("chromium"),
            args=[*CHROMIUM_ARGS, "--js-flags=--expose-gc"],
        )
        releases(browser, bare)
        drags(browser, bare, app)
        sizes(browser, plain, app)
        endurance(browser, app, server, minutes)


def releases(browser: Browser, bare: str) -> None:
    """Release of a slider until every chart is redrawn, on a bare page."""
    for charts, goal in ((1, 0.8), (4, 0.5)):
        pages = {
            way: opened(browser, f"{bare}/?charts={charts}&chart={way}", charts)
            for way in ("streamlit", "live")
        }
        taken: dict[str, list[float]] = {way: [] for way in pages}
        for i in range(REPEATS + 3):
            for way, page in pages.items():
                took = _release(page, charts, 0.3 if i % 2 else 0.7)
                if i >= 3:
                    taken[way].append(took)
        theirs, ours = (statistics.median(taken[way]) for way in ("streamlit", "live"))
        say(
            f"release, {charts} chart(s): st.plotly_chart {theirs:.0f} ms, live {ours:.0f} ms, "
            f"ratio {ours / theirs:.2f} (goal {goal})"
        )
        for page in pages.values():
            page.context.close()


def drags(browser: Browser, bare: str, app: str) -> None:
    """Chart updates a second while a slider is dragged."""
    cases = [
        ("bare page", f"{bare}/?charts={n}&chart=live&slider=live", n, "Value") for n in (1, 4)
    ]
    cases += [
        ("the app's home page", app, 4, "Radial clearance"),
        ("the app's static equilibrium", f"{app}/Equilibrium", 2, "Running speed"),
        ("the app's root locus", f"{app}/Root_locus", 1, "Running speed"),
        ("the app's root locus, clearance", f"{app}/Root_locus", 1, "Radial clearance"),
    ]
    for name, url, charts, label in cases:
        page = opened(browser, url, charts)
        zoomed = _zoomed(page)
        found = page.evaluate(DRAG, [label, 6000])
        kept = page.evaluate(_RANGE) == zoomed
        rate = min(found["updates"]) / found["seconds"]
        say(
            f"drag, {name}, {charts} chart(s): {rate:.1f} updates/s of every chart, "
            f"zoom kept: {kept}, same node: {found['same']}, "
            f"blank frames: {found['blanks']}, last value drawn after {found['settled']:.0f} ms"
        )
        page.context.close()


def sizes(browser: Browser, plain: str, app: str) -> None:
    """Bytes that the server sends for one step of a slider."""
    for name in ("Machine", "Equilibrium", "Stability"):
        path = PATHS[name]
        before, after = (_size(browser, f"{address}/{path}") for address in (plain, app))
        dragged = _size_of_preview(browser, f"{app}/{path}")
        say(
            f"bytes an update, {name}: {before / 1e3:.0f} kB before, {after / 1e3:.0f} kB live, "
            f"{dragged / 1e3:.0f} kB while dragging"
        )


def _size(browser: Browser, url: str) -> int:
    page = browser.new_page()
    traffic = Traffic(page)
    _open(page, url, 1)
    before = traffic.received
    page.get_by_role("slider", name="Radial clearance").press("ArrowRight")
    page.wait_for_timeout(2000)
    received = traffic.received - before
    page.context.close()
    return received


def _size_of_preview(browser: Browser, url: str) -> float:
    """Return the bytes of a preview, as they travel."""
    page = browser.new_page()
    sizes: list[int] = []
    page.on(
        "requestfinished",
        lambda request: (
            "/preview?" in request.url and sizes.append(request.sizes()["responseBodySize"])
        ),
    )
    _open(page, url, 1)
    page.evaluate(DRAG, ["Radial clearance", 1500])
    page.context.close()
    return statistics.median(sizes)


def endurance(browser: Browser, app: str, server: int, minutes: float) -> None:
    """Memory of browser and server over a long drag."""
    page = opened(browser, f"{app}/Equilibrium", 2)
    page.evaluate(DRAG, ["Radial clearance", 15000])  # caches fill
    for when in ("before", "after"):
        page.evaluate("() => gc()")
        heap = page.evaluate("() => performance.memory.usedJSHeapSize") / 1e6
        pages = Path(f"/proc/{server}/statm").read_text().split()[1]
        held = int(pages) * 4096 / 1e6
        say(f"{when} {minutes:g} minutes: browser {heap:.0f} MB, server {held:.0f} MB")
        if when == "before":
            page.evaluate(DRAG, ["Radial clearance", minutes * 60e3])
    page.context.close()


def _zoomed(page: Page) -> list[float]:
    """Zoom into the last chart with the mouse, and return the range of its x-axis."""
    box = page.locator(".live-chart .nsewdrag").last.bounding_box()
    assert box
    page.mouse.move(box["x"] + 0.3 * box["width"], box["y"] + 0.3 * box["height"])
    page.mouse.down()
    page.mouse.move(box["x"] + 0.6 * box["width"], box["y"] + 0.6 * box["height"], steps=5)
    page.mouse.up()
    page.wait_for_timeout(500)
    return page.evaluate(_RANGE)


def _release(page: Page, charts: int, share: float) -> float:
    thumb = page.get_by_role("slider").first
    box = page.locator(".stSlider, .live-slider").first.bounding_box()
    here = thumb.bounding_box()
    assert box
    assert here
    mouse = page.mouse
    mouse.move(here["x"] + here["width"] / 2, here["y"] + here["height"] / 2)
    mouse.down()
    mouse.move(box["x"] + box["width"] * (share + 0.01), here["y"] + here["height"] / 2)
    mouse.move(box["x"] + box["width"] * share, here["y"] + here["height"] / 2)
    redrawn = page.evaluate_handle(f"(charts) => ({{promise: ({_REDRAWN})(charts)}})", charts)
    mouse.up()
    took = redrawn.evaluate("(held) => held.promise")
    page.wait_for_timeout(150)
    return took


def opened(browser: Browser, url: str, charts: int) -> Page:
    page = browser.new_page(viewport={"width": 1440, "height": 900})
    _open(page, url, charts)
    return page


def _open(page: Page, url: str, charts: int) -> None:
    page.goto(url)
    page.wait_for_function(
        "(n) => document.querySelectorAll('.js-plotly-plot .main-svg').length >= n", arg=charts
    )
    page.wait_for_timeout(1500)


@contextlib.contextmanager
def served(script: Path, live: str = "drag") -> Iterator[tuple[str, int]]:
    """Serve a script by Streamlit with the project's settings; give its address and process."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    command = [sys.executable, "-m", "streamlit", "run", str(script), f"--server.port={port}",
               "--server.headless=true", "--server.address=127.0.0.1"]  # fmt: skip
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "ROTORCALC_LIVE": live}
    server = subprocess.Popen(command, cwd=ROOT, stdout=subprocess.DEVNULL, env=environment)
    try:
        _wait(lambda: urlopen(f"http://127.0.0.1:{port}/_stcore/health", timeout=5).status == 200)
        yield f"http://127.0.0.1:{port}", server.pid
    finally:
        server.terminate()
        server.wait()


def beside_static(folder: str) -> Path:
    """Put the bare page where Streamlit finds the app's static files beside it."""
    (Path(folder) / "static").symlink_to(ROOT / "static")
    return Path(shutil.copy(ROOT / "tests/benchmarks/bare.py", folder))


def _wait(ready: Callable[[], bool]) -> None:
    end = time.monotonic() + 60
    while time.monotonic() < end:
        with contextlib.suppress(URLError, OSError):
            if ready():
                return
        time.sleep(0.1)
    raise TimeoutError("the server did not start")


def say(line: str) -> None:
    print(line, flush=True)  # noqa: T201 - what this script is for


if __name__ == "__main__":
    main()
