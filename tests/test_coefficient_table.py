"""A table of a bearing's own coefficients in place of a film: the machine it was made of."""

import itertools
import json
import math
import re
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

import rotorcalc as rc
from rotorcalc import unbalance_curves
from rotorcalc.coefficient_files import written
from rotorcalc.comparison import bearing_result
from rotorcalc.criteria.campbell import campbell
from rotorcalc.criteria.checks import checks
from rotorcalc.variation import damping_reference

SHEET = rc.PRESETS["sheet-1e7"].machine
REAL = replace(SHEET, rotor=replace(SHEET.rotor, imbalance=12e-6))
FIRST, LAST = 200.0, 1500.0
INSIDE = np.linspace(211.0, 1489.0, 60)


def table_of(machine, speed):
    """Return the table of a machine's coefficients at speeds."""
    sweep = rc.analyse(machine, speed)
    return rc.CoefficientTable(speed=sweep.speed, stiffness=sweep.stiffness, damping=sweep.damping)


def machine_of(rows, machine=REAL):
    """Return a machine on the table of its own film at speeds in equal ratios."""
    return replace(machine, bearing=table_of(machine, np.geomspace(FIRST, LAST, rows)))


@pytest.fixture(scope="module")
def coarse():
    return machine_of(20)


@pytest.fixture(scope="module")
def fine():
    return machine_of(400)


# The record


def two_rows(**changes):
    """Return the fields of a small table, some of them changed."""
    fields = {
        "speed": [100.0, 200.0],
        "stiffness": [[[1e7, 2e6], [-2e6, 1e7]], [[2e7, 3e6], [-3e6, 2e7]]],
        "damping": [[[1e5, 1e3], [1e3, 1e5]], [[9e4, 2e3], [2e3, 9e4]]],
    }
    return fields | changes


def test_lists_tuples_and_arrays_make_one_table():
    fields = two_rows()
    arrays = {name: np.array(rows) for name, rows in fields.items()}
    one, other = rc.CoefficientTable(**fields), rc.CoefficientTable(**arrays)
    assert one == other
    assert hash(one) == hash(other)
    assert isinstance(one.stiffness[0][0], tuple)
    assert one != rc.CoefficientTable(**two_rows(speed=[100.0, 201.0]))


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"speed": [100.0], "stiffness": two_rows()["stiffness"][:1],
          "damping": two_rows()["damping"][:1]}, "speed: has 1 row; .* needs at least 2"),
        ({"speed": []}, "speed: has 0 rows"),
        ({"speed": 100.0}, r"speed = 100.0: must be a list of numbers, \(n\)"),
        ({"speed": [200.0, 100.0]}, r"speed\[1\] = 100 rad/s: must be greater than .* 200 rad/s"),
        ({"speed": [100.0, 100.0]}, r"speed\[1\] = 100 rad/s: must be greater"),
        ({"speed": [0.0, 100.0]}, r"speed\[0\] = 0 rad/s: must be positive"),
        ({"speed": [100.0, math.nan]}, r"speed\[1\] = nan rad/s: must be finite"),
        ({"speed": ["100", 200.0]}, r"speed\[0\] = '100': must be a number in rad/s"),
        ({"stiffness": two_rows()["stiffness"][:1]}, "stiffness: has 1 rows, must have 2"),
        ({"damping": [[1.0, 2.0], [3.0, 4.0]]}, r"damping\[0\]\[0\] = 1.0: must be a list of 2"),
        ({"damping": [[[1.0], [2.0]]] * 2}, r"damping\[0\]\[0\] = \[1.0\]: must be a list of 2"),
        ({"stiffness": [[[1.0, math.inf], [0.0, 1.0]]] * 2},
         r"stiffness\[0\]\[0\]\[1\] = inf N/m: must be finite"),
    ],
)  # fmt: skip
def test_a_bad_table_is_refused_with_row_value_and_bound(changes, words):
    with pytest.raises(ValueError, match=words):
        rc.CoefficientTable(**two_rows(**changes))


def test_json_returns_the_machine_to_the_last_bit(fine):
    assert rc.Machine.from_json(fine.to_json()) == fine
    assert json.loads(fine.to_json())["bearing"]["type"] == "own-coefficients"
    assert "type" not in json.loads(REAL.to_json())["bearing"]  # old files stay as they are


