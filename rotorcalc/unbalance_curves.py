"""The steady response over speed: curves, orbits, and the responses of modified rotors.

Prepares the steady response for charts: amplitude, phase and ellipse of disk and journal, orbits
point by point, the journal's orbit in its clearance, and the responses of rotors that differ in
midspan damping or journal mass (the extensions that the calculation sheet leaves to the reader).

Source: San Andrés, Notes 5, Eq. 5.38, and the calculation sheet. Axes and signs as in
`unbalance_response`.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.analysis import Sweep
from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, BoolArray, ComplexArray
from rotorcalc.coefficients import rising_speed, stiffness_and_damping
from rotorcalc.display import Result
from rotorcalc.films import film_of
from rotorcalc.machine import Machine, Rotor
from rotorcalc.onset import Onset, judge
from rotorcalc.unbalance_peaks import ResponsePeaks, disk_peak_speeds
from rotorcalc.unbalance_response import (
    OrbitEllipse,
    Rotors,
    orbit_ellipse,
    orbit_points,
    orbit_sizes,
    phase_lag,
    synchronous_response,
)
from rotorcalc.variation import damping_reference

# A point every 5°: the chords of a circle then lie within 0.1 % of its radius.
_ORBIT_POINTS = 73
# Points around a peak, in spacings of the sweep, halving towards it: a lightly damped peak is
# narrower than one spacing.
_NEAR = np.concatenate([-(0.5 ** np.arange(1, 10)), [0.0], 0.5 ** np.arange(9, 0, -1)])
# Variants of midspan damping and of journal mass, as shares of critical damping and of half mass.
_DAMPING = (0.0, 0.05, 0.1, 0.2, 0.5)
_JOURNAL_MASS = (0.0, 0.05, 0.1, 0.2, 0.4)


@dataclass(frozen=True, eq=False)
class BodyResponse(Result):
    """The steady response of a disk or a journal.

    Attributes
    ----------
    amplitude : array, (..., 2)
        Of X and Y, zero to peak [m].
    lag : array, (..., 2)
        Lag of X behind cos Ωt and of Y behind sin Ωt [rad].
    ellipse : OrbitEllipse
        The orbit's axes [m], each of shape (...).
    """

    amplitude: Array
    lag: Array
    ellipse: OrbitEllipse


@dataclass(frozen=True, eq=False)
class ResponseCurves(Result):
    """The steady response of a machine over speed, and at its running speed.

    Attributes
    ----------
    speed : array, (n,)
        Ω [rad/s], denser around the peaks than the sweep.
    disk, journal : BodyResponse
        Over speed; the lag is unwrapped.
    disk_peaks, journal_peaks : ResponsePeaks
        Where the orbits are largest.
    unstable : array, (m, 2)
        First and last speed of the ranges where the machine is unstable [rad/s]: no response is
        steady there.
    running_speed : array, scalar
        Running speed, Ω [rad/s].
    disk_here, journal_here : BodyResponse
        At the running speed; the lag continues the curve's unwrapped one.
    is_rigid : bool
        Whether disk and journal are one.
    """

    speed: Array
    disk: BodyResponse
    journal: BodyResponse
    disk_peaks: ResponsePeaks
    journal_peaks: ResponsePeaks
    unstable: Array
    running_speed: Array
    disk_here: BodyResponse
    journal_here: BodyResponse
    is_rigid: bool


@dataclass(frozen=True, eq=False)
class Orbits(Result):
    """Orbits of disk and journal about their static equilibrium, point by point.

    Attributes
    ----------
    speed : array, (...)
        Ω [rad/s].
    disk, journal : array, (..., p, 2)
        Points in X, Y over one turn, from the instant when the imbalance points along X [m].
    centre : array, (..., 2)
        Static equilibrium of the journal's centre, from the bearing's [m].
    disk_forward, journal_forward : boolean array, (...)
        Whether the orbit turns with the shaft.
    is_rigid : bool
        Whether disk and journal are one.
    """

    speed: Array
    disk: Array
    journal: Array
    centre: Array
    disk_forward: BoolArray
    journal_forward: BoolArray
    is_rigid: bool


@dataclass(frozen=True, eq=False)
class ClearanceOrbit(Result):
    """The journal's orbit about its static equilibrium, within the clearance.

    Attributes
    ----------
    clearance : float
        Radial clearance, C [m].
    wall : array, (p, 2)
        Positions of the journal's centre at contact, all the way round, in X, Y [m].
    centre : array, (2,)
        Static equilibrium of the journal's centre [m].
    path : array, (p, 2)
        The orbit from the bearing's centre [m].
    closest : float
        Smallest film thickness on the orbit over the clearance [-]; negative where the linear
        theory predicts an orbit through the wall.
    """

    clearance: float
    wall: Array
    centre: Array
    path: Array
    closest: float


@dataclass(frozen=True, eq=False)
class ResponseFamily(Result):
    """The orbits' size over speed for several rotors in one machine's bearings.

    Attributes
    ----------
    rotors : tuple of Rotor
        The m rotors.
    speed : array, (n,)
        Ω [rad/s]: those given, and more around the peaks of each rotor.
    disk, journal : array, (m, n)
        Semi-major axes [m].
    unstable : boolean array, (m, n)
        Where the machine is unstable with that rotor.
    """

    rotors: tuple[Rotor, ...]
    speed: Array
    disk: Array
    journal: Array
    unstable: BoolArray


@checked
def response_curves(
    sweep: Sweep,
    point: Sweep,
    *,
    disk_peaks: ResponsePeaks,
    journal_peaks: ResponsePeaks,
    onset: Onset | None = None,
) -> ResponseCurves:
    """Return a machine's steady response over speed and at the running speed.

    Parameters
    ----------
    sweep : Sweep
        The machine over rising speeds, (n,).
    point : Sweep
        The same machine at the running speed, scalar.
    disk_peaks, journal_peaks : ResponsePeaks
        Peaks within the sweep.
    onset : Onset, optional
        The machine's onset, where it is known.

    Returns
    -------
    ResponseCurves
        Curves and point.
    """
    machine = sweep.machine
    near = _near(sweep.speed, np.concatenate([disk_peaks.speed, journal_peaks.speed]))
    # Only the added speeds are computed; the sweep's own responses are known.
    there = synchronous_response(machine.rotor, *stiffness_and_damping(machine, near), near)
    # Sorted, and a speed that is in both lists once.
    speed, order = np.unique(np.concatenate([sweep.speed, near]), return_index=True)
    known = sweep.disk_response, sweep.journal_response
    disk, journal = (_body(np.concatenate(pair)[order]) for pair in zip(known, there, strict=True))
    return ResponseCurves(
        speed=speed,
        disk=disk,
        journal=journal,
        disk_peaks=disk_peaks,
        journal_peaks=journal_peaks,
        unstable=judge.unstable_ranges(machine, sweep.speed, onset=onset),
        running_speed=point.speed,
        disk_here=_body_on(disk, speed, point.disk_response, point.speed),
        journal_here=_body_on(journal, speed, point.journal_response, point.speed),
        is_rigid=machine.rotor.is_rigid,
    )


@checked
def unstable_ranges(sweep: Sweep | Machine, speed: ArrayLike | None = None) -> Array:
    """Return the ranges of speed within a sweep where some mode grows.

    Parameters
    ----------
    sweep : Sweep or Machine
        A machine over rising speeds, (n,); or a machine, with its speeds.
    speed : array_like, (n,), or None
        Rising speeds of a machine, Ω [rad/s]; None with a sweep, which has its own.

    Returns
    -------
    array, (m, 2)
        First and last speed of each range [rad/s], to the digits of `onset_speed`.

    Raises
    ------
    ValueError
        Where the speeds are not in one row and rising, or a machine comes without them.
    """
    if isinstance(sweep, Sweep):
        if speed is not None:
            raise ValueError("speed: a sweep has its own; give it with a machine only")
        speeds = rising_speed(sweep.speed, name="sweep.speed")
        return judge.unstable_ranges(sweep.machine, speeds)
    if speed is None:
        raise ValueError("speed = None: a machine needs rising speeds in rad/s")
    return judge.unstable_ranges(sweep, rising_speed(speed))


@checked
def orbits(sweep: Sweep, *, points: int = _ORBIT_POINTS, every: int = 1) -> Orbits:
    """Return the orbits of disk and journal about their static equilibrium.

    Parameters
    ----------
    sweep : Sweep
        A machine over speed, or at one speed.
    points : int
        Points of each orbit; the last equals the first.
    every : int
        Stride through a sweep's speeds, counted so that the last is taken.

    Returns
    -------
    Orbits
        Its fields have the leading shape of the speeds taken.
    """
    taken = slice(every - 1, None, every) if sweep.speed.ndim else ...
    disk, journal = sweep.disk_response[taken], sweep.journal_response[taken]
    return Orbits(
        speed=sweep.speed[taken],
        disk=orbit_points(disk[..., 0], disk[..., 1], points=points),
        journal=orbit_points(journal[..., 0], journal[..., 1], points=points),
        centre=sweep.journal_position[taken],
        disk_forward=orbit_ellipse(disk).semi_minor > 0.0,
        journal_forward=orbit_ellipse(journal).semi_minor > 0.0,
        is_rigid=sweep.machine.rotor.is_rigid,
    )


@checked
def clearance_orbit(point: Sweep) -> ClearanceOrbit:
    """Return the journal's orbit about its static equilibrium inside its clearance.

    Parameters
    ----------
    point : Sweep
        A machine at one speed.

    Returns
    -------
    ClearanceOrbit
        Wall, equilibrium, path, and the smallest film thickness on the path.
    """
    film, C = film_of(point.machine.bearing), point.machine.bearing.radial_clearance
    journal = point.journal_response
    # Denser than a chart needs, as the thinnest film is read off at these points.
    path = point.journal_position + orbit_points(journal[0], journal[1], points=4 * _ORBIT_POINTS)
    return ClearanceOrbit(
        clearance=C,
        wall=C * film.outline(np.linspace(0.0, 2.0 * np.pi, 2 * _ORBIT_POINTS)),
        centre=point.journal_position,
        path=path,
        closest=float(film.gap(path / C).min()),
    )


@checked
def response_family(
    machine: Machine, speed: ArrayLike, *, rotors: Sequence[Rotor]
) -> ResponseFamily:
    """Return the responses of several rotors in one machine's bearings, under its static load.

    Parameters
    ----------
    machine : Machine
        The machine; its load, oil and bearing serve all rotors.
    speed : array_like, (n,)
        Rising speeds, Ω [rad/s].
    rotors : sequence of Rotor
        The m rotors.

    Returns
    -------
    ResponseFamily
        Semi-major axes of their orbits, and where they are unstable.

    Raises
    ------
    ValueError
        Where a speed is not positive and finite.
    """
    speeds, group = rising_speed(speed), Rotors.of(rotors)
    film = stiffness_and_damping(machine, speeds)
    sizes = orbit_sizes(*synchronous_response(group, *film, speeds))
    near = _near(speeds, disk_peak_speeds(machine, rotors, speeds, film, sizes[0]))
    film_there = stiffness_and_damping(machine, near)
    sizes_there = orbit_sizes(*synchronous_response(group, *film_there, near))
    denser, order = np.unique(np.concatenate([speeds, near]), return_index=True)
    disk, journal = np.concatenate([sizes, sizes_there], axis=-1)[..., order]
    K, C = (np.concatenate(pair)[order] for pair in zip(film, film_there, strict=True))
    # The load stays the machine's, so that all variants run at the same equilibrium.
    machines = [replace(machine, rotor=rotor, load=machine.static_load) for rotor in rotors]
    return ResponseFamily(
        rotors=tuple(rotors),
        speed=denser,
        disk=disk,
        journal=journal,
        unstable=np.array([judge.is_unstable(one, denser, film=(K, C)) for one in machines]),
    )


@checked
def damping_variants(machine: Machine) -> tuple[Rotor, ...]:
    """Return the rotor, then variants with midspan damping of 0 to ½ `damping_reference`."""
    rotor, unit = machine.rotor, damping_reference(machine)
    # Two digits, as these values are shown in the chart's legend.
    dampings = [float(f"{share * unit:.2g}") for share in _DAMPING]
    others = (replace(rotor, disk_damping=value) for value in dampings)
    return (rotor, *(other for other in others if other != rotor))


@checked
def journal_mass_variants(machine: Machine) -> tuple[Rotor, ...]:
    """Return the rotor, then variants with a journal mass of 0 to 40 % of half its mass."""
    rotor = machine.rotor
    masses = [float(f"{share * rotor.half_mass:.2g}") for share in _JOURNAL_MASS]
    others = (replace(rotor, journal_mass=value) for value in masses)
    return (rotor, *(other for other in others if other != rotor))


def _body(response: ComplexArray) -> BodyResponse:
    return BodyResponse(
        amplitude=np.abs(response), lag=phase_lag(response), ellipse=orbit_ellipse(response)
    )


def _body_on(
    curve: BodyResponse, speeds: Array, response: ComplexArray, speed: Array
) -> BodyResponse:
    """Return a response at one speed, its lag unwrapped to the same turn as the curve's."""
    lag = phase_lag(response[None, :])[0]
    near = np.array([float(np.interp(speed, speeds, curve.lag[:, i])) for i in range(2)])
    # The lag is known to whole turns: those that bring it nearest to the curve.
    lag = lag + 2.0 * np.pi * np.rint((near - lag) / (2.0 * np.pi))
    return BodyResponse(amplitude=np.abs(response), lag=lag, ellipse=orbit_ellipse(response))


def _near(speeds: Array, peaks: Array) -> Array:
    """Return speeds around each peak, denser than the given ones and within their range."""
    near = peaks[:, None] + (speeds[1] - speeds[0]) * _NEAR
    return near[(near > 0.0) & (near <= speeds[-1])]
