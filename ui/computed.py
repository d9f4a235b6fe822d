"""A machine at its running speed, and its results, each computed on first use."""

import math
from collections.abc import Callable
from dataclasses import replace
from functools import cached_property, lru_cache

import numpy as np

from rotorcalc import (
    CoefficientTable,
    Gas,
    Hydrostatic,
    Machine,
    Oil,
    Onset,
    Plain,
    Rotor,
    Sweep,
    analyse,
    film_curves,
    heat,
    modes,
    onset_speed,
    thresholds,
)
from rotorcalc.analysis import Axes, FilmCurves, ForceCoefficients, force_coefficients
from rotorcalc.arrays import Array, ComplexArray
from rotorcalc.bearing_parts import Parts, bearing_parts
from rotorcalc.coefficients import (
    AddedMass,
    Equilibrium,
    FilmForces,
    OverWhirlRatio,
    PressureField,
    Unloading,
    added_mass,
    equilibrium,
    film_field,
    film_forces,
    middle_pressure,
    over_whirl_ratio,
    unloading,
)
from rotorcalc.figures.equilibrium import Path
from rotorcalc.figures.machine import OtherSpeeds
from rotorcalc.films import draft, film_of
from rotorcalc.machine import Bearing, oil_of
from rotorcalc.numerics.first_answer import from_first_answer
from rotorcalc.oils import by_other_law
from rotorcalc.recesses import RecessEquilibrium, recess_equilibrium
from rotorcalc.root_locus import Locus, root_locus
from rotorcalc.unbalance_curves import (
    ClearanceOrbit,
    Orbits,
    ResponseCurves,
    ResponseFamily,
    clearance_orbit,
    orbits,
    response_curves,
    response_family,
)
from rotorcalc.unbalance_peaks import ResponsePeaks, both_peaks
from rotorcalc.validity import IMBALANCE_ORBIT, Check, validity
from ui.bores import Values
from ui.inputs import in_words, machine_of, speeds_of

# Points of a sweep: enough for a smooth line across a projector.
POINTS = 240
# The notes' figures span these modified Sommerfeld numbers.
_SOMMERFELD = np.geomspace(1e-2, 1e2, POINTS)
# 100, 200, 500 … 50000 rpm, to mark on the journal's locus.
_ROUND_SPEEDS = np.array([a * 10.0**b for b in (2, 3, 4) for a in (1, 2, 5)]) * math.pi / 30
# From close to the wall, ε = 0.997, to near the centre.
_TO_THE_WALL = np.geomspace(1e-5, 1e2, POINTS)
# Around the film every two degrees, along it every twentieth of the length.
_THETA = np.linspace(0.0, 2.0 * np.pi, 181)
# Of a sweep's speeds, every tenth has its pressure and modes drawn; that around every five degrees.
_FEW = 10
_COARSE = np.linspace(-np.pi, np.pi, 73)
# The wall, every degree: a square bore's corners are among them.
_AROUND = np.linspace(0.0, 2.0 * np.pi, 361)
_ZETA = np.linspace(-0.5, 0.5, 21)
# Half-speed whirl, imbalance at 1, and its second harmonic.
_WHIRL_RATIOS = np.linspace(0.02, 2.0, 100)


# So small a share of the running speed that rotation carries nothing of the load.
_REST = 1e-9


