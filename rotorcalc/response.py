"""Steady response to imbalance, and the orbits that it draws.

Model: linear film coefficients; the disk's mass centre lies a distance u off the shaft's axis and
turns forward, (cos Ωt, sin Ωt); the source's (sin, cos) turns backward. A phasor P stands for
Re{P e^{jΩt}}, amplitude from zero to peak, about static equilibrium.

Source: San Andrés, Notes 5, Eq. 5.38, and the calculation sheet's synchronous response of the
flexible rotor, with midspan damping and journal mass added.
"""

from dataclasses import dataclass
from typing import cast

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.coefficients import checked_speed, stiffness_and_damping
from rotorcalc.machine import Machine, Rotor
from rotorcalc.typing import Array, ComplexArray, IntArray

# The imbalance (cos Ωt, sin Ωt) as phasors.
_FORWARD = np.array([1.0, -1.0j])
# The search for a peak: zooms, each into this many points.
_ZOOMS, _ZOOM_POINTS = 2, 65


@dataclass(frozen=True, eq=False)
class OrbitEllipse:
    """The ellipse that two phasors draw, each field of shape (...), lengths in the phasors' unit.

    Attributes
    ----------
    semi_major : array
        Semi-major axis, |f| + |b|.
    semi_minor : array
        Semi-minor axis, |f| − |b|; positive where the orbit turns forward.
    inclination : array
        Angle from X to the major axis, (arg f + arg b)/2 [rad].
    forward : complex array
        Forward circle, f = (X + jY)/2.
    backward : complex array
        Backward circle, b = (X − jY)*/2.
    """

    semi_major: Array
    semi_minor: Array
    inclination: Array
    forward: ComplexArray
    backward: ComplexArray


@dataclass(frozen=True, eq=False)
class ResponsePeaks:
    """Local maxima of an orbit's size over speed, each field of shape (peaks,).

    Attributes
    ----------
    speed : array
        Running speed, Ω [rad/s].
    amplitude : array
        Semi-major axis of the orbit [m].
    """

    speed: Array
    amplitude: Array


def synchronous_response(
    rotor: Rotor, K: Array, C: Array, speed: ArrayLike
) -> tuple[ComplexArray, ComplexArray]:
    """Return the response of disk and journal to the rotor's imbalance.

    Parameters
    ----------
    rotor : Rotor
        The rotor.
    K, C : array, (..., 2, 2)
        The film's stiffness [N/m] and damping [N·s/m] in X, Y.
    speed : array_like, (...)
        Running speed, Ω [rad/s].

    Returns
    -------
    disk, journal : complex array, (..., 2)
        Phasors of X and Y [m]; equal for a rigid shaft.

    Notes
    -----
    With Z = K + jΩC − Ω²M_j I for film and journal, z = jΩC_s − Ω²m_d for the disk and s = 1/K_rot
    for the shaft, eliminating the disk from its balance and the journal's leaves

        (Z + z I + s z Z) j = m_d u Ω² e,    d = (I + s Z) j,

    which holds for the rigid shaft too, s = 0.
    """
    speed = checked_speed(speed)[..., None, None]
    identity = np.eye(2)
    s = 1.0 / rotor.shaft_stiffness
    Z = K + 1j * speed * C - speed**2 * rotor.journal_mass * identity
    z = 1j * speed * rotor.disk_damping - speed**2 * rotor.disk_mass
    force = rotor.disk_mass * rotor.imbalance * speed**2 * _FORWARD[:, None]
    journal = cast("ComplexArray", np.linalg.solve(Z + z * identity + s * z * Z, force))
    disk = journal + s * (Z @ journal)
    return disk[..., 0], journal[..., 0]


def orbit_ellipse(x: ArrayLike, y: ArrayLike) -> OrbitEllipse:
    """Return the ellipse that the phasors of X and Y draw.

    Parameters
    ----------
    x, y : array_like, (...)
        Complex phasors of X and Y, in any one unit.

    Returns
    -------
    OrbitEllipse
        Axes, inclination, and the forward and backward circles that add up to it. Its fields
        have the shape (...).

    Examples
    --------
    >>> orbit = orbit_ellipse(2.0, -1.0j)
    >>> float(orbit.semi_major), float(orbit.semi_minor)
    (2.0, 1.0)
    """
    x, y = np.broadcast_arrays(np.asarray(x, dtype=complex), np.asarray(y, dtype=complex))
    forward = (x + 1j * y) / 2.0
    backward: ComplexArray = (x - 1j * y).conj() / 2.0
    return OrbitEllipse(
        semi_major=np.abs(forward) + np.abs(backward),
        semi_minor=np.abs(forward) - np.abs(backward),
        inclination=(np.angle(forward) + np.angle(backward)) / 2.0,
        forward=forward,
        backward=backward,
    )


