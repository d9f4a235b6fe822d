"""A preview: a page's content at the value to which an input is being dragged.

Whatever on a page depends on the machine is registered here as a function of the machine's results:
charts, rows of results, and texts. A run of the page draws them by Streamlit; while a slider is
dragged the same functions answer, and the browser writes over what the run drew.
"""

from collections.abc import Callable, Collection
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any, Literal, NoReturn, TypeVar

import streamlit as st
from streamlit.delta_generator import DeltaGenerator

from rotorcalc.figures import Chart, themed
from rotorcalc.units import Units
from ui.bores import Values
from ui.cases import Draw, Shown
from ui.computed import Computed, computed_while_dragging
from ui.inputs import as_shown, input_named

T = TypeVar("T")
Kind = Literal["markdown", "caption", "success", "info", "warning", "error", "html"]


@dataclass(frozen=True)
class Text:
    """A text of a page: Markdown, or HTML of this program's own, and as what it is shown.

    The browser knows of Markdown what this program uses: paragraphs, lists, tables, bold, code,
    badges, `:small[…]` and LaTeX.
    """

    words: str
    kind: Kind = "markdown"


Words = Callable[[Computed], Text | None]
# A result's number, its change from the first case, and its source.
Cells = Callable[[Computed], tuple[str, str, str]]


@dataclass
class Preview:
    """A page as last drawn: its machine, the first case, and what it shows of them."""

    values: Values
    computed: Computed
    first: Shown | None
    units: Units
    dark: bool
    charts: dict[str, Draw] = field(default_factory=dict)
    rows: dict[str, list[Cells]] = field(default_factory=dict)
    texts: dict[str, Words] = field(default_factory=dict)
    # Texts that depend on the inputs alone.
    of_inputs: dict[str, Callable[[Values], Text]] = field(default_factory=dict)

    def say(self, key: str, words: Words, *, while_dragging: Words | None = None) -> None:
        """Show a text that depends on the machine; nothing where it has no words for it.

        While a slider is dragged it may have other words, as of a coarser result.
        """
        key = f"said_{key}"
        self.texts[key] = while_dragging or words
        text = words(self.computed)
        with st.container(key=key):
            if text is None:
                # Streamlit leaves out an empty container, where the browser could not write.
                st.html('<span class="unsaid"></span>')
            else:
                getattr(st, text.kind)(text.words)

    def dimmed(self, key: str) -> DeltaGenerator:
        """Return a container whose content is dimmed while a slider is dragged."""
        key = f"dimmed_{key}"
        self.texts[key] = not_at_once
        return st.container(key=key)

    def at(self, name: str, value: str, charts: Collection[str] = ()) -> dict[str, Any]:
        """Return charts and texts by key, and the texts of each row of results, at a value.

        Where charts are named, those alone. A chart or text that the machine does not give is None.
        Raises ValueError where there is no such input, or the value makes no machine.
        """
        # The other inputs are those of the page as last drawn, which its charts show beside it.
        values = self.values | {name: input_named(name, self.values).taken(value, self.units)}
        try:
            computed = computed_while_dragging(values, self.computed)
            _ = computed.point  # a film may have no answer at the running speed
        except ValueError as error:
            raise ValueError(as_shown(f"{error}", values, self.units)) from error
        drawn = {
            key: _given(lambda draw=draw: self._still(draw, computed))
            for key, draw in self.charts.items()
            if not charts or key in charts
        }
        if charts:
            return {"charts": drawn}
        return {
            "charts": drawn,
            "texts": {
                key: _given(lambda words=words: vars(words(computed) or Text("")))
                for key, words in self.texts.items()
            }
            | {key: vars(words(values)) for key, words in self.of_inputs.items()},
            "rows": {
                key: [_given(lambda cell=cell: cell(computed)) for cell in row]
                for key, row in self.rows.items()
            },
        }

    def _still(self, draw: Draw, computed: Computed) -> Chart:
        """Return a chart without its frames: no animation plays while a slider is dragged."""
        chart = dict(draw(computed))
        chart.pop("frames", None)
        return themed(chart, dark=self.dark)


def not_at_once(_: Computed) -> NoReturn:
    """Raise the ValueError of what takes too long to be computed while a slider is dragged."""
    raise ValueError("computed when the slider is released")


def _given(ask: Callable[[], T]) -> T | None:
    """Return an answer, None where the machine does not give it."""
    with suppress(ValueError):
        return ask()
    return None
