"""Bearings of other kinds, made for the tests, go through every page, link, file and export."""

import csv
import html
import io
import itertools
import math
from dataclasses import replace
from types import SimpleNamespace

import pytest
from scipy.constants import degree

from rotorcalc import Machine, PartialArc
from rotorcalc.figures.cases import COLOURS
from rotorcalc.films import film_of
from rotorcalc.geometry import Geometry
from rotorcalc.units import SI, US
from tests.app.session import (
    HOME,
    NOTES,
    ORBITS,
    PAGES,
    comparison,
    faults,
    session_of,
    texts,
    tours,
    visit,
)
from tests.films.models import BEARINGS, FINITE, MOVING, PADS, RINGS, SHORT_PADS, Ringed
from tests.machines import SHEET
from ui.bearing import _TAKEN, bearing_values, fields_of, shape_of
from ui.bores import name_of
from ui.cases import Case, Shown
from ui.computed import Computed
from ui.inputs import INPUTS, LAW, machine_of, values_of
from ui.sharing import address, export, popover, report
from ui.sharing.labels import Labels

RPM = math.pi / 30
FIXED = [*FINITE, *SHORT_PADS]
OTHERS = [name for name in BEARINGS if name != "short"]
# The last bearing of each class of films visits every page, where its citations are read
# (tests/app/test_sources.py); the others visit home and one page more, in turn.
EVERYWHERE = list({type(film_of(bearing)): name for name, bearing in BEARINGS.items()}.values())
_REST = [name for name in OTHERS if name not in EVERYWHERE]
VISITS = [(HOME, name) for name in _REST] + list(
    zip(itertools.cycle(path for path in PAGES if path != HOME), _REST, strict=False)
)
# Keys of the address bar that are not inputs yet.
_LATER = ("tab", "present")
SPEED, TOP = 6000 * RPM, 12000 * RPM
SHEETS = Shown(Case("Sheet", values_of(SHEET, SPEED, TOP), COLOURS[0]), Computed(SHEET, SPEED, TOP))


def machine(name: str) -> Machine:
    return replace(SHEET, bearing=BEARINGS[name])


def on(geometry: Geometry) -> Machine:
    return replace(SHEET, bearing=replace(SHEET.bearing, geometry=geometry))


def query(name: str) -> dict[str, str]:
    return address.write("sheet-1e8", values_of(machine(name), SPEED, TOP), "SI")


@pytest.mark.parametrize("name", BEARINGS)
def test_values_lead_to_the_bearing_and_back(name: str) -> None:
    bearing = BEARINGS[name]
    values = values_of(machine(name), SPEED, TOP)
    assert machine_of(values).bearing == bearing
    assert shape_of(values) == (bearing.geometry, bearing.film)
    explicit = replace(bearing, film=bearing.geometry.models[-1])
    assert machine_of(values | bearing_values(explicit)).bearing == explicit


@pytest.mark.parametrize("name", BEARINGS)
@pytest.mark.parametrize("place", [0, -1])
def test_a_link_has_the_whole_bearing(name: str, place: int) -> None:
    film = BEARINGS[name].geometry.models[place]
    whole = replace(machine(name), bearing=replace(BEARINGS[name], film=film))
    link = address.read(address.write("sheet-1e8", values_of(whole, SPEED, TOP), "SI"))
    assert link.problems == []
    assert machine_of(link.values).bearing == whole.bearing


def test_a_link_writes_a_bore_in_the_units_of_engineers() -> None:
    ring = Ringed(outer_clearance=110e-6, share=0.25)
    whole = replace(SHEET, bearing=replace(SHEET.bearing, geometry=ring))
    written = address.write("sheet-1e8", values_of(whole, SPEED, TOP), "SI")
    assert written["bearing"] == "ringed"
    assert written["outer_clearance"] == "110"
    # A key that means something else in the address bar says that it is the bearing's.
    assert written["bearing_share"] == "0.25"
    assert "ring_mass" not in written
    link = address.read(written)
    assert link.problems == []
    assert machine_of(link.values) == whole


def test_a_link_gives_back_an_angle_to_the_last_bit() -> None:
    for degrees in (0.1, 13.0, 33.3, 52.0, 68.0, 127.0, 145.0, 150.0, 154.0):
        arc = PartialArc(arc=degrees * degree, centre=-degrees / 2 * degree)
        link = address.read({"bearing": "partial-arc", "arc": f"{degrees:g}"})
        assert machine_of(link.values).bearing.geometry == PartialArc(arc=degrees * degree)
        written = address.write("sheet-1e8", values_of(on(arc), SPEED, TOP), "SI")
        assert written.get("arc", "150") == f"{degrees:g}"
        assert machine_of(address.read(written).values).bearing.geometry == arc
    # One that is no round number of degrees keeps its digits.
    odd = PartialArc(arc=1.2345678901234567)
    written = address.write("sheet-1e8", values_of(on(odd), SPEED, TOP), "SI")
    assert machine_of(address.read(written).values).bearing.geometry == odd


