"""Level-one stability: the log decrement with cross-coupled stiffness at midspan.

The screening of API 617 (7th edition, 2002) and of API 684: a stiffness Q that stands for all that
drives the disk forward is raised from zero past the anticipated Q_A. The first forward mode must
have a logarithmic decrement of at least 0.1 at Q_A, and Q_0, where the decrement vanishes, must be
at least twice Q_A; else a second level of analysis, with the seals' own coefficients, is asked for.
The anticipated value is Wachel's form of Alford's equation,

    q_A = B T/(D H) · ρ_d/ρ_s,    T = P/Ω,

for each impeller, Q_A their sum; B = 3 for a centrifugal impeller, and for a row of blades B = 1.5
without the ratio of densities. Of several forward modes, such as oil whirl beside that of the bent
shaft, the least damped counts here as the first. Q damps a backward mode more, but as Q rises its
orbit may narrow to a line and open forward: where it is damped less, that is to be known too.

The standard prints B C P/(D H N) with C = 9.55 = 60/2π for P in W, N in rpm, D and H in mm and q_A
in kN/mm, and with C = 63 for hp, inches and klbf/in.

Source: the paragraphs SP6.8.5.6 to SP6.8.5.10 of API 684 as Petrobras' open program ROSS cites and
computes them (`ross/API_Report/Report.py`). The standard's chart of the critical speed ratio over
the gas density, which asks for a second level between Q_0/Q_A = 2 and 10, is not included.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc import modes
from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, BoolArray, ComplexArray, checked_speed, real_array, shown
from rotorcalc.coefficients import dynamics
from rotorcalc.criteria.coupled_modes import coupled_eigenvalues, disk_whirls_forward
from rotorcalc.display import Result
from rotorcalc.films import FilmDynamics
from rotorcalc.machine import Machine, Rotor
from rotorcalc.numerics.roots import narrow_root

# B of the anticipated cross-coupling.
CENTRIFUGAL, AXIAL = 3.0, 1.5
# Least log decrement at Q_A, and least Q_0/Q_A.
LEAST_DECREMENT, LEAST_RATIO = 0.1, 2.0
# Steps in which Q is raised until the machine is unstable, each fourfold; and places from a
# millionth of that Q up at which the growth is computed to find the first crossing.
_RAISED, _PLACES = 80, 121
# Rounding errors of a growth rate over its largest value between two of these places.
_NOISE = 1e-10


@dataclass(frozen=True, eq=False)
class LevelOne(Result):
    """The first forward mode of a machine over the cross-coupled stiffness at midspan.

    Attributes
    ----------
    speed : float
        Running speed, Ω [rad/s].
    cross_coupling : array, (...)
        Q of the whole machine, positive forward [N/m].
    forward_decrement : array, (...)
        δ of the first forward mode [-]: of the modes in which the disk turns with the shaft, or
        moves along a line, the least damped; infinite where none oscillates.
    whirl_frequency : array, (...)
        Frequency of that mode [rad/s]; 0 where there is none.
    backward_decrement : array, (...)
        δ of the least damped of the other modes [-], in which the disk turns against the shaft.
        Minus infinity where a mode grows without oscillating, infinite where there is no other
        mode.
    zero_decrement : float
        Q_0, the smallest Q at which δ vanishes [N/m]; 0 where the machine is unstable without any,
        infinite where no Q makes it unstable.
    """

    speed: float
    cross_coupling: Array
    forward_decrement: Array
    whirl_frequency: Array
    backward_decrement: Array
    zero_decrement: float

    @property
    def log_decrement(self) -> Array:
        """δ of the least damped mode, forward or backward [-], (...)."""
        return np.minimum(self.forward_decrement, self.backward_decrement)


@checked
def level_one(machine: Machine, speed: float, cross_coupling: ArrayLike) -> LevelOne:
    """Return the log decrement of the first forward mode with cross-coupled stiffness at midspan.

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : float
        Running speed, Ω [rad/s].
    cross_coupling : array_like, (...)
        Q of the whole machine, both sides together, positive forward [N/m].

    Returns
    -------
    LevelOne
        δ over Q, and Q_0.

    Raises
    ------
    ValueError
        Where the speed is not positive and finite, a Q is not finite, or on a film that is known by
        its impedance no mode was found.
    """
    omega = float(checked_speed(speed))
    Q = real_array("cross_coupling", cross_coupling)
    if not np.all(np.isfinite(Q)):
        raise ValueError(f"cross_coupling = {shown(cross_coupling)} N/m: must be finite")
    film = dynamics(machine, omega)
    row = Q.ravel()
    values = _known(coupled_eigenvalues(machine.rotor, film, row))
    forward = (values.imag > 0.0) & disk_whirls_forward(machine.rotor, film, row, values)
    first, others = _least_damped(values, forward), _least_damped(values, ~forward)
    return LevelOne(
        speed=omega,
        cross_coupling=Q,
        forward_decrement=modes.logarithmic_decrement(first).reshape(Q.shape),
        whirl_frequency=modes.damped_frequency(first).reshape(Q.shape),
        backward_decrement=modes.logarithmic_decrement(others).reshape(Q.shape),
        zero_decrement=_zero_decrement(machine.rotor, film),
    )


@checked
def anticipated_cross_coupling(  # noqa: PLR0913 - as many as the equation has
    power: ArrayLike,
    *,
    speed: ArrayLike,
    diameter: ArrayLike,
    width: ArrayLike,
    density_ratio: ArrayLike = 1.0,
    factor: float = CENTRIFUGAL,
) -> Array:
    """Return the cross-coupled stiffness to be expected of an impeller or a row of blades.

    Parameters
    ----------
    power : array_like, (...)
        Power of the stage, P [W].
    speed : array_like, (...)
        Running speed, Ω [rad/s].
    diameter : array_like, (...)
        Outer diameter of the impeller, or mean diameter of the blades, D [m].
    width : array_like, (...)
        The smaller of the widths of impeller outlet and diffuser, or the blades' height, H [m].
    density_ratio : array_like, (...)
        Density of the gas at discharge over suction, ρ_d/ρ_s [-]; 1 for a row of blades.
    factor : float
        B [-]: `CENTRIFUGAL`, 3, or `AXIAL`, 1.5.

    Returns
    -------
    array, (...)
        q_A [N/m] of each stage; the machine's Q_A is their sum.

    Raises
    ------
    ValueError
        Where an argument is not positive and finite.

    Examples
    --------
    >>> q = anticipated_cross_coupling(1e6, speed=1000.0, diameter=0.4, width=0.02)
    >>> print(f"{q:.0f}")
    375000
    """
    given = {
        "power": (power, "W"), "diameter": (diameter, "m"), "width": (width, "m"),
        "density_ratio": (density_ratio, "-"), "factor": (factor, "-"),
    }  # fmt: skip
    P, D, H, ratio, B = (_positive(name, value, unit) for name, (value, unit) in given.items())
    torque = P / checked_speed(speed)
    return B * torque / (D * H) * ratio


def _positive(name: str, value: ArrayLike, unit: str) -> Array:
    array = real_array(name, value)
    if not np.all(np.isfinite(array) & (array > 0.0)):
        raise ValueError(f"{name} = {shown(value)} {unit}: must be positive and finite")
    return array


def _known(values: ComplexArray) -> ComplexArray:
    """Return λ of modes (m, n); raises ValueError where of one Q none is known."""
    if np.any(np.all(np.isnan(values), axis=-1)):
        raise ValueError(
            "cross_coupling: on this film no mode was found whose frequency is that of its own "
            "stiffness and damping; try other values of Q or another speed"
        )
    return values


def _least_damped(values: ComplexArray, counts: BoolArray) -> ComplexArray:
    """Return λ of the least damped of those modes (m, n) that count, (m,); −1 where none does."""
    # A pair counts once, and a mode that decays without oscillating has an infinite decrement.
    counts = counts & (values.imag >= 0.0)
    decrement = np.where(counts, modes.logarithmic_decrement(values), np.inf)
    place = np.argmin(decrement, axis=-1)[:, None]
    found: ComplexArray = np.take_along_axis(values, place, axis=-1)[:, 0]
    return np.where(np.min(decrement, axis=-1) < np.inf, found, -1.0 + 0.0j)


def _zero_decrement(rotor: Rotor, film: FilmDynamics) -> float:
    """Return the smallest Q at which the fastest growth is zero."""

    def growth(Q: Array) -> Array:
        return np.nanmax(coupled_eigenvalues(rotor, film, Q).real, axis=-1)

    if growth(np.zeros(1))[0] >= 0.0:
        return 0.0
    # A stiffness of the film's size; the rotor's inertia has the last word, so one is large enough.
    raised = np.abs(film.stiffness).max() * 4.0 ** np.arange(_RAISED)
    high = next((Q for Q in raised if growth(np.array([Q]))[0] > 0.0), np.inf)
    if np.isinf(high):
        return np.inf
    # Growth may fall and rise: the first crossing counts.
    places = np.concatenate([[0.0], np.geomspace(1e-6 * high, high, _PLACES)])
    first = int(np.argmax(growth(places) > 0.0))
    low, high = places[first - 1], places[first]
    return narrow_root(growth, low, high, noise=_NOISE)
