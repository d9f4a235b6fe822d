"""What moves the onset, against `onset_speed` itself, machine by machine."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import minimize_scalar

from rotorcalc import PRESETS, Machine, PressureDam, analyse, design, onset_speed, variation
from rotorcalc.machine import JournalBearing, Oil, Rotor
from rotorcalc.onset import closed_form, curves
from rotorcalc.onset.many import onset_speeds
from tests.films.models import BEARINGS, Sprung

SHEET = PRESETS["sheet-1e8"].machine
RPM = math.pi / 30
DAMPED = replace(SHEET, rotor=replace(SHEET.rotor, disk_damping=5e3, journal_mass=10.0))


def _logarithmic(low: float, high: float) -> st.SearchStrategy[float]:
    return st.floats(math.log(low), math.log(high)).map(math.exp)


# As far as the widgets go, and further.
machines = st.builds(
    Machine,
    oil=st.builds(
        Oil,
        reference_viscosity=_logarithmic(1e-3, 0.5),
        reference_temperature=st.floats(0.0, 150.0),
        temperature_coefficient=st.floats(0.0, 0.08),
    ),
    bearing=st.builds(
        JournalBearing,
        diameter=_logarithmic(0.02, 0.6),
        length=_logarithmic(0.005, 0.3),
        radial_clearance=_logarithmic(1e-5, 5e-4),
    ),
    rotor=st.builds(
        Rotor,
        mass=_logarithmic(10.0, 2000.0),
        shaft_stiffness=_logarithmic(1e5, 1e10) | st.just(math.inf),
    ),
    temperature=st.floats(0.0, 150.0),
    load=st.none() | _logarithmic(1.0, 2e4),
)


@given(machine=machines)
def test_the_closed_form_is_the_crossing_of_the_eigenvalues(machine: Machine) -> None:
    assert closed_form.has_closed_form(machine)
    [speed] = onset_speeds([machine])
    below, above = speed * (1.0 - 1e-11), speed * (1.0 + 1e-11)
    assert analyse(machine, below).flexible_threshold > below
    assert analyse(machine, above).flexible_threshold < above
    # A light load on a soft shaft lets the growth rise so slowly through zero that the eigenvalues
    # tell the speed to no more than nine digits.
    assert speed == pytest.approx(onset_speed(machine).speed, rel=1e-7)


@given(machine=machines, flexible=st.booleans())
def test_one_machine_is_solved_as_many_are(machine: Machine, flexible: bool) -> None:
    onset = closed_form.closed_form_onset(machine, flexible=flexible)
    bends = machine if flexible else _rigid(machine)
    [speed] = onset_speeds([bends])
    assert onset.speed == pytest.approx(speed, rel=1e-13)
    there = analyse(machine, onset.speed)
    # Eq. 5.46 gives ω̄² as a difference of numbers of order one.
    ratio2 = (onset.whirl_frequency / onset.speed) ** 2
    assert ratio2 == pytest.approx(there.whirl_ratio**2, rel=1e-9, abs=1e-12)
    assert onset.eccentricity_ratio == pytest.approx(there.eccentricity_ratio, rel=1e-9)


def _rigid(machine: Machine) -> Machine:
    return replace(machine, rotor=replace(machine.rotor, shaft_stiffness=math.inf))


@pytest.mark.parametrize("machine", [SHEET, replace(SHEET, load=0.0), PRESETS["sheet-1e7"].machine])
@pytest.mark.parametrize("flexible", [True, False])
def test_the_closed_form_is_the_onset_on_the_eigenvalues(machine: Machine, flexible: bool) -> None:
    onset = closed_form.closed_form_onset(machine, flexible=flexible)
    found = onset_speed(machine, flexible=flexible)
    for name in ("speed", "whirl_frequency", "eccentricity_ratio"):
        assert getattr(onset, name) == pytest.approx(getattr(found, name), rel=1e-9), name


def test_a_machine_without_a_closed_form_raises_a_valueerror() -> None:
    with pytest.raises(ValueError, match="has midspan damping or another film, so no closed form"):
        closed_form.closed_form_onset(DAMPED)


def test_one_film_has_one_onset() -> None:
    """Both terms of the equation rise with σ, so it has one root whatever the static sag."""
    for term in curves.table():
        whirls = term > 0.0
        assert np.all(np.diff(term[whirls]) > 0.0)
        assert np.all(np.diff(whirls.astype(int)) >= 0)


def test_machines_of_all_kinds_are_solved_in_their_order() -> None:
    many = [SHEET, DAMPED, replace(SHEET, load=0.0), PRESETS["fig-5-2"].machine]
    expected = [onset_speed(machine).speed for machine in many]
    np.testing.assert_allclose(onset_speeds(many), expected, rtol=1e-9)
    assert len(onset_speeds([])) == 0


@pytest.mark.parametrize(
    ("rotor", "closed"),
    [
        ({}, True),
        ({"shaft_stiffness": math.inf}, True),
        ({"shaft_stiffness": math.inf, "journal_mass": 20.0}, True),  # all moves as one
        ({"journal_mass": 20.0}, False),  # a balance, but not Eq. 5.50
        ({"disk_damping": 1.0}, False),
        ({"shaft_stiffness": math.inf, "disk_damping": 1.0}, False),
    ],
)
def test_a_closed_form_needs_no_damper_and_massless_journals_or_a_rigid_shaft(
    rotor: dict[str, float], closed: bool
) -> None:
    machine = replace(SHEET, rotor=replace(SHEET.rotor, **rotor))
    assert closed_form.has_closed_form(machine) is closed
    [speed] = onset_speeds([machine])
    assert speed == pytest.approx(onset_speed(machine).speed, rel=1e-9)


# --- Inputs by name -------------------------------------------------------------------------


def test_an_input_is_named_by_its_path_or_its_last_name() -> None:
    for field in ("bearing.radial_clearance", "radial_clearance"):
        assert variation.value_of(SHEET, field) == 60e-6
        other = variation.varied(SHEET, {field: 80e-6})
        assert other == replace(SHEET, bearing=replace(SHEET.bearing, radial_clearance=80e-6))


def test_several_inputs_of_one_record_change_at_once() -> None:
    other = variation.varied(SHEET, {"mass": 10.0, "rotor.journal_mass": 4.0, "temperature": 20.0})
    assert (other.rotor.mass, other.rotor.journal_mass, other.temperature) == (10.0, 4.0, 20.0)


def test_the_load_follows_the_mass_until_it_is_given() -> None:
    heavier = variation.varied(SHEET, {"mass": 2.0 * SHEET.rotor.mass})
    assert heavier.static_load == pytest.approx(2.0 * SHEET.static_load)
    assert variation.value_of(SHEET, "load") == SHEET.static_load
    loaded = variation.varied(SHEET, {"load": 500.0})
    assert variation.varied(loaded, {"mass": 1000.0}).static_load == 500.0


@pytest.mark.parametrize("field", ["clearance", "bearing.mass", "film", "oil", "rotor.", ""])
def test_an_unknown_input_is_named(field: str) -> None:
    for ask in (variation.value_of, lambda m, f: variation.varied(m, {f: 1.0})):
        with pytest.raises(ValueError, match="no input of a machine"):
            ask(SHEET, field)
    with pytest.raises(ValueError, match="no input of a machine"):
        design.onset_map(SHEET, x=field, xs=[1.0], y="load", ys=[1.0])


def test_a_geometrys_inputs_are_among_its_machines() -> None:
    sprung = replace(SHEET, bearing=BEARINGS["sprung"])
    for field in ("bearing.geometry.ratio", "geometry.ratio", "ratio"):
        assert variation.value_of(sprung, field) == 0.5
        changed = variation.varied(sprung, {field: 0.7, "radial_clearance": 80e-6})
        assert changed.bearing.geometry == Sprung(ratio=0.7)
        assert changed.bearing.radial_clearance == 80e-6
        with pytest.raises(ValueError, match="no input of a machine"):
            variation.value_of(SHEET, field)
    assert variation.value_of(sprung, "mass") == SHEET.rotor.mass


# --- The map --------------------------------------------------------------------------------


AXES = {
    "radial_clearance": np.geomspace(1e-5, 5e-4, 60),
    "temperature": np.linspace(0.0, 150.0, 60),
    "oil.reference_viscosity": np.geomspace(1e-3, 0.5, 60),
    "load": np.linspace(0.0, 2e4, 60),
    "rotor.mass": np.geomspace(10.0, 2000.0, 60),
    "shaft_stiffness": np.geomspace(1e5, 1e10, 60),
    "length": np.geomspace(5e-3, 0.3, 60),
    "diameter": np.geomspace(0.02, 0.6, 60),
}


@pytest.mark.parametrize(
    ("x", "y"),
    [
        ("radial_clearance", "temperature"),
        ("load", "rotor.mass"),
        ("shaft_stiffness", "length"),
        ("diameter", "oil.reference_viscosity"),
    ],
)
@pytest.mark.parametrize("key", PRESETS)
def test_a_map_is_the_onset_of_each_machine_on_it(key: str, x: str, y: str) -> None:
    machine = PRESETS[key].machine
    found = design.onset_map(machine, x=x, xs=AXES[x], y=y, ys=AXES[y])
    assert found.speed.shape == (60, 60)
    draw = np.random.default_rng(5)
    for i, j in draw.integers(60, size=(8, 2)):
        cell = variation.varied(machine, {x: float(found.xs[j]), y: float(found.ys[i])})
        assert found.speed[i, j] == pytest.approx(onset_speed(cell).speed, rel=1e-9)


def test_a_map_with_damping_reports_its_progress() -> None:
    told: list[float] = []
    xs, ys = np.array([5e-5, 1e-4]), np.array([0.0, 1e3, 1e4])
    found = design.onset_map(
        SHEET, x="radial_clearance", xs=xs, y="disk_damping", ys=ys, progress=told.append
    )
    assert told == pytest.approx([1 / 3, 2 / 3, 1.0])
    for j, C in enumerate(xs):
        for i, C_s in enumerate(ys):
            cell = variation.varied(
                SHEET, {"radial_clearance": float(C), "disk_damping": float(C_s)}
            )
            assert found.speed[i, j] == pytest.approx(onset_speed(cell).speed, rel=1e-9)


@pytest.mark.parametrize(("rows", "blocks"), [(1, 1), (3, 3), (4, 4), (8, 4), (11, 4)])
def test_a_map_of_many_rows_reports_its_progress_by_blocks(rows: int, blocks: int) -> None:
    heard: list[float] = []
    axes = {"xs": [60e-6], "ys": np.linspace(1e3, 1e4, rows)}
    found = design.onset_map(
        SHEET, x="radial_clearance", y="disk_damping", progress=heard.append, **axes
    )
    assert heard == sorted(heard)
    assert heard[-1] == 1.0
    assert len(heard) == blocks
    onsets = [onset_speed(variation.varied(SHEET, {"disk_damping": c})).speed for c in found.ys]
    np.testing.assert_allclose(found.speed[:, 0], onsets, rtol=1e-9)


def test_a_map_has_a_gap_where_the_values_make_no_machine() -> None:
    xs, ys = [0.0, 60.0, 200.0], [100.0, 1000.0]
    found = design.onset_map(SHEET, x="journal_mass", xs=xs, y="mass", ys=ys)
    np.testing.assert_array_equal(np.isnan(found.speed), [[False, True, True], [False] * 3])


def test_a_map_needs_two_inputs() -> None:
    with pytest.raises(ValueError, match="must differ"):
        design.onset_map(SHEET, x="load", xs=[1.0], y="load", ys=[1.0])


# --- Sensitivities --------------------------------------------------------------------------


@pytest.mark.parametrize("machine", [SHEET, DAMPED], ids=["closed form", "eigenvalues"])
def test_sensitivities_are_onsets_of_moved_machines(machine: Machine) -> None:
    found = design.sensitivities(machine)
    assert found.onset == pytest.approx(onset_speed(machine).speed, rel=1e-9)
    moves = []
    for one in found.inputs:
        for value, onset in ((one.low, one.onset_low), (one.high, one.onset_high)):
            moved = variation.varied(machine, {one.field: value})
            assert onset == pytest.approx(onset_speed(moved).speed, rel=1e-9)
        moves.append(max(abs(one.onset_low - found.onset), abs(one.onset_high - found.onset)))
    assert moves == sorted(moves, reverse=True)


def test_inputs_move_by_a_tenth_and_temperature_by_degrees() -> None:
    values = {one.field: (one.low, one.high) for one in design.sensitivities(SHEET).inputs}
    assert values["bearing.radial_clearance"] == pytest.approx((54e-6, 66e-6))
    assert values["load"] == pytest.approx((0.9 * SHEET.static_load, 1.1 * SHEET.static_load))
    assert values["temperature"] == (55.0, 65.0)


def test_a_value_that_follows_from_others_is_varied_from_what_follows() -> None:
    dam = replace(PRESETS["sheet-1e8"].machine, bearing=BEARINGS["pressure dam"])
    depth = 2.0 * dam.bearing.radial_clearance
    assert variation.value_of(dam, "depth") == depth
    (step,) = design.sensitivities(dam, inputs=["depth"]).inputs
    assert (step.low, step.high) == pytest.approx((0.9 * depth, 1.1 * depth))
    deeper = replace(dam, bearing=replace(dam.bearing, geometry=PressureDam(depth=1.1 * depth)))
    assert step.onset_high == pytest.approx(onset_speed(deeper).speed, rel=1e-9)
    grooves = replace(dam, bearing=BEARINGS["axial grooves"])
    assert variation.value_of(grooves, "first") == math.pi / 2


def test_an_infinite_input_is_left_out() -> None:
    rigid = replace(SHEET, rotor=replace(SHEET.rotor, shaft_stiffness=math.inf), load=0.0)
    assert design.sensitivities(rigid).left_out == ("rotor.shaft_stiffness",)


def test_a_load_damping_or_mass_of_zero_is_raised() -> None:
    values = {one.field: (one.low, one.high) for one in design.sensitivities(SHEET).inputs}
    M, K = SHEET.rotor.half_mass, SHEET.rotor.shaft_stiffness
    assert values["rotor.disk_damping"] == (0.0, pytest.approx(0.2 * math.sqrt(K * M)))
    assert values["rotor.journal_mass"] == (0.0, pytest.approx(0.1 * M))


def test_without_load_a_load_alone_raises_the_onset() -> None:
    unloaded = replace(SHEET, load=0.0)
    first, *others = design.sensitivities(unloaded).inputs
    weight = SHEET.static_load
    assert (first.field, first.low) == ("load", 0.0)
    assert first.high == pytest.approx(0.1 * weight)
    expected = onset_speed(replace(SHEET, load=0.1 * weight)).speed
    assert first.onset_high == pytest.approx(expected, rel=1e-9)
    assert {(one.onset_low, one.onset_high) for one in others} == {(0.0, 0.0)}


def test_a_bores_own_inputs_are_among_those_that_move_the_onset() -> None:
    machine = replace(SHEET, bearing=BEARINGS["preloaded"], load=0.0)
    assert design.inputs_of(SHEET) == design.INPUTS
    assert design.inputs_of(machine) == (*design.INPUTS, "bearing.geometry.spring")
    moved = {one.field: one for one in design.sensitivities(machine).inputs}
    spring = moved["bearing.geometry.spring"]
    assert 0.0 < spring.onset_low < spring.onset_high


@pytest.mark.parametrize("share", [0.91, 0.95, 0.999])
def test_inputs_that_cannot_be_varied_are_left_out(share: float) -> None:
    """A tenth more of the journals' mass, or less of the rotor's, leaves no disk."""
    heavy = replace(SHEET.rotor, journal_mass=share * SHEET.rotor.half_mass)
    found = design.sensitivities(replace(SHEET, rotor=heavy))
    assert {"rotor.journal_mass", "rotor.mass"} == set(found.left_out)
    moved = {one.field for one in found.inputs}
    assert moved | set(found.left_out) == set(design.INPUTS)


def test_the_small_clearance_and_the_large_load_raise_the_onset() -> None:
    """Ω_s ∝ √(F_o/MC) at a fixed film: half a tenth of a rigid rotor's onset."""
    rigid = variation.varied(PRESETS["fig-5-2"].machine, {"length": 0.15})  # nearly centred
    by_field = {one.field: one for one in design.sensitivities(rigid).inputs}
    onset = onset_speeds([rigid])[0]
    assert by_field["bearing.radial_clearance"].onset_low / onset == pytest.approx(
        0.9**-0.5, rel=2e-3
    )
    assert by_field["load"].onset_high / onset == pytest.approx(1.1**0.5, rel=2e-3)


