"""Design studies: how the onset speed depends on the inputs, over many machines.

Whole grids of machines are solved together where a closed form holds, otherwise by their
characteristic polynomials, and one by one where rounding leaves these uncertain.

Inputs are named by the fields of the records, "bearing.radial_clearance" or "radial_clearance".

Source: San Andrés, Notes 5.
"""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from contextlib import suppress
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.constants import g
from scipy.optimize import brentq, minimize_scalar

from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, real_array
from rotorcalc.coefficient_table import CoefficientTable
from rotorcalc.display import Result
from rotorcalc.films import film_of
from rotorcalc.machine import Machine, Oil
from rotorcalc.numerics.parts import in_parts
from rotorcalc.numerics.roots import zeros
from rotorcalc.onset.beside import edge, onset_between
from rotorcalc.onset.closed_form import covers
from rotorcalc.onset.many import onset_speeds
from rotorcalc.onset.search import NOISE
from rotorcalc.records import number_paths
from rotorcalc.variation import address, changed, damping_reference, value_of, varied

# The inputs that affect the onset of any machine; a bore with a shape of its own has more.
INPUTS = (
    "rotor.mass",
    "load",
    "oil.reference_viscosity",
    "oil.temperature_coefficient",
    "temperature",
    "bearing.diameter",
    "bearing.length",
    "bearing.radial_clearance",
    "rotor.shaft_stiffness",
    "rotor.disk_damping",
    "rotor.journal_mass",
)
# In place of the film's temperature where that follows from the supply.
SUPPLY_INPUTS = ("supply.temperature", "supply.flow", "oil.heat_capacity")
# On a gas, whose law of viscosity is another.
GAS_INPUTS = tuple(
    "oil.sutherland_temperature" if name == "oil.temperature_coefficient" else name
    for name in INPUTS
)
# A share of a temperature in °C means nothing, as its zero is arbitrary: it is varied by degrees.
TEMPERATURE_STEP = 5.0
# A map that is not solved in one go reports its progress after each of 3 or 4 blocks of rows: fewer
# blocks are faster, as the machines of a block are solved together.
_BLOCKS = 3
# Values at which `solve_onset` scans the onset before it refines: in closed form, and without.
# 200 machines in closed form take less time than 24 with midspan damping: 8 and 20 ms.
_SCAN, _SLOW_SCAN = 200, 24
# Relative differences of onsets that may be rounding.
_ROUNDING = 1e-12
# A root whose onset is farther from the target than this, relative, is a jump past the target.
_HIT = 1e-6
# Relative differences up to which two onsets are one, found by the search and without it; and how
# far, relative, an onset between two values of the scan may lie beyond those beside it.
_SAME, _NEAR = 1e-10, 0.03
# Relative accuracy of an input, and how far about it, of the range, it is refined at last.
_SHARP, _ASIDE = 1e-13, 1e-6


@dataclass(frozen=True, eq=False)
class OnsetMap(Result):
    """Onset speed over two inputs.

    Attributes
    ----------
    x, y : str
        The inputs.
    xs, ys : array, (n,), (m,)
        Their values.
    speed : array, (m, n)
        Onset speed, Ω_s [rad/s]; NaN where the values are not a valid machine, or its film has no
        answer.
    """

    x: str
    y: str
    xs: Array
    ys: Array
    speed: Array


@dataclass(frozen=True)
class Sensitivity:
    """How the onset depends on one input.

    Attributes
    ----------
    field : str
        The input.
    low, high : float
        Its values.
    onset_low, onset_high : float
        Onset speed at these, Ω_s [rad/s].
    """

    field: str
    low: float
    high: float
    onset_low: float
    onset_high: float