class Computed:
    """A machine at its running speed, with all results that the pages show."""

    def __init__(self, machine: Machine, speed: float, top_speed: float) -> None:
        self.machine = machine
        self.speed = speed
        self.top_speed = top_speed

    @cached_property
    def point(self) -> Sweep:
        """The machine at its running speed; fields without a leading axis."""
        return analyse(self.machine, self.speed)

    @cached_property
    def checks(self) -> tuple[Check, ...]:
        """The model's assumptions, checked at the running speed."""
        return validity(self.point)

    @property
    def is_outside(self) -> bool:
        """Whether the machine lies outside the model's range."""
        return any(check.worst == "outside" for check in self.checks)

    @cached_property
    def onset_is_outside(self) -> bool:
        """Whether the film lies outside the model's range at the onset of whirl."""
        if not 0.0 < self.onset.speed < math.inf:
            return False
        there = validity(analyse(self.machine, self.onset.speed))
        # The onset is that of a small motion, whatever the imbalance.
        return any(one.worst == "outside" and one.name != IMBALANCE_ORBIT for one in there)

    @property
    def onset_is_unknown(self) -> bool:
        """Whether an onset was sought up to a speed only, and no onset lies below.

        Where the oil supplied carries the heat no further, where own coefficients end, or where the
        search of the eigenvalues does, which proves nothing of higher speeds.
        """
        return self.ends_unanswered(self.onset)

    def ends_unanswered(self, onset: Onset) -> bool:
        """Return whether an onset was sought up to a speed only, and none was found."""
        return math.isinf(onset.speed) and onset.searched_to < math.inf

    @property
    def has_own(self) -> bool:
        """Whether the bearing is known by its own coefficients alone."""
        return isinstance(self.machine.bearing, CoefficientTable)

    @property
    def has_gas(self) -> bool:
        """Whether the film is a gas, which carries next to no heat away."""
        return isinstance(self.machine.oil, Gas)

    @property
    def sweep(self) -> Sweep:
        """The machine over speed, up to the top speed."""
        return _sweep(self.machine, self.top_speed)

    @property
    def curves(self) -> FilmCurves:
        """The bearing's dimensionless film over the modified Sommerfeld number."""
        decades = _decades(float(self.point.sommerfeld))
        if film_of(self.machine.bearing).curve is not None:  # of σ alone
            return _curves(self.machine.bearing, *decades)
        return _curves(self.machine.bearing, *decades, self.viscosity, self.speed)

    @property
    def viscosity(self) -> float:
        """Viscosity of the oil in the film at the running speed, μ [Pa·s]."""
        return float(self.point.viscosity)

    @property
    def curves_here(self) -> FilmCurves:
        """The bearing's dimensionless film at the running speed."""
        return film_curves(
            self.machine.bearing,
            self.point.sommerfeld,
            viscosity=self.viscosity,
            speed=self.speed,
        )

    @cached_property
    def heat_curves(self) -> heat.HeatCurves:
        """Heat made and heat carried over the film's temperature, at the running speed."""
        machine, T = self.machine, float(self.point.temperature)
        if machine.supply is None:
            raise ValueError("the film's temperature is given")
        inlet = machine.supply.temperature
        # As far above the balance as the supply is below it, to a round end that stays in a drag.
        top = 20.0 * math.floor((T + max(T - inlet, 5.0)) / 20.0 + 1.0)
        return heat.heat_curves(machine, self.speed, np.linspace(inlet, top, POINTS // 2))

    @property
    def unwarmed(self) -> "Computed":
        """The same machine with its film at the supply's temperature at every speed."""
        supply = self.machine.supply
        if supply is None:
            raise ValueError("the film's temperature is given")
        machine = replace(self.machine, temperature=supply.temperature, supply=None)
        return _computed(machine, self.speed, self.top_speed)

    @property
    def settled(self) -> "Computed":
        """The same machine with its film at the running speed's temperature at every speed."""
        return _computed(heat.settled(self.machine, self.speed), self.speed, self.top_speed)

    @property
    def other_oil(self) -> Oil | None:
        """The oil by the other law of viscosity, None where it has none."""
        return by_other_law(oil_of(self.machine))

    @cached_property
    def flow_needed(self) -> float:
        """Groove flow that holds the oil's rise at the running speed at 20 K [m³/s]; NaN if none.

        With a supply the film is then at another temperature.
        """
        try:
            return float(heat.flow_for_rise(self.machine, self.speed))
        except ValueError:  # so warm a film does not carry its load
            return math.nan

    @cached_property
    def at_round_speeds(self) -> Equilibrium:
        """Equilibrium positions at round speeds, up to the top speed."""
        # The allowance is for rounding: a top speed of 10000 rpm has its own mark.
        number = np.searchsorted(_ROUND_SPEEDS, self.top_speed * (1 + 1e-9), side="right")
        return from_first_answer(
            lambda speed: equilibrium(self.machine, speed),
            _with_film(self.machine, _ROUND_SPEEDS[:number]),
        )

    @cached_property
    def film(self) -> PressureField:
        """The film over the unwrapped bearing at the running speed."""
        return film_field(self.machine, self.speed, theta=_THETA, zeta=_ZETA)

    @cached_property
    def middle_film(self) -> PressureField:
        """The film around the bearing's middle at the running speed."""
        return film_field(self.machine, self.speed, theta=_THETA)

    @property
    def has_recesses(self) -> bool:
        """Whether the bearing has recesses that are supplied with oil."""
        return isinstance(self.machine.bearing.geometry, Hydrostatic)

    @cached_property
    def recesses(self) -> RecessEquilibrium:
        """The bearing's recesses over the sweep."""
        return recess_equilibrium(self.machine, self.sweep.speed)

    @cached_property
    def recesses_here(self) -> RecessEquilibrium:
        """The bearing's recesses at the running speed."""
        return recess_equilibrium(self.machine, self.speed)

    @cached_property
    def at_rest(self) -> Sweep:
        """The machine on its recesses as its rotation ends, the film as warm as in operation."""
        T = float(self.point.temperature)
        return analyse(replace(self.machine, temperature=T, supply=None), _REST * self.speed)

    @property
    def other_speeds(self) -> OtherSpeeds:
        """What the bearing's drawing shows at other speeds."""
        return _other_speeds(self.machine, self.speed, self.top_speed)

    @cached_property
    def parts(self) -> Parts | None:
        """The bearing's parts that move or are supplied, at the running speed."""
        return bearing_parts(self.machine, self.speed)

    @property
    def path(self) -> Path:
        """The journal's equilibrium over speed, and the wall."""
        outline = film_of(self.machine.bearing).outline(_AROUND)
        return Path(self.curves, self.sweep, self.at_round_speeds, outline)

    @cached_property
    def forces(self) -> FilmForces:
        """The film's forces at the running speed, at this machine's own equilibrium."""
        return film_forces(self.machine, self.speed, sommerfeld=self.point.sommerfeld)

    @cached_property
    def force_curves(self) -> FilmForces:
        """The film's forces at the running speed, from close to the wall to near the centre."""
        return from_first_answer(
            lambda sigma: film_forces(self.machine, self.speed, sommerfeld=sigma), _TO_THE_WALL
        )

    @property
    def onset(self) -> Onset:
        """Onset of whirl of the machine."""
        return _onset(self.machine, True)

    @property
    def of_finite_length(self) -> "Computed | None":
        """The same machine on the film of finite length; None where it has it or there is none."""
        bearing = self.machine.bearing
        if isinstance(bearing, CoefficientTable):
            return None
        if bearing.model != "short" or "finite" not in bearing.geometry.models:
            return None
        machine = replace(self.machine, bearing=replace(bearing, film="finite"))
        return _computed(machine, self.speed, self.top_speed)

    @property
    def short_plain(self) -> "Computed | None":
        """The same machine on the notes' bearing, short and plain; None where it has it."""
        if isinstance(self.machine.bearing, CoefficientTable):
            return None
        bearing = replace(self.machine.bearing, geometry=Plain(), film=None)
        if self.machine.bearing.geometry == Plain() and self.machine.bearing.model == "short":
            return None
        if isinstance(self.machine.oil, Gas):  # whose film the notes do not have
            return None
        machine = replace(self.machine, bearing=bearing)
        return _computed(machine, self.speed, self.top_speed)

    @property
    def rigid_onset(self) -> Onset:
        """Onset of whirl with a rigid shaft."""
        return _onset(self.machine, False)

    @property
    def rigid_branches(self) -> ComplexArray:
        """Eigenvalues of the rigid rotor over the sweep, one column per mode."""
        return _branches(self.machine, self.top_speed, False)

    @property
    def branches(self) -> ComplexArray:
        """Eigenvalues of the rotor over the sweep, one column per mode."""
        return _branches(self.machine, self.top_speed, True)

    @cached_property
    def critical_mass(self) -> float:
        """Mass per bearing with which the machine would be at its onset at the running speed."""
        return thresholds.critical_mass(self.point)

    def locus(self, flexible: bool) -> Locus:
        """Return the root locus over the sweep, and the modes at the running speed."""
        return _locus(self.machine, self.speed, self.top_speed, flexible)

    @property
    def rigid_frequency(self) -> Array:
        """Natural frequency of a rigid rotor on the film over the sweep, √(K_eq/M) [rad/s]."""
        rotor = self.machine.rotor
        return modes.undamped_frequency(self.sweep.equivalent_stiffness, rotor.half_mass)

    @property
    def shaft_frequency(self) -> float:
        """Natural frequency of the shaft in rigid bearings, √(K_rot/M) [rad/s]."""
        rotor = self.machine.rotor
        return float(modes.undamped_frequency(rotor.shaft_stiffness, rotor.half_mass))

    @property
    def disk_peaks(self) -> ResponsePeaks:
        """Peaks of the disk's response up to the top speed."""
        return _peaks(self.machine, self.top_speed)[0]

    @property
    def journal_peaks(self) -> ResponsePeaks:
        """Peaks of the journals' response up to the top speed."""
        return _peaks(self.machine, self.top_speed)[1]

    def coefficients(self, axes: Axes) -> ForceCoefficients:
        """Return K and C over the sweep, with dimensions, in one frame."""
        return force_coefficients(self.sweep, axes=axes)

    def coefficients_here(self, axes: Axes) -> ForceCoefficients:
        """Return K and C at the running speed, with dimensions, in one frame."""
        return force_coefficients(self.point, axes=axes)

    def film_coefficients(self, axes: Axes) -> ForceCoefficients:
        """Return k and c over the modified Sommerfeld number, in one frame."""
        return force_coefficients(self.curves, axes=axes)

    def film_coefficients_here(self, axes: Axes) -> ForceCoefficients:
        """Return k and c at the running speed, in one frame."""
        return force_coefficients(self.curves_here, axes=axes)

    @property
    def unloading(self) -> Unloading:
        """K and (Ω/2)·C at the running speed as the load is removed."""
        return from_first_answer(
            lambda sigma: unloading(self.machine, self.speed, sommerfeld=sigma), _SOMMERFELD
        )

    @property
    def centred(self) -> Unloading:
        """K and (Ω/2)·C at the running speed without load."""
        return unloading(self.machine, self.speed, sommerfeld=np.inf)

    @property
    def unloading_here(self) -> Unloading:
        """K and (Ω/2)·C at the running speed under the machine's load."""
        return unloading(self.machine, self.speed, sommerfeld=self.point.sommerfeld)

    @cached_property
    def over_whirl_ratio(self) -> OverWhirlRatio:
        """Stiffness and damping at the running speed over the frequency of the whirl."""
        return over_whirl_ratio(self.machine, self.speed, whirl_ratio=_WHIRL_RATIOS)

    def added_mass(self, factor: float) -> AddedMass:
        """Return the film's added mass over the sweep, for a velocity profile."""
        return added_mass(self.machine, self.sweep.speed, factor=factor)

    def added_mass_here(self, factor: float) -> AddedMass:
        """Return the film's added mass at the running speed, for a velocity profile."""
        return added_mass(self.machine, self.speed, factor=factor)

    @cached_property
    def response(self) -> ResponseCurves:
        """The steady response to imbalance over the sweep and at the running speed."""
        return response_curves(
            self.sweep,
            self.point,
            disk_peaks=self.disk_peaks,
            journal_peaks=self.journal_peaks,
            onset=self.onset,
        )

    @property
    def orbits(self) -> Orbits:
        """Orbits at the running speed."""
        # A point every 2.5°, as this orbit fills its chart.
        return orbits(self.point, points=145)

    @property
    def orbit_steps(self) -> Orbits:
        """Orbits at some speeds of the sweep, coarser than at the running speed."""
        # 40 orbits of a point every 7.5°: as frames of an animation they all travel to the browser.
        return orbits(self.sweep, points=49, every=POINTS // 40)

    @property
    def clearance_orbit(self) -> ClearanceOrbit:
        """The journal's orbit at the running speed in its clearance."""
        return clearance_orbit(self.point)

    def response_family(self, variants: Callable[[Machine], tuple[Rotor, ...]]) -> ResponseFamily:
        """Return the responses of this machine's rotor and of others made of it."""
        return _family(self.machine, self.top_speed, variants(self.machine))

    @property
    def is_stable(self) -> bool:
        """Whether every mode decays at the running speed."""
        return bool(np.all(self.point.flexible_eigenvalues.real < 0.0))

    @property
    def unloaded(self) -> bool:
        """Whether the bearings carry no load."""
        return self.machine.static_load == 0.0


def computed_from(values: Values) -> Computed:
    """Return the results of kept values, or raise the core's ValueError."""
    return _computed(machine_of(values), *speeds_of(values))


def computed_while_dragging(values: Values, before: Computed) -> Computed:
    """Return the results of kept values, on a coarse mesh where they have another bore than before.

    On release a page has them as they are.
    """
    machine = machine_of(values)
    if film_of(machine.bearing).curve != film_of(before.machine.bearing).curve:
        machine = replace(machine, bearing=draft(machine.bearing))
    return _computed(machine, *speeds_of(values))


def answered_from(values: Values) -> Computed:
    """Return the results of kept values, or raise ValueError in the sidebar's words.

    Also where the film has no answer at the running speed, or no temperature.
    """
    computed = computed_from(values)
    try:
        _ = computed.point
    except ValueError as error:
        raise ValueError(in_words(f"{error}", values)) from error
    return computed


def speeds(top_speed: float) -> Array:
    """Return the speeds of a sweep [rad/s]."""
    # From the first step on: at Ω = 0 there is no film.
    return np.linspace(top_speed / POINTS, top_speed, POINTS)


def _with_film(machine: Machine, speeds: Array) -> Array:
    """Return the speeds at which a film has a temperature, where that follows from the supply.

    Of own coefficients as many speeds within their ends.
    """
    if isinstance(table := machine.bearing, CoefficientTable):
        low, high = max(speeds[0], table.first), min(speeds[-1], table.last)
        return np.linspace(*((low, high) if low < high else (table.first, table.last)), len(speeds))
    if machine.supply is None:
        return speeds
    known = speeds[heat.has_film(machine, speeds)]
    return known if known.size else speeds  # whose refusal says why


@lru_cache(maxsize=64)
def _computed(machine: Machine, speed: float, top_speed: float) -> Computed:
    return Computed(machine, speed, top_speed)


@lru_cache(maxsize=64)
def _sweep(machine: Machine, top_speed: float) -> Sweep:
    carried = _with_film(machine, speeds(top_speed))
    return from_first_answer(lambda speed: analyse(machine, speed), carried)


@lru_cache(maxsize=64)
def _branches(machine: Machine, top_speed: float, flexible: bool) -> ComplexArray:
    return _sweep(machine, top_speed).branches(flexible=flexible)


@lru_cache(maxsize=64)
def _locus(machine: Machine, speed: float, top_speed: float, flexible: bool) -> Locus:
    point = _computed(machine, speed, top_speed).point
    return root_locus(
        _sweep(machine, top_speed).speed,
        _branches(machine, top_speed, flexible),
        running_speed=speed,
        shapes=point.mode_shapes(flexible=flexible),
        bearing=machine.bearing,
    )


@lru_cache(maxsize=16)
def _other_speeds(machine: Machine, speed: float, top_speed: float) -> OtherSpeeds:
    sweep = _sweep(machine, top_speed)
    some = sweep.speed[_FEW - 1 :: _FEW]
    modes_speed = np.union1d(some, speed)
    return OtherSpeeds(
        sweep=sweep,
        angle=_COARSE,
        pressure_speed=some,
        pressure=middle_pressure(machine, some, angle=_COARSE),
        modes_speed=modes_speed,
        modes=analyse(machine, modes_speed).mode_shapes(),
        parts=bearing_parts(machine, some),
    )


@lru_cache(maxsize=256)
def _onset(machine: Machine, flexible: bool) -> Onset:
    return onset_speed(machine, flexible=flexible)


@lru_cache(maxsize=64)
def _peaks(machine: Machine, top_speed: float) -> tuple[ResponsePeaks, ResponsePeaks]:
    return both_peaks(_sweep(machine, top_speed))


@lru_cache(maxsize=32)
def _family(machine: Machine, top_speed: float, rotors: tuple[Rotor, ...]) -> ResponseFamily:
    return response_family(machine, _sweep(machine, top_speed).speed, rotors=rotors)


@lru_cache(maxsize=16)
def _curves(
    bearing: Bearing,
    lowest: int,
    highest: int,
    viscosity: float = 1.0,
    speed: float = 1.0,
) -> FilmCurves:
    return from_first_answer(
        lambda sigma: film_curves(bearing, sigma, viscosity=viscosity, speed=speed),
        np.geomspace(10.0**lowest, 10.0**highest, POINTS),
    )


def _decades(sommerfeld: float) -> tuple[int, int]:
    """Return the decades of the notes' figures, and as many more as a machine needs."""
    # Without load σ is infinite, and its point is drawn at the end of the notes' range.
    if not math.isfinite(sommerfeld):
        return -2, 2
    exponent = math.log10(sommerfeld)
    return min(-2, math.floor(exponent)), max(2, math.ceil(exponent))


def hertz(frequency: float) -> float:
    """Return a frequency [rad/s] in Hz."""
    return frequency / (2.0 * math.pi)
