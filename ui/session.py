"""What a visitor's session holds: one machine, its preset, the units shown, the pinned baseline.

Widgets read from here and write to here, and the address bar is written from here. So a value
survives a change of page, whether it was moved or came with a link.
"""

import secrets
from contextlib import suppress
from dataclasses import dataclass, field

import streamlit as st

from rotorcalc.units import SYSTEMS, Units
from ui.bearing import Value, Values
from ui.inputs import PRESET_VALUES
from ui.preview import Preview
from ui.sharing import address

_KEY = "rotorcalc"


@dataclass
class Session:
    """One visitor's machine and how it is shown."""

    preset: str
    values: Values
    units_name: str
    problems: list[str] = field(default_factory=list)
    baseline: Values | None = None
    typed: bool = False
    image_format: str = "png"
    # Whether a slider is being dragged: the address bar waits until it is released.
    dragging: bool = False
    # The preview of the page as it was last drawn, and the secret to ask for it.
    preview: Preview | None = None
    token: str = field(default_factory=secrets.token_urlsafe)
    # Whether the page's content is to run with its frame as one, the next time.
    whole: bool = False
    # How often a page's frame was drawn: whether sliders or preview know better what a value is.
    frame: int = 0
    # The page whose sidebar was drawn last, and whether the visitor has just come to another.
    page: str = ""
    arriving: bool = True

    @property
    def units(self) -> Units:
        """The units shown."""
        return SYSTEMS[self.units_name]

    def set_value(self, key: str, value: Value) -> None:
        """Keep a moved value; what a link or a file got wrong has been read by now."""
        self.values[key] = value
        self.problems.clear()

    def set_preset(self, preset: str) -> None:
        """Take over a preset's machine and speeds."""
        self.preset, self.values = preset, dict(PRESET_VALUES[preset])
        self.problems.clear()

    def pin(self) -> None:
        """Keep the live machine as the baseline A."""
        self.baseline = dict(self.values)

    def unpin(self) -> None:
        """Forget the baseline."""
        self.baseline = None

    def swap(self) -> None:
        """Exchange the live machine and the baseline."""
        if self.baseline is not None:
            self.values, self.baseline = self.baseline, self.values


def session() -> Session:
    """Return this session's state; a new session's comes from the address bar."""
    with suppress(KeyError):
        return st.session_state[_KEY]
    given = address.read(st.query_params.to_dict())
    st.session_state[_KEY] = visitor = Session(
        preset=given.preset, values=given.values, units_name=given.units, problems=given.problems
    )
    return visitor


def write_address_bar() -> None:
    """Put the whole machine into the address bar, where it is not there yet."""
    visitor = session()
    if visitor.dragging:
        return
    params = address.write(visitor.preset, visitor.values, visitor.units_name)
    if st.query_params.to_dict() != params:
        st.query_params.from_dict(params)


def mirror(key: str, value: object) -> bool:
    """Give a widget its value before it is drawn, where it has another; return whether it had.

    A page's widgets are its own: on arriving, `session_state` still answers for the last page's.
    """
    needed = session().arriving or st.session_state.get(key) != value
    if needed:
        st.session_state[key] = value
    return needed
