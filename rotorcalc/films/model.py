"""The interface of a film model: all that the rest of the program knows of a bearing's film.

A film is an object made once for each bearing. It takes operating points, arrays of viscosity,
speed and load, and returns results in the film's units (`films.units`). No caller may assume a
circular bore, ε below 1, an attitude angle below 90°, a closed form, whirl at zero load, or
coefficients independent of the whirl frequency.
"""

from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Protocol, TypeAlias, runtime_checkable

from numpy.typing import ArrayLike

from rotorcalc.arrays import Array
from rotorcalc.films.dynamics import FilmDynamics
from rotorcalc.films.state import FilmField, FilmState, OperatingPoints
from rotorcalc.machine import Bearing


class Velocity(Protocol):
    """The velocity of a journal from its position and the film's force on it."""

    def __call__(  # noqa: D102 - see FilmMotion
        self, x: float, y: float, f_x: float, f_y: float, near: list[float] | None = ...
    ) -> tuple[float, float]: ...


Force: TypeAlias = Callable[[float, float, float, float], tuple[float, float]]


@dataclass(frozen=True)
class FilmMotion:
    """The force of a film without inner coordinates on a moving journal, in plain floats.

    Attributes
    ----------
    force : callable
        (f_x, f_y) in μΩRL³/C² from x, y in C and x', y' in CΩ.
    velocity : callable
        (x', y') from (x, y, f_x, f_y), and optionally a list, empty at first, in which one search
        leaves the starting value of the next.
    thinnest : float
        Gap below which the force is not known, in C.
    tables : hashable or None
        Equal for films that share the tables which are made when the first force is asked for; None
        where there are none.
    seconds : float
        About how long that takes, on one core of a laptop.
    revolution : float
        About how long a revolution takes then [s], where a chart cannot have it at once; else 0.
    apart : float
        By how much its stiffness and damping at rest may differ from the film's own, over their
        largest entry: both are known to a mesh, or exactly, 0.
    """

    force: Force
    velocity: Velocity
    thinnest: float = 0.0
    tables: Hashable | None = None
    seconds: float = 0.0
    revolution: float = 0.0
    apart: float = 0.0


# (x, y, x', y') or (x, y, f_x, f_y), inner states, instantaneous viscosity [Pa·s], speed [rad/s]
# → (f_x, f_y) or (x', y'), and the derivatives of the inner states by the angle of rotation.
InnerRates: TypeAlias = Callable[
    [tuple[float, float, float, float], list[float], float, float],
    tuple[float, float, list[float]],
]
# Places of journal and inner coordinates in C, their velocities in CΩ, viscosity [Pa·s] and speed
# [rad/s] → the film's forces on all of them, in μΩRL³/C².
AllForces: TypeAlias = Callable[[list[float], list[float], float, float], list[float]]
# Places [C] and velocities [CΩ] over time, (m, 2 + n) each, viscosity [Pa·s] and speed [rad/s]
# → how far each is from where the forces have no derivative, (m,), in C and CΩ, taken together.
Smooth: TypeAlias = Callable[[Array, Array, float, float], Array]


@dataclass(frozen=True)
class InnerMotion:
    """The force of a film with inner coordinates on a moving journal, in plain floats.

    Attributes
    ----------
    states : int
        Number of inner states: the positions of all inner coordinates, then the velocities of those
        with a mass.
    rest : callable
        The inner states in static equilibrium at operating points, (..., states), in C and CΩ.
    force : callable
        Force on the journal and rates of the inner states from the journal's position and velocity.
    velocity : callable
        Velocity of the journal and the same rates from its position and the force on it.
    loaded : callable or None
        The same under a static load per bearing [N], where what does not move in a motion depends
        on it, as the speed of rotation of a floating ring does; without it there is no load.
    beside : callable or None
        Inner states from which a motion may start with the journal at rest at places (..., 2), in
        C: those of `rest`, or where they would leave the journal no film, others. None for those of
        `rest` at any place.
    gap : callable or None
        Thinnest film, in C, from the journal's places (..., 2), and the inner states; None where
        the journal's place alone says it.
    share : callable or None
        The same over the clearance of the film that is thinnest in its own; None where all have C.
    forces : callable or None
        Forces on the journal and on the inner coordinates from the places and velocities of all,
        with which limit cycles are found; None where a motion has none, as of pads that stand
        still without pressure.
    smooth : callable or None
        How far, in C and CΩ, a place and velocity is from the nearest at which those forces have no
        derivative; it comes with `forces`.
    thinnest : float
        Share below which the force is not known.
    tables, seconds, revolution, apart
        As of a `FilmMotion`.
    """

    states: int
    rest: Callable[[OperatingPoints], Array]
    force: InnerRates
    velocity: InnerRates
    loaded: "Callable[[float], InnerMotion] | None" = None
    beside: Callable[[OperatingPoints, Array], Array] | None = None
    gap: Callable[[Array, Array], Array] | None = None
    share: Callable[[Array, Array], Array] | None = None
    forces: AllForces | None = None
    smooth: Smooth | None = None
    thinnest: float = 0.0
    tables: Hashable | None = None
    seconds: float = 0.0
    revolution: float = 0.0
    apart: float = 0.0


def at_one_speed(motion: InnerMotion, *, viscosity: float, speed: float) -> FilmMotion:
    """Return the force of a film without inner states at one viscosity [Pa·s] and speed [rad/s]."""
    force, velocity = (
        partial(_at, rates, viscosity, speed) for rates in (motion.force, motion.velocity)
    )
    return FilmMotion(force, velocity, thinnest=motion.thinnest, apart=motion.apart)


