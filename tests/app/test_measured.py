"""What a visitor measured stands on its page and over Orbits and Response, and nowhere else."""

import json
import math

import numpy as np
import pytest
from streamlit.testing.v1 import AppTest

from rotorcalc import simulate
from rotorcalc.measured import orbit_table, response_table
from tests.app.session import ORBITS, charts, faults, open_part, session_of, texts, visit
from tests.machines import RPM, SHEET
from ui.computed import computed_from
from ui.frame.page import PAGES
from ui.inputs import PRESET_VALUES
from ui.measured import Kind, Measured, Setting, Upload
from ui.words import measured as words

_PAGE = next(path for path, name in PAGES.items() if name == "Your data")
_RESPONSE = next(path for path, name in PAGES.items() if name == "Response")
SPEED = 6000 * RPM


@pytest.fixture(scope="module")
def files() -> dict[Kind, str]:
    c = computed_from(PRESET_VALUES["sheet-1e8"])
    angles = Setting().angles
    return {"orbit": words._sample_orbit(c, angles), "response": words._sample_response(c, angles)}


def page_with(files: dict[Kind, str], page: str, **query: str) -> AppTest:
    """Return a page of a visitor who gave these files."""
    at = visit(page, **query)
    mine = Measured()
    for kind, text in files.items():
        mine.take(kind, Upload(f"*{kind}*.csv", text.encode()))
        mine.read(kind)
    at.session_state["rotorcalc_measured"] = mine
    return at.run()


def traces(at: AppTest, chart: str) -> list[str]:
    return [one.get("name", "") for one in charts(at)[f"chart_{chart}"]["data"]]


def test_what_was_read_is_said_in_the_visitors_units(files: dict[Kind, str]) -> None:
    at = page_with(files, _PAGE, tab="Measured vibration", units="US", amplitude="p-p")
    said = "\n".join(texts(at))
    assert faults(at) == []
    assert "1889 samples, 59 revolutions, running speed 6000 rpm, from the keyphasor" in said
    assert "**whirl** at 0.5" in said
    assert "decaying: growth rate −2" in said
    # 4.85 µm zero to peak are 0.38 mil peak to peak.
    assert "X 0.38" in said
    assert "mil p-p, lag 102°" in said
    assert "60 speeds, 50 to 11850 rpm" in said
    assert "`*orbit*.csv`" in said


def test_orbit_and_spectrum_have_the_measured_ones_on_top(files: dict[Kind, str]) -> None:
    at = page_with(files, ORBITS)
    assert traces(at, "orbits_path")[-1] == "measured"
    frame = charts(at)["chart_orbits_path"]["frames"][0]
    assert len(traces(at, "orbits_path")) - 1 not in frame["traces"]
    assert any("Green: measured, the last 8 revolutions" in text for text in texts(at))
    open_part(at, "orbits_tab", "Spectrum")
    assert traces(at, "orbits_spectrum")[-1] == "measured"
    assert faults(at) == []


@pytest.mark.parametrize("shown", ["axes", "XY"])
def test_amplitude_and_phase_lie_on_those_of_the_machine(
    files: dict[Kind, str], shown: str
) -> None:
    at = page_with(files, _RESPONSE, shown=shown)
    for chart in ("amplitude", "phase"):
        own = {one["name"]: one for one in charts(at)[f"chart_{chart}"]["data"]}
        parts = ("X", "Y") if chart == "phase" or shown == "XY" else ("major", "|minor|")
        for part in parts:
            there = _points(own[f"measured {part}"])
            line = _points(own[f"journal {part}"])
            near = np.interp(there[0], *line)
            # At the lowest speeds the curve bends between the sweep's points.
            assert there[1][5:] == pytest.approx(near[5:], rel=5e-3), part


def _points(trace: dict) -> tuple[np.ndarray, np.ndarray]:
    return _array(trace["x"]), _array(trace["y"])


def _array(given: object) -> np.ndarray:
    import base64

    if isinstance(given, dict):
        return np.frombuffer(base64.b64decode(given["bdata"]), given["dtype"])
    return np.array(given, dtype=float)


def test_it_is_in_no_link_and_in_nothing_that_the_browser_keeps(files: dict[Kind, str]) -> None:
    at = page_with(files, _PAGE, tab="Measured vibration")
    plain = visit(_PAGE, tab="Measured vibration")
    assert at.query_params == plain.query_params
    kept = json.dumps(session_of(at).kept())
    assert len(kept) < 3000
    assert "measured_" not in kept
    assert "probe" not in kept


def test_a_refused_file_is_named_with_its_line_and_the_page_asks_for_what_it_lacks() -> None:
    motion = simulate(SHEET, SPEED, revolutions=8)
    table = orbit_table(motion, with_keyphasor=False)
    at = page_with(
        {"orbit": table.replace("time [s]", "clock [s]")}, _PAGE, tab="Measured vibration",
        rpm="7000",
    )  # fmt: skip
    assert {"measured_set_sample_rate", "measured_set_rpm"} <= {one.key for one in at.number_input}
    # Asked, and beginning with the machine's own.
    assert at.number_input(key="measured_set_rpm").value == 7000.0
    assert any("running speed 7000 rpm, as given" in text for text in texts(at))
    assert any("columns not read: `clock [s]`" in text for text in texts(at))
    rows = table.split("\r\n")
    rows[9] = "=1+1,2,3"
    at = page_with({"orbit": "\n".join(rows)}, _PAGE, tab="Measured vibration")
    (error,) = (one.value for one in at.error)
    assert "line 10, column time [s]: '=1+1' is a formula, which is not run" in error.replace(
        "`", ""
    )
    at.button(key="measured_remove_orbit").click().run()
    assert not at.error
    assert at.session_state["rotorcalc_measured"].uploads == {}


def test_too_short_an_orbit_is_drawn_and_says_what_it_is_too_short_for() -> None:
    table = orbit_table(simulate(SHEET, SPEED, revolutions=3), with_keyphasor=False)
    at = page_with({"orbit": table}, _PAGE, tab="Measured vibration")
    assert any("need more: `motion: 3 revolutions, must be 4" in text for text in texts(at))
    assert faults(at) == []


def test_probes_that_cannot_give_an_orbit_are_refused(files: dict[Kind, str]) -> None:
    at = page_with(files, _PAGE, tab="Measured vibration")
    at.number_input(key="measured_set_second").set_value(135.0).run()
    assert len(at.error) == 2
    assert "nearly parallel" in at.error[0].value
    at.number_input(key="measured_set_second").set_value(45.0).run()
    assert not at.error


def test_a_balanced_machine_offers_no_response() -> None:
    at = visit(_PAGE, tab="Measured vibration", u="0")
    keys = [one.key for one in at.get("download_button")]
    assert any("sample_orbit" in key for key in keys)
    assert not any("sample_response" in key for key in keys)


def test_a_bearing_without_a_motion_offers_no_orbit() -> None:
    at = visit(_PAGE, tab="Measured vibration", bearing="foil")
    keys = [one.key for one in at.get("download_button")]
    assert not any("sample_orbit" in key for key in keys)
    assert any("sample_response" in key for key in keys)


def test_a_table_of_a_balanced_rotor_has_no_phase_that_is_none() -> None:
    table = response_table(np.array([SPEED]), np.zeros((1, 2), complex))
    assert math.isfinite(float(table.split("\r\n")[1].split(",")[2]))
