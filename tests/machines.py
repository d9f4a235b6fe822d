"""Machines that the tests draw, and an exact judge of their stability."""

import itertools
import math
from dataclasses import replace
from fractions import Fraction

import numpy as np
from hypothesis import strategies as st
from scipy.optimize import linear_sum_assignment

from rotorcalc import PRESETS, JournalBearing, Machine, Oil, Rotor, whirl_onset
from rotorcalc.coefficients import equilibrium
from rotorcalc.films import short

EPS = float(np.finfo(float).eps)
RPM = math.pi / 30

# Above this eccentricity ratio the short bearing's film cannot whirl (the notes print 0.75).
ALWAYS_STABLE = 0.756030386471

SHEET = Machine(
    oil=Oil(
        reference_viscosity=0.0172368925, reference_temperature=50, temperature_coefficient=0.03
    ),
    bearing=JournalBearing(diameter=0.150, length=0.050, radial_clearance=60e-6),
    rotor=Rotor(mass=272.1422, shaft_stiffness=1e8, imbalance=12e-6),
    temperature=60.0,
)


def with_rotor(machine=SHEET, **changes):
    """Return the machine with some of its rotor's fields changed."""
    return replace(machine, rotor=replace(machine.rotor, **changes))


# Every kind of rotor that the equations of motion know.
ROTORS = {
    "rigid": replace(SHEET.rotor, shaft_stiffness=math.inf),
    "rigid, damped": replace(SHEET.rotor, shaft_stiffness=math.inf, disk_damping=2e4),
    "massless journals": SHEET.rotor,
    "damped": replace(SHEET.rotor, disk_damping=2e4),
    "journal mass": replace(SHEET.rotor, journal_mass=15.0),
    "journal mass, damped": replace(SHEET.rotor, journal_mass=15.0, disk_damping=2e4),
}
# Machines of every kind, the presets among them.
MACHINES = {
    **{key: preset.machine for key, preset in PRESETS.items()},
    "midspan damping": with_rotor(disk_damping=1e4),
    "journal mass": with_rotor(journal_mass=20.0),
    "both": with_rotor(disk_damping=5e3, journal_mass=10.0, shaft_stiffness=1e7),
    "rigid and damped": with_rotor(disk_damping=1e4, shaft_stiffness=math.inf),
    "heavy": replace(SHEET, load=20000.0),
}
C = SHEET.bearing.radial_clearance


def balanced(rotor, imbalance=0.0):
    """Return the sheet's machine with another rotor, by default without imbalance."""
    return replace(SHEET, rotor=replace(rotor, imbalance=imbalance))


def near_hopf(eps, factor, speed=600.0):
    """Return a rigid rotor that rests at ε with p² = factor · p_s², the speed, and its rest."""
    b = SHEET.bearing
    sigma = float(short.modified_sommerfeld(eps))
    load = SHEET.viscosity * speed * b.length * b.radius * (b.length / C) ** 2 / (4.0 * sigma)
    p_s2 = float(whirl_onset(short.stiffness(eps), short.damping(eps)).critical_mass)
    mass = factor * p_s2 * load / (C * speed**2)
    machine = replace(SHEET, load=load, rotor=Rotor(mass=2.0 * mass))
    return machine, speed, equilibrium(machine, speed).film.position * C


def log_uniform(low, high):
    """Draw numbers of every order of magnitude between two positive ones."""
    return st.floats(math.log10(low), math.log10(high)).map(lambda power: 10.0**power)


RIGID = st.just(math.inf)
BENDING = log_uniform(1e6, 1e10)


@st.composite
def machines(draw, *, stiffness=RIGID | BENDING, damped=False, journals=False, load=None):
    """Draw a machine of ordinary size; `drawn` has those of the app's whole ranges.

    Midspan damping reaches from next to nothing to ten times what leaves the disk on its shaft
    without oscillation, journal mass from next to nothing to nearly the whole rotor.
    """
    diameter = draw(st.floats(0.02, 0.4))
    mass = draw(log_uniform(10, 2000))
    shaft = draw(stiffness)
    critical = math.sqrt(min(shaft, 1e10) * mass / 2)
    return Machine(
        oil=Oil(
            reference_viscosity=draw(log_uniform(2e-3, 0.2)),
            reference_temperature=50,
            temperature_coefficient=0.03,
        ),
        bearing=JournalBearing(
            diameter=diameter,
            length=diameter * draw(st.floats(0.2, 1.0)),
            radial_clearance=diameter / 2 * draw(log_uniform(5e-4, 3e-3)),
        ),
        rotor=Rotor(
            mass=mass,
            shaft_stiffness=shaft,
            imbalance=1e-5,
            disk_damping=critical * draw(log_uniform(1e-3, 10)) if damped else 0.0,
            journal_mass=mass / 2 * draw(log_uniform(1e-4, 0.9)) if journals else 0.0,
        ),
        temperature=draw(st.floats(20, 120)),
        load=None if load is None else draw(load),
    )


