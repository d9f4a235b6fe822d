"""Live charts and sliders as the server sees them, and pages without their package."""

import base64
import json
import sys

import numpy as np
import pytest

from tests.app.session import HOME, PAGES, faults, session_of, slider_keys, visit
from ui.inputs import inputs_of
from ui.live.chart import encoded
from ui.serving import settings
from ui.widgets import _moved


@pytest.fixture
def live(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROTORCALC_LIVE", "drag")


@pytest.mark.parametrize("page", PAGES)
def test_page_has_a_live_slider_for_every_input_and_live_charts(live: None, page: str) -> None:
    at = visit(page)
    assert faults(at) == []
    components = [element.proto for element in at.get("bidi_component")]
    groups = [c for c in components if c.component_name == "rotorcalc.sliders"]
    names = [item["name"] for group in groups for item in json.loads(group.json)[0]]
    inputs = inputs_of(session_of(at).values)
    assert sorted(names) == sorted(inputs.keys() - {"load"})  # the load follows the weight
    assert slider_keys(at) == []
    assert not at.get("plotly_chart")


@pytest.mark.parametrize("page", PAGES)
def test_page_works_without_the_package(page: str, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in [name for name in sys.modules if name.startswith("ui.live")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "ui.live", None)
    at = visit(page)
    assert faults(at) == []
    assert at.slider


def test_unknown_setting_is_refused_by_name(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROTORCALC_LIVE", "yes")
    with pytest.raises(ValueError, match="ROTORCALC_LIVE = 'yes': must be one of drag, release"):
        settings.live()


@pytest.mark.parametrize(
    "sent", ["", "much", None, [1], {"a": 1}, True, float("nan"), 1e9, -5, "60<b>", "rigid"]
)
def test_only_values_in_range_are_kept(sent: object, monkeypatch) -> None:
    at = visit(HOME)
    visitor = session_of(at)
    before = dict(visitor.values)
    monkeypatch.setattr("ui.widgets.session", lambda: visitor)
    _moved("C", visitor.units, sent, dragging=False)
    assert visitor.values == before
    assert len(visitor.problems) == 1
    assert visitor.problems[0].startswith("Radial clearance")


def test_a_value_is_kept_in_the_links_unit_and_the_last_word_is_a_rigid_shaft(monkeypatch) -> None:
    at = visit(HOME, units="US")
    visitor = session_of(at)
    monkeypatch.setattr("ui.widgets.session", lambda: visitor)
    _moved("C", visitor.units, 3.0, dragging=True)
    assert visitor.values["C"] == pytest.approx(76.2)
    assert visitor.dragging
    _moved("k", visitor.units, "rigid", dragging=False)
    assert visitor.values["k"] == float("inf")
    assert visitor.problems == []


def test_arrays_travel_in_single_precision_and_keep_their_shape() -> None:
    values = np.tile([[1.0, np.nan, 1e300], [0.1, 2.0, 3.0]], 3)
    few = np.array([0.1, np.nan])
    sent = json.loads(
        encoded({"line": values[1], "map": values, "words": np.array(["a"]), "few": few})
    )
    assert sent["words"] == ["a"]
    assert sent["few"] == [0.1, None]
    line = np.frombuffer(base64.b64decode(sent["line"]["bdata"]), sent["line"]["dtype"])
    np.testing.assert_array_equal(line, values[1].astype(np.float32))
    # What single precision cannot hold stays double.
    assert sent["map"]["dtype"] == "f8"
    assert sent["map"]["shape"] == "2,9"
    with pytest.raises(TypeError, match="set"):
        encoded({"odd": {1}})
