"""Machines within tolerances: identities, distributions known in closed form, any executor."""

import math
import re
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from dataclasses import replace
from multiprocessing import get_context

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

import rotorcalc as rc
from rotorcalc.onset.judge import is_unstable
from rotorcalc.tolerances import spreads, statistics, study
from rotorcalc.tolerances.spreads import drawn
from tests.machines import RPM, SHEET, with_rotor

SPREADS = {
    "radial_clearance": ("uniform", 50e-6, 80e-6),
    "temperature": ("normal", 60.0, 4.0),
    "load": ("triangular", 1200.0, 1334.0, 1400.0),
}
SPEED = 8500 * RPM
DISTRIBUTIONS = {
    ("uniform", 2.0, 5.0): stats.uniform(2.0, 3.0),
    ("normal", -3.0, 2.0): stats.norm(-3.0, 2.0),
    ("normal", 1.0, 2.0, 0.0, 4.0): stats.truncnorm(-0.5, 1.5, 1.0, 2.0),
    ("triangular", 1.0, 1.5, 4.0): stats.triang(0.5 / 3.0, 1.0, 3.0),
    ("triangular", 1.0, 1.0, 4.0): stats.triang(0.0, 1.0, 3.0),
    ("lognormal", 3.0, 1.5): stats.lognorm(math.log(1.5), scale=3.0),
}
NO_WIDTH = [
    ("uniform", 7.0, 7.0),
    ("normal", 7.0, 0.0),
    ("triangular", 7.0, 7.0, 7.0),
    ("lognormal", 7.0, 1.0),
]


class Later(Executor):
    """The least that an executor is: it begins each task when its result is asked for."""

    def submit(self, fn: Callable, /, *args, **kwargs) -> Future:
        future: Future = Future()
        future.set_result(fn(*args, **kwargs))
        return future


# --- Draws ----------------------------------------------------------------------------------


@pytest.mark.parametrize("spread", DISTRIBUTIONS, ids=str)
def test_draws_have_their_distribution(spread: tuple) -> None:
    found = drawn("load", spread, samples=4000, seed=3)
    assert stats.kstest(found, DISTRIBUTIONS[spread].cdf).pvalue > 0.01


@pytest.mark.parametrize("spread", NO_WIDTH, ids=str)
def test_a_spread_without_width_is_its_value(spread: tuple) -> None:
    np.testing.assert_allclose(drawn("load", spread, samples=5, seed=0), 7.0, rtol=1e-15)


def test_draws_depend_on_seed_and_name_alone() -> None:
    few, many = (drawn("load", ("uniform", 0.0, 1.0), samples=n, seed=1) for n in (5, 50))
    np.testing.assert_array_equal(few, many[:5])
    for name, seed in (("load", 2), ("temperature", 1)):
        other = drawn(name, ("uniform", 0.0, 1.0), samples=50, seed=seed)
        assert abs(np.corrcoef(other, many)[0, 1]) < 0.5


@pytest.mark.parametrize(
    ("spread", "words"),
    [
        (("gamma", 1.0, 2.0), "must be one of ('uniform', low, high)"),
        ("uniform", "must be one of"),
        ((), "must be one of"),
        (("uniform", 1.0), "must be ('uniform', low, high)"),
        (("uniform", 2.0, 1.0), "high = 1: must be at least low = 2"),
        (("uniform", "1", 2.0), "load: low = '1': must be a number"),
        (("normal", 1.0, -1.0), "deviation = -1: must be at least 0"),
        (("normal", 1.0, 1.0, 0.0), "two bounds, or none"),
        (("normal", 3.0, 1.0, 0.0, 2.0), "high = 2: must be at least mean = 3"),
        (("normal", math.nan, 1.0), "mean = nan SI: must be finite"),
        (("triangular", 1.0, 3.0, 2.0), "high = 2: must be at least mode = 3"),
        (("lognormal", 0.0, 2.0), "median = 0: must be positive"),
        (("lognormal", 1.0, 0.5), "ratio = 0.5: must be at least 1"),
    ],
)
def test_a_wrong_distribution_is_named(spread: object, words: str) -> None:
    with pytest.raises(ValueError, match="load") as error:
        rc.tolerance(SHEET, {"load": spread}, 10)
    assert words in str(error.value)


# --- Machines -------------------------------------------------------------------------------


