"""The whole calculation in one call: from load, oil, clearance and shaft to orbits.

Follows the calculation sheet of the notes, vectorised over running speed.
"""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Literal, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc import heat, modes
from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, ComplexArray
from rotorcalc.coefficients import Equilibrium, dynamics, equilibrium
from rotorcalc.display import Result
from rotorcalc.films import FilmDynamics, FilmState, film_of, film_state
from rotorcalc.films.dynamics import NO_INERTIA
from rotorcalc.frames import rotate
from rotorcalc.machine import Bearing, Machine
from rotorcalc.onset.eigenvalues import certain_eigenvalues, certain_mode_shapes
from rotorcalc.onset.whirl import WhirlOnset, flexible_threshold, whirl_onset
from rotorcalc.tables import columns, dataframe, eigenvalue_columns
from rotorcalc.unbalance_response import synchronous_response

if TYPE_CHECKING:
    import pandas as pd  # pyright: ignore[reportMissingTypeStubs]

# σ of a load so light that its effect on k_eq, whirl ratio and p_s² is below rounding (order ε²).
_LIGHTEST = 1e10

Axes: TypeAlias = Literal["XY", "rt"]


@dataclass(frozen=True, eq=False)
class Sweep(Result):
    """Everything that the calculation sheet computes, over running speed; n is the speeds' shape.

    Attributes
    ----------
    machine : Machine
        The machine.
    speed : array, (n,)
        Running speed, Ω [rad/s].
    temperature : array, (n,)
        Of the film, T [°C].
    outlet_temperature : array, (n,)
        Of the oil that leaves, T_out [°C]; NaN where the film's temperature is given.
    viscosity : array, (n,)
        Of the oil in the film, μ [Pa·s].
    sommerfeld : array, (n,)
        Modified Sommerfeld number, σ [-] (Eq. 5.8); infinite without load.
    journal_position : array, (n, 2)
        Journal centre in equilibrium in X, Y from the bearing's centre [m].
    eccentricity_ratio : array, (n,)
        ε [-].
    attitude_angle : array, (n,)
        φ [rad] (Eq. 5.7).
    minimum_film_thickness : array, (n,)
        [m].
    power_loss : array, (n,)
        Per bearing [W].
    side_flow : array, (n,)
        Per bearing, both ends [m³/s].
    drag_torque : array, (n,)
        Torque of the film on one journal [N·m].
    friction_coefficient : array, (n,)
        Drag torque over radius and load, f = T/(R F_o) [-]; infinite without load.
    peak_pressure : array, (n,)
        Highest pressure of the film above ambient [Pa] (Eq. 5.25).
    stiffness, damping : array, (n, 2, 2)
        K_ij [N/m] and C_ij [N·s/m] in X, Y, per bearing (Eqs. 5.30, 5.31).
    equivalent_stiffness : array, (n,)
        K_eq [N/m] (Eq. 5.45).
    whirl_ratio : array, (n,)
        ω̄ [-] (Eq. 5.46); 0 where the film cannot whirl.
    critical_mass : array, (n,)
        M_c [kg], per bearing: a heavier rotor is unstable at this speed; infinite where the
        film cannot whirl, NaN where it whirls and K_eq is negative: any mass is unstable then.
    rigid_threshold, flexible_threshold : array, (n,)
        Ω_s and Ω_sf [rad/s] (Eqs. 5.45 to 5.50) at this speed's equilibrium; the machine is
        unstable where its speed lies above. Without midspan damping and journal mass, and with the
        film's synchronous coefficients: the onset of a film that depends on the whirl's frequency
        is `onset_speed` alone.
    disk_response, journal_response : complex array, (n, 2)
        Phasors of X and Y due to imbalance [m].
    """

    machine: Machine
    speed: Array
    temperature: Array
    outlet_temperature: Array
    viscosity: Array
    sommerfeld: Array
    journal_position: Array
    eccentricity_ratio: Array
    attitude_angle: Array
    minimum_film_thickness: Array
    power_loss: Array
    side_flow: Array
    drag_torque: Array
    friction_coefficient: Array
    peak_pressure: Array
    stiffness: Array
    damping: Array
    equivalent_stiffness: Array
    whirl_ratio: Array
    critical_mass: Array
    rigid_threshold: Array
    flexible_threshold: Array
    disk_response: ComplexArray
    journal_response: ComplexArray

    @cached_property
    def dynamics(self) -> FilmDynamics:
        """The film that governs free motion [N/m], [N·s/m], [kg].

        It is `stiffness` and `damping` unless the film depends on the frequency of the whirl.
        """
        if film_of(self.machine.bearing).frequency_dependent:
            return dynamics(self.machine, self.speed)
        # Without inner coordinates K and C do not depend on frequency: the synchronous ones hold.
        return FilmDynamics(self.stiffness, self.damping, NO_INERTIA)

    @cached_property
    def rigid_eigenvalues(self) -> ComplexArray:
        """λ of the rigid rotor [1/s], (n, 4), and of inner coordinates; computed on first use.

        The signs of their real parts are certain: they agree with `unstable_ranges`.
        """
        return self._eigenvalues(flexible=False)

    @cached_property
    def flexible_eigenvalues(self) -> ComplexArray:
        """λ of the flexible rotor [1/s], (n, 6); 8 with journal mass; a rigid shaft's as above.

        The signs of their real parts are certain: they agree with `unstable_ranges`.
        """
        if self.machine.rotor.is_rigid:
            return self.rigid_eigenvalues
        return self._eigenvalues(flexible=True)

    def mode_shapes(self, *, flexible: bool = True) -> modes.ModeShapes:
        """Return the free motions at each speed, of a flexible or a rigid shaft."""
        return certain_mode_shapes(self.machine, self.speed, self.dynamics, flexible=flexible)

    def branches(self, *, flexible: bool = True) -> ComplexArray:
        """Return the eigenvalues, each mode followed over the sweep, of a flexible or rigid shaft.

        Parameters
        ----------
        flexible : bool
            Whether the shaft bends.

        Returns
        -------
        complex array, (n, m)
            λ [1/s], a column a mode, as `modes.follow_branches` orders them; where two could be
            confused from one speed to the next, by speeds in between.

        Raises
        ------
        ValueError
            Where the speeds are neither one nor a list, (n,).
        """
        if self.speed.ndim > 1:
            raise ValueError(f"speed: must have the shape (n,), has {self.speed.shape}")
        values = self.flexible_eigenvalues if flexible else self.rigid_eigenvalues

        def more(speed: Array) -> ComplexArray:
            film = dynamics(self.machine, speed)
            return certain_eigenvalues(self.machine, speed, film, flexible=flexible)

        rows = values.reshape(self.speed.size, values.shape[-1])
        return modes.follow_branches(rows, at=self.speed.reshape(-1), more=more)

    def _eigenvalues(self, *, flexible: bool) -> ComplexArray:
        return certain_eigenvalues(self.machine, self.speed, self.dynamics, flexible=flexible)

    def to_dataframe(self) -> "pd.DataFrame":
        """Return the sweep as a pandas table: one row per speed, one column per number.

        Returns
        -------
        pandas.DataFrame
            Columns "speed [rad/s]", "stiffness_XY [N/m]" and so on. Responses are given as
            amplitude [m], zero to peak, and phase lag [rad], of X behind cos Ωt and of Y behind
            sin Ωt, unwrapped over the sweep, as in a Bode plot. The flexible rotor's eigenvalues
            are given as real and imaginary parts, each mode followed over the sweep.

        Raises
        ------
        ValueError
            Where the speeds are neither one nor a list, (n,).
        ImportError
            Where pandas is not installed.
        """
        if self.speed.ndim > 1:
            raise ValueError(f"speed: must have the shape (n,) for a table, has {self.speed.shape}")
        # Each speed's eigenvalues come in an order of their own; a column of the table is one mode.
        modes_followed = eigenvalue_columns(self.branches())
        return dataframe(columns(self, rows=self.speed.size) | modes_followed)


