"""How soon a page has answered a key, and how often it follows a thumb, page by page.

    python -m tests.benchmarks.follow [PAGE[, TAB] …]

A key's answer is everything at its final place: charts' lines, points, notes and shapes within
two pixels, and every visible word. A bare page of as many `st.plotly_chart`s, in a server process
of its own with the same settings, is pressed in turns with the page of the app.
"""

import argparse
import shutil
import statistics
import tempfile
from collections.abc import Iterator

from playwright.sync_api import Browser, Page, sync_playwright

from tests.benchmarks.live import DRAG, ROOT, beside_static, opened, say, served
from tests.browser.app_page import PATHS, AppPage
from tests.browser.conftest import CHROMIUM_ARGS, DESK

PRESSES, WARMUP = 30, 4
SECONDS = 5.0

# From a key until nothing seen changes any more, and until the app is at rest [ms].
_ANSWERED = """() => new Promise(resolve => {
  const PARTS = '.trace, .annotation-text, .annotation-arrow-g path, .legendtext, '
    + '.shapelayer path, .slider-grip-rect, .bars .point, '
    + '.contourlevel path, .contourfill path, .contourlines path';
  const app = document.querySelector('[data-testid="stApp"]');
  const within = (one, low, high) => Math.min(Math.max(one, low), high);
  const seen = () => {
    const places = [...document.querySelectorAll('.js-plotly-plot')].flatMap(chart => {
      const plots = [...chart.querySelectorAll('.nsewdrag')];
      // A line may go on beyond its plot, unseen.
      const { left, top, right, bottom } =
        (plots.length === 1 ? plots[0] : chart).getBoundingClientRect();
      const parts = [...chart.querySelectorAll(PARTS)].map(part => part.getBoundingClientRect());
      // The bare page's sines keep their boxes: of each its ends, to a fifth of a pixel.
      const ends = chart.matches('.live-chart') ? [] : [...chart.querySelectorAll('.js-line')]
        .flatMap(line => [/[\\d.]+,([\\d.]+)/, /[\\d.]+,([\\d.]+)$/].map(
          end => 10 * line.getAttribute('d').match(end)[1]));
      return [...ends, ...parts.filter(box => box.width || box.height).flatMap(box =>
        [within(box.left, left, right), within(box.top, top, bottom),
         within(box.right, left, right), within(box.bottom, top, bottom)])];
    });
    const words = ['stMain', 'stSidebar'].map(name =>
      document.querySelector(`[data-testid=${name}]`)?.innerText.replaceAll(/[\\s\\u200b]/g, ''));
    const dim = document.querySelectorAll('.live-unknown').length;
    return { places, words: words.join() + dim };
  };
  const stay = (a, b) => a.places.length === b.places.length
    && a.places.every((place, i) => Math.abs(place - b.places[i]) < 2);
  const same = (a, b) => a.words === b.words && stay(a, b);
  let changed = true, resting = 0;
  new MutationObserver(() => { changed = true; }).observe(
    document.body, {subtree: true, childList: true, attributes: true, characterData: true});
  const first = seen(), records = [];
  addEventListener('keydown', () => {
    const start = performance.now();
    const look = () => {
      const now = performance.now() - start;
      if (changed) records.push([now, seen()]);
      changed = false;
      const rest = app.dataset.testScriptState === 'notRunning'
        && !window.rotorcalcDrawing
        && !document.querySelector(
          '.live-slider[data-busy], .live-chart[data-moved], [data-stale="true"]');
      const [, last] = records.at(-1) ?? [0, first];
      // The bare page's own words, its slider's, change before it has run.
      const kept = document.querySelector('.live-chart') ? same : stay;
      resting = rest && !kept(last, first) ? resting + 1 : 0;
      if (resting < 5 && now < 15000) { requestAnimationFrame(look); return; }
      const after = records.findLastIndex(record => !same(record[1], last)) + 1;
      const other = records[after - 1]?.[1];
      resolve({ final: records[after][0], rest: now, late: now >= 15000,
        why: other && other.words !== last.words ? 'words' : 'places' });
    };
    requestAnimationFrame(look);
  }, {once: true, capture: true});
})"""


