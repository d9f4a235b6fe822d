"""One function that makes an input, and one that shows a chart.

How an input sends and how a chart is drawn are decided here and nowhere else.
"""

import importlib
import math
from collections.abc import Callable, Sequence
from functools import cache, lru_cache, partial
from types import ModuleType
from typing import Any

import numpy as np
import streamlit as st
from plotly.basedatatypes import BaseFigure

from rotorcalc.figures import Chart, themed
from rotorcalc.units import Units
from ui.bearing import Values
from ui.inputs import INPUTS, Input, input_named, number
from ui.preview import Preview
from ui.serving import settings
from ui.session import Session, session


class _Checked(BaseFigure):
    """A chart that Streamlit need not validate again.

    Streamlit turns a dict into a `go.Figure` to validate it, 3 to 4 ms a chart; the tests have
    done that. What it takes for a figure it asks for its dict.
    """

    def __init__(self, chart: Chart) -> None:
        self._chart = chart

    def to_dict(self) -> Chart:
        """Return the dict."""
        return self._chart


def show_chart(chart: Chart, *, key: str, alt: str) -> None:
    """Show a chart; `alt` is its text alternative."""
    config: dict[str, Any] = {
        "displaylogo": False,
        "modeBarButtonsToRemove": ["select2d", "lasso2d", "autoScale2d"],
        "toImageButtonOptions": {"format": session().image_format, "filename": key, "scale": 2},
    }
    drawn = themed(chart, dark=is_dark())
    if settings.live() == "off":
        st.plotly_chart(_Checked(drawn), key=chart_key(key), theme=None, config=config, alt=alt)
    else:
        _live().show_chart(drawn, key=chart_key(key), config=config, alt=alt)


def show_preview(preview: Preview | None) -> None:
    """Let sliders change what is drawn here, and show its preview while one is dragged."""
    visitor = session()
    if settings.live() == "off" or visitor.typed:
        return
    units = visitor.units
    _live().show_preview(
        preview if settings.live() == "drag" else None, visitor.token, visitor.frame,
        {key: _sent(item, visitor.values, units) for key, item in INPUTS.items()}, _mover(units),
    )  # fmt: skip


def show_connection(kept: dict[str, Any] | None) -> object:
    """Give the browser what to keep of the session; return what it kept for a server without it."""
    return None if settings.live() == "off" else _live().show_connection(kept)


def chart_key(key: str) -> str:
    """Return a chart's key in the preview."""
    return f"chart_{key}"


def is_dark() -> bool:
    """Return whether the visitor's page is dark."""
    return st.context.theme.type == "dark"


def show_inputs(group: str, items: Sequence[Input]) -> None:
    """Show sliders, or fields to type in, that read and write the session's state."""
    visitor = session()
    if settings.live() == "off" or visitor.typed:
        for item in items:
            _own(item, visitor)
    else:
        _live_sliders(group, items, visitor)


def _own(item: Input, visitor: Session) -> None:
    """Show one of Streamlit's own sliders or fields."""
    units = visitor.units
    shown = _shown(item, visitor.values, units)
    key = f"input_{item.key}_{units.name}_{'typed' if visitor.typed else 'slider'}"
    common: dict[str, Any] = {
        "label": item.name(units), "key": key, "help": item.help, "on_change": _keep,
        "args": (item, key, units),
    }  # fmt: skip
    draw = _typed if visitor.typed else _log_slider if item.log else _slider
    found = draw(item, shown, visitor, common)
    # What a browser brings to a server without its session is no change to Streamlit.
    if visitor.frame == 1 and not math.isclose(found, shown):
        visitor.set_value(item.key, item.stored(found, units))


def _shown(item: Input, values: Values, units: Units) -> float:
    if values[item.key] is None:
        return item.low
    return item.shown(number(values, item.key), units)


def _keep(item: Input, key: str, units: Units) -> None:
    session().set_value(item.key, item.stored(float(st.session_state[key]), units))


def _live() -> ModuleType:
    """Return the package of live components, which need not be there when they are off."""
    return importlib.import_module("ui.live")


