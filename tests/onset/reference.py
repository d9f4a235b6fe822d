"""An exact judge of a machine's stability: film, polynomial and Routh's count in sixty digits.

Independent of the package: the short bearing's Eqs. 5.30 and 5.31 turned by Eq. 5.16, ε by Newton
on the logarithm of Eq. 5.8, and the determinant of the machine's impedance multiplied out.
"""

import itertools
import math
import random

import mpmath
from mpmath import mp, mpf

from rotorcalc import JournalBearing, Machine, Oil, Rotor

mp.dps = 60


def drawn(seed, *, damped=None):
    """Draw a machine from ranges wider than the widgets': of turbochargers and of generators."""
    draw = random.Random(seed)

    def between(low, high):
        return math.exp(draw.uniform(math.log(low), math.log(high)))

    diameter, clearance = between(3e-3, 1.2), between(3e-6, 2e-3)
    while clearance > diameter / 20:
        clearance = between(3e-6, 2e-3)
    mass = between(0.05, 1e5)
    stiffness = draw.choice([between(1e3, 1e11), between(1e5, 1e11), math.inf])
    critical = 2 * math.sqrt(min(stiffness, 1e11) * mass / 2)
    has_damper = draw.random() < 0.5 if damped is None else damped
    return Machine(
        oil=Oil(
            reference_viscosity=between(1e-3, 0.5),
            reference_temperature=50,
            temperature_coefficient=0.03,
        ),
        bearing=JournalBearing(
            diameter=diameter, length=diameter * draw.uniform(0.1, 1.5), radial_clearance=clearance
        ),
        rotor=Rotor(
            mass=mass,
            shaft_stiffness=stiffness,
            disk_damping=critical * between(1e-4, 10) if has_damper else 0.0,
            journal_mass=mass / 2 * between(1e-5, 0.9) if draw.random() < 0.5 else 0.0,
        ),
        temperature=50,
        load=draw.choice([None, between(1e-2, 2e6)]),
    )


def unstable_roots(machine, speed, *, flexible=True):
    """Return how many eigenvalues of a machine lie in the right half plane."""
    return _routh(_polynomial(machine, mpf(speed), flexible))


def _eccentricity(sigma):
    if sigma == mp.inf:
        return mpf(0)
    t = -mp.log(sigma * mp.pi)  # ln w, w = ε/s
    t = t / 4 if t > 0 else t
    for _ in range(200):
        w2 = mp.exp(2 * t)
        value = t + mp.log((1 + w2) * mp.sqrt(mp.pi**2 + 16 * w2)) + mp.log(sigma)
        step = value / (1 + 2 * w2 / (1 + w2) + 16 * w2 / (mp.pi**2 + 16 * w2))
        t -= step
        if abs(step) < mpf(10) ** (5 - mp.dps):
            return mp.exp(t) / mp.sqrt(1 + mp.exp(2 * t))
    raise AssertionError("Newton's method does not settle")


def _film(eps):
    """Return K and C in X, Y in film units."""
    s = mp.sqrt(1 - eps**2)
    K = mpmath.matrix(
        [
            [2 * eps * (1 + eps**2) / s**6, mp.pi / (4 * s**3)],
            [-mp.pi * (1 + 2 * eps**2) / (4 * s**5), eps / s**4],
        ]
    )
    cross = -2 * eps / s**4
    C = mpmath.matrix([[mp.pi * (1 + 2 * eps**2) / (2 * s**5), cross], [cross, mp.pi / (2 * s**3)]])
    phi = mp.atan2(mp.pi * s, 4 * eps)
    turn = mpmath.matrix([[mp.cos(phi), -mp.sin(phi)], [mp.sin(phi), mp.cos(phi)]])
    return turn * K * turn.T, turn * C * turn.T


def _polynomial(machine, W, flexible):
    """Return the determinant's coefficients in λ/Ω, highest power first."""
    bearing, rotor = machine.bearing, machine.rotor
    R, L, C = mpf(bearing.diameter) / 2, mpf(bearing.length), mpf(bearing.radial_clearance)
    mu, F = mpf(machine.viscosity), mpf(machine.static_load)
    k, c = _film(_eccentricity(mu * W * L * R / (4 * F) * (L / C) ** 2 if F else mp.inf))
    unit = mu * R * L**3 / C**3 * W
    M, M_j, C_s = mpf(rotor.mass) / 2, mpf(rotor.journal_mass), mpf(rotor.disk_damping)
    bends = flexible and not rotor.is_rigid
    journal = [M_j * W**2 if bends else mpf(0)]
    disk = [(M - M_j if bends else M) * W**2, C_s * W, mpf(0)]
    on_shaft = _sum(disk, [mpf(rotor.shaft_stiffness)]) if bends else [mpf(1)]
    beside = [mpf(rotor.shaft_stiffness) * x for x in disk] if bends else disk

    def element(i, j):
        film = [c[i, j] * unit, k[i, j] * unit]
        own = _sum([*journal, 0, 0], film) if i == j else film
        whole = _product(own, on_shaft)
        return _sum(whole, beside) if i == j else whole

    det = _sum(
        _product(element(0, 0), element(1, 1)),
        [-x for x in _product(element(0, 1), element(1, 0))],
    )
    return list(itertools.dropwhile(lambda x: x == 0, det))


def _sum(a, b):
    n = max(len(a), len(b))
    a, b = [mpf(0)] * (n - len(a)) + list(a), [mpf(0)] * (n - len(b)) + list(b)
    return [x + y for x, y in zip(a, b, strict=True)]


def _product(a, b):
    result = [mpf(0)] * (len(a) + len(b) - 1)
    for i, x in enumerate(a):
        for j, y in enumerate(b):
            result[i + j] += x * y
    return result


def _routh(polynomial):
    """Return the number of roots with a positive real part: the sign changes of Routh's column."""
    above, row = polynomial[0::2], polynomial[1::2]
    row = row + [mpf(0)] * (len(above) - len(row))
    column = [above[0], row[0]]
    for _ in range(len(polynomial) - 2):
        ratio = above[0] / row[0]
        above, row = (
            row,
            [a - ratio * b for a, b in zip(above[1:], row[1:], strict=True)] + [mpf(0)],
        )
        column.append(row[0])
    return sum((a > 0) != (b > 0) for a, b in itertools.pairwise(column))


def exact_roots(machine, speed, *, flexible=True):
    """Return the eigenvalues λ of a machine, `mpc` [1/s]."""
    polynomial = _polynomial(machine, mpf(speed), flexible)
    # In units of the roots' geometric mean none of the coefficients is out of all proportion.
    n = len(polynomial) - 1
    unit = (abs(polynomial[-1] / polynomial[0])) ** (mpf(1) / n)
    scaled = [a * unit ** (n - i) for i, a in enumerate(polynomial)]
    monic = [a / scaled[0] for a in reversed(scaled)]
    roots = mpmath.polyroots(monic, maxsteps=5000, extraprec=1000, asc=True)
    return [root * unit * speed for root in roots]