def test_a_machine_without_spread_is_itself() -> None:
    found = rc.tolerance(SHEET, {"temperature": ("normal", 60.0, 0.0)}, 20, 1, speed=SPEED)
    np.testing.assert_allclose(found.onset, rc.onset_speed(SHEET).speed, rtol=1e-14)
    np.testing.assert_array_equal(found.margin, found.onset / SPEED - 1.0)
    assert not found.unstable.any()
    assert math.isnan(found.influences[0].index)


@pytest.mark.parametrize(
    "machine",
    [
        SHEET,
        with_rotor(disk_damping=5e3, journal_mass=10.0),
        replace(SHEET, bearing=replace(SHEET.bearing, geometry=rc.Elliptical(), film="short")),
        replace(SHEET, temperature=None, supply=rc.Supply(temperature=45.0, flow=2e-5)),
    ],
    ids=["closed form", "polynomial", "lobes", "supply"],
)
def test_each_sample_is_a_machine_of_its_own(machine: rc.Machine) -> None:
    own = {"supply.temperature": ("normal", 45.0, 2.0)} if machine.supply else {}
    own |= {"preload": ("uniform", 0.2, 0.6)} if machine.bearing.geometry.kind != "plain" else {}
    chosen = {"radial_clearance": SPREADS["radial_clearance"], "load": SPREADS["load"], **own}
    speed = rc.onset_speed(machine).speed
    found = rc.tolerance(machine, chosen, 40, 4, speed=speed)
    assert found.answered.all()
    assert found.fields[0] == "bearing.radial_clearance"
    for i in range(0, 40, 5):
        one = rc.varied(machine, dict(zip(found.fields, found.values[i].tolist(), strict=True)))
        assert found.onset[i] == pytest.approx(rc.onset_speed(one).speed, rel=1e-9)
        assert found.unstable[i] == is_unstable(one, speed)
    assert 0 < found.unstable.sum() < 40


def test_the_probability_is_the_counted_share() -> None:
    found = rc.tolerance(SHEET, SPREADS, 500, 7, speed=SPEED)
    share = np.mean(found.onset < SPEED)
    assert found.probability_unstable.value == share
    expected = stats.binomtest(int(share * 500 + 0.5), 500).proportion_ci(method="wilson")
    assert found.probability_unstable.low == pytest.approx(expected.low, rel=1e-9)
    assert found.probability_unstable.high == pytest.approx(expected.high, rel=1e-9)


def test_a_soft_shaft_is_unstable_as_often_as_its_stiffness_is_low() -> None:
    """The centred film whirls at half the speed: Ω_s = 2√(K_rot/M), lognormal as K_rot is."""
    thick = replace(SHEET, oil=replace(SHEET.oil, reference_viscosity=20.0))
    machine = with_rotor(thick, shaft_stiffness=1e4)
    stiffness = ("lognormal", 1e4, 1.2)
    speed = 2.0 * math.sqrt(1.1e4 / machine.rotor.half_mass)
    found = rc.tolerance(machine, {"shaft_stiffness": stiffness}, 4000, 5, speed=speed)
    exact = stats.norm.cdf(math.log(1.1) / math.log(1.2))
    chance = found.probability_unstable
    assert chance.low < exact < chance.high
    assert chance.high - chance.low < 0.04
    # ln Ω_s = ½ ln K_rot + constant.
    logs = np.log(found.onset)
    assert np.std(logs) == pytest.approx(0.5 * math.log(1.2), rel=0.03)
    centre = math.log(2.0 * math.sqrt(1e4 / machine.rotor.half_mass))
    assert np.mean(logs) == pytest.approx(centre, abs=4 * np.std(logs) / math.sqrt(4000) + 1e-3)


def test_samples_that_are_no_machine_are_counted_and_named() -> None:
    with pytest.raises(ValueError, match="no valid machine") as error:
        rc.tolerance(SHEET, {"radial_clearance": ("normal", 60e-6, 60e-6)}, 200, 0)
    words = str(error.value)
    values = drawn("bearing.radial_clearance", ("normal", 60e-6, 60e-6), samples=200, seed=0)
    first = int(np.argmax(values <= 0.0))
    assert f"sample {first + 1}: radial_clearance = {values[first]:.3g}"[:30] in words
    counted = re.search(r"(\d+) of samples (\d+) to (\d+) are no valid", words)
    assert counted is not None
    count, start, end = map(int, counted.groups())
    assert count == np.count_nonzero(values[start - 1 : end] <= 0.0)


