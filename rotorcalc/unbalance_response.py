"""Steady response to imbalance, and its orbits.

Model: linear film coefficients; the disk's mass centre lies a distance u off the shaft's axis and
turns forward, (cos Ωt, sin Ωt); the source's (sin, cos) turns backward. A phasor P stands for
Re{P e^{jΩt}}, amplitude from zero to peak, about static equilibrium.

Source: San Andrés, Notes 5, Eq. 5.38, and the calculation sheet's synchronous response of the
flexible rotor, with midspan damping and journal mass added.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, ComplexArray, IntArray, complex_array
from rotorcalc.coefficients import checked_speed
from rotorcalc.display import Result
from rotorcalc.machine import Rotor

# The imbalance (cos Ωt, sin Ωt) as phasors: Re{−j e^{jΩt}} = sin Ωt.
_FORWARD = np.array([1.0, -1.0j])


@dataclass(frozen=True, eq=False)
class OrbitEllipse(Result):
    """The ellipse traced by two phasors, each field of shape (...), lengths in the phasors' unit.

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
class Rotors(Result):
    """Several rotors as one: their fields of the same names in `Rotor`, each of shape (...)."""

    shaft_stiffness: Array
    disk_mass: Array
    disk_damping: Array
    journal_mass: Array
    imbalance: Array

    @classmethod
    def of(cls, rotors: Sequence[Rotor]) -> "Rotors":
        """Return m rotors, fields of shape (m, 1), to broadcast over speeds."""
        return cls(**{
            name: np.array([[getattr(rotor, name)] for rotor in rotors])
            for name in cls.__dataclass_fields__
        })  # fmt: skip

    def at(self, places: IntArray) -> "Rotors":
        """Return the rotors of some indices, fields of shape (p,)."""
        return Rotors(**{name: values[places, 0] for name, values in vars(self).items()})


@checked
def synchronous_response(
    rotor: Rotor | Rotors, K: Array, C: Array, speed: ArrayLike
) -> tuple[ComplexArray, ComplexArray]:
    """Return the response of disk and journal to the rotor's imbalance.

    Parameters
    ----------
    rotor : Rotor or Rotors
        The rotor, or some, whose fields broadcast with the speed.
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
    speed = checked_speed(speed)
    s = 1.0 / rotor.shaft_stiffness  # 0 for the rigid shaft
    z = speed * (1j * rotor.disk_damping - speed * rotor.disk_mass)
    bent, inertia = 1.0 + s * z, speed**2 * rotor.journal_mass

    def film(i: int, j: int) -> ComplexArray:
        return K[..., i, j] + 1j * speed * C[..., i, j]

    Z_xx, Z_xy, Z_yx, Z_yy = film(0, 0) - inertia, film(0, 1), film(1, 0), film(1, 1) - inertia
    # W = Z + z I + s z Z. Its inverse is written out: for 240 speeds LAPACK takes 47 µs, this 4 µs.
    W_xx, W_xy, W_yx, W_yy = Z_xx * bent + z, Z_xy * bent, Z_yx * bent, Z_yy * bent + z
    force = rotor.disk_mass * rotor.imbalance * speed**2
    unit = force / (W_xx * W_yy - W_xy * W_yx)  # times adj W (1, −j)
    x, y = unit * (W_yy + 1j * W_xy), -unit * (W_yx + 1j * W_xx)
    # d = (I + s Z) j: the shaft carries the film's force and the journal's inertia.
    disk, journal = np.empty((2, *x.shape, 2), dtype=complex)
    journal[..., 0], journal[..., 1] = x, y
    disk[..., 0] = x + s * (Z_xx * x + Z_xy * y)
    disk[..., 1] = y + s * (Z_yx * x + Z_yy * y)
    return disk, journal


def orbit_ellipse(x: ArrayLike, y: ArrayLike | None = None) -> OrbitEllipse:
    """Return the ellipse traced by the phasors of X and Y.

    Parameters
    ----------
    x, y : array_like, (...)
        Complex phasors of X and Y, in any one unit; or both as one array of shape (..., 2), as a
        sweep's `disk_response` has them.

    Returns
    -------
    OrbitEllipse
        Axes, inclination, and the forward and backward circles whose sum it is. Its fields
        have the shape (...).

    Examples
    --------
    >>> orbit = orbit_ellipse(2.0, -1.0j)
    >>> float(orbit.semi_major), float(orbit.semi_minor)
    (2.0, 1.0)
    >>> orbit_ellipse([[2.0, -1.0j], [1.0, 1.0j]]).semi_minor
    array([ 1., -1.])
    """
    if y is None:
        both = complex_array("x", x, ends=(2,))
        x, y = both[..., 0], both[..., 1]
    x, y = np.broadcast_arrays(complex_array("x", x), complex_array("y", y))
    # x + jy = f e^{jΩt} + b e^{−jΩt}: two circles, whose radii add along the major axis.
    forward: ComplexArray = (x + 1j * y) / 2.0
    backward: ComplexArray = (x - 1j * y).conj() / 2.0
    return OrbitEllipse(
        semi_major=np.abs(forward) + np.abs(backward),
        semi_minor=np.abs(forward) - np.abs(backward),
        inclination=(np.angle(forward) + np.angle(backward)) / 2.0,
        forward=forward,
        backward=backward,
    )


@checked
def orbit_points(x: ArrayLike, y: ArrayLike, *, points: int = 73) -> Array:
    """Return the orbit of the phasors of X and Y, point by point over one turn.

    Parameters
    ----------
    x, y : array_like, (...)
        Complex phasors of X and Y, in any one unit.
    points : int
        Number of points; the last equals the first.

    Returns
    -------
    array, (..., points, 2)
        Re{X e^{jΩt}}, Re{Y e^{jΩt}} from Ωt = 0 to 2π, in the phasors' unit.

    Examples
    --------
    >>> orbit_points(2.0, -1.0j, points=5).round(12) + 0.0
    array([[ 2.,  0.], [ 0.,  1.], [-2.,  0.], [ 0., -1.], [ 2.,  0.]])
    """
    both = np.broadcast_arrays(complex_array("x", x), complex_array("y", y))
    phasors = np.stack(both, axis=-1)
    turn = np.exp(1j * np.linspace(0.0, 2.0 * np.pi, points))
    return np.real(phasors[..., None, :] * turn[:, None])


def phase_lag(response: ArrayLike) -> Array:
    """Return the phase lag of a response behind the imbalance, unwrapped over the sweep.

    Parameters
    ----------
    response : array_like, (n, 2)
        Phasors of X and Y at n neighbouring speeds.

    Returns
    -------
    array, (n, 2)
        Lag of X behind cos Ωt and of Y behind sin Ωt [rad]; at the first speed within ±π.
    """
    # Y is compared with sin Ωt, so X and Y of a forward circle lag alike. Past 180° the lag goes on
    # instead of jumping to −180°: neighbouring speeds differ by less than half a turn.
    return np.unwrap(-np.angle(complex_array("response", response, ends=(2,)) / _FORWARD), axis=0)


@checked
def orbit_sizes(disk: ComplexArray, journal: ComplexArray) -> Array:
    """Return the semi-major axes of the disk's orbit and the journal's, (2, ...), of (..., 2)."""
    # |f| + |b| as in `orbit_ellipse`, without its other fields; |b| = |X − jY|/2.
    x, jy = (np.stack([disk[..., i], journal[..., i]]) * unit for i, unit in ((0, 0.5), (1, 0.5j)))
    return np.abs(x + jy) + np.abs(x - jy)