def _at(  # noqa: PLR0913, PLR0917 - as `Velocity` takes it, and `Force` with x', y' in place of f
    rates: InnerRates,
    viscosity: float,
    speed: float,
    x: float,
    y: float,
    f_x: float,
    f_y: float,
    near: list[float] | None = None,  # noqa: ARG001 - the film keeps its own
) -> tuple[float, float]:
    found_x, found_y, _ = rates((x, y, f_x, f_y), [], viscosity, speed)
    return found_x, found_y


@dataclass(frozen=True)
class Limit:
    """One limit of a film model's validity, as the validity panel words it.

    Attributes
    ----------
    name : str
        What is checked, in words with its symbol.
    value : float
        The number compared with the two bounds [-].
    caution, outside : float
        Above the first the model is doubtful, above the second it fails.
    reason : str
        What goes wrong, in a sentence.
    """

    name: str
    value: float
    caution: float
    outside: float
    reason: str


@dataclass(frozen=True)
class Source:
    """The source of a film's result, for captions and for the popover beside a number.

    Attributes
    ----------
    equation : str
        Where it is printed, as "Eq. 5.8" or "Eqs. 5.5, 5.6, Fig. 5.2"; or in words what was solved.
    tex : str
        The equation in TeX; empty where none can be written down.
    remark : str
        What a caption says of the result on this film alone, without capital and full stop.
    """

    equation: str
    tex: str = ""
    remark: str = ""


@dataclass(frozen=True)
class Accuracy:
    """How finely a film was computed, and how far a mesh about twice as fine is from it.

    Attributes
    ----------
    mesh : str
        The mesh in words.
    place : float
        Distance between the journal's two equilibrium positions, in C.
    stiffness, damping : float
        Largest difference of an entry over the largest entry [-].
    """

    mesh: str
    place: float
    stiffness: float
    damping: float


class Film(Protocol):
    """One bearing's film.

    Attributes
    ----------
    bearing : JournalBearing or CoefficientTable
        The bearing.
    inner : int
        Number of inner coordinates, n.
    frequency_dependent : bool
        Whether the journal's stiffness and damping depend on the frequency of its whirl: with inner
        coordinates, or where the film is known by its impedance alone.
    can_whirl : bool
        False where the film has no cross-coupling at any load, so that no rotor on it can whirl.
    curve : hashable or None
        Equal for bearings whose k and c are the same function of σ; None where they depend on more.
    sommerfeld_range : (float, float)
        σ below which no rotor whirls, and σ above which the film's coefficients, in its own units,
        hardly change.
    least_sommerfeld : float
        σ below which the model has no answer, as the load presses the journal onto the bore; 0
        where there is none.
    limits : tuple of Limit
        What the model assumes of the bearing.
    sources : mapping of str to Source
        By the name of the result, of those that the model knows: "film" (the model itself),
        "eccentricity", "attitude", "thickness", "pressure", "force", "drag", "flow", "stiffness",
        "damping", "k", "c", both in "XY" and in "rt", "centre" (K without load), "half speed"
        (whirl of a light load); and of figures, "over ε", "over σ", "whirl ratio", "threshold",
        "critical mass", "flexible threshold". Pages cite nothing else of a film.
    """

    @property
    def bearing(self) -> Bearing: ...  # noqa: D102
    @property
    def inner(self) -> int: ...  # noqa: D102
    @property
    def frequency_dependent(self) -> bool: ...  # noqa: D102
    @property
    def can_whirl(self) -> bool: ...  # noqa: D102
    @property
    def curve(self) -> Hashable: ...  # noqa: D102
    @property
    def sommerfeld_range(self) -> tuple[float, float]: ...  # noqa: D102
    @property
    def least_sommerfeld(self) -> float: ...  # noqa: D102
    @property
    def limits(self) -> tuple[Limit, ...]: ...  # noqa: D102
    @property
    def sources(self) -> Mapping[str, Source]: ...  # noqa: D102

    def state(self, points: OperatingPoints) -> FilmState:
        """Return the film in static equilibrium; NaN for what the model does not give."""
        ...

    def dynamics(self, points: OperatingPoints) -> FilmDynamics:
        """Return stiffness, damping and inertia, inner coordinates included, or an impedance."""
        ...

    def drag_and_flow(self, points: OperatingPoints) -> tuple[Array, Array]:
        """Return `drag` and `side_flow` of `state` alone: the balance of heat asks them often."""
        ...

    def field(self, points: OperatingPoints, *, angle: ArrayLike, zeta: ArrayLike) -> FilmField:
        """Return thickness and pressure at angles Θ from X [rad] and ζ = z/L, broadcast."""
        ...

    def added_mass(self, points: OperatingPoints) -> Array:
        """Return I_ij, (..., 2, 2), or raise ValueError where the model has no fluid inertia."""
        ...

    def motion(self) -> FilmMotion | InnerMotion:
        """Return the force on a moving journal; ValueError where the model has none.

        Its functions can be pickled: a long computation runs in another process.
        """
        ...

    def accuracy(self, sommerfeld: float) -> Accuracy | None:
        """Return how finely the film is computed and its error at σ; None for a closed form."""
        ...

    def gap(self, position: ArrayLike) -> Array:
        """Return the minimum film thickness at positions (..., 2) of the journal, (...), in C."""
        ...

    def outline(self, angle: ArrayLike) -> Array:
        """Return where the journal's centre is at contact, in directions Θ, (..., 2), in C."""
        ...


@runtime_checkable
class BoundedFilm(Protocol):
    """A film that depends on more than σ, and so has an answer between other bounds.

    `turning_bounds` has the least and the largest μΩ [Pa] at which it has one at a load [N]; other
    films have one from `least_sommerfeld` on. It raises ValueError where there is none at any.
    """

    def turning_bounds(self, load: float) -> tuple[float, float]: ...  # noqa: D102