def drawn(seed):
    """Return a machine and a top speed from the sliders' whole ranges, the same ever again.

    Rotors of 50 g to 100 t, journals of 3 mm to 1.2 m, clearances of 3 µm to 2 mm, any shaft.
    """
    random = np.random.default_rng(seed)

    def between(low, high):
        return 10.0 ** random.uniform(math.log10(low), math.log10(high))

    def or_zero(value):
        return value if random.random() < 0.5 else 0.0

    diameter, mass = between(3e-3, 1.2), between(0.05, 1e5)
    clearance = min(max(0.5 * diameter * between(5e-4, 2e-2), 3e-6), 2e-3)
    shaft = math.inf if random.random() < 0.15 else between(1e3, 1e11)
    critical = 2.0 * math.sqrt(min(shaft, 1e10) * mass / 2.0)
    machine = Machine(
        oil=Oil(
            reference_viscosity=between(2e-3, 0.2),
            reference_temperature=50,
            temperature_coefficient=0.03,
        ),
        bearing=JournalBearing(
            diameter=diameter,
            length=diameter * random.uniform(0.2, 1.0),
            radial_clearance=clearance,
        ),
        rotor=Rotor(
            mass=mass,
            shaft_stiffness=shaft,
            imbalance=0.1 * clearance,
            disk_damping=or_zero(critical * between(1e-4, 10.0)),
            journal_mass=or_zero(0.5 * mass * between(1e-4, 0.9)),
        ),
        temperature=50.0,
    )
    return machine, between(300.0, 60000.0) * RPM


def farthest(one, other):
    """Return the largest distance between two sets of as many eigenvalues, paired as they lie."""
    distance = np.abs(np.asarray(one)[:, None] - np.asarray(other)[None, :])
    return float(distance[linear_sum_assignment(distance)].max())


def unstable_roots(machine, speed, *, flexible=True):
    """Return how many eigenvalues of a machine lie in the right half plane, without rounding.

    Routh's array of the characteristic polynomial in rational arithmetic: exact for the film's
    coefficients as they are, and independent of the package's state matrices.
    """
    state = equilibrium(machine, speed)
    return _routh(
        characteristic_polynomial(
            machine.rotor, state.stiffness, state.damping, speed, flexible=flexible
        )
    )


def characteristic_polynomial(rotor, K, C, speed, *, flexible=True):
    """Return the coefficients in λ/Ω of det of the machine's impedance, highest power first.

    The disk hangs on the shaft and the journal on the film,
    (m_d λ² + C_s λ)·d + K_rot(d − j) = 0 and (M_j λ² + Cλ + K)·j + K_rot(j − d) = 0.
    """
    W, K, C = Fraction(float(speed)), _fractions(K), _fractions(C)
    damping = Fraction(rotor.disk_damping) * W
    rigid = rotor.is_rigid or not flexible
    disk = [Fraction(rotor.half_mass if rigid else rotor.disk_mass) * W**2, damping, Fraction(0)]
    journal = Fraction(0 if rigid else rotor.journal_mass) * W**2
    film = [[[journal * (i == j), C[i][j] * W, K[i][j]] for j in (0, 1)] for i in (0, 1)]
    if rigid:
        total = [[_sum(film[i][j], disk) if i == j else film[i][j] for j in (0, 1)] for i in (0, 1)]
    else:
        k = Fraction(rotor.shaft_stiffness)
        disk_on_shaft, coupling = _sum(disk, [k]), [k * c for c in disk]
        total = [
            [
                _sum(_product(film[i][j], disk_on_shaft), coupling if i == j else [Fraction(0)])
                for j in (0, 1)
            ]
            for i in (0, 1)
        ]
    det = _sum(_product(total[0][0], total[1][1]), [-c for c in _product(total[0][1], total[1][0])])
    while det[0] == 0:
        det = det[1:]
    return det


def _fractions(matrix):
    return [[Fraction(float(element)) for element in row] for row in matrix]


def _sum(a, b):
    n = max(len(a), len(b))
    a, b = [Fraction(0)] * (n - len(a)) + a, [Fraction(0)] * (n - len(b)) + b
    return [x + y for x, y in zip(a, b, strict=True)]


def _product(a, b):
    result = [Fraction(0)] * (len(a) + len(b) - 1)
    for i, x in enumerate(a):
        for j, y in enumerate(b):
            result[i + j] += x * y
    return result


def _routh(polynomial):
    """Return the number of roots with a positive real part: the sign changes of Routh's column."""
    above, row = polynomial[0::2], polynomial[1::2]
    row = row + [Fraction(0)] * (len(above) - len(row))
    column = [above[0], row[0]]
    for _ in range(len(polynomial) - 2):
        ratio = above[0] / row[0]
        above, row = (
            row,
            [a - ratio * b for a, b in zip(above[1:], row[1:], strict=True)] + [Fraction(0)],
        )
        column.append(row[0])
    assert all(column), "a root on the imaginary axis, or a degenerate array"
    return sum((a > 0) != (b > 0) for a, b in itertools.pairwise(column))