@dataclass(frozen=True, repr=False)
class Sensitivities(Result):
    """How the onset depends on each input.

    Attributes
    ----------
    onset : float
        Onset speed of the machine as it is, Ω_s [rad/s].
    inputs : tuple of Sensitivity
        The input that moves the onset most comes first.
    left_out : tuple of str
        Inputs that could not be varied: those at infinity, or at a zero with which no reference
        value can be compared, and those for which a varied value is not a valid machine or leaves
        the film no answer.
    """

    onset: float
    inputs: tuple[Sensitivity, ...]
    left_out: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class OnsetSolution(Result):
    """The values of one input that put the onset at a speed.

    Attributes
    ----------
    field : str
        The input.
    target : float
        Onset speed asked for [rad/s].
    solutions : array, (k,)
        All values that give it, rising; empty where the onset never equals the target.
    values : array, (n,)
        Values over the range that was searched, without those for which the film has no answer.
    onset : array, (n,)
        The onset there [rad/s].
    """

    field: str
    target: float
    solutions: Array
    values: Array
    onset: Array

    @property
    def reachable(self) -> tuple[float, float]:
        """Lowest and highest onset over the range [rad/s]."""
        return float(self.onset.min()), float(self.onset.max())


def inputs_of(machine: Machine) -> tuple[str, ...]:
    """Return the inputs that affect the onset of a machine, those of its bearing's bore too.

    With a table of coefficients they are the rotor's alone.

    Parameters
    ----------
    machine : Machine
        The machine.

    Returns
    -------
    tuple of str
        "rotor.mass", …, "bearing.geometry.preload".
    """
    if isinstance(machine.bearing, CoefficientTable):
        return tuple(name for name in INPUTS if name.startswith("rotor."))
    bore = (path for path in number_paths(machine) if path[:2] == ("bearing", "geometry"))
    own = INPUTS if isinstance(machine.oil, Oil) else GAS_INPUTS
    if machine.supply is not None:
        own = (*(name for name in INPUTS if name != "temperature"), *SUPPLY_INPUTS)
    return (*own, *map(".".join, bore))


