"""What a page costs when a slider moves: its whole script, and its charts alone.

Run by `make bench`. A page's script should take less than 30 ms with its first tab open. Both are
processor time, which a busy machine's other work does not lengthen.
"""

import itertools
import logging
import time
from collections.abc import Callable, Iterator
from typing import Any

import plotly.io
import pytest
from streamlit.runtime.scriptrunner import script_runner

from rotorcalc.figures import Chart
from tests.app.session import PAGES, session_of, tours, visit
from ui.computed import Computed
from ui.frame.page import Page

ROUNDS, WARMUP = 30, 3
# A clearance is never tried twice, whatever page it was for: no result comes from a cache.
CLEARANCES = map(float, itertools.count(61))

pytestmark = pytest.mark.parametrize("path", PAGES)


class ScriptClock:
    """A clock that runs only while the thread of a page's script does."""

    def __init__(self) -> None:
        self.seconds = 0.0

    def __call__(self) -> float:
        return self.seconds

    def timed(self, execute: Callable[..., Any]) -> Callable[..., Any]:
        """Return `execute` with its time added to this clock."""

        def run(*args: Any, **kwargs: Any) -> Any:
            start = time.thread_time()
            try:
                return execute(*args, **kwargs)
            finally:
                self.seconds += time.thread_time() - start

        return run


CLOCK = ScriptClock()


@pytest.fixture
def script_clock(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    name = "exec_func_with_error_handling"
    monkeypatch.setattr(script_runner, name, CLOCK.timed(getattr(script_runner, name)))
    # AppTest reports with each run that it is no browser.
    logging.disable(logging.WARNING)
    yield
    logging.disable(logging.NOTSET)


@pytest.mark.benchmark(group="script of a page, a slider moved", timer=CLOCK)
def test_script(path: str, script_clock: None, benchmark: Any) -> None:
    at = visit(path)

    def move() -> None:
        session_of(at).set_value("C", next(CLEARANCES))

    benchmark.pedantic(at.run, setup=move, rounds=ROUNDS, warmup_rounds=WARMUP)
    assert not at.exception


@pytest.mark.benchmark(group="all charts of a page, results at hand", timer=time.process_time)
def test_charts(path: str, monkeypatch: pytest.MonkeyPatch, benchmark: Any) -> None:
    drawn: dict[str, tuple[Callable[[Computed], Chart], Computed]] = {}

    def collect(
        page: Page, draw: Callable[[Computed], Chart], key: str, *, alt: str, caption: str
    ) -> None:
        drawn[key] = draw, page.computed

    monkeypatch.setattr(Page, "chart", collect)
    at = visit(path)
    for _ in tours(at):
        assert not at.exception

    def draw_all() -> int:
        return sum(
            len(plotly.io.to_json(draw(computed), validate=False))
            for draw, computed in drawn.values()
        )

    benchmark.extra_info["charts"] = len(drawn)
    assert benchmark(draw_all) >= 2 * len(drawn)
