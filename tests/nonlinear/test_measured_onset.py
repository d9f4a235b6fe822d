"""What the nonlinear motion shows of growth and onset is what the eigenvalues say."""

import math
from dataclasses import replace

import pytest

from rotorcalc import PRESETS, Rotor, analyse, modes, onset_speed
from rotorcalc.nonlinear import measured_onset
from rotorcalc.nonlinear.measured_onset import Onsets, measured_growth, onsets
from rotorcalc.nonlinear.transient import start_on_mode
from rotorcalc.variation import varied
from tests.machines import ROTORS, RPM, C, balanced, drawn, near_hopf, with_rotor

# Growth rates that a measurement can tell from zero, and gives to a twentieth, over |λ|.
_SEEN = 1e-5


def expected(machine, speed):
    return complex(modes.leading(analyse(machine, speed).flexible_eigenvalues))


@pytest.mark.parametrize("factor", [0.3, 0.9, 1.1, 3.0])
@pytest.mark.parametrize("seed", range(12))
def test_growth_is_that_of_the_mode_that_decays_slowest(seed, factor):
    machine, top = drawn(seed)
    onset = onset_speed(machine).speed
    speed = factor * (onset if 0.0 < onset < math.inf else top / 3.0)
    mode, measured = expected(machine, speed), measured_growth(machine, speed)
    order = mode.imag / speed
    if not 0.005 < order < 400.0:  # two whirls in 400 revolutions, 400 in one
        assert math.isnan(measured)
    elif abs(mode.real) > _SEEN * abs(mode):
        assert measured == pytest.approx(mode.real, rel=0.05)
    else:
        assert measured == pytest.approx(mode.real, abs=_SEEN * abs(mode))


def test_growth_on_a_soft_shaft_is_that_of_the_slow_mode_and_not_of_the_kicked_one():
    machine = varied(PRESETS["sheet-1e7"].machine, {"shaft_stiffness": 3e6})
    speed = 1.1 * onset_speed(machine).speed
    assert measured_growth(machine, speed) == pytest.approx(1.22485, rel=1e-4)
    found = onsets(machine)
    assert found.agree == "agree"
    assert found.spread < 1e-5


@pytest.mark.parametrize("eps", [0.02, 0.99])
def test_growth_is_measured_at_small_and_large_eccentricity(eps):
    machine, speed, _ = near_hopf(0.5, 0.9)
    load = machine.static_load * (1.0 - eps) if eps < 0.5 else machine.static_load / (1.0 - eps)
    machine = varied(machine, {"load": load})
    mode = expected(machine, speed)
    assert measured_growth(machine, speed) == pytest.approx(mode.real, rel=1e-3)


@pytest.mark.parametrize("kind", ROTORS)
def test_three_ways_to_the_onset_agree(kind):
    told = []
    found = onsets(balanced(ROTORS[kind], 0.1 * C), progress=told.append)
    assert found.agree == "agree"
    assert found.spread < 1e-5
    assert math.isnan(found.closed_form) == ("damped" in kind)
    assert told == sorted(told)
    assert 0.0 < told[0] < told[-1] < 1.0


def test_onsets_differ_where_the_measurement_is_wrong(monkeypatch):
    monkeypatch.setattr(
        measured_onset,
        "measured_growth",
        lambda machine, speed: measured_growth(machine, speed) + 1.0,
    )
    assert onsets(balanced(ROTORS["rigid"])).agree == "differ"


def test_nothing_agrees_where_nothing_was_measured():
    assert Onsets(closed_form=500.0, eigenvalues=500.0, measured=math.nan).agree == "not measured"
    assert Onsets(closed_form=math.nan, eigenvalues=500.0, measured=500.1).agree == "agree"
    assert Onsets(closed_form=400.0, eigenvalues=500.0, measured=500.0).agree == "differ"


def test_an_onset_is_not_measured_where_the_growth_is_not(monkeypatch):
    monkeypatch.setattr(measured_onset, "measured_growth", lambda *_: math.nan)
    found = onsets(balanced(ROTORS["rigid"]))
    assert math.isnan(found.measured)
    assert found.agree == "not measured"


def test_a_machine_without_an_onset_has_none_to_compare():
    with pytest.raises(ValueError, match="has no onset"):
        onsets(with_rotor(disk_damping=1e5))


def test_a_machine_without_oscillating_modes_has_no_whirl_growth():
    machine = replace(balanced(Rotor(mass=1.0, disk_damping=1e9)), load=2e5)
    speed = 1000 * RPM
    assert math.isnan(expected(machine, speed).real)
    assert math.isnan(measured_growth(machine, speed))
    with pytest.raises(ValueError, match="none of its modes oscillates"):
        start_on_mode(machine, speed, 1e-4 * C)


def test_onsets_and_growth_share_their_releases_and_are_those_of_each_alone(monkeypatch):
    machine, speeds = balanced(ROTORS["rigid"]), []

    def counted(machine, speed):
        speeds.append(speed)
        return measured_growth(machine, speed)

    monkeypatch.setattr(measured_onset, "measured_growth", counted)
    found, curve = measured_onset.onsets_and_growth(machine)
    assert len(speeds) == len(set(speeds)) < len(curve.measured) + 6
    alone = measured_onset.growth_curve(machine, found.eigenvalues)
    assert found == onsets(machine)
    assert list(curve.measured) == list(alone.measured)