@pytest.mark.parametrize("name", FIXED)
def test_a_link_leaves_out_what_is_at_its_default(name: str) -> None:
    written = address.write("sheet-1e8", values_of(machine(name), SPEED, TOP), "SI")
    usual = address.write("sheet-1e8", values_of(SHEET, SPEED, TOP), "SI")
    assert set(written) - set(usual) <= {"bearing", "film"}


def test_no_field_of_a_bore_takes_the_key_of_an_input() -> None:
    assert set(INPUTS) < _TAKEN
    assert {"bearing", "film", "preset", "units", LAW, *_LATER} < _TAKEN


@pytest.mark.parametrize(
    ("given", "word"),
    [
        ({"bearing": "square"}, "`'square'` is not one of plain"),
        ({"bearing": "ringed", "bearing_share": "-1"}, "must be positive"),
        ({"bearing": "ringed", "bearing_share": "-1"}, "Bearing share"),
        ({"bearing": "ringed", "outer_clearance": "wide"}, "is not a number"),
        ({"bearing": "sprung", "outer_clearance": "90"}, "is not an input of this machine"),
        ({"bearing": "pressure-dam", "film": "short"}, "film = 'short'"),
        ({"film": "<b>"}, "film"),
    ],
)
def test_bearing_fields_that_cannot_be_used_are_named(given: dict[str, str], word: str) -> None:
    link = address.read(given)
    (problem,) = link.problems
    assert word in problem
    machine_of(link.values)


@pytest.mark.parametrize("name", BEARINGS)
def test_an_uploaded_machine_keeps_its_bearing(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    at = visit(HOME)
    visitor = session_of(at)
    upload = SimpleNamespace(name="m.json", getvalue=lambda: machine(name).to_json().encode())
    monkeypatch.setattr(popover, "session", lambda: visitor)
    monkeypatch.setattr(popover.st, "session_state", {"upload": upload})
    popover._load()
    assert visitor.problems == []
    assert machine_of(visitor.values).bearing == BEARINGS[name]


@pytest.mark.parametrize("name", BEARINGS)
def test_files_are_written_for_every_bearing(name: str) -> None:
    shown = Computed(machine(name), SPEED, TOP)
    text = export.sweep_csv(shown, SI).decode("utf-8-sig")
    rows = [row for row in csv.reader(io.StringIO(text)) if not row[0].startswith("#")]
    assert len(rows) == 1 + len(shown.sweep.speed)
    # A film that the load presses onto its wall has no answer at the lowest speeds.
    assert len(rows) == 241 or (name in ("sprung", "multi dam") and 200 < len(rows) < 241)
    assert all(len(row) == len(rows[0]) for row in rows)
    assert export.ross_table(shown)[:2] == b"PK"
    page = report.report(shown, [SHEETS], US, "link", Labels()).decode()
    for field in fields_of(BEARINGS[name].geometry.kind).values():
        assert html.escape(field.label) in page
    for words in ("Kind of bearing", name_of(BEARINGS[name].geometry.kind), "Film model"):
        assert f"<td>{words}</td>" in page or f'<td class="n">{words}</td>' in page


def refusal(path: str, name: str) -> str:
    """Return what a page lacks: Orbits need a force in any motion, and every tab says so."""
    if path != ORBITS or name in (*MOVING, *FINITE, *PADS, *RINGS):
        return ""
    with pytest.raises(ValueError, match="motion") as refused:
        film_of(BEARINGS[name]).motion()
    return str(refused.value).partition(": ")[2]


@pytest.mark.usefixtures("coarse_maps")
@pytest.mark.parametrize(("path", "name"), VISITS)
def test_every_page_shows_every_bearing(path: str, name: str) -> None:
    # Pads on one side only push: a journal without mass has no velocity where it is pulled.
    mass = {"mj": "10"} if "partial arc" in name else {}
    at = visit(path, **query(name) | mass)
    for tab in tours(at):
        assert faults(at) == [], tab
        lacks = refusal(path, name)
        assert not lacks or any(lacks in one.value for one in at.info), tab
    assert not at.warning or path != HOME
    assert machine_of(session_of(at).values).bearing == BEARINGS[name]


def test_a_massless_journal_that_pads_on_one_side_cannot_follow_is_refused_in_words() -> None:
    at = visit(ORBITS, **query("short partial arc"))
    (said,) = faults(at)
    assert "give the journals a mass. It stopped after" in said


@pytest.mark.parametrize("path", PAGES)
def test_no_page_gives_a_threshold_to_a_film_that_cannot_whirl(path: str) -> None:
    assert not film_of(BEARINGS["sprung"]).can_whirl
    at = visit(path, **query("sprung"))
    said = "\n".join(text for _ in tours(at) for text in texts(at))
    assert path == NOTES or "0.7560" not in said
    if path == "pages/3_Stability.py":
        assert "cannot whirl" in said


def test_a_bearing_of_another_kind_is_distinguished_in_the_cases() -> None:
    at = visit(HOME, **query("ringed"))
    at.button(key="keep").click().run()
    session_of(at).values = values_of(SHEET, SPEED, TOP)
    at.run()
    rows = comparison(at)
    assert rows["Bearing"] == "Plain circular | Ringed"
    assert "Outer clearance [µm]" in rows
    assert faults(at) == []