@pytest.mark.parametrize(
    ("break_it", "words"),
    [
        (lambda tree: tree.update(type="spline"), "bearing.type = 'spline': must be one of"),
        (lambda tree: tree.pop("damping"), "bearing.damping: missing"),
        (lambda tree: tree.update(diameter=0.1), "bearing.diameter: unknown key"),
        (lambda tree: tree["speed"].reverse(), r"speed\[1\] = "),
    ],
)
def test_a_file_with_a_bad_table_is_refused(coarse, break_it, words):
    document = json.loads(coarse.to_json())
    break_it(document["bearing"])
    with pytest.raises(ValueError, match=words):
        rc.Machine.from_json(json.dumps(document))


def test_the_csv_gives_the_table_back_to_the_last_bit(coarse):
    table = coarse.bearing
    read = rc.read_coefficients(written(table.speed, table.stiffness, table.damping))
    assert (
        rc.CoefficientTable(speed=read.speed, stiffness=read.stiffness, damping=read.damping)
        == table
    )


def test_a_supply_is_refused_and_any_lubricant_taken(coarse):
    with pytest.raises(ValueError, match=r"supply: .* a table of coefficients does not know"):
        replace(coarse, temperature=None, supply=rc.Supply(temperature=40.0))
    on_gas = replace(coarse, oil=rc.Gas(), temperature=20.0, load=1.0)
    assert rc.onset_speed(on_gas) == rc.onset_speed(coarse)  # nothing of it depends on them
    with pytest.raises(ValueError, match="UnknownBore"):
        replace(REAL.bearing, geometry=coarse.bearing.geometry)


# Between the rows


def slopes(x, y):
    """Return the slopes of Fritsch and Butland at places x, and the three-point ones at ends."""
    h, d = np.diff(x), np.diff(y) / np.diff(x)
    found = np.zeros(len(x))
    for i in range(1, len(x) - 1):
        if d[i - 1] * d[i] > 0.0:
            w1, w2 = 2.0 * h[i] + h[i - 1], h[i] + 2.0 * h[i - 1]
            found[i] = (w1 + w2) / (w1 / d[i - 1] + w2 / d[i])
    for end, near, beyond in ((0, 0, 1), (-1, -1, -2)):
        slope = ((2.0 * h[near] + h[beyond]) * d[near] - h[near] * d[beyond]) / (
            h[near] + h[beyond]
        )
        if slope * d[near] <= 0.0:
            slope = 0.0
        elif d[near] * d[beyond] < 0.0 and abs(slope) > 3.0 * abs(d[near]):
            slope = 3.0 * d[near]
        found[end] = slope
    return found


def interpolated(x, y, at):
    """Return the cubic of Hermite through values and `slopes` at one place."""
    i = max(j for j in range(len(x) - 1) if x[j] <= at)
    h = x[i + 1] - x[i]
    t, m = (at - x[i]) / h, slopes(x, y)
    return (
        (1 + 2 * t) * (1 - t) ** 2 * y[i] + t * (1 - t) ** 2 * h * m[i]
        + t**2 * (3 - 2 * t) * y[i + 1] + t**2 * (t - 1) * h * m[i + 1]
    )  # fmt: skip


def test_a_second_program_interpolates_the_same(coarse):
    table = coarse.bearing
    K, C = rc.coefficients.stiffness_and_damping(coarse, INSIDE)
    x = np.array(table.speed)
    for found, rows in ((K, np.array(table.stiffness)), (C, np.array(table.damping))):
        for i, j in np.ndindex(2, 2):
            plain = [interpolated(x, rows[:, i, j], at) for at in INSIDE]
            assert_allclose(found[:, i, j], plain, rtol=1e-11)


def test_rows_are_met_exactly_and_nothing_swings_beyond_them():
    speed = np.array([100.0, 110.0, 300.0, 301.0, 900.0])
    stiffness = np.array([1.0, 1.0, 5.0, -3.0, 0.1])[:, None, None] * np.full((2, 2), 1e7 / 3.0)
    stiffness, damping = stiffness * [[1.0, 2.0], [3.0, 4.0]], stiffness * [[5.0, 6.0], [7.0, 8.0]]
    table = rc.CoefficientTable(speed=speed, stiffness=stiffness, damping=damping)
    machine = replace(REAL, bearing=table)
    K, C = rc.coefficients.stiffness_and_damping(machine, speed)
    assert np.array_equal(K, stiffness)
    assert np.array_equal(C, damping)
    for (low, high), (before, after) in zip(
        itertools.pairwise(speed), itertools.pairwise(stiffness[:, 0, 0]), strict=True
    ):
        K, _ = rc.coefficients.stiffness_and_damping(machine, np.linspace(low, high, 9))
        between = K[:, 0, 0]
        assert between.min() >= min(before, after) * (
            1.0 - math.copysign(1e-12, min(before, after))
        )
        assert between.max() <= max(before, after) * (
            1.0 + math.copysign(1e-12, max(before, after))
        )


