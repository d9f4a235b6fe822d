"""A simulated orbit written as two probes would give it is read back as it was."""

import contextlib
import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from rotorcalc import Machine, MeasuredOrbit, Transient, analyse, read_orbit, simulate
from rotorcalc.measured import keyphasor, orbit_table
from rotorcalc.nonlinear.signals import (
    growth,
    poincare_points,
    spectrum,
    synchronous_vector,
    waterfall,
)
from rotorcalc.nonlinear.transient import start_on_mode
from tests.machines import RPM, SHEET, with_rotor

SPEED, TURNS = 6000 * RPM, 20


@cache
def simulated(machine: Machine = SHEET, whirl: float = 1e-6) -> Transient:
    start = start_on_mode(machine, SPEED, whirl)
    return simulate(machine, SPEED, revolutions=TURNS, samples_per_revolution=32, start=start)


def late(motion: Transient, first: int, end: int | None = None) -> Transient:
    """Return a motion from a sample on, up to another."""
    own = {name: getattr(motion, name)[first:end] for name in ("time", "journal", "speed", "angle")}
    return replace(motion, **own)


def made(
    *, noise: float, rate: float = 4.0, whirl: float = 2e-6, order: float = 0.478, seed: int = 0
) -> MeasuredOrbit:
    """Return a growing whirl beside the imbalance's ellipse, with noise."""
    drawn = np.random.default_rng(seed)
    angle = np.linspace(0.0, 2.0 * math.pi * 40, 40 * 64 + 1)
    time = angle / SPEED
    circles = 20e-6 * np.exp(1j * angle) + 2e-6 * np.exp(-1j * angle)
    circles += whirl * np.exp((rate + 1j * order * SPEED) * time)
    path = np.stack([circles.real, circles.imag], axis=-1)
    path += noise * drawn.standard_normal(path.shape)
    speed = np.full_like(time, SPEED)
    return MeasuredOrbit(time, path, speed, angle, np.zeros(2), has_keyphasor=True)


# --- Identities -------------------------------------------------------------------------------


def test_an_orbit_with_pulses_has_the_speed_the_spectrum_and_the_vector_of_its_simulation() -> None:
    motion = simulated()
    found = read_orbit(orbit_table(motion))
    # The first pulse is the end of the first revolution: before it no edge was seen to rise.
    after = late(motion, 32)
    assert found.speed == pytest.approx(np.full(len(after.time), SPEED), rel=1e-8)
    assert found.angle == pytest.approx(after.angle - 2.0 * math.pi, abs=1e-6)
    assert found.position + found.mean == pytest.approx(after.journal, abs=1e-13)
    for last in (None, 8):
        seen, meant = spectrum(found, last=last), spectrum(after, last=last)
        assert seen.whirl_ratio == pytest.approx(meant.whirl_ratio, rel=1e-6)
        assert seen.whirl == pytest.approx(meant.whirl, rel=1e-6)
        vector = synchronous_vector(after, last=last)
        assert synchronous_vector(found, last=last) == pytest.approx(vector, abs=1e-12)
    points = poincare_points(found) + found.mean
    assert points == pytest.approx(poincare_points(after), abs=1e-12)
    assert waterfall(found, width=16, spectra=2).amplitude == pytest.approx(
        waterfall(after, width=16, spectra=2).amplitude, abs=1e-12
    )


def test_growth_is_read_as_from_the_simulation_and_is_the_linear_theorys() -> None:
    machine = with_rotor(imbalance=0.0)
    motion = simulated(machine, 1e-9)
    table = orbit_table(motion, with_keyphasor=False)
    found = growth(read_orbit(table, speed=SPEED))
    assert found == pytest.approx(growth(motion), rel=1e-5)
    assert np.abs(analyse(machine, SPEED).flexible_eigenvalues - found).min() < 1e-3 * abs(found)


def test_the_vector_of_a_small_motion_is_the_linear_theorys_response() -> None:
    machine = with_rotor(imbalance=1e-9)
    still = simulate(machine, SPEED, revolutions=TURNS, samples_per_revolution=32)
    vector = synchronous_vector(read_orbit(orbit_table(still)), last=4)
    # What the start left of whirl is a few per cent of its first size.
    response = analyse(machine, SPEED).journal_response
    assert vector == pytest.approx(response, abs=0.01 * np.abs(response).max())


@settings(max_examples=25)
@given(
    first=st.floats(-180.0, 180.0), apart=st.floats(12.0, 168.0), flipped=st.booleans(),
    gap=st.booleans(),
)  # fmt: skip
def test_probes_at_any_two_angles_see_the_same_orbit(
    first: float, apart: float, flipped: bool, gap: bool
) -> None:
    motion = late(simulated(), 500)
    angles = [math.radians(angle) for angle in (first, first + (-apart if flipped else apart))]
    table = orbit_table(motion, angles=angles, with_keyphasor=False)
    found = read_orbit(table, angles=angles, speed=SPEED, mean="kept",
                       reads="gap" if gap else "displacement")  # fmt: skip
    # A gap closes as the journal comes nearer.
    assert found.position == pytest.approx((-1.0 if gap else 1.0) * motion.journal, abs=1e-12)
    assert (found.mean == 0.0).all()