@checked
def analyse(machine: Machine, speed: ArrayLike) -> Sweep:
    """Return the whole calculation sheet of a machine over running speed.

    Parameters
    ----------
    machine : Machine
        The machine.
    speed : array_like, (n,) or scalar
        Running speed, Ω [rad/s], positive.

    Returns
    -------
    Sweep
        Its fields have the leading shape (n,), or none for a scalar.

    Raises
    ------
    ValueError
        Where a speed is not positive and finite.
    """
    rotor = machine.rotor
    state = equilibrium(machine, speed)
    K, C, film = state.stiffness, state.damping, state.film
    T, T_out, mu = _temperatures(machine, state)
    # K and ΩC share the unit N/m, so k_eq is K_eq and p_s² is M_c Ω².
    onset = whirl_onset(K, C * state.speed[..., None, None])
    K_eq = onset.equivalent_stiffness
    # p_s is here √(M_c)Ω, so Ω_s = p_s/√M (Eq. 5.45).
    rigid_threshold = onset.threshold_speed / np.sqrt(rotor.half_mass)
    disk, journal = synchronous_response(rotor, K, C, state.speed)
    return Sweep(
        machine=machine,
        speed=state.speed,
        temperature=T,
        outlet_temperature=T_out,
        viscosity=mu,
        sommerfeld=film.sommerfeld,
        journal_position=film.position * machine.bearing.radial_clearance,
        eccentricity_ratio=film.eccentricity_ratio,
        attitude_angle=film.attitude_angle,
        minimum_film_thickness=state.minimum_film_thickness,
        power_loss=state.power_loss,
        side_flow=state.side_flow,
        drag_torque=state.drag_torque,
        friction_coefficient=state.friction_coefficient,
        peak_pressure=state.peak_pressure,
        stiffness=K,
        damping=C,
        equivalent_stiffness=K_eq,
        whirl_ratio=onset.whirl_ratio,
        # A negative K_eq leaves no mass that is stable; what the formula gives is none.
        critical_mass=np.where(onset.critical_mass < 0.0, np.nan, onset.critical_mass)
        / state.speed**2,
        rigid_threshold=rigid_threshold,
        # k_eq Γ/C = K_eq/K_rot (Eq. 5.50): 1/K_rot stands for the sag, 0 for a rigid shaft.
        flexible_threshold=flexible_threshold(rigid_threshold, K_eq, 1.0 / rotor.shaft_stiffness),
        disk_response=disk,
        journal_response=journal,
    )


