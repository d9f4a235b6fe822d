"""One function that makes an input, and one that shows a chart.

How an input sends and how a chart is drawn are decided here and nowhere else.
"""

import importlib
import math
from collections.abc import Callable, Mapping, Sequence
from functools import cache, lru_cache, partial
from types import ModuleType
from typing import Any

import streamlit as st
from plotly.basedatatypes import BaseFigure

from rotorcalc.figures import Chart, themed
from rotorcalc.units import Units
from ui.bores import Values
from ui.choices import NAMES
from ui.format import short
from ui.input_record import Input
from ui.inputs import input_named, inputs_of, number, usual, usual_values
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
    visitor = session()
    config: dict[str, Any] = {
        "displaylogo": False,
        "modeBarButtonsToRemove": ["select2d", "lasso2d", "autoScale2d"],
        "toImageButtonOptions": {"format": visitor.image_format, "filename": key, "scale": 2},
    }
    drawn = themed(chart, dark=is_dark())
    if settings.live() == "off":
        st.plotly_chart(_Checked(drawn), key=chart_key(key), theme=None, config=config, alt=alt)
    else:
        presenting = bool(visitor.present)
        _live().show_chart(drawn, key=chart_key(key), config=config, alt=alt, presenting=presenting)


def show_preview(preview: Preview | None) -> None:
    """Let sliders change what is drawn here, and show its preview while one is dragged."""
    visitor = session()
    if settings.live() == "off" or visitor.typed:
        return
    units, items = visitor.units, inputs_of(visitor.values)
    _live().show_preview(
        preview if settings.live() == "drag" else None, visitor.token, visitor.frame,
        {key: _sent(item, visitor.values, units) for key, item in items.items()}, _mover(units),
    )  # fmt: skip


def show_connection() -> None:
    """Look after the connection, and take over what the browser kept of a session before."""
    if settings.live() == "off":
        return
    visitor = session()
    kept = _live().show_connection(lambda state: session().recall(state))
    if not visitor.frame:
        visitor.recall(kept)


def show_links() -> bool:
    """Let the browser complete links between pages; return whether it can."""
    if settings.live() == "off":
        return False
    _live().show_links(NAMES)
    return True


def keep(when: str) -> None:
    """Give the browser what to keep of the session, before or after a page's content."""
    if settings.live() != "off":
        _live().keep(session().kept(), when)


def chart_key(key: str) -> str:
    """Return a chart's key in the preview."""
    return f"chart_{key}"


def is_dark() -> bool:
    """Return whether the visitor's page is dark."""
    return st.context.theme.type == "dark"


def show_inputs(
    group: str, items: Sequence[Input], windows: Mapping[str, tuple[float, float]] | None = None
) -> None:
    """Show sliders, or fields to type in, that read and write the session's state.

    A live slider named in `windows` has a track that is fixed between two kept values.
    """
    visitor = session()
    if settings.live() == "off" or visitor.typed:
        for item in items:
            _own(item, visitor)
    else:
        _live_sliders(group, items, visitor, windows or {})


def _own(item: Input, visitor: Session) -> None:
    """Show one of Streamlit's own sliders, or a field."""
    units = visitor.units
    shown = _shown(item, visitor.values, units)
    key = f"input_{item.key}_{units.name}_{'typed' if visitor.typed else 'slider'}"
    low, high = item.shown(item.low, units), item.shown(item.high, units)
    common: dict[str, Any] = {
        "label": item.name(units), "key": key, "help": item.help, "on_change": _keep,
        "args": (item, key, units),
    }  # fmt: skip
    if visitor.typed:
        _typed(item, visitor, common)
        return
    draw = _slider if item.step else _log_slider
    # A link may have a value beyond a bore's slider, which then rests at its end.
    begun = shown if math.isinf(shown) else min(max(shown, low), high)
    found = draw(item, begun, visitor, common)
    # What a browser brings to a server without its session is no change to Streamlit.
    if visitor.frame == 1 and not math.isclose(found, begun):
        visitor.set_value(item.key, item.stored(found, units))


def _typed(item: Input, visitor: Session, common: dict[str, Any]) -> None:
    """Show a field whose text `_keep` reads, and which shows the kept value again after that."""
    text = item.text(_kept(item, visitor.values), visitor.units)
    found = st.text_input(value=_begin(visitor, common["key"], text, "") or "", **common)
    if visitor.frame == 1 and found != text:  # as above
        _moved(item.key, visitor.units, found, dragging=False)


def _shown(item: Input, values: Values, units: Units) -> float:
    return item.shown(_kept(item, values), units)