def test_the_usual_probes_stand_right_and_left_of_the_top() -> None:
    # Up is −X; to the right, where the shaft turns counterclockwise, is +Y.
    rows = "\n".join(f"{i / 100},{'1,0' if i % 2 else '0,0'}" for i in range(16))
    found = read_orbit(f"time [s],probe 1 [mm],probe 2 [mm]\n{rows}", speed=1.0, mean="kept")
    x, y = 1e3 * found.position[1]
    assert (x, y) == pytest.approx((-math.sqrt(0.5), math.sqrt(0.5)))


def test_pulses_give_a_speed_that_changes_and_where_the_imbalance_points() -> None:
    motion = simulate(with_rotor(imbalance=0.0), SPEED, revolutions=30, final_speed=1.1 * SPEED)
    found = read_orbit(orbit_table(motion), imbalance_angle=0.5)
    after = late(motion, 64)
    assert found.speed == pytest.approx(after.speed, rel=1e-3)
    assert found.angle == pytest.approx(after.angle - 2.0 * math.pi + 0.5, abs=2e-3)


@pytest.mark.parametrize("falling", [False, True])
def test_noise_on_a_slow_edge_is_no_second_pulse(falling: bool) -> None:
    drawn = np.random.default_rng(3)
    time = np.arange(8000) / 400.0
    signal = np.sin(2.0 * math.pi * time) + 0.03 * drawn.standard_normal(len(time))
    found = keyphasor.pulses(time, signal, None, falling=falling)
    assert found == pytest.approx((0.5 if falling else 1.0) + np.arange(len(found)), abs=0.02)
    assert len(found) == 20 - (not falling)


@pytest.mark.parametrize("noise", [1e-8, 1e-6])
def test_noise_changes_what_is_read_by_no_more_than_its_share(noise: float) -> None:
    for seed in range(3):
        orbit = made(noise=noise, seed=seed)
        found = growth(orbit)
        assert found.real == pytest.approx(4.0, abs=2e5 * noise)
        assert found.imag == pytest.approx(0.478 * SPEED, rel=1e-3)
        assert spectrum(orbit).whirl_ratio == pytest.approx(0.478, abs=2e-3)
        assert synchronous_vector(orbit) == pytest.approx([22e-6, -18e-6j], abs=0.5 * noise + 1e-8)


def test_of_two_whirls_that_an_imbalance_makes_of_one_the_slowest_to_decay_is_read() -> None:
    # The imbalance holds the whirl at one half, of which one phase decays and the other grows.
    speed = 10500 * RPM
    start = start_on_mode(SHEET, speed, 1.2e-6)
    motion = simulate(SHEET, speed, revolutions=60, samples_per_revolution=32, start=start)
    found = growth(read_orbit(orbit_table(late(motion, 0, 40 * 32 + 1))))
    # As its size at half the speed grows over the last twenty revolutions.
    sizes = [spectrum(late(motion, 0, turns * 32 + 1), last=10).whirl for turns in (40, 60)]
    rate = math.log(sizes[1] / sizes[0]) / (20 * 2.0 * math.pi / speed)
    assert found.real == pytest.approx(rate, abs=1.0)
    assert found.imag == pytest.approx(0.5 * speed, rel=1e-3)


def test_noise_alone_is_no_whirl() -> None:
    for seed in range(10):
        orbit = made(noise=1e-6, whirl=0.0, seed=seed)
        assert math.isnan(spectrum(orbit).whirl_ratio)
        assert math.isnan(growth(orbit).real)


# --- Files ------------------------------------------------------------------------------------

HEAD = "time [ms];probe 1 [mil];probe 2 [µm];keyphasor [V];load [N]"


def lines(count: int = 64) -> list[str]:
    """Return the rows of a table, one revolution in 16 samples."""
    return [f"{i}.5;{i % 16};{25.4 * (i % 16)};{5 * (i % 16 < 4)};7" for i in range(count)]


def test_units_of_the_header_and_columns_left_unread() -> None:
    found = read_orbit("\n".join([HEAD, *lines()]))
    assert found.unread == ("load [N]",)
    assert np.diff(found.time) == pytest.approx(1e-3)
    assert found.speed == pytest.approx(2.0 * math.pi / 0.016, rel=1e-9)
    # Equal readings of both probes point straight up, −X.
    assert found.position[:, 1] == pytest.approx(0.0, abs=1e-18)
    assert np.ptp(found.position[:, 0]) == pytest.approx(15 * 25.4e-6 * math.sqrt(2.0))
    assert found.sample_rate == pytest.approx(1000.0)


def test_decimal_commas_and_a_sample_rate() -> None:
    text = "probe 1 [µm];probe 2 [µm]\n" + "\n".join(f"{i},5;0,25" for i in range(20))
    found = read_orbit(text, sample_rate=100.0, speed=5.0, mean="kept")
    assert found.time[-1] == pytest.approx(0.19)
    assert not found.has_keyphasor
    assert found.position[4, 0] == pytest.approx(-4.75e-6 * math.sqrt(0.5))