# --- Solving for an input -------------------------------------------------------------------


@pytest.mark.parametrize(
    ("vary", "low", "high"),
    [
        ("radial_clearance", 1e-5, 5e-4),
        ("load", 0.0, 2e4),
        ("shaft_stiffness", 1e5, 1e10),
        ("length", 5e-3, 0.3),
        ("temperature", 0.0, 150.0),
        ("oil.reference_viscosity", 1e-3, 0.5),
    ],
)
@pytest.mark.parametrize("rpm", [4700.0, 7200.0, 8800.0])
def test_solutions_put_the_onset_at_the_target(
    vary: str, low: float, high: float, rpm: float
) -> None:
    found = design.solve_onset(SHEET, vary=vary, target=rpm * RPM, low=low, high=high)
    least, most = found.reachable
    for value in found.solutions:
        assert low <= value <= high
        onset = onset_speed(variation.varied(SHEET, {vary: float(value)})).speed
        assert onset == pytest.approx(rpm * RPM, rel=1e-9)
    assert (len(found.solutions) > 0) == (least <= rpm * RPM <= most)


def test_an_onset_that_falls_and_rises_gives_two_solutions() -> None:
    found = design.solve_onset(
        SHEET, vary="radial_clearance", target=7200 * RPM, low=1e-5, high=5e-4
    )
    assert found.solutions == pytest.approx([100.44e-6, 459.40e-6], rel=1e-4)