def _kept(item: Input, values: Values) -> float:
    return item.low if values.get(item.key) is None else number(values, item.key)


def _keep(item: Input, key: str, units: Units) -> None:
    _moved(item.key, units, st.session_state[key], dragging=False)


def _live() -> ModuleType:
    """Return the package of live components, which need not be there when they are off."""
    return importlib.import_module("ui.live")


def _live_sliders(
    group: str, items: Sequence[Input], visitor: Session, windows: Mapping[str, tuple[float, float]]
) -> None:
    live, values, units = _live(), visitor.values, visitor.units

    def slider(item: Input) -> object:
        start = _start(visitor)
        return live.Slider(
            item.key, item.name(units), item.help, _sent(item, values, units),
            item.shown(item.low, units), item.shown(item.high, units),
            usual=item.shown(usual(item.key, values), units),
            preset=None if start.get(item.key) is None else _sent(item, start, units),
            least=item.shown(item.least, units) if item.least else 0.0,
            step=_step(item, units),
            span=_difference(item, item.span, units) if item.step else 0.0,
            beyond=item.infinite,
            window=tuple(item.shown(end, units) for end in windows.get(item.key, ())),
        )  # fmt: skip

    live.show_sliders(
        [slider(item) for item in items],
        key=f"inputs_{group}_{units.name}",
        frame=visitor.frame,
        on_move=_mover(units),
        while_dragging=settings.live() == "drag",
    )


def _start(visitor: Session) -> Values:
    """Return the values from which a visitor began."""
    return usual_values(visitor.preset, visitor.values)


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
        item = input_named(name, visitor.values)
        visitor.set_value(item.key, item.taken(value, units))
    except ValueError as error:
        visitor.problems[:] = [f"{error}; it was left as it is."]


def _begin(visitor: Session, key: str, value: Any, default: Any) -> Any:
    """Return with what a widget begins.

    In a session's first run it begins with what the browser shows, or with a value. Later the value
    is written, and Streamlit would warn of two; where it stands already, any will do.
    """
    if visitor.frame == 1:
        return value
    return None if visitor.mirror(key, value) else default


def _slider(item: Input, shown: float, visitor: Session, common: dict[str, Any]) -> float:
    units = visitor.units
    low, high = item.shown(item.low, units), item.shown(item.high, units)
    step = 0.5 * _step(item, units)
    digits = max(1, math.ceil(-math.log10(step)))
    return st.slider(
        min_value=float(low), max_value=float(high), step=step, format=f"%.{digits}f",
        # Without a value Streamlit looks through the whole session for one.
        value=_begin(visitor, common["key"], shown, float(low)), **common,
    )  # fmt: skip


def _log_slider(item: Input, shown: float, visitor: Session, common: dict[str, Any]) -> float:
    units = visitor.units
    ends = [item.shown(end, units) for end in (item.low, item.least, item.high)]
    beyond = [math.inf] if item.infinite else []
    start = _shown(item, _start(visitor), units)
    # Of several values with one text the last: Streamlit knows its options by their texts.
    stops = {_word(item.infinite, one): one for one in (*_stops(*ends), *beyond, start, shown)}
    options = sorted(stops.values())
    return st.select_slider(
        options=options, value=_begin(visitor, common["key"], shown, None),
        format_func=partial(_word, item.infinite), **common,
    )  # fmt: skip


def _step(item: Input, units: Units) -> float:
    """Return a round step of a linear scale; 0 for a logarithmic one."""
    return _round_step(_difference(item, item.step, units)) if item.step else 0.0


def _difference(item: Input, by: float, units: Units) -> float:
    """Return a difference of two values in a visitor's unit."""
    return item.shown(item.low + by, units) - item.shown(item.low, units)


@cache
def _stops(low: float, least: float, high: float) -> frozenset[float]:
    """Return where Streamlit's own slider stops: its ends, and numbers of two digits between."""
    start = least if low == 0.0 else low
    powers = range(math.floor(math.log10(start)), math.ceil(math.log10(high)))
    inside = (float(f"{digits}e{power - 1}") for power in powers for digits in range(10, 100))
    return frozenset((low, high, *(value for value in inside if start <= value <= high)))


@lru_cache(maxsize=16384)
def _word(infinite: str, value: float) -> str:
    """Return a stop's text, or the input's word for an infinite one."""
    return infinite if math.isinf(value) else short(value)


def _round_step(step: float) -> float:
    """Return the largest of 1, 2, 5 times a power of ten that is not above a step."""
    power = 10.0 ** math.floor(math.log10(step * (1 + 1e-9)))
    return max(factor * power for factor in (1.0, 2.0, 5.0) if factor * power <= step * (1 + 1e-9))