def main() -> None:
    """Measure, and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("pages", nargs="*", help="such as Machine, or 'Stability, Map'")
    parser.add_argument("--presses", type=int, default=PRESSES)
    parser.add_argument("--seconds", type=float, default=SECONDS, help="of each drag")
    given = parser.parse_args()
    with (
        tempfile.TemporaryDirectory() as folder,
        served(beside_static(folder)) as (bare, _),
        served(ROOT / "app.py") as (app, _),
        sync_playwright() as playwright,
    ):
        browser = playwright.chromium.launch(
            executable_path=shutil.which("chromium"), args=CHROMIUM_ARGS
        )
        for page in given.pages or [name for name in PATHS if name != "Notes"]:
            name, _, tab = page.partition(", ")
            for place, tab_page in _tabs(browser, app, name, tab):
                say(f"{place:45}" + keys(browser, bare, tab_page, given.presses))
                say(f"{place:45}" + drags(tab_page, given.seconds))


def _tabs(browser: Browser, app: str, name: str, tab: str) -> Iterator[tuple[str, AppPage]]:
    """Open a page with one of its tabs, with each for "*", and with the first for none."""
    page = AppPage(browser.new_page(viewport=DESK), app)
    page.open(name)
    for label in (page.tabs() or [""]) if tab == "*" else [tab]:
        if label:
            page.open_tab(label)
        yield f"{name}{', ' if label else ''}{label}", page
    page.page.close()


def keys(browser: Browser, bare: str, app: AppPage, presses: int) -> str:
    """Press the clearance's slider and the bare page's in turns."""
    charts = app.page.locator(".js-plotly-plot:visible").count()
    other = opened(browser, f"{bare}/?charts={charts}", charts)
    sides = {"ours": app.page, "bare": other}
    taken: dict[str, list[dict[str, float]]] = {side: [] for side in sides}
    for i in range(WARMUP + presses):
        for side, page in sides.items():
            found = _press(page)  # each time at a value that no cache knows
            if i >= WARMUP:
                taken[side].append(found)
    other.close()
    final, theirs = ([one["final"] for one in taken[side]] for side in sides)
    ratios = [one(final) / one(theirs) for one in (min, statistics.median)]
    rest = statistics.median(one["rest"] for one in taken["ours"])
    why = sum(one["why"] == "words" for one in taken["ours"])
    return (
        f"{charts} charts: {min(final):4.0f} {statistics.median(final):4.0f} ms, bare "
        f"{min(theirs):4.0f} {statistics.median(theirs):4.0f} ms, ratio {ratios[0]:.2f} "
        f"{ratios[1]:.2f} (goal {0.8 if charts < 3 else 0.5}), at rest {rest:.0f} ms; {why} words"
    )


def _press(page: Page) -> dict[str, float]:
    page.bring_to_front()
    slider = page.get_by_role("slider", name="Radial clearance").or_(
        page.get_by_role("slider", name="Value")
    )
    slider.first.focus()
    held = page.evaluate_handle(f"() => ({{promise: ({_ANSWERED})()}})")
    page.keyboard.press("ArrowRight")
    found = held.evaluate("held => held.promise")
    page.wait_for_timeout(100)
    return found


def drags(app: AppPage, seconds: float) -> str:
    """Drag the clearance and the running speed; the chart with the fewest updates counts."""
    rates = []
    for label in ("Radial clearance", "Running speed"):
        app.page.evaluate(DRAG, [label, 1500])
        found = app.page.evaluate(DRAG, [label, 1000 * seconds])
        rates.append(f"{min(found['updates'], default=0) / found['seconds']:.1f}")
    return f"dragged: {' and '.join(rates)} updates/s (goal 12)"


if __name__ == "__main__":
    main()