def orbit_points(x: ArrayLike, y: ArrayLike, *, points: int = 73) -> Array:
    """Return the orbit that the phasors of X and Y draw, point by point over one turn.

    Parameters
    ----------
    x, y : array_like, (...)
        Complex phasors of X and Y, in any one unit.
    points : int
        Number of points; the last is the first again.

    Returns
    -------
    array, (..., points, 2)
        Re{X e^{jΩt}}, Re{Y e^{jΩt}} from Ωt = 0 to 2π, in the phasors' unit.

    Examples
    --------
    >>> orbit_points(2.0, -1.0j, points=5).round(12) + 0.0
    array([[ 2.,  0.], [ 0.,  1.], [-2.,  0.], [ 0., -1.], [ 2.,  0.]])
    """
    phasors = np.stack(np.broadcast_arrays(x, y), axis=-1)
    turn = np.exp(1j * np.linspace(0.0, 2.0 * np.pi, points))
    return np.real(phasors[..., None, :] * turn[:, None])


def phase_lag(response: ArrayLike) -> Array:
    """Return by how much a response lags the imbalance, unwrapped over the sweep.

    Parameters
    ----------
    response : array_like, (n, 2)
        Phasors of X and Y at n neighbouring speeds.

    Returns
    -------
    array, (n, 2)
        Lag of X behind cos Ωt and of Y behind sin Ωt [rad]; at the first speed within ±π.
    """
    return np.unwrap(-np.angle(np.asarray(response) / _FORWARD), axis=0)


def response_peaks(machine: Machine, speed: ArrayLike, *, at: str = "disk") -> ResponsePeaks:
    """Return the speeds at which the orbit is largest: local maxima of its semi-major axis.

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : array_like, (n,)
        Rising speeds, Ω [rad/s], dense enough to show each peak. A peak lies within them.
    at : str
        Whose orbit, "disk" or "journal".

    Returns
    -------
    ResponsePeaks
        Speeds and amplitudes, the speeds to 1e-6 of the spacing.

    Raises
    ------
    ValueError
        Where `at` is neither, or a speed is not positive and finite.
    """
    if at not in ("disk", "journal"):
        raise ValueError(f"at = {at!r}: must be 'disk' or 'journal'")
    disk, journal = both_peaks(machine, speed)
    return disk if at == "disk" else journal


def both_peaks(
    machine: Machine,
    speed: ArrayLike,
    *,
    responses: tuple[ComplexArray, ComplexArray] | None = None,
) -> tuple[ResponsePeaks, ResponsePeaks]:
    """Return the peaks of the disk's response and of the journals', found in one search.

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : array_like, (n,)
        Rising speeds, Ω [rad/s], dense enough to show each peak. A peak lies within them.
    responses : pair of complex arrays, (n, 2), or None
        The responses of disk and journal at these speeds [m], where they are known already.

    Returns
    -------
    disk, journal : ResponsePeaks
        As `response_peaks` gives them.

    Raises
    ------
    ValueError
        Where a speed is not positive and finite.
    """
    speeds = checked_speed(speed)
    size = _orbit_sizes(machine, speeds) if responses is None else _sizes(responses)
    is_peak = (size[:, 1:-1] > size[:, :-2]) & (size[:, 1:-1] >= size[:, 2:])
    body, place = np.nonzero(is_peak)
    if not len(body):
        none = ResponsePeaks(speed=np.empty(0), amplitude=np.empty(0))
        return none, none
    tops = _tops(machine, speeds[place], speeds[place + 2], body)
    sizes = _orbit_sizes(machine, tops)
    disk, journal = (
        ResponsePeaks(speed=tops[body == i], amplitude=sizes[i, body == i]) for i in (0, 1)
    )
    return disk, journal


def _orbit_sizes(machine: Machine, speed: ArrayLike) -> Array:
    """Return the semi-major axes of the disk's orbit and the journal's, shape (2, ...)."""
    K, C = stiffness_and_damping(machine, speed)
    return _sizes(synchronous_response(machine.rotor, K, C, speed))


def _sizes(responses: tuple[ComplexArray, ComplexArray]) -> Array:
    orbits = np.stack(responses)
    return orbit_ellipse(orbits[..., 0], orbits[..., 1]).semi_major


def _tops(machine: Machine, low: Array, high: Array, body: IntArray) -> Array:
    """Return the speeds of the peaks between two speeds each, all at once.

    `body` is 0 for a peak of the disk, 1 for one of the journal. A zoom goes into the two intervals
    beside the largest value; a parabola does the rest, for more zooms would lose the flat top in
    rounding errors.
    """
    columns = np.arange(len(low))
    before = largest = after = np.zeros(len(low))
    for _ in range(_ZOOMS):
        grid = np.linspace(low, high, _ZOOM_POINTS)
        size = _orbit_sizes(machine, grid)[body, :, columns].T
        top = size[1:-1].argmax(axis=0) + 1
        low, high = grid[top - 1, columns], grid[top + 1, columns]
        before, largest, after = (size[top + step, columns] for step in (-1, 0, 1))
    bend = before - 2.0 * largest + after
    shift = (before - after) / np.where(bend < 0.0, bend, -np.inf) / 2.0
    return (low + high) / 2.0 + shift * (high - low) / 2.0