@pytest.mark.parametrize("beyond", [FIRST * (1.0 - 1e-12), LAST * (1.0 + 1e-12), 1.0, 1e6])
@pytest.mark.parametrize(
    "ask",
    [
        rc.analyse,
        lambda machine, speed: rc.analyse(machine, [300.0, speed]),
        rc.coefficients.dynamics,
        lambda machine, speed: rc.level_one(machine, float(speed), 0.0),
        lambda machine, speed: rc.response_peaks(machine, sorted([300.0, speed])),
        lambda machine, speed: rc.unstable_ranges(machine, sorted([300.0, speed])),
        lambda machine, speed: campbell(machine, sorted([300.0, speed])),
    ],
)
def test_never_beyond_the_ends(coarse, ask, beyond):
    words = (
        rf"speed = {re.escape(f'{beyond:.9g}')} rad/s: .*own coefficients, which are given from "
        "200 to 1500 rad/s .*give rows for more speeds"
    )
    with pytest.raises(ValueError, match=words):
        ask(coarse, beyond)


# The machine that the table was made of


def test_the_onset_is_the_machine_s_and_its_error_falls_with_the_step():
    real = rc.onset_speed(REAL)
    errors = [abs(rc.onset_speed(machine_of(rows)).speed / real.speed - 1.0)
              for rows in (26, 51, 101, 201)]  # fmt: skip
    assert errors[0] < 1e-5
    # A fourth of the error or less with half the step.
    assert errors[-1] < errors[0] / 4.0**3
    found = rc.onset_speed(machine_of(201))
    assert found.whirl_frequency == pytest.approx(real.whirl_frequency, rel=1e-8)
    assert math.isnan(found.eccentricity_ratio)
    assert (found.searched_from, found.searched_to) == (FIRST, LAST)


@pytest.mark.parametrize(
    "changes",
    [
        {"shaft_stiffness": math.inf},
        {"disk_damping": 4e4},
        {"journal_mass": 20.0},
        {"journal_mass": 20.0, "disk_damping": 4e3},
    ],
)
def test_onset_and_ranges_with_any_rotor(changes):
    real = replace(REAL, rotor=replace(REAL.rotor, **changes))
    mine = machine_of(200, real)
    for flexible in (True, False):
        known, found = rc.onset_speed(real, flexible), rc.onset_speed(mine, flexible)
        assert found.speed == pytest.approx(
            known.speed if known.speed < LAST else math.inf, rel=3e-7
        )
    assert_allclose(rc.unstable_ranges(mine, INSIDE), rc.unstable_ranges(real, INSIDE), rtol=3e-7)


def test_a_plain_search_on_the_eigenvalues_finds_the_onset(coarse):
    rotor = coarse.rotor

    def grows(speed):
        K, C = rc.coefficients.stiffness_and_damping(coarse, speed)
        k, m = rotor.shaft_stiffness * np.eye(2), np.diag([rotor.half_mass] * 2)
        # Disk x, its velocity v, journal y: C y' = k (x − y) − K y.
        A = np.block([
            [np.zeros((2, 2)), np.eye(2), np.zeros((2, 2))],
            [-np.linalg.solve(m, k), np.zeros((2, 2)), np.linalg.solve(m, k)],
            [np.linalg.solve(C, k), np.zeros((2, 2)), -np.linalg.solve(C, k + K)],
        ])  # fmt: skip
        return np.linalg.eigvals(A).real.max() > 0.0

    low, high = FIRST, LAST
    while high - low > 1e-9 * high:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if grows(middle) else (middle, high)
    assert rc.onset_speed(coarse).speed == pytest.approx(low, rel=1e-7)


