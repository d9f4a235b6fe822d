"""What is spared of Streamlit's work is what would have come out the same."""

from types import SimpleNamespace

import pytest
from streamlit import config
from streamlit.proto.NewSession_pb2 import CustomThemeConfig
from streamlit.runtime import app_session
from streamlit.runtime.state.session_state import Value, WStates

from ui.serving import spare


@pytest.fixture
def spared(monkeypatch: pytest.MonkeyPatch) -> None:
    for module, name, _ in spare.REPLACED:
        monkeypatch.setattr(module, name, getattr(module, name))  # put back afterwards
    spare.begin()


def test_streamlit_has_the_functions() -> None:
    assert all(hasattr(module, name) for module, name, _ in spare.REPLACED)


def theme() -> CustomThemeConfig:
    message = CustomThemeConfig()
    for section in ("theme", "theme.light", "theme.dark"):
        app_session._populate_theme_msg(message, section)
    return message


def test_the_theme_is_read_once_and_is_the_same(
    request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch
) -> None:
    own = theme()
    assert own.text_color
    request.getfixturevalue("spared")
    assert theme() == own
    monkeypatch.setattr(config, "get_config_options", lambda: pytest.fail("read again"))
    assert theme() == own


def shown(sent: object) -> tuple[object, object]:
    """Return what a script is shown of a component's state, spared and by Streamlit alone."""
    states = WStates({"sent": Value(sent)}, {})
    states.widget_metadata["sent"] = SimpleNamespace(value_type="json_trigger_value")  # type: ignore[assignment]
    state, value = SimpleNamespace(_new_widget_state=states), {"kept": 1}
    make = spare.components.make_bidi_component_presenter
    return make("sent", "id")(value, state), make.__wrapped__("sent", "id")(value, state)


@pytest.mark.usefixtures("spared")
def test_a_component_s_state_is_shown_with_what_was_sent() -> None:
    moved = [{"event": "moved", "value": {"name": "C"}}]
    for sent, more in ((None, {}), (moved, {"moved": {"name": "C"}})):
        spared, own = shown(sent)
        assert spared == own == {"kept": 1} | more
    assert type(shown(None)[0]) is dict


@pytest.mark.usefixtures("spared")
def test_where_streamlit_names_its_state_otherwise_its_own_answer_stands() -> None:
    make = spare.REPLACED[-1][2](lambda _: lambda value, _: f"{value} with what was sent")
    assert make("sent")("kept", SimpleNamespace()) == "kept with what was sent"