def _live_sliders(group: str, items: Sequence[Input], visitor: Session) -> None:
    live, values, units = _live(), visitor.values, visitor.units

    def slider(item: Input) -> object:
        low, high, step = _range(item, units)
        return live.Slider(
            item.key, item.name(units), item.help, _sent(item, values, units),
            low, high, item.step if item.log else step, item.log, item.infinite,
        )  # fmt: skip

    live.show_sliders(
        [slider(item) for item in items],
        key=f"inputs_{group}_{units.name}",
        frame=visitor.frame,
        on_move=_mover(units),
        while_dragging=settings.live() == "drag",
    )


def _sent(item: Input, values: Values, units: Units) -> float | str:
    """Return an input's value as a live slider gets it, which knows the last one by its word."""
    shown = _shown(item, values, units)
    return item.infinite if math.isinf(shown) else shown


def _mover(units: Units) -> Callable[[str, object, bool], None]:
    """Return the handler of values that live sliders send in these units."""
    return lambda name, value, dragging: _moved(name, units, value, dragging=dragging)


def _moved(name: str, units: Units, value: object, *, dragging: bool) -> None:
    """Keep a live slider's value, or report why it is refused."""
    visitor = session()
    visitor.dragging = dragging
    try:
        item = input_named(name)
        visitor.set_value(item.key, item.taken(value, units))
    except ValueError as error:
        visitor.problems[:] = [f"{error}; it was left as it is."]


def _begin(visitor: Session, key: str, value: float, default: float | None) -> float | None:
    """Return with what a widget begins.

    In a session's first run it begins with what the browser shows, or with a value. Later the value
    is written, and Streamlit would warn of two; where it stands already, any will do.
    """
    if visitor.frame == 1:
        return value
    return None if visitor.mirror(key, value) else default


def _slider(item: Input, shown: float, visitor: Session, common: dict[str, Any]) -> float:
    low, high, step = _range(item, visitor.units)
    decimals = max(0, -math.floor(math.log10(step)))
    value = float(min(max(shown, low), high))
    return st.slider(
        min_value=low, max_value=high, step=step, format=f"%.{decimals}f",
        # Without a value Streamlit looks through the whole session for one.
        value=_begin(visitor, common["key"], value, low), **common,
    )  # fmt: skip


def _log_slider(item: Input, shown: float, visitor: Session, common: dict[str, Any]) -> float:
    low, high, _ = _range(item, visitor.units)
    beyond = {math.inf} if item.infinite else set[float]()
    options = sorted(_stops(low, high, item.step) | beyond | {shown})
    return st.select_slider(
        options=options, value=_begin(visitor, common["key"], shown, None),
        format_func=partial(_word, item.infinite), **common,
    )  # fmt: skip


def _typed(item: Input, shown: float, visitor: Session, common: dict[str, Any]) -> float:
    low, high, step = _range(item, visitor.units)
    value = _begin(visitor, common["key"], float(min(shown, high)), None)
    return st.number_input(
        min_value=low, max_value=high, step=low if item.log else step, format="%.6g",
        value="min" if value is None else value, **common,
    )  # fmt: skip


def _range(item: Input, units: Units) -> tuple[float, float, float]:
    """Return the ends of an input's range, and a round step."""
    low, high = float(item.shown(item.low, units)), float(item.shown(item.high, units))
    return low, high, _round_step(item.shown(item.low + item.step, units) - low)


@cache
def _stops(low: float, high: float, per_decade: float) -> frozenset[float]:
    """Return the values at which a logarithmic slider stops."""
    number = round(math.log10(high / low) * per_decade) + 1
    return frozenset(float(f"{value:.3g}") for value in np.geomspace(low, high, number))


@lru_cache(maxsize=4096)
def _word(infinite: str, value: float) -> str:
    """Return a stop's text, or the input's word for an infinite one."""
    if math.isinf(value):
        return infinite
    return f"{value:.4g}".replace("e+0", "e").replace("e+", "e")


def _round_step(step: float) -> float:
    """Return the largest of 1, 2, 5 times a power of ten that is not above a step."""
    power = 10.0 ** math.floor(math.log10(step * (1 + 1e-9)))
    return max(factor * power for factor in (1.0, 2.0, 5.0) if factor * power <= step * (1 + 1e-9))