def test_eigenvalues_response_and_peaks_are_the_machine_s(fine):
    real, mine = rc.analyse(REAL, INSIDE), rc.analyse(fine, INSIDE)
    for name in ("disk_response", "journal_response", "stiffness", "damping"):
        known = getattr(real, name)
        assert_allclose(getattr(mine, name), known, atol=1e-6 * np.abs(known).max())
    assert_allclose(mine.branches(), real.branches(), atol=1e-6 * np.abs(real.branches()).max())
    assert_allclose(mine.whirl_ratio, real.whirl_ratio, rtol=1e-6)
    assert_allclose(mine.flexible_threshold, real.flexible_threshold, rtol=1e-6)
    known, found = rc.response_peaks(REAL, INSIDE), rc.response_peaks(fine, INSIDE)
    assert_allclose(found.speed, known.speed, rtol=1e-6)
    assert_allclose(found.amplitude, known.amplitude, rtol=1e-5)


def test_what_a_table_does_not_know_is_nan(coarse):
    sweep = rc.analyse(coarse, INSIDE)
    for name in (
        "sommerfeld", "journal_position", "eccentricity_ratio", "attitude_angle", "power_loss",
        "minimum_film_thickness", "side_flow", "drag_torque", "friction_coefficient",
        "peak_pressure", "outlet_temperature",
    ):  # fmt: skip
        assert np.isnan(getattr(sweep, name)).all(), name
    assert np.isfinite(sweep.flexible_eigenvalues).all()
    assert sweep.temperature[0] == REAL.temperature
    assert rc.validity(sweep) == ()
    assert math.isnan(unbalance_curves.clearance_orbit(rc.analyse(coarse, 400.0)).closest)


# Its ends


def test_no_onset_within_the_table_is_infinite_and_says_how_far_it_was_sought():
    short = replace(REAL, bearing=table_of(REAL, np.linspace(200.0, 400.0, 20)))
    found = rc.onset_speed(short)
    assert found.speed == math.inf
    assert (found.searched_from, found.searched_to) == (200.0, 400.0)
    assert rc.unstable_ranges(short, [200.0, 400.0]).size == 0


def test_unstable_from_the_first_speed_on():
    late = replace(REAL, bearing=table_of(REAL, np.linspace(700.0, 1500.0, 20)))
    found = rc.onset_speed(late)
    assert found.speed == found.searched_from == 700.0
    fastest = rc.analyse(late, 700.0).flexible_eigenvalues
    assert found.whirl_frequency == pytest.approx(abs(fastest[np.argmax(fastest.real)].imag))
    assert_allclose(rc.unstable_ranges(late, [700.0, 900.0, 1500.0]), [[700.0, 1500.0]])


@pytest.mark.parametrize("first", [True, False])
def test_an_onset_at_an_end_of_the_table(first):
    real = rc.onset_speed(REAL).speed
    speeds = (real, 2.0 * real) if first else (0.5 * real, real)
    machine = replace(REAL, bearing=table_of(REAL, np.linspace(*speeds, 60)))
    found = rc.onset_speed(machine).speed
    assert found == pytest.approx(real, rel=1e-9) or (not first and found == math.inf)


def test_a_range_between_two_rows_is_found():
    """Cross-coupling rises at one row alone, steeply: the rows are among the speeds searched."""
    speed = np.sort(np.append(np.linspace(200.0, 900.0, 8), [449.0, 450.0, 451.0]))
    stiffness = np.tile([[2e7, 0.0], [0.0, 2e7]], (len(speed), 1, 1))
    stiffness[speed == 450.0] += [[0.0, 4e7], [-4e7, 0.0]]
    damping = np.tile(1e5 * np.eye(2), (len(speed), 1, 1))
    machine = replace(
        REAL,
        bearing=rc.CoefficientTable(speed=speed, stiffness=stiffness, damping=damping),
    )
    found = rc.unstable_ranges(machine, [200.0, 900.0])
    assert found.shape == (1, 2)
    assert 449.0 < found[0, 0] < 450.0 < found[0, 1] < 451.0
    assert rc.onset_speed(machine).speed == pytest.approx(found[0, 0])


# Studies


def test_the_rotor_can_be_varied_and_nothing_else(coarse):
    heavier = rc.varied(coarse, {"rotor.mass": 300.0})
    assert heavier.bearing == coarse.bearing
    assert rc.onset_speed(heavier).speed < rc.onset_speed(coarse).speed
    for name in ("radial_clearance", "load", "temperature", "oil.reference_viscosity"):
        with pytest.raises(ValueError, match="a table of coefficients does not depend on it"):
            rc.varied(coarse, {name: 1.0})
    found = rc.sensitivities(coarse)
    assert {one.field for one in found.inputs} == {
        "rotor.mass", "rotor.shaft_stiffness", "rotor.disk_damping", "rotor.journal_mass"
    }  # fmt: skip


