"""What the core costs: `make bench`. No test, for timing depends on the machine.

Groups are to be read side by side: `analyse` beside the eigenvalues that it cannot do without (aim:
1.5 times), an import beside that of SciPy (aim: 0.3 s more), `onset_speed` alone (aim: 20 ms).
"""

import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from rotorcalc import PRESETS, Sweep, analyse, onset_speed
from rotorcalc.arrays import ComplexArray
from rotorcalc.coefficients import equilibrium
from rotorcalc.modes import state_matrix
from tests.machines import SHEET, with_rotor

ROOT = Path(__file__).resolve().parents[2]
SPEEDS = np.linspace(10.0, 12000 * math.pi / 30, 1000)
ROTORS = {
    "sheet": SHEET,
    "journal mass": with_rotor(journal_mass=10.0),
    "damped": with_rotor(disk_damping=1e3),
    "both": with_rotor(journal_mass=10.0, disk_damping=1e3),
    "no onset": with_rotor(disk_damping=1e5),
}


@pytest.mark.benchmark(group="1000 speeds")
def test_analyse_1000_speeds(benchmark):
    rigid, flexible = benchmark(lambda: _all_eigenvalues(analyse(SHEET, SPEEDS)))
    assert (rigid.shape, flexible.shape) == ((1000, 4), (1000, 6))


def _all_eigenvalues(sweep: Sweep) -> tuple[ComplexArray, ComplexArray]:
    """Return what a sweep computes when first asked for."""
    return sweep.rigid_eigenvalues, sweep.flexible_eigenvalues


@pytest.mark.benchmark(group="1000 speeds")
def test_eigvals_of_the_same_two_stacks(benchmark):
    state = equilibrium(SHEET, SPEEDS)
    stacks = [
        state_matrix(SHEET.rotor, state.stiffness, state.damping, flexible=flexible)
        for flexible in (False, True)
    ]
    rigid, flexible = benchmark(lambda: [np.linalg.eigvals(stack) for stack in stacks])
    assert (rigid.shape, flexible.shape) == ((1000, 4), (1000, 6))


@pytest.mark.benchmark(group="one speed")
def test_analyse_one_speed(benchmark):
    assert benchmark(analyse, SHEET, 600.0).speed == 600.0


@pytest.mark.benchmark(group="onset")
@pytest.mark.parametrize("name", ROTORS)
def test_onset_speed(benchmark, name):
    onset = benchmark(onset_speed, ROTORS[name])
    assert (onset.speed < math.inf) == (name != "no onset")


@pytest.mark.benchmark(group="onset")
@pytest.mark.parametrize("name", PRESETS)
def test_onset_speed_of_a_preset(benchmark, name):
    assert benchmark(onset_speed, PRESETS[name].machine).speed < math.inf


@pytest.mark.benchmark(group="import")
@pytest.mark.parametrize(
    "statement",
    ["import scipy.optimize, scipy.linalg", "import scipy.optimize, scipy.linalg, rotorcalc"],
)
def test_import(benchmark, statement):
    command = [sys.executable, "-c", statement]
    done = benchmark.pedantic(
        lambda: subprocess.run(command, cwd=ROOT, check=True), rounds=7, warmup_rounds=1
    )
    assert done.returncode == 0