def changed(place: int, row: str) -> str:
    rows = [HEAD, *lines()]
    rows[place] = row
    return "\n".join(rows)


@pytest.mark.parametrize(
    ("text", "how", "words"),
    [
        ("", {}, "the file is empty"),
        (";;", {}, "all its cells are empty"),
        (HEAD, {}, "0 rows of numbers, must have 16"),
        (changed(3, "2;1;x;0;7"), {}, r"line 4, column probe 2 \[µm\]: 'x' is no number"),
        (changed(3, "2;=A1;1;0;7"), {}, r"line 4, column probe 1 \[mil\]: '=A1' is a formula"),
        (changed(3, "2;;1;0;7"), {}, r"line 4, column probe 1 \[mil\]: is empty"),
        (changed(3, "2;1;1"), {}, "line 4: has 3 cells, the header 5"),
        (changed(3, "2;1e300;1;1;7"), {}, r"line 4, column probe 1 \[mil\]: is larger than"),
        (changed(3, "0.5;1;1;1;7"), {}, "line 4, column time: does not come after"),
        (changed(64, "99;1;1;1;7"), {}, "line 65, column time: 0.0365 s after"),
        (changed(0, HEAD.replace("mil", "V")), {}, r"probe 1 \[V\] has an unknown unit; known"),
        (changed(0, HEAD.replace(" [mil]", "")), {}, "probe 1 has no unit; write"),
        (changed(0, HEAD.replace("probe 1", "probe 2")), {}, "'probe 2' has two columns"),
        (changed(0, HEAD.replace("probe 2", "other")), {}, "has no column 'probe 2"),
        (changed(0, HEAD.replace("keyphasor", "other")), {}, "without one the running speed"),
        (changed(0, HEAD.replace("time", "other")), {}, "else the sample rate is needed"),
        (changed(1, lines()[0]), {"sample_rate": 5.0}, "given beside the file's column of times"),
        (changed(1, lines()[0]), {"threshold": 6.0}, "no pulse passes the threshold 6"),
        (changed(1, lines()[0]), {"angles": (0.0, 3.1)}, "nearly parallel"),
        (changed(1, lines()[0]), {"angles": (0.0,)}, "1 of them, must be two"),
        (changed(0, HEAD.replace("keyphasor", "o")), {"speed": -1.0}, "speed = -1 rad/s: must be"),
        ("\n".join([HEAD, *lines(30)]), {}, "1 pulses, must be 3 or more"),
        ("\n".join([HEAD, *[r.replace(";5;", ";0;") if 30 < i < 40 else r
                            for i, r in enumerate(lines(90))]]), {}, "a pulse is missing or one"),
        (b"\xff\xfe\x00", {}, "no text"),
        ("time [s]" + ",x" * 60, {}, "more than 50 columns"),
        ("x" * 20_000_001, {}, "more than 20 MB"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_named(text: str | bytes, how: dict[str, float], words: str) -> None:
    with pytest.raises(ValueError, match=words):
        read_orbit(text, **how)


def test_an_orbit_too_short_or_too_coarse_for_orders_says_so() -> None:
    short = read_orbit("\n".join([HEAD, *lines(96)]))
    with pytest.raises(ValueError, match="2 revolutions, must be 4"):
        spectrum(short)
    with pytest.raises(ValueError, match="4 samples in a revolution, must have 8"):
        spectrum(read_orbit(_without_pulses(), speed=1570.0))
    with pytest.raises(ValueError, match="holds no whole revolution"):
        spectrum(read_orbit(_without_pulses(), speed=10.0))
    with pytest.raises(ValueError, match="only the journal's is known"):
        spectrum(short, of="disk")


def _without_pulses() -> str:
    return changed(0, HEAD.replace("keyphasor", "other"))


CELL = st.sampled_from(["0", "1", "-2.5", "1e9", "1e-9", "", "=1", "a", "1,5", '"', "nan", "5"])


@settings(max_examples=60)
@given(text=st.binary(max_size=300))
@example(text=b";")
@example(text=b"time [s],probe 1 [m],probe 2 [m]\n" + b"0,0,0\n" * 20)
def test_any_bytes_are_read_or_refused(text: bytes) -> None:
    with pytest.raises(ValueError, match=r"\w"):
        read_orbit(text)


@settings(max_examples=60)
@given(
    cells=st.lists(st.tuples(CELL, CELL, CELL), min_size=1, max_size=4), place=st.integers(0, 20),
    speed=st.sampled_from([1e-2, 5.0, 700.0, 1e6]), count=st.integers(14, 40),
)  # fmt: skip
def test_any_cells_are_an_orbit_or_refused(
    cells: list[tuple[str, str, str]], place: int, speed: float, count: int
) -> None:
    rows = [f"{i / 700};{i % 7};{i % 5}" for i in range(count)]
    rows[place:place] = [";".join(row) for row in cells]
    text = "\n".join(["time [s];probe 1 [µm];probe 2 [µm]", *rows])
    with contextlib.suppress(ValueError):
        found = read_orbit(text, speed=speed)
        assert np.isfinite(found.position).all()
        spectrum(found)
        growth(found)