def test_maps_solutions_and_tolerances(coarse):
    found = rc.onset_map(coarse, x="mass", xs=[260.0, 300.0], y="shaft_stiffness", ys=[1e7])
    assert found.speed[0, 1] == rc.onset_speed(rc.varied(coarse, {"mass": 300.0})).speed
    solved = rc.solve_onset(coarse, vary="shaft_stiffness", target=600.0, low=1e6, high=1e8)
    (k,) = solved.solutions
    assert rc.onset_speed(rc.varied(coarse, {"shaft_stiffness": k})).speed == pytest.approx(600.0)
    drawn = rc.tolerance(coarse, {"rotor.mass": ("uniform", 260.0, 300.0)}, samples=5, speed=490.0)
    assert (drawn.unstable == (drawn.onset < 490.0)).all()
    with pytest.raises(ValueError, match="does not depend on it"):
        rc.tolerance(coarse, {"radial_clearance": ("uniform", 1e-5, 2e-5)}, samples=5)


def test_criteria(coarse, fine):
    known, found = rc.amplification(REAL), rc.amplification(fine)
    assert_allclose(found.critical_speed, known.critical_speed, rtol=1e-5)
    assert_allclose(found.amplification_factor, known.amplification_factor, rtol=1e-4)
    level = rc.level_one(fine, 400.0, 1e5)
    assert level.log_decrement == pytest.approx(rc.level_one(REAL, 400.0, 1e5).log_decrement, 1e-5)
    of_clearance = [one for one in checks(coarse, 400.0) if "clearance" in one.name]
    assert [one.passed for one in of_clearance] == [None]
    assert campbell(coarse, INSIDE).frequency.shape[0] == len(INSIDE)


def test_a_row_of_a_comparison(coarse):
    row, known = bearing_result(coarse, 400.0), bearing_result(REAL, 400.0)
    assert row.refusal == ""
    assert row.onset == pytest.approx(known.onset, rel=1e-4)
    assert row.log_decrement == pytest.approx(known.log_decrement, rel=1e-3)
    assert row.peak_response == pytest.approx(known.peak_response, rel=1e-3)
    assert math.isnan(row.power_loss)


def test_variants_of_the_rotor(coarse):
    rigid = replace(coarse, rotor=replace(coarse.rotor, shaft_stiffness=math.inf))
    assert damping_reference(rigid) == coarse.bearing.damping[0][0][0]
    rotors = unbalance_curves.damping_variants(coarse)
    family = unbalance_curves.response_family(coarse, INSIDE, rotors=rotors)
    assert np.isfinite(family.disk).all()


@pytest.mark.parametrize(
    ("ask", "words"),
    [
        (lambda m: rc.simulate(m, 400.0, revolutions=2), "no force of a film"),
        (lambda m: rc.measured_growth(m, 400.0), "no force of a film"),
        (rc.onsets, "no force of a film"),
        (rc.hopf, "no force of a film"),
        (lambda m: rc.coefficients.film_field(m, 400.0, theta=[0.0]), "neither its thickness"),
        (lambda m: rc.coefficients.added_mass(m, 400.0), "no inertia"),
        (lambda m: rc.coefficients.unloading(m, 400.0, sommerfeld=1.0), "a table over speed"),
        (lambda m: rc.film_curves(m.bearing, 1.0), "a table over speed"),
        (lambda m: rc.compare_bearings(m, speed=400.0), "no diameter"),
        (lambda m: rc.compare_bearings(m, [rc.Plain()], speed=400.0), "no diameter"),
        (lambda m: rc.load_for(m, 400.0, eccentricity_ratio=0.5), "whatever the load"),
        (lambda m: rc.ring_speed(m, 400.0), "has no floating ring"),
        (lambda m: rc.recess_pressure(m, 400.0), "has no recesses"),
        (lambda m: rc.pad_tilts(m, 400.0), "has no tilting pads"),
        (rc.lift_off_speed, "has no foil"),
    ],
)  # fmt: skip
def test_what_needs_a_film_refuses_in_words(coarse, ask, words):
    with pytest.raises(ValueError, match=f"bearing = own-coefficients: .*{words}"):
        ask(coarse)