def test_samples_without_an_answer_are_kept_and_widen_the_interval() -> None:
    # A film of finite length does not carry the heaviest of these loads.
    finite = replace(SHEET, bearing=replace(SHEET.bearing, film="finite"))
    found = rc.tolerance(finite, {"load": ("uniform", 1e3, 3e6)}, 40, 2, speed=200.0)
    unknown = ~found.answered
    assert 0 < unknown.sum() < 40
    assert len(found.onset) == 40
    assert any("smallest film" in words for words in found.refusals)
    assert found.probability_unstable.high > 0.5 * unknown.mean()
    assert found.probability_unstable.low == 0.0


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"spreads": {}}, "none given"),
        ({"spreads": {"clearance": ("uniform", 1.0, 2.0)}}, "no input of a machine"),
        ({"spreads": {"load": ("uniform", 1.0, 2.0)}, "samples": 0}, "samples = 0"),
        ({"spreads": {"load": ("uniform", 1.0, 2.0)}, "seed": -1}, "seed = -1"),
        ({"spreads": {"load": ("uniform", 1.0, 2.0)}, "speed": -1.0}, "speed = -1"),
        ({"spreads": {"length": SPREADS["load"], "bearing.length": SPREADS["load"]}}, "twice"),
        ({"spreads": {3: SPREADS["load"]}}, "must be the name of an input"),
    ],
)
def test_a_wrong_question_is_named(arguments: dict, words: str) -> None:
    with pytest.raises(ValueError, match=re.escape(words)):
        rc.tolerance(SHEET, **arguments)


def test_without_a_speed_there_is_no_margin_and_no_probability() -> None:
    found = rc.tolerance(SHEET, SPREADS, 50, 1)
    assert np.isnan(found.margin).all()
    with pytest.raises(ValueError, match="speed: none was given"):
        _ = found.probability_unstable


# --- Any executor ---------------------------------------------------------------------------


@pytest.fixture(scope="module", params=["one", "threads", "processes", "dask"])
def executor(request: pytest.FixtureRequest) -> Iterator[Executor]:
    if request.param == "one":
        yield Later()
    elif request.param == "threads":
        with ThreadPoolExecutor(2) as pool:
            yield pool
    elif request.param == "processes":
        with ProcessPoolExecutor(2, get_context("spawn")) as pool:
            yield pool
    else:
        yield from _dask()


def _dask() -> Iterator[Executor]:
    """Yield the executor of a real cluster of two workers, processes of their own."""
    from distributed import Client, LocalCluster

    with (
        LocalCluster(
            n_workers=2, threads_per_worker=1, dashboard_address="127.0.0.1:0", host="127.0.0.1"
        ) as cluster,
        Client(cluster) as client,
    ):
        assert len(client.scheduler_info()["workers"]) == 2
        yield client.get_executor()


def test_any_executor_gives_the_same_answer(executor: Executor) -> None:
    told: list[float] = []
    damped = with_rotor(disk_damping=5e3)
    # In closed form a part is of a thousand machines at least, else on the short film of 25.
    for machine, spread, n in (
        (SHEET, SPREADS, 2500), (damped, {"load": SPREADS["load"]}, 64),
    ):  # fmt: skip
        alone = rc.tolerance(machine, spread, n, 11, speed=SPEED)
        shared = rc.tolerance(machine, spread, n, 11, executor, speed=SPEED, progress=told.append)
        for name in ("values", "onset", "margin", "unstable", "answered"):
            np.testing.assert_array_equal(getattr(alone, name), getattr(shared, name))
        assert alone.influences == shared.influences
    assert told == pytest.approx([*np.arange(1, 4) / 3, *np.arange(1, 4) / 3])
    xs, ys = np.array([50e-6, 80e-6]), np.array([1e3, 5e3])
    axes = {"x": "radial_clearance", "xs": xs, "y": "disk_damping", "ys": ys}
    one, many = (rc.onset_map(SHEET, executor=each, **axes) for each in (None, executor))
    np.testing.assert_allclose(one.speed, many.speed, rtol=1e-11)