def test_both_solutions_beside_an_extreme_are_found() -> None:
    """Closer to the lowest onset than the scan sees."""
    span = {"vary": "radial_clearance", "low": 1e-5, "high": 5e-4}
    least = minimize_scalar(
        lambda C: onset_speeds([variation.varied(SHEET, {"radial_clearance": C})])[0],
        bounds=(1e-4, 5e-4),
        method="bounded",
        options={"xatol": 1e-10},
    ).fun
    found = design.solve_onset(SHEET, target=least * (1.0 + 1e-7), **span)
    assert len(found.solutions) == 2
    assert found.solutions[0] == pytest.approx(found.solutions[1], rel=1e-2)
    assert found.reachable[0] == pytest.approx(least, rel=1e-9)
    none = design.solve_onset(SHEET, target=least * (1.0 - 1e-7), **span)
    assert len(none.solutions) == 0


def test_without_a_solution_the_reachable_range_is_given() -> None:
    found = design.solve_onset(SHEET, vary="temperature", target=20000 * RPM, low=0.0, high=150.0)
    assert len(found.solutions) == 0
    onsets = [
        onset_speed(variation.varied(SHEET, {"temperature": T})).speed for T in (0.0, 75.0, 150.0)
    ]
    least, most = found.reachable
    assert least <= min(onsets) * (1 + 1e-9)
    assert max(onsets) * (1 - 1e-9) <= most < 20000 * RPM


