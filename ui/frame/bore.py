"""The bearing in the sidebar: its kind, its film model, and the inputs of its bore."""

import base64
from collections.abc import Callable, Iterable
from contextlib import suppress
from functools import lru_cache
from itertools import groupby

import streamlit as st
from streamlit.delta_generator import DeltaGenerator

from rotorcalc.figures.bore import picture
from rotorcalc.machine import Bearing
from rotorcalc.units import SI
from ui.bearing import film_model, kinds, shape_of
from ui.bores import FILMS, KIND, NAMES, Pick, Value, Values, bore_inputs, name_of
from ui.input_record import Input, tidy
from ui.inputs import INPUTS, has_own, machine_of, number
from ui.own import TABLE, described, rows_of
from ui.preview import Text
from ui.session import session
from ui.widgets import show_inputs

# Key of the picture's place.
PICTURE = "said_bore"
_NO_PICTURE = "<span></span>"
_KIND_HELP = (
    "Diameter, length, clearance and load stay as they are. The clearance is the one to which a "
    "pad is machined: its radius of curvature less the journal's."
)
_FILM_HELP = (
    "The short bearing has its film in closed form and neglects the flow around the journal, which "
    "makes it too stable. A bearing of finite length is computed from Reynolds' equation."
)


def draw() -> DeltaGenerator:
    """Draw the choice of a kind and of a film model, and the inputs of the bore.

    Returns the place of its picture, which follows the sliders.
    """
    left, right = st.columns([3, 1], gap="small", vertical_alignment="bottom")
    with left:
        _kind()
    _film()
    if has_own(session().values):
        _own()
    for place, (is_pick, items) in enumerate(
        groupby(bore_inputs(session().values), lambda item: isinstance(item, Pick))
    ):
        if is_pick:
            _picks(items)
        else:
            _sliders(f"Bore {place}", items)
    return right


def draw_picture(values: Values) -> None:
    """Draw the small picture of the bore that values describe."""
    with st.container(key=PICTURE):
        st.html(drawing(values).words)


def drawing(values: Values) -> Text:
    """Return the small picture of the bore that values describe, where it has fixed pads."""
    with suppress(ValueError):  # values that make no machine
        return Text(picture_tag(machine_of(values).bearing, 72), "html")
    return Text(_NO_PICTURE, "html")


def picture_tag(bearing: Bearing, size: int) -> str:
    """Return the small picture of a bore as HTML, so many pixels wide, beside its name."""
    address = picture_address(bearing)
    if not address:
        return _NO_PICTURE
    return f'<img src="{address}" alt="" width="{size}" height="{size}">'


@lru_cache(maxsize=256)
def picture_address(bearing: Bearing) -> str:
    """Return the small picture of a bore as an address that holds it, empty where there is none."""
    try:
        svg = picture(bearing)
    except ValueError:  # a bearing without fixed pads
        return ""
    return f"data:image/svg+xml;base64,{base64.b64encode(svg.encode()).decode()}"


def _kind() -> None:
    visitor = session()
    kind = str(visitor.values[KIND])
    visitor.mirror("bearing_kind", kind)
    st.selectbox(
        "Bearing", list(NAMES) if kind in NAMES else [*NAMES, kind], format_func=name_of,
        key="bearing_kind", help=_KIND_HELP, on_change=_from("bearing_kind", visitor.set_kind),
    )  # fmt: skip


def _film() -> None:
    visitor = session()
    now = film_model(visitor.values)
    # A link may have one more.
    models = {*kinds()[str(visitor.values[KIND])].models, now}
    if len(models) < 2:
        return
    visitor.mirror("film_model", now)
    st.segmented_control(
        "Film model", sorted(models, reverse=True), format_func=lambda model: FILMS[model],
        key="film_model", required=True, help=_FILM_HELP,
        on_change=_from("film_model", visitor.set_film),
    )  # fmt: skip


def _own() -> None:
    """Say what the table of own coefficients is, in place of a bore's inputs."""
    visitor = session()
    try:
        table = rows_of(visitor.values.get(TABLE))
    except ValueError:  # no machine: said on the page
        return
    st.caption(
        f"Own coefficients: {described(table, visitor.units)}, interpolated between. Choose a "
        "bearing above to compute one again; undo brings these back."
    )


def _picks(items: Iterable[Input | Pick]) -> None:
    for item in items:
        if isinstance(item, Pick):
            _pick(item)


def _pick(item: Pick) -> None:
    visitor = session()
    value, key = visitor.values[item.key], f"pick_{item.key}"
    visitor.mirror(key, value)
    # A link may have more pads than are offered here.
    options = item.options if value in item.options else (*item.options, value)
    st.segmented_control(
        item.label, options, format_func=_word, key=key, required=True, help=item.help,
        on_change=_from(key, lambda value: visitor.set_pick(item, value)),
    )  # fmt: skip


def _sliders(group: str, items: Iterable[Input | Pick]) -> None:
    """Draw sliders; one whose value follows from others has a switch, which says from what."""
    together: list[Input] = []
    for item in items:
        if isinstance(item, Pick):
            continue
        if item.follows:
            _some(group, together)
            group, together = f"{group}, after {item.key}", []
            _follows(item)
        if session().values[item.key] is not None:
            together.append(item)
    _some(group, together)


def _some(group: str, items: list[Input]) -> None:
    if items:
        show_inputs(group, items)


def _follows(item: Input) -> None:
    visitor = session()
    key = f"{item.key}_follows"
    visitor.mirror(key, visitor.values[item.key] is None)

    def toggle(follows: bool) -> None:
        visitor.set_value(item.key, None if follows else _implied(item))

    st.toggle(item.follows, key=key, on_change=_from(key, toggle))


def _implied(item: Input) -> float:
    """Return the value that an input has where none is given."""
    values = session().values
    geometry, _ = shape_of(values)
    clearance = INPUTS["C"].unit(SI).to_si(number(values, "C"))
    return tidy(float(item.unit(SI).of(geometry.implied(item.key, clearance))))


def _from(key: str, take: Callable[..., None]) -> Callable[[], None]:
    """Return a callback that takes a widget's value."""
    return lambda: take(st.session_state[key])


def _word(value: Value) -> str:
    return f"{value:g}" if isinstance(value, float | int) else str(value)
