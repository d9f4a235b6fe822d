"""The onset of an undamped machine whose film's temperature follows from its supply of oil.

At a given σ the onset condition of `closed_form`, A + B − βAB = 1, gives the speed alone, as A and
B are Ω² times curves of the film; σ and Ω give the viscosity that the film must have (Eq. 5.8), and
that gives loss, flow and the temperature that they lead to (`heat`). One equation for σ is left:
the oil at that temperature has that viscosity. The lowest speed of its roots is the onset.

Source: San Andrés, Notes 5, Eqs. 5.8, 5.45 and 5.46; ISO 7902-1.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.optimize import elementwise, minimize_scalar

from rotorcalc.arrays import Array, BoolArray, IntArray
from rotorcalc.films import short
from rotorcalc.machine import HOTTEST, Machine, Oil, Supply, oil_of
from rotorcalc.numerics.roots import narrow_root
from rotorcalc.onset.curves import SIGMA, curves, table

# Only the relative step ends the search, as σ spans many decades.
_ROOT: Any = {"xatol": 0.0, "xrtol": 1e-14, "fatol": 0.0, "frtol": 0.0}
# An extreme of the excess nearer to zero than this may hide a pair of roots between two σ.
_NEAR = 0.05


@dataclass(frozen=True, eq=False)
class Warming:
    """The data of n machines, arrays (n,).

    Attributes
    ----------
    rigid, flexible, journal : array
        M C/F_o [s²], m_d/K_rot [s²] and β = M_j/M [-].
    stress : array
        μΩ/σ = 4F_o C²/(RL³) [Pa].
    torque, flow : array
        R³L/C [m³] and RLC [m³].
    slender : array
        (L/R)² [-].
    inlet, groove : array
        T_in [°C] and q [m³/s].
    carried : array
        2ρc/share [J/(m³·K)], infinite without heat.
    oils : tuple of Oil
        The oils, and of which each machine has the one at `oil`.
    oil : array of int
        Their places.
    """

    rigid: Array
    flexible: Array
    journal: Array
    stress: Array
    torque: Array
    flow: Array
    slender: Array
    inlet: Array
    groove: Array
    carried: Array
    oils: tuple[Oil, ...]
    oil: IntArray

    @classmethod
    def of(cls, machines: Sequence[Machine], *, flexible: bool = True) -> "Warming":
        """Return the data of machines with a supply and a load, on short plain bearings."""
        oils = tuple(dict.fromkeys(map(oil_of, machines)))
        rows = np.array([_numbers(one, flexible) for one in machines]).T
        fields = dict(zip(_FIELDS, rows, strict=True))
        return cls(**fields, oils=oils, oil=np.array([oils.index(oil_of(one)) for one in machines]))

    def speed(self, sigma: Array, i: IntArray, known: tuple[Array, Array] | None = None) -> Array:
        """Return the onset speed of machines i at σ [rad/s], infinite where no film whirls."""
        rigid, flexible = known or curves(sigma)
        a, b = self.rigid[i] * rigid / sigma**2, self.flexible[i] * flexible / sigma**2
        # The lower root of A + B − βAB = 1 for Ω², without cancellation.
        root = np.sqrt(np.maximum((a + b) ** 2 - 4.0 * self.journal[i] * a * b, 0.0))
        with np.errstate(divide="ignore"):
            return np.sqrt(2.0 / (a + b + root))

    def temperature(self, sigma: Array, speed: Array, i: IntArray) -> Array:
        """Return to what temperature the film at σ and a speed leads [°C]."""
        eps = short.eccentricity_ratio(sigma)
        shear = short.drag(eps, length_to_radius=0.0)
        couple = short.drag(eps, length_to_radius=1.0) - shear
        drag = shear + couple * self.slender[i]
        loss = drag * self.stress[i] * sigma * self.torque[i] * speed
        passing = short.side_flow(eps) * self.flow[i] * speed + self.groove[i]
        return self.inlet[i] + loss / (self.carried[i] * passing)

    def excess(self, sigma: Array, i: IntArray, known: tuple[Array, Array] | None = None) -> Array:
        """Return how much thicker the oil must be for the onset at σ than it is, −1 to 1.

        The difference of the two viscosities over their sum.
        """
        speed = self.speed(sigma, i, known)
        whirls = np.isfinite(speed)
        finite = np.where(whirls, speed, 1.0)
        T = np.minimum(self.temperature(sigma, finite, i), HOTTEST)
        # Where no film whirls the onset is at infinite speed, for which no viscosity is left.
        needed = np.where(whirls, self.stress[i] * sigma / finite, 0.0)
        oil = self.viscosity(T, i)
        return (needed - oil) / (needed + oil)

    def viscosity(self, T: Array, i: IntArray) -> Array:
        """Return the viscosity of the oils of machines i at temperatures [Pa·s]."""
        if len(self.oils) == 1:
            return self.oils[0].viscosity(T)
        each, which = np.broadcast_arrays(T, self.oil[i])
        found = np.empty(each.shape)
        for place, oil in enumerate(self.oils):
            found[which == place] = oil.viscosity(each[which == place])
        return found


_FIELDS = (
    "rigid", "flexible", "journal", "stress", "torque", "flow", "slender", "inlet", "groove",
    "carried",
)  # fmt: skip


def _numbers(machine: Machine, flexible: bool) -> list[float]:
    """Return the numbers of `_FIELDS`."""
    bearing, rotor, F = machine.bearing, machine.rotor, machine.static_load
    supply = machine.supply or Supply(temperature=0.0)
    R, L, C = bearing.radius, bearing.length, bearing.radial_clearance
    bends = flexible and not rotor.is_rigid
    return [
        rotor.half_mass * C / F,
        rotor.disk_mass / rotor.shaft_stiffness if bends else 0.0,
        rotor.journal_mass / rotor.half_mass if bends else 0.0,
        4.0 * F * C**2 / (R * L**3),
        R**3 * L / C,
        R * L * C,
        (L / R) ** 2,
        supply.temperature,
        supply.flow,
        2.0 * oil_of(machine).volumetric_heat / supply.heat_share if supply.heat_share else np.inf,
    ]


def warm_onset(machine: Machine, *, flexible: bool = True) -> tuple[float, float]:
    """Return σ and speed [rad/s] at the onset of a machine; NaN and ∞ where the oil ends before."""
    data, one = Warming.of([machine], flexible=flexible), np.zeros(1, dtype=np.intp)

    def excess(sigma: Array) -> Array:
        return data.excess(sigma, one)

    sigma = _grid(data)[:, 0]
    value = np.concatenate([data.excess(SIGMA, one, table()), excess(sigma[len(SIGMA) :])])
    for k in np.flatnonzero(_is_near(value)):
        place, turned = _beyond(excess, (float(sigma[k]), float(sigma[k + 2])), value[k + 1])
        sigma, value = np.append(sigma, place), np.append(value, turned)
    order = np.argsort(sigma)
    sigma, value = sigma[order], value[order]
    roots = [
        narrow_root(excess, float(sigma[k]), float(sigma[k + 1]))
        for k in np.flatnonzero((value[:-1] < 0.0) != (value[1:] < 0.0))
    ]
    found = np.array(roots)
    speed = data.speed(found, one)
    valid = data.temperature(found, speed, one) <= HOTTEST
    if not valid.any():
        return np.nan, np.inf
    first = int(np.argmin(np.where(valid, speed, np.inf)))
    return float(found[first]), float(speed[first])


def warm_onsets(machines: Sequence[Machine]) -> Array:
    """Return the onset speeds of machines [rad/s], (n,); NaN where one by one must decide."""
    data = Warming.of(machines)
    i = np.arange(len(machines))
    sigma = _grid(data)
    known = tuple(each[:, None] for each in table())
    value = np.concatenate([
        data.excess(SIGMA[:, None], i, (known[0], known[1])), data.excess(sigma[len(SIGMA):], i)
    ])  # fmt: skip
    change = (value[:-1] < 0.0) != (value[1:] < 0.0)
    k = np.argmax(change, axis=0)

    def excess(sigma: Array, which: Array) -> Array:
        return data.excess(sigma, which.astype(int))

    # The stubs lack what find_root returns for arrays of arguments.
    found: Any = elementwise.find_root(
        excess, (sigma[k, i], sigma[k + 1, i]), args=(i.astype(float),), tolerances=_ROOT
    )
    speed = data.speed(found.x, i)
    sure = found.success & (change.sum(axis=0) == 1) & ~np.any(_is_near(value), axis=0)
    return np.where(sure & (data.temperature(found.x, speed, i) <= HOTTEST), speed, np.nan)


def _beyond(
    excess: Callable[[Array], Array], bounds: tuple[float, float], value: float
) -> tuple[float, float]:
    """Return where between two σ the excess is farthest from a value's sign, and it there."""
    sign = math.copysign(1.0, value)

    def signed(sigma: float) -> float:
        return sign * float(excess(np.array([sigma]))[0])

    found = minimize_scalar(signed, bounds=bounds, method="bounded")
    return float(found.x), sign * float(found.fun)


def _is_near(value: Array) -> BoolArray:
    """Return where the inner values, (k−2, ...), turn back just before they reach zero."""
    size = np.abs(value)
    same = (np.sign(value[:-2]) == np.sign(value[1:-1])) & (
        np.sign(value[1:-1]) == np.sign(value[2:])
    )
    least = (size[1:-1] <= size[:-2]) & (size[1:-1] < size[2:])
    return same & least & (size[1:-1] < _NEAR)


def _grid(data: Warming) -> Array:
    """Return σ of the search, rising, (k, n): those of the table, and one above every root."""
    i = np.arange(len(data.rigid))
    # With the cold oil's viscosity even the centred film is at its onset; the last table speed is
    # the centred film's.
    centred = data.speed(np.full(len(i), SIGMA[-1]), i)
    cold = data.viscosity(data.inlet, i)
    far = np.maximum(2.0 * SIGMA[-1], 1.01 * cold * centred / data.stress)
    # In between by the table's ratio, as a root finder wants narrow intervals.
    return np.concatenate([np.repeat(SIGMA[:, None], len(i), axis=1), far[None, :]])