def test_a_damped_machine_is_solved_on_its_eigenvalues() -> None:
    found = design.solve_onset(
        DAMPED, vary="radial_clearance", target=7200 * RPM, low=4e-5, high=2e-4
    )
    assert len(found.solutions) == 1
    solved = variation.varied(DAMPED, {"radial_clearance": float(found.solutions[0])})
    assert onset_speed(solved).speed == pytest.approx(7200 * RPM, rel=1e-9)


def test_a_target_between_two_branches_is_no_solution() -> None:
    """At a damping the whirl of the first branch is quenched: the onset jumps to the second."""
    soft = replace(SHEET, rotor=replace(SHEET.rotor, shaft_stiffness=1.5e7, journal_mass=20.0))
    span = {"vary": "disk_damping", "low": 1e2, "high": 1e5}
    found = design.solve_onset(soft, target=1500.0, **span)
    steps = found.onset[1:] / found.onset[:-1]
    assert np.any(steps > 1.5)
    at = int(np.argmax(steps))
    between = math.sqrt(found.onset[at] * found.onset[at + 1])
    missed = design.solve_onset(soft, target=between, **span)
    assert not np.any(
        (missed.solutions > found.values[at]) & (missed.solutions < found.values[at + 1])
    )


def test_a_jump_past_the_target_is_no_solution(monkeypatch: pytest.MonkeyPatch) -> None:
    def jump(machines: list[Machine]) -> np.ndarray:
        return np.array([100.0 if one.static_load < 1000.0 else 300.0 for one in machines])

    monkeypatch.setattr(design, "onset_speeds", jump)
    found = design.solve_onset(SHEET, vary="load", target=200.0, low=500.0, high=2000.0)
    assert len(found.solutions) == 0
    assert found.reachable == (100.0, 300.0)