@checked
def onset_map(  # noqa: PLR0913 - two axes, each a name and its values
    machine: Machine,
    *,
    x: str,
    xs: ArrayLike,
    y: str,
    ys: ArrayLike,
    executor: Executor | None = None,
    progress: Callable[[float], object] | None = None,
) -> OnsetMap:
    """Return the onset speed over two inputs, the others as they are.

    Parameters
    ----------
    machine : Machine
        The machine.
    x, y : str
        The inputs, "bearing.radial_clearance" or "radial_clearance".
    xs, ys : array_like, (n,), (m,)
        Their values in SI.
    executor : concurrent.futures.Executor, optional
        Computes rows at the same time; with or without, onsets agree to their rounding.
    progress : callable, optional
        Called with the share done, 0 to 1, after each block of rows.

    Returns
    -------
    OnsetMap
        Onset speeds of shape (m, n).

    Raises
    ------
    ValueError
        Where there is no such input, or both are the same.
    """
    x_path, y_path = address(machine, x), address(machine, y)
    if x_path == y_path:
        raise ValueError(f"y = {y!r}: must differ from x")
    xs, ys = real_array("xs", xs), real_array("ys", ys)
    for name, values in (("xs", xs), ("ys", ys)):
        if values.ndim != 1:
            raise ValueError(f"{name}: must be a list, (n,), has the shape {values.shape}")
    rows = [[_machine_or_none(machine, {x_path: a, y_path: b}) for a in xs] for b in ys]
    made = [row_machine for row in rows for row_machine in row if row_machine is not None]
    whole = all(covers(one) for one in made)
    # In one go in closed form, else by blocks of rows, so that progress can be reported; row by row
    # where others may compute them.
    height = max(1, len(ys) if whole else len(ys) // _BLOCKS) if executor is None else 1
    blocks = [rows[top : top + height] for top in range(0, len(ys), height)]
    parts = list(in_parts(_onsets_where_made, blocks, executor=executor, progress=progress))
    speed = np.concatenate(parts) if parts else np.empty((0, len(xs)))
    return OnsetMap(x=x, y=y, xs=xs, ys=ys, speed=speed)


@checked
def sensitivities(
    machine: Machine, *, share: float = 0.10, inputs: Iterable[str] | None = None
) -> Sensitivities:
    """Return how far the onset moves when each input alone is varied.

    Parameters
    ----------
    machine : Machine
        The machine.
    share : float
        Share of its value by which each input is varied, down and up [-], between 0 and 1. A
        temperature is varied by `TEMPERATURE_STEP` instead. A load, a midspan damping or a journal
        mass of zero is raised to this share of half the rotor's weight, of `damping_reference` or
        of half the rotor's mass.
    inputs : iterable of str, optional
        The inputs, by default those of `inputs_of`. Any other at zero, and one at infinity, is left
        out; so is one for which a varied value is not a valid machine, such as a journal mass near
        half the rotor's, or leaves the film no answer, such as a load near the heaviest.

    Returns
    -------
    Sensitivities
        Sorted by effect, the largest first. Where the load follows the rotor's
        weight, the mass moves both, and "load" moves the load alone.

    Raises
    ------
    ValueError
        Where there is no such input, the share is not between 0 and 1, or the film has no answer.
    """
    if not 0.0 < share < 1.0:
        raise ValueError(
            f"share = {share:g}: must be between 0 and 1; 0.10 varies each input by a tenth"
        )
    moved = [
        _moved(machine, field, share)
        for field in (inputs_of(machine) if inputs is None else inputs)
    ]
    pairs = [
        (step, [_machine_or_none(machine, {address(machine, step[0]): v}) for v in step[1:]])
        for step in moved
        if step[1] < step[2] < np.inf  # at ∞ a share moves nothing
    ]
    steps = [step for step, pair in pairs if None not in pair]
    machines = [one for _, pair in pairs if None not in pair for one in pair if one is not None]
    onset, *onsets = _onsets_or_nan([machine, *machines])
    if np.isnan(onset):
        onset_speeds([machine])  # raises the film's reason
    found = [
        Sensitivity(field, low, high, float(onset_low), float(onset_high))
        for (field, low, high), onset_low, onset_high in zip(
            steps, onsets[::2], onsets[1::2], strict=True
        )
        if not np.isnan(onset_low + onset_high)
    ]
    known = {one.field for one in found}
    return Sensitivities(
        onset=float(onset),
        inputs=tuple(sorted(found, key=lambda one: _movement(one, float(onset)), reverse=True)),
        left_out=tuple(step[0] for step in moved if step[0] not in known),
    )


@checked
def solve_onset(
    machine: Machine, *, vary: str, target: float, low: float, high: float
) -> OnsetSolution:
    """Return all values of one input that put the onset at a speed.

    The onset need not be monotonic: it is scanned over the range, and each crossing of the target
    refined, including pairs of crossings at an extreme between two values of the scan.

    Parameters
    ----------
    machine : Machine
        The machine.
    vary : str
        The input, "bearing.radial_clearance" or "radial_clearance".
    target : float
        The onset speed wanted, Ω_s [rad/s], positive.
    low, high : float
        The range of the input in SI; spaced by ratios where it is positive.

    Returns
    -------
    OnsetSolution
        The solutions, and the onset over the scan.

    Raises
    ------
    ValueError
        Where there is no such input, the range is empty or an end is not a valid machine, the
        target is not positive and finite, or the film has no answer over the whole range.
    """
    if not 0.0 < target < np.inf:
        raise ValueError(f"target = {target} rad/s: must be positive and finite")
    if not -np.inf < low < high < np.inf:
        raise ValueError(
            f"low = {low}, high = {high}: must both be finite, and high the greater; a range to "
            "infinity cannot be searched"
        )

    line = _Line(machine, address(machine, vary))
    values = _scan_values(machine, vary, low, high)
    machines = list(map(line.machine, values.tolist()))
    onsets = _onsets_or_nan(machines)
    answered = ~np.isnan(onsets)
    if not answered.any():
        onset_speeds(machines)  # raises the film's reason
    values, onsets = _with_extremes(values[answered], onsets[answered], line)
    above = onsets >= target
    # The absolute tolerance serves ranges that include zero, the relative one those over decades.
    sharp = _SHARP * (high - low)
    roots = [
        line.value(target, float(values[i]), float(values[i + 1]), sharp)
        for i in np.flatnonzero(above[1:] != above[:-1])
    ]
    hits = [root for root in roots if not math.isnan(root)]
    return OnsetSolution(
        field=vary, target=target, solutions=np.array(hits), values=values, onset=onsets
    )


@dataclass(frozen=True)
class _Line:
    """The machines over one input, all others as they are."""

    base: Machine
    path: tuple[str, ...]

    def machine(self, value: float) -> Machine:
        return changed(self.base, {self.path: value})

    def onset(self, value: float) -> float:
        return float(onset_speeds([self.machine(value)])[0])

    def value(self, target: float, low: float, high: float, sharp: float) -> float:
        """Return the value between two at which the onset is the target, NaN where it jumps."""

        def beside_target(value: float) -> float:
            return _beside(self.onset(value), target)

        with suppress(ValueError):
            places = self._on_edge(target, low, high, sharp)
            return next((root for root in places if self._is_onset(target, root, _SAME)), math.nan)
        root = float(brentq(beside_target, low, high, xtol=sharp, rtol=_SHARP))
        # Where the onset jumps past the target, between two branches, no value gives it.
        return root if self._is_onset(target, root, _HIT) else math.nan

    def _is_onset(self, speed: float, value: float, apart: float) -> bool:
        return abs(self.onset(value) / speed - 1.0) < apart

    def _on_edge(self, speed: float, low: float, high: float, sharp: float) -> Iterator[float]:
        """Yield values between two at which a change of stability lies at a speed.

        First what bracketing finds, then all there are; a machine may be unstable at lower speeds
        too. Raises ValueError where they are not known, as on films with a table at each value.
        """

        def on_edge(value: float) -> float:
            return edge(self.machine(value), speed)

        with suppress(ValueError):
            yield float(brentq(on_edge, low, high, xtol=sharp, rtol=_SHARP))
        one, other = (film_of(self.machine(end).bearing) for end in (low, high))
        if one.curve is None or one.curve != other.curve or one.frequency_dependent:
            raise ValueError(f"{'.'.join(self.path)}: changes the film")
        aside = _ASIDE * (high - low)
        for root in zeros(np.vectorize(on_edge, otypes=[float]), low, high, noise=NOISE):
            ends = max(root - aside, low), min(root + aside, high)
            yield float(brentq(on_edge, *ends, xtol=sharp, rtol=_SHARP))

    def extreme(self, sign: float, values: Array, onsets: Array) -> tuple[float, float]:
        """Return the place of an extreme about three values, and the onset there."""
        near = (1.0 - _NEAR) * float(onsets.min()), (1.0 + _NEAR) * float(onsets.max())
        ends = float(values[0]), float(values[-1])

        def nearby(value: float) -> float:
            found = onset_between(self.machine(value), *near) if np.isfinite(near[1]) else math.nan
            return self.onset(value) if math.isnan(found) else found

        place = _extreme(nearby, sign, *ends)
        top = self.onset(place)
        if not abs(top / nearby(place) - 1.0) < _SAME:  # another change of stability comes first
            place = _extreme(self.onset, sign, *ends)
            top = self.onset(place)
        return place, top


def _machine_or_none(machine: Machine, values: Mapping[tuple[str, ...], float]) -> Machine | None:
    """Return a machine with other values at some paths, None where that is no valid machine."""
    try:
        return changed(machine, values)
    except ValueError:
        return None


def _onsets_where_made(rows: Sequence[Sequence[Machine | None]]) -> Array:
    made = np.array([[one is not None for one in row] for row in rows], dtype=bool)
    speed = np.full(made.shape, np.nan)
    speed[made] = _onsets_or_nan([one for row in rows for one in row if one is not None])
    return speed


def _onsets_or_nan(machines: Sequence[Machine]) -> Array:
    """Return the onsets of machines, NaN where a film has no answer at any speed."""
    with suppress(ValueError):
        return onset_speeds(machines)
    found = np.full(len(machines), np.nan)
    for i, one in enumerate(machines):
        with suppress(ValueError):
            found[i] = onset_speeds([one])[0]
    return found


def _moved(machine: Machine, field: str, share: float) -> tuple[str, float, float]:
    """Return an input with its two varied values, lower and higher."""
    value = value_of(machine, field)
    if address(machine, field)[-1] in ("temperature", "reference_temperature"):
        return field, value - TEMPERATURE_STEP, value + TEMPERATURE_STEP
    if value == 0.0:
        return field, 0.0, share * _reference(machine, field)
    return field, value * (1.0 - share), value * (1.0 + share)


def _reference(machine: Machine, field: str) -> float:
    """Return with what an input at zero is compared, zero where there is nothing."""
    match address(machine, field):
        case ("load",):
            return machine.rotor.half_mass * g
        case ("rotor", "disk_damping"):
            return damping_reference(machine)
        case ("rotor", "journal_mass"):
            return machine.rotor.half_mass
        case _:
            return 0.0


def _movement(one: Sensitivity, onset: float) -> float:
    """Return the larger of an input's two changes of the onset; ∞ − ∞ counts as 0."""
    ends = (one.onset_low, one.onset_high)
    return max(0.0 if end == onset else abs(end - onset) for end in ends)


def _scan_values(machine: Machine, field: str, low: float, high: float) -> Array:
    ends = [varied(machine, {field: value}) for value in (low, high)]
    points = _SCAN if all(covers(end) for end in ends) else _SLOW_SCAN
    # The onset varies with powers of most inputs, so equal ratios scan it evenly.
    return np.geomspace(low, high, points) if low > 0.0 else np.linspace(low, high, points)


def _with_extremes(values: Array, onsets: Array, line: _Line) -> tuple[Array, Array]:
    """Return a scan with its local extremes added, each refined between its neighbours."""
    before, here, after = onsets[:-2], onsets[1:-1], onsets[2:]
    # An infinite onset is no maximum that a search could refine.
    # ">" on one side and "≥" on the other, so that two equal values count as one extreme.
    # Where the onset hardly depends on the input, rounding makes extremes of its own.
    tops = np.flatnonzero((here > before * (1.0 + _ROUNDING)) & (here >= after) & np.isfinite(here))
    bottoms = np.flatnonzero((here < before * (1.0 - _ROUNDING)) & (here <= after))
    extremes = [
        line.extreme(sign, values[i : i + 3], onsets[i : i + 3])
        for sign, found in ((-1.0, tops), (1.0, bottoms))
        for i in found
    ]
    all_values, all_onsets = np.hstack([[values, onsets], np.reshape(extremes, (-1, 2)).T])
    order = np.argsort(all_values)
    return all_values[order], all_onsets[order]


def _extreme(onset: Callable[[float], float], sign: float, low: float, high: float) -> float:
    def signed(value: float) -> float:
        return sign * onset(value)

    # The onset is flat at its extreme: an error of 1e-5 in the input leaves one of 1e-10 in it.
    found = minimize_scalar(
        signed, bounds=(low, high), method="bounded", options={"xatol": 1e-5 * (high - low)}
    )
    return float(found.x)


def _beside(onset: float, target: float) -> float:
    """Return a measure of an onset, zero at the target and finite where the onset is infinite."""
    # Ω/(Ω+Ω_t) − ½ rises with Ω from −½ to ½, so that a bracketing search may start at Ω = ∞.
    return 0.5 if np.isinf(onset) else onset / (onset + target) - 0.5