def _temperatures(machine: Machine, state: Equilibrium) -> tuple[Array, Array, Array]:
    """Return the temperatures of film and outlet [°C] and the viscosity [Pa·s] at speeds."""
    speed = state.speed
    if machine.temperature is not None:
        mu = np.full(speed.shape, machine.viscosity)
        return np.full(speed.shape, machine.temperature), np.full(speed.shape, np.nan), mu
    T = heat.film_temperature(machine, speed)
    T_out = heat.outlet_temperature(machine, state.power_loss, state.side_flow)
    return T, T_out, machine.oil.viscosity(T)


@dataclass(frozen=True, eq=False)
class FilmCurves(Result):
    """A bearing's dimensionless film and whirl threshold over the modified Sommerfeld number.

    Attributes
    ----------
    film : FilmState
        The film (Figs. 5.5 and 5.6 show its k and c).
    onset : WhirlOnset
        k_eq, whirl ratio, p_s² and p_s (Figs. 5.7 to 5.9), in units of the load.
    """

    film: FilmState
    onset: WhirlOnset


@checked
def film_curves(
    bearing: Bearing,
    sommerfeld: ArrayLike,
    *,
    viscosity: ArrayLike = 1.0,
    speed: ArrayLike = 1.0,
) -> FilmCurves:
    """Return a bearing's film and threshold over the modified Sommerfeld number (Figs. 5.5 to 5.9).

    Parameters
    ----------
    bearing : JournalBearing or CoefficientTable
        The bearing.
    sommerfeld : array_like, (...)
        σ [-], positive; infinite without load, where the threshold is the limit for a vanishing
        one: for a circular bore k_eq = 6/π, whirl ratio ½ and p_s² = 24/π.
    viscosity, speed : array_like, (...)
        μ [Pa·s] and Ω [rad/s]: a film of fixed parts depends on σ alone, others on these too.

    Returns
    -------
    FilmCurves
        Its fields have the leading shape (...).

    Raises
    ------
    ValueError
        Where σ, μ or Ω is not positive.
    """
    film = film_state(bearing, sommerfeld, viscosity=viscosity, speed=speed)
    loaded = film
    if np.any(np.isinf(film.sommerfeld)):
        # k and c are in units of the load, which vanishes: the limit is taken at a very light load.
        lightest = np.minimum(film.sommerfeld, _LIGHTEST)
        loaded = film_state(bearing, lightest, viscosity=viscosity, speed=speed)
    return FilmCurves(film=film, onset=whirl_onset(loaded.k, loaded.c))