def test_an_onset_at_infinity_is_bracketed_too(monkeypatch: pytest.MonkeyPatch) -> None:
    def vanish(machines: list[Machine]) -> np.ndarray:
        loads = np.array([one.static_load for one in machines])
        return np.where(loads < 1000.0, loads, np.inf)

    def unknown(_machine: Machine, _speed: float) -> float:
        raise ValueError("no film")

    monkeypatch.setattr(design, "onset_speeds", vanish)
    monkeypatch.setattr(design, "edge", unknown)  # then the onset itself is bracketed
    found = design.solve_onset(SHEET, vary="load", target=700.0, low=500.0, high=2000.0)
    assert found.solutions == pytest.approx([700.0])
    assert math.isinf(found.reachable[1])


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"target": 0.0}, "target"),
        ({"target": math.nan}, "target"),
        ({"target": math.inf}, "target"),
        ({"low": 2e-4, "high": 1e-4}, "high"),
        ({"vary": "shaft_stiffness", "low": 1e6, "high": math.inf}, "must both be finite"),
        ({"high": math.nan}, "must both be finite"),
        ({"low": -math.inf}, "must both be finite"),
        ({"low": -1e-4}, "radial_clearance"),
        ({"vary": "clearance"}, "no input"),
    ],
)
def test_an_input_that_cannot_be_solved_for_is_named(wrong: dict[str, float], message: str) -> None:
    asked = {"vary": "radial_clearance", "target": 700.0, "low": 1e-5, "high": 1e-4} | wrong
    with pytest.raises(ValueError, match=message):
        design.solve_onset(SHEET, **asked)


