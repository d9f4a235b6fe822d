"""What nonlinear orbits cost: `make bench`. No test, for timing depends on the machine.

Aims: 60 revolutions of a rigid rotor 0.25 s, of a flexible one 0.6 s, a run-up of 200 spectra 20 s.
The baseline is a plain script: SciPy's `solve_ivp` over the film's force in NumPy, to the same
accuracy; pytest-benchmark prints the ratio.
"""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from rotorcalc import bifurcation, onsets, simulate
from rotorcalc.films import short
from rotorcalc.nonlinear.signals import waterfall
from tests.machines import ROTORS, RPM, C, balanced

SPEED = 6000 * RPM
RIGID, FLEXIBLE = (balanced(ROTORS[kind], 0.2 * C) for kind in ("rigid", "massless journals"))


@pytest.mark.benchmark(group="60 revolutions", min_rounds=3)
@pytest.mark.parametrize("kind", ROTORS)
def test_simulate(benchmark, kind):
    machine = balanced(ROTORS[kind], 0.2 * C)
    motion = benchmark(simulate, machine, SPEED, revolutions=60)
    assert motion.journal.shape == (3841, 2)


@pytest.mark.benchmark(group="60 revolutions")
def test_a_plain_script_of_the_rigid_rotor(benchmark):
    b, M = RIGID.bearing, RIGID.rotor.half_mass
    unit = RIGID.viscosity * SPEED * b.radius * b.length**3 / C**2
    load = np.array([RIGID.static_load, 0.0])

    def rates(t, state):
        film = unit * short.film_force(state[:2] / C, state[2:] / (C * SPEED))
        turning = np.array([math.cos(SPEED * t), math.sin(SPEED * t)])
        imbalance = RIGID.rotor.imbalance * SPEED**2 * turning
        return np.concatenate([state[2:], (film + load) / M + imbalance])

    ours = simulate(RIGID, SPEED, revolutions=60)
    state = [*ours.journal[0], 0.0, 0.0]
    found = benchmark.pedantic(
        lambda: solve_ivp(
            rates, (0.0, ours.time[-1]), state, t_eval=ours.time, rtol=1e-10, atol=1e-16,
            method="LSODA",
        ),
        rounds=1,
    )  # fmt: skip
    assert np.abs(found.y[:2].T - ours.journal).max() < 1e-6 * C


@pytest.mark.benchmark(group="run-up")
@pytest.mark.parametrize("machine", [RIGID, FLEXIBLE], ids=["rigid", "flexible"])
def test_waterfall_of_200_speeds(benchmark, machine):
    def work():
        motion = simulate(
            machine, 3000 * RPM, revolutions=1600, samples_per_revolution=16,
            final_speed=12000 * RPM, tolerance=1e-7,
        )  # fmt: skip
        return waterfall(motion, spectra=200)

    assert benchmark.pedantic(work, rounds=1).amplitude.shape[0] == 200


@pytest.mark.benchmark(group="bifurcation")
@pytest.mark.parametrize("machine", [RIGID, FLEXIBLE], ids=["rigid", "flexible"])
def test_limit_cycles(benchmark, machine):
    assert benchmark.pedantic(bifurcation, (machine,), rounds=1).stable.any()


@pytest.mark.benchmark(group="bifurcation")
def test_three_onsets(benchmark):
    assert benchmark.pedantic(onsets, (FLEXIBLE,), rounds=1).agree == "agree"