@dataclass(frozen=True, eq=False)
class ForceCoefficients(Result):
    """A film's force coefficients in one frame, either with dimensions or without.

    Attributes
    ----------
    axes : "XY" or "rt"
        The frame: X along the load, or r along the line of centres.
    sommerfeld, eccentricity_ratio : array, (...)
        σ and ε [-] at which they hold.
    stiffness, damping : array, (..., 2, 2)
        K_ij [N/m] and C_ij [N·s/m], or k_ij and c_ij [-] (Eq. 5.32).
    equivalent_stiffness : array, (...)
        K_eq [N/m] or k_eq [-] (Eq. 5.45), the same in both frames.
    """

    axes: Axes
    sommerfeld: Array
    eccentricity_ratio: Array
    stiffness: Array
    damping: Array
    equivalent_stiffness: Array


@checked
def force_coefficients(source: Sweep | FilmCurves, *, axes: Axes) -> ForceCoefficients:
    """Return force coefficients in the frame of the load, X and Y, or of the line of centres.

    Parameters
    ----------
    source : Sweep or FilmCurves
        A sweep gives the coefficients with dimensions, a bearing's curves those without.
    axes : "XY" or "rt"
        The frame.

    Returns
    -------
    ForceCoefficients
        Its fields have the leading shape of the source's.
    """
    # A sweep's K and C have dimensions; a bearing's curves have k and c in units of the load.
    if isinstance(source, Sweep):
        found = ForceCoefficients(
            axes="XY",
            sommerfeld=source.sommerfeld,
            eccentricity_ratio=source.eccentricity_ratio,
            stiffness=source.stiffness,
            damping=source.damping,
            equivalent_stiffness=source.equivalent_stiffness,
        )
    else:
        found = ForceCoefficients(
            axes="XY",
            sommerfeld=source.film.sommerfeld,
            eccentricity_ratio=source.film.eccentricity_ratio,
            stiffness=source.film.k,
            damping=source.film.c,
            equivalent_stiffness=source.onset.equivalent_stiffness,
        )
    return found if axes == "XY" else _in_radial_axes(found, _attitude_angle(source))


def _attitude_angle(source: Sweep | FilmCurves) -> Array:
    return source.attitude_angle if isinstance(source, Sweep) else source.film.attitude_angle


def _in_radial_axes(found: ForceCoefficients, phi: Array) -> ForceCoefficients:
    # K_eq = (tr K tr C − tr KC)/tr C (Eq. 5.45) does not change under rotation.
    return replace(
        found,
        axes="rt",
        stiffness=rotate(found.stiffness, -phi),  # Eq. 5.16, inverse
        damping=rotate(found.damping, -phi),
    )