@pytest.mark.parametrize("share", [1.5, 1.0, 0.0, -0.1, math.nan, math.inf])
def test_a_share_that_leaves_nothing_of_an_input_is_refused(share):
    with pytest.raises(ValueError, match=r"share = .*: must be between 0 and 1"):
        design.sensitivities(SHEET, share=share)


# --- Films without an answer ----------------------------------------------------------------

# Recesses that carry half the rotor's weight, 1334 N, and not three times that.
RECESSED = replace(SHEET, bearing=replace(BEARINGS["hydrostatic"], film="coarse"))
SUPPLIED = variation.varied(RECESSED, {"supply_pressure": 1e6})


def test_a_map_is_empty_where_a_film_has_no_answer() -> None:
    found = design.onset_map(
        SUPPLIED, x="load", xs=[500.0, 5e3], y="supply_pressure", ys=[1e6, 4e6]
    )
    assert np.isnan(found.speed).tolist() == [[False, True], [False, False]]
    alone = onset_speed(variation.varied(SUPPLIED, {"load": 500.0})).speed
    assert found.speed[0, 0] == pytest.approx(alone, rel=1e-12)


def test_an_input_whose_other_value_leaves_no_answer_is_left_out() -> None:
    heavy = variation.varied(SUPPLIED, {"load": 2200.0})
    found = design.sensitivities(heavy, share=0.2, inputs=["load", "mass"])
    assert found.left_out == ("load",)
    assert [one.field for one in found.inputs] == ["mass"]
    with pytest.raises(ValueError, match="static load"):
        design.sensitivities(variation.varied(SUPPLIED, {"load": 1e4}), inputs=["mass"])


def test_a_wanted_onset_is_sought_where_the_film_answers() -> None:
    target = onset_speed(variation.varied(SUPPLIED, {"load": 1e3})).speed
    found = design.solve_onset(SUPPLIED, vary="load", target=target, low=200.0, high=1e4)
    assert found.values[-1] < 1e4
    assert np.isfinite(found.onset).all()
    assert found.solutions == pytest.approx([1e3], rel=1e-6)
    with pytest.raises(ValueError, match="static load"):
        design.solve_onset(SUPPLIED, vary="load", target=target, low=1e4, high=2e4)
