"""The film's static equilibrium, pressure and force coefficients of a machine, with dimensions.

Scales the film model's dimensionless results by this machine's oil, bearing, load and speed.
Coefficients are K_ij = −∂F_i/∂X_j and C_ij = −∂F_i/∂Ẋ_j in X, Y (Eq. 5.14), per bearing.
Source: San Andrés, Notes 5, Eqs. 5.5, 5.8, 5.30 and 5.31.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc import heat
from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, BoolArray, real_array, shown
from rotorcalc.arrays import checked_speed as checked_speed  # noqa: PLC0414 - its known place
from rotorcalc.display import Result
from rotorcalc.films import (
    FilmDynamics,
    FilmState,
    FilmUnits,
    OperatingPoints,
    film_of,
    film_state,
    reduced,
)
from rotorcalc.films.dynamics import Impedance
from rotorcalc.machine import Machine, oil_of

# Factors α_m of the film's inertia: 6/5 for a parabolic velocity profile, 1 for a flat one.
LAMINAR, BULK_FLOW = 6.0 / 5.0, 1.0


@dataclass(frozen=True, eq=False)
class Equilibrium(Result):
    """A bearing in static equilibrium, with dimensions.

    Attributes
    ----------
    speed : array, (...)
        Running speed, Ω [rad/s].
    film : FilmState
        The film, dimensionless.
    stiffness : array, (..., 2, 2)
        K_ij in X, Y [N/m].
    damping : array, (..., 2, 2)
        C_ij in X, Y [N·s/m].
    minimum_film_thickness : array, (...)
        [m].
    side_flow : array, (...)
        Oil that leaves at both ends together [m³/s].
    drag_torque : array, (...)
        Torque of the film on the journal [N·m].
    power_loss : array, (...)
        Drag torque times speed [W].
    friction_coefficient : array, (...)
        Drag torque over radius and load, f = T/(R F_o) [-]; infinite without load.
    peak_pressure : array, (...)
        Highest pressure of the film above ambient [Pa].
    """

    speed: Array
    film: FilmState
    stiffness: Array
    damping: Array
    minimum_film_thickness: Array
    side_flow: Array
    drag_torque: Array
    power_loss: Array
    friction_coefficient: Array
    peak_pressure: Array


@dataclass(frozen=True, eq=False)
class PressureField(Result):
    """Thickness and pressure of a film over the unwrapped bearing, with dimensions.

    Attributes
    ----------
    speed : array, scalar
        Running speed, Ω [rad/s].
    theta : array, (m,)
        Angle θ in the sense of rotation from the place opposite to the line of centres, where a
        circular bearing's film is thickest [rad].
    axial_position : array, (n,)
        z from the bearing's middle [m].
    thickness : array, (m,)
        Film thickness in the middle plane, h [m].
    pressure : array, (m, n)
        Pressure above ambient, p [Pa].
    cavitated : boolean array, (m,)
        Whether the film is cavitated there, in the middle plane.
    load_theta : array, scalar
        θ at which the load points [rad].
    peak_theta : array, scalar
        θ of the highest pressure [rad].
    """

    speed: Array
    theta: Array
    axial_position: Array
    thickness: Array
    pressure: Array
    cavitated: BoolArray
    load_theta: Array
    peak_theta: Array


@dataclass(frozen=True, eq=False)
class FilmForces(Result):
    """Static forces of a film on the journal, with dimensions.

    Attributes
    ----------
    eccentricity_ratio : array, (...)
        ε [-].
    radial, tangential : array, (...)
        F_r and F_t [N] (Eq. 5.5); F_r < 0 pushes the journal back to the centre.
    total : array, (...)
        Their resultant: the load that this film carries [N] (Eq. 5.6).
    """

    eccentricity_ratio: Array
    radial: Array
    tangential: Array
    total: Array


@dataclass(frozen=True, eq=False)
class AddedMass(Result):
    """The film's added mass, and its size relative to rotor and damping.

    Attributes
    ----------
    speed : array, (...)
        Running speed, Ω [rad/s].
    mass : array, (..., 2, 2)
        M_ij in X, Y [kg], per bearing (Eq. 5.14).
    to_rotor : array, (...)
        Mean of M_XX and M_YY over half the rotor's mass, M [-].
    to_damping : array, (...)
        Force of the film's inertia over that of its damping in a circular orbit at running speed,
        Ω(M_XX + M_YY)/(C_XX + C_YY) [-].
    """

    speed: Array
    mass: Array
    to_rotor: Array
    to_damping: Array


@dataclass(frozen=True, eq=False)
class Unloading(Result):
    """A film's coefficients as its load is removed, at constant speed and viscosity.

    Attributes
    ----------
    eccentricity_ratio : array, (...)
        ε [-].
    stiffness : array, (..., 2, 2)
        K_ij in X, Y [N/m].
    whirl_damping : array, (..., 2, 2)
        (Ω/2)·C_ij in X, Y [N/m]: the force of damping on a whirl at half running speed.
    """

    eccentricity_ratio: Array
    stiffness: Array
    whirl_damping: Array


@dataclass(frozen=True, eq=False)
class OverWhirlRatio(Result):
    """A film's stiffness and damping for a journal that whirls at other frequencies than Ω.

    Attributes
    ----------
    speed : array, ()
        Running speed, Ω [rad/s].
    whirl_ratio : array, (n,)
        Frequency of the whirl over running speed, ν = ω/Ω [-].
    stiffness : array, (n, 2, 2)
        Re Z(ν) in X, Y [N/m].
    damping : array, (n, 2, 2)
        Im Z(ν)/(νΩ) in X, Y [N·s/m].
    """

    speed: Array
    whirl_ratio: Array
    stiffness: Array
    damping: Array


@checked
def equilibrium(machine: Machine, speed: ArrayLike) -> Equilibrium:
    """Return the static equilibrium of a machine's bearing and its force coefficients.

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : array_like, (...)
        Running speed, Ω [rad/s], positive.

    Returns
    -------
    Equilibrium
        Its fields have the leading shape (...).

    Raises
    ------
    ValueError
        Where a speed is not positive and finite, or the film has no temperature there
        (`heat.film_temperature`).
    """
    speed = checked_speed(speed)
    bearing, points = machine.bearing, _points(machine, speed)
    units = FilmUnits(bearing, points.viscosity, speed)
    film = film_of(bearing).state(points)
    drag_torque = film.drag * units.torque
    with np.errstate(divide="ignore"):  # f = ∞ without load
        friction = drag_torque / (bearing.radius * np.float64(machine.static_load))
    return Equilibrium(
        speed=speed,
        film=film,
        # Eqs. 5.30 and 5.31, turned to X, Y (Eq. 5.16); σ has given the equilibrium (Eq. 5.8).
        stiffness=_matrices(film.stiffness, units.stiffness),
        damping=_matrices(film.damping, units.damping),
        minimum_film_thickness=film.minimum_thickness * bearing.radial_clearance,
        side_flow=film.side_flow * units.flow,
        drag_torque=drag_torque,
        # The whole dissipation of the film, as the second term of the drag is the axial flow's.
        power_loss=drag_torque * speed,
        friction_coefficient=friction,
        peak_pressure=film.peak_pressure * units.pressure,
    )


@checked
def operating_points(machine: Machine, speed: ArrayLike) -> OperatingPoints:
    """Return the operating points of a machine's film.

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : array_like, (...)
        Running speed, Ω [rad/s], positive.

    Returns
    -------
    OperatingPoints
        Its fields broadcast to the shape (...).

    Raises
    ------
    ValueError
        Where a speed is not positive and finite.
    """
    return _points(machine, checked_speed(speed))


@checked
def dynamics(machine: Machine, speed: ArrayLike) -> FilmDynamics:
    """Return the film's linear forces in static equilibrium, inner coordinates included.

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : array_like, (...)
        Running speed, Ω [rad/s], positive.

    Returns
    -------
    FilmDynamics
        Stiffness [N/m] and damping [N·s/m], (..., 2+n, 2+n), and inertia [kg], (n,).

    Raises
    ------
    ValueError
        Where a speed is not positive and finite.
    """
    return _dynamics(machine, checked_speed(speed))


@checked
def stiffness_and_damping(
    machine: Machine, speed: ArrayLike, *, whirl_ratio: ArrayLike = 1.0
) -> tuple[Array, Array]:
    """Return the force coefficients of a machine's film in static equilibrium.

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : array_like, (...)
        Running speed, Ω [rad/s], positive.
    whirl_ratio : array_like, (...)
        Frequency of the whirl over the running speed, ν [-], positive; broadcast with the speed. A
        film's own moving parts follow the journal in that whirl. Other films do not depend on it.

    Returns
    -------
    K, C : array, (..., 2, 2)
        Stiffness [N/m] and damping [N·s/m] in X, Y; by default in synchronous motion: those of
        `equilibrium`, in half the time.

    Raises
    ------
    ValueError
        Where a speed or a whirl ratio is not positive and finite.
    """
    omega = checked_speed(speed)
    if type(whirl_ratio) is float and whirl_ratio == 1.0:
        # Imbalance shakes the film at running speed, ν = 1: inner coordinates are eliminated at ω.
        return reduced(_dynamics(machine, omega), omega)
    ratio = real_array("whirl_ratio", whirl_ratio)
    if not np.all((ratio > 0.0) & np.isfinite(ratio)):
        raise ValueError(f"whirl_ratio = {shown(whirl_ratio)}: must be positive and finite")
    omega, ratio = np.broadcast_arrays(omega, ratio)
    return reduced(_dynamics(machine, omega), ratio * omega)


@checked
def over_whirl_ratio(machine: Machine, speed: float, *, whirl_ratio: ArrayLike) -> OverWhirlRatio:
    """Return the film's stiffness and damping over the frequency of the journal's whirl.

    They are the same at any frequency where the film has no parts that move and does not yield;
    those of `stiffness_and_damping` belong to the whirl ratio 1.

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : float
        Running speed, Ω [rad/s], positive.
    whirl_ratio : array_like, (n,)
        ν = ω/Ω [-], positive.

    Returns
    -------
    OverWhirlRatio
        In static equilibrium at that speed.

    Raises
    ------
    ValueError
        Where the speed or a whirl ratio is not positive and finite.
    """
    ratio = np.atleast_1d(real_array("whirl_ratio", whirl_ratio))
    K, C = stiffness_and_damping(machine, speed, whirl_ratio=ratio)
    return OverWhirlRatio(checked_speed(speed), ratio, K, C)


@checked
def film_field(
    machine: Machine, speed: float, *, theta: ArrayLike, zeta: ArrayLike = (0.0,)
) -> PressureField:
    """Return thickness and pressure of the film over the unwrapped bearing in static equilibrium.

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : float
        Running speed, Ω [rad/s], positive.
    theta : array_like, (m,)
        Angle θ in the sense of rotation from the place opposite to the line of centres [rad].
    zeta : array_like, (n,)
        Axial position from the bearing's middle, ζ = z/L [-], −1/2 ≤ ζ ≤ 1/2.

    Returns
    -------
    PressureField
        Pressure over the grid of θ and ζ, thickness over θ.

    Raises
    ------
    ValueError
        Where the speed is not positive and finite or ζ lies outside the bearing.
    """
    bearing, points = machine.bearing, operating_points(machine, speed)
    model = film_of(bearing)
    film = model.state(points)
    theta, zeta = np.atleast_1d(real_array("theta", theta)), np.atleast_1d(real_array("zeta", zeta))
    # θ counts from the thickest film, Θ = φ + π; the film model takes angles Θ from X.
    opposite = film.attitude_angle + np.pi
    angle = opposite + theta
    # The thickness does not vary along an aligned bearing: the middle plane gives it.
    middle = model.field(points, angle=angle, zeta=0.0)
    field = model.field(points, angle=angle[:, None], zeta=zeta)
    return PressureField(
        speed=points.speed,
        theta=theta,
        axial_position=zeta * bearing.length,
        thickness=middle.thickness * bearing.radial_clearance,
        pressure=field.pressure * FilmUnits(bearing, points.viscosity, points.speed).pressure,
        cavitated=middle.cavitated,
        # The load points along X, Θ = 0.
        load_theta=np.mod(-opposite, 2.0 * np.pi),
        peak_theta=np.mod(film.peak_angle - opposite, 2.0 * np.pi),
    )


@checked
def middle_pressure(machine: Machine, speed: ArrayLike, *, angle: ArrayLike) -> Array:
    """Return the pressure around the bearing's middle in static equilibrium, at several speeds.

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : array_like, (k,)
        Running speeds, Ω [rad/s], positive.
    angle : array_like, (m,)
        Angles Θ from X in the sense of rotation [rad].

    Returns
    -------
    array, (k, m)
        Pressure above ambient [Pa]; NaN where the film's model gives none.

    Raises
    ------
    ValueError
        Where a speed is not positive and finite.
    """
    omega = np.atleast_1d(real_array("speed", speed))[:, None]
    points = operating_points(machine, omega)
    field = film_of(machine.bearing).field(points, angle=real_array("angle", angle), zeta=0.0)
    unit = FilmUnits(machine.bearing, points.viscosity, points.speed).pressure
    return field.pressure * unit


@checked
def film_forces(machine: Machine, speed: ArrayLike, *, sommerfeld: ArrayLike) -> FilmForces:
    """Return the static forces of a machine's film at any equilibrium position (Eq. 5.5).

    Parameters
    ----------
    machine : Machine
        The machine; its load does not enter.
    speed : array_like, (...)
        Running speed, Ω [rad/s], positive.
    sommerfeld : array_like, (...)
        Modified Sommerfeld number of the positions, σ [-], positive; infinite in the centre.

    Returns
    -------
    FilmForces
        Its fields have the leading shape (...).

    Raises
    ------
    ValueError
        Where a speed is not positive and finite or σ is not positive.
    """
    omega = checked_speed(speed)
    mu = heat.viscosity(machine, omega)
    film = film_state(machine.bearing, sommerfeld, viscosity=mu, speed=omega)
    unit = FilmUnits(machine.bearing, mu, omega).force
    # Eq. 5.5; the unit has one value for each speed, the force two components.
    F = film.force * np.asarray(unit)[..., None]
    return FilmForces(
        eccentricity_ratio=film.eccentricity_ratio,
        radial=F[..., 0],
        tangential=F[..., 1],
        total=np.hypot(F[..., 0], F[..., 1]),
    )


@checked
def added_mass(machine: Machine, speed: ArrayLike, *, factor: float = LAMINAR) -> AddedMass:
    """Return the film's added mass in static equilibrium, M_ij = α_m ρRL³/(12C)·I_ij.

    Temporal inertia only, of the half film under pressure. The rest of the program neglects it,
    as the notes do.

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : array_like, (...)
        Running speed, Ω [rad/s], positive.
    factor : float
        α_m [-] of the velocity profile across the film: 6/5 in laminar flow, 1 in bulk flow.

    Returns
    -------
    AddedMass
        Its fields have the leading shape (...).

    Raises
    ------
    ValueError
        Where a speed is not positive and finite.
    """
    state = equilibrium(machine, speed)
    bearing = machine.bearing
    inertia = film_of(bearing).added_mass(operating_points(machine, speed))
    # α_m ρRL³/(12C), independent of viscosity and speed.
    M = factor * FilmUnits(bearing, 1.0, 1.0).added_mass(oil_of(machine).density) * inertia
    return AddedMass(
        speed=state.speed,
        mass=M,
        # Traces do not depend on the frame, so means of the direct terms stand for M and C.
        to_rotor=_trace(M) / 2.0 / machine.rotor.half_mass,
        to_damping=state.speed * _trace(M) / _trace(state.damping),
    )


@checked
def unloading(machine: Machine, speed: float, *, sommerfeld: ArrayLike) -> Unloading:
    """Return how the film's coefficients change as the load is removed (Eqs. 5.36 and 5.37).

    Parameters
    ----------
    machine : Machine
        The machine; its load does not enter.
    speed : float
        Running speed, Ω [rad/s], positive.
    sommerfeld : array_like, (...)
        Modified Sommerfeld number of the positions, σ [-], positive; infinite in the centre, where
        the direct stiffness vanishes and K_XY = −K_YX = (Ω/2)·C_XX.

    Returns
    -------
    Unloading
        Its fields have the leading shape (...).

    Raises
    ------
    ValueError
        Where the speed is not positive and finite or σ is not positive.
    """
    omega = float(checked_speed(speed))
    mu = heat.viscosity(machine, omega)
    film = film_state(machine.bearing, sommerfeld, viscosity=mu, speed=omega)
    units = FilmUnits(machine.bearing, mu, omega)
    return Unloading(
        eccentricity_ratio=film.eccentricity_ratio,
        stiffness=film.stiffness * units.stiffness,
        # (Ω/2)·C: the unit of damping times Ω is the unit of stiffness.
        whirl_damping=film.damping * units.stiffness / 2.0,
    )


@checked
def modified_sommerfeld(machine: Machine, speed: ArrayLike) -> Array:
    """Return the modified Sommerfeld number, σ = μΩLR/(4F_o)·(L/C)² (Eq. 5.8).

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : array_like, (...)
        Running speed, Ω [rad/s], positive.

    Returns
    -------
    array, (...)
        σ [-]; infinite without load.

    Raises
    ------
    ValueError
        Where a speed is not positive and finite.
    """
    return operating_points(machine, speed).sommerfeld


def rising_speed(speed: ArrayLike, *, name: str = "speed") -> Array:
    """Return speeds [rad/s], (n,), or raise ValueError where they do not rise."""
    speeds = checked_speed(speed)
    # Two at least: callers take spacings and ranges between neighbours.
    if speeds.ndim != 1 or len(speeds) < 2:
        raise ValueError(f"{name}: must be two or more rising speeds, (n,), has {speeds.shape}")
    falls = np.flatnonzero(np.diff(speeds) <= 0.0)
    if falls.size:
        i = int(falls[0])
        raise ValueError(
            f"{name}[{i + 1}] = {speeds[i + 1]:g} rad/s: must be greater than the speed before it, "
            f"{speeds[i]:g} rad/s"
        )
    return speeds


def _points(machine: Machine, speed: Array) -> OperatingPoints:
    """Return the operating points of a machine's film at checked speeds."""
    # Asked again only where it depends on speed: a given one is the machine's own.
    mu = machine.viscosity if machine.supply is None else heat.viscosity(machine, speed)
    return OperatingPoints.of(machine.bearing, viscosity=mu, speed=speed, load=machine.static_load)


def _dynamics(machine: Machine, speed: Array) -> FilmDynamics:
    """Return the film's linear forces at checked speeds."""
    points = _points(machine, speed)
    units = FilmUnits(machine.bearing, points.viscosity, speed)
    found = film_of(machine.bearing).dynamics(points)
    return FilmDynamics(
        stiffness=_matrices(found.stiffness, units.stiffness),
        damping=_matrices(found.damping, units.damping),
        inertia=found.inertia,
        at=None if found.at is None else _with_dimensions(found.at, units, speed),
    )


def _with_dimensions(impedance: Impedance, units: FilmUnits, speed: Array) -> Impedance:
    """Return a film's impedance over frequency [rad/s], in N/m and N·s/m."""

    def at(frequency: Array) -> tuple[Array, Array]:
        K, C = impedance(frequency / speed)
        return _matrices(K, units.stiffness), _matrices(C, units.damping)

    return at


def _matrices(coefficients: Array, unit: Array | float) -> Array:
    """Return matrices (..., m, m) times their unit, (...)."""
    return coefficients * np.asarray(unit)[..., None, None]


def _trace(coefficients: Array) -> Array:
    return coefficients[..., 0, 0] + coefficients[..., 1, 1]