def test_the_size_of_the_parts_changes_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    whole = rc.tolerance(SHEET, SPREADS, 60, 11)
    for size in (1, 7):
        for name in ("_CLOSED", "_FEWEST"):
            monkeypatch.setattr(study, name, size)
        parts = rc.tolerance(SHEET, SPREADS, 60, 11)
        np.testing.assert_allclose(parts.onset, whole.onset, rtol=1e-13)
        np.testing.assert_array_equal(parts.values, whole.values)


def test_a_map_takes_a_bores_own_inputs() -> None:
    ellipse = replace(SHEET, bearing=replace(SHEET.bearing, geometry=rc.Elliptical(), film="short"))
    axes = {"x": "bearing.geometry.preload", "xs": [0.2, 0.4], "y": "length", "ys": [0.04, 0.05]}
    found = rc.onset_map(ellipse, executor=Later(), **axes)
    cell = rc.varied(ellipse, {"preload": 0.4, "length": 0.04})
    assert found.speed[0, 1] == pytest.approx(rc.onset_speed(cell).speed, rel=1e-9)


# --- What matters most ----------------------------------------------------------------------


def test_the_indices_of_a_sum_are_shares_of_its_variance() -> None:
    """1/12, 4/45 of a square, 1/144 of a product about its middle, in which no factor is alone."""
    draw = np.random.default_rng(8).random((20000, 4))
    a, b, c, d = draw.T
    y = a + b**2 + (c - 0.5) * (d - 0.5)
    parts = np.array([1 / 12, 4 / 45, 0.0, 0.0])
    shares = parts / (1 / 12 + 4 / 45 + 1 / 144)
    for x, share in zip(draw.T, shares, strict=True):
        found = statistics.influence("x", x, y)
        assert found.error < 0.01
        assert found.index == pytest.approx(share, abs=3.0 * found.error + 1e-4)


def test_the_error_of_an_index_is_its_scatter() -> None:
    indices, errors = [], []
    for seed in range(60):
        a, b = np.random.default_rng(seed).random((2, 400))
        found = statistics.influence("a", a, a + b)
        indices.append(found.index)
        errors.append(found.error)
    assert np.mean(indices) == pytest.approx(0.5, abs=0.015)
    assert np.mean(errors) == pytest.approx(np.std(indices), rel=0.35)


def test_an_input_without_effect_has_no_index_on_average() -> None:
    """A polynomial explains some of any scatter, which the degrees of freedom take out again."""
    found = []
    for seed in range(60):
        a, y = np.random.default_rng(seed).random((2, 130))
        found.append(statistics.influence("a", a, y).index)
    assert abs(np.mean(found)) < 0.012


def test_the_index_is_that_of_a_plain_binned_variance() -> None:
    """Another estimator: the variance of the means of bins, over the whole."""
    found = rc.tolerance(SHEET, SPREADS, 8000, 3)
    for one in found.influences:
        x = found.values[:, found.fields.index(one.field)]
        means = [part.mean() for part in np.array_split(found.onset[np.argsort(x)], 25)]
        # The scatter of a mean in a bin adds its share of the whole.
        assert one.index == pytest.approx(np.var(means) / np.var(found.onset), abs=0.01)
    assert [one.field for one in found.influences] == [
        "bearing.radial_clearance", "load", "temperature",
    ]  # fmt: skip
    assert sum(one.index for one in found.influences) == pytest.approx(1.0, abs=0.01)


def test_an_infinite_onset_leaves_no_variance() -> None:
    found = rc.tolerance(SHEET, {"disk_damping": ("uniform", 0.0, 4e5)}, 50, 1)
    assert np.isinf(found.onset).any()
    assert math.isnan(found.influences[0].index)


@given(n=st.integers(1, 200), share=st.floats(0.0, 1.0))
def test_the_interval_is_wilsons(n: int, share: float) -> None:
    k = round(share * n)
    found = statistics.probability(k, 0, n)
    expected = stats.binomtest(k, n).proportion_ci(method="wilson")
    assert (found.low, found.high) == pytest.approx((expected.low, expected.high), abs=1e-12)
    assert found.low <= found.value <= found.high


def test_every_kind_of_distribution_is_tried_here() -> None:
    assert {spread[0] for spread in DISTRIBUTIONS} == {spread[0] for spread in NO_WIDTH}
    assert set(spreads.KINDS) == {spread[0] for spread in DISTRIBUTIONS}
