"""What Streamlit does anew at each run though nothing has changed, spared.

The first message of a run holds the theme, for which Streamlit reads all its options; they do not
change while a server runs. And each look at a component's state makes a class, so that a script may
write to what it is shown, with what the browser has just sent: here nothing writes to it.

A version of Streamlit without a function by one of these names does its work as before.
"""

from collections.abc import Callable
from functools import cache, wraps
from types import ModuleType
from typing import Any

from streamlit import config
from streamlit.components.v2.bidi_component import main as components
from streamlit.runtime import app_session

# Of a component's stored value and the session's state, the value that a script is shown.
_Presenter = Callable[[Any, Any], Any]


def begin() -> None:
    """Spare it from now on."""
    for module, name, sparing in REPLACED:
        if hasattr(module, name):
            setattr(module, name, sparing(getattr(module, name)))


def _as_it_is(make: Callable[..., _Presenter]) -> Callable[..., _Presenter]:
    """Return a maker of presenters that show the state itself where nothing was sent."""

    @wraps(make)
    def made(sent_to: str, *rest: Any, **named: Any) -> _Presenter:
        with_sent = make(sent_to, *rest, **named)

        def present(value: Any, state: Any) -> Any:
            sent = getattr(state, "_new_widget_state", None)  # as Streamlit's own looks
            if sent is None or sent.get(sent_to) is not None:
                return with_sent(value, state)
            return value

        return present

    return made


# Streamlit's modules, the functions by which they do it, and what makes sparing ones of them.
REPLACED: tuple[tuple[ModuleType, str, Callable[[Any], Any]], ...] = (
    (config, "get_options_for_section", cache),
    (app_session, "to_snake_case", cache),
    (components, "make_bidi_component_presenter", _as_it_is),
)
