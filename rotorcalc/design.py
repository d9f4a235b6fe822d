"""What if: how the onset speed follows from the inputs, for many machines at once.

Whole grids of machines are solved at once where a closed form holds, by their characteristic
polynomials where none does, and one by one where these leave doubt.

Inputs are named by the fields of the records, "bearing.radial_clearance" or "radial_clearance".

Source: San Andrés, Notes 5.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq, minimize_scalar

from rotorcalc.arguments import checked
from rotorcalc.arrays import Array, real_array
from rotorcalc.display import Result
from rotorcalc.machine import Machine
from rotorcalc.onset.closed_form import covers
from rotorcalc.onset.many import onset_speeds
from rotorcalc.variation import address, value_of, varied

# What moves an onset: the inputs that `sensitivities` moves.
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


# A temperature has no natural zero of which to take a share: it is moved by degrees.
TEMPERATURE_STEP = 5.0


# Blocks of rows, or one more, by which a map that is not solved in one go tells its progress.
_BLOCKS = 3


# Values at which `solve_onset` looks before it closes in: where the onset is cheap, where not.
_SCAN, _SLOW_SCAN = 200, 24


# An onset this near to the target, relative, is the target.
_HIT = 1e-6


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
        Onset speed, Ω_s [rad/s]; not a number where the values make no machine.
    """

    x: str
    y: str
    xs: Array
    ys: Array
    speed: Array


@dataclass(frozen=True)
class Sensitivity:
    """How the onset follows one input.

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


@dataclass(frozen=True)
class Sensitivities:
    """How the onset follows each input.

    Attributes
    ----------
    onset : float
        Onset speed of the machine as it is, Ω_s [rad/s].
    inputs : tuple of Sensitivity
        The input that moves the onset most comes first.
    left_out : tuple of str
        Inputs that could not be moved: at zero or infinite they have no share of their value, or
        one of the values moved to makes no machine.
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
        All values that give it, rising; none where the onset never takes the target's value.
    values : array, (n,)
        Values over the range that was searched.
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


@checked
def onset_map(  # noqa: PLR0913 - two axes, each a name and its values
    machine: Machine,
    *,
    x: str,
    xs: ArrayLike,
    y: str,
    ys: ArrayLike,
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
    progress : callable, optional
        Told the share that is done, 0 to 1, after each block of rows.

    Returns
    -------
    OnsetMap
        Onset speeds of shape (m, n).

    Raises
    ------
    ValueError
        Where there is no such input, or both are the same.
    """
    if address(machine, x) == address(machine, y):
        raise ValueError(f"y = {y!r}: must differ from x")
    xs, ys = real_array("xs", xs), real_array("ys", ys)
    for name, values in (("xs", xs), ("ys", ys)):
        if values.ndim != 1:
            raise ValueError(f"{name}: must be a list, (n,), has the shape {values.shape}")
    rows = [[_machine_or_none(machine, {x: a, y: b}) for a in xs] for b in ys]
    made = [row_machine for row in rows for row_machine in row if row_machine is not None]
    whole = all(covers(one) for one in made)
    speed = np.empty((len(ys), len(xs)))
    # In one go where that is cheapest, else by blocks of rows, so that the progress can be told.
    height = max(1, len(ys) if whole else len(ys) // _BLOCKS)
    for top in range(0, len(ys), height):
        part = slice(top, top + height)
        speed[part] = _onsets_where_made(rows[part])
        if progress is not None:
            progress(min(1.0, (top + height) / len(ys)))
    return OnsetMap(x=x, y=y, xs=xs, ys=ys, speed=speed)


@checked
def sensitivities(
    machine: Machine, *, share: float = 0.10, inputs: Iterable[str] = INPUTS
) -> Sensitivities:
    """Return how far the onset moves with each input by itself.

    Parameters
    ----------
    machine : Machine
        The machine.
    share : float
        By how much of its value each input is moved, down and up [-]. A temperature in °C has no
        natural zero and is moved by `TEMPERATURE_STEP` instead.
    inputs : iterable of str
        The inputs. One at zero or infinite has no share of its value and is left out; so is one
        whose value up or down makes no machine, such as a journal's mass near half the rotor's.

    Returns
    -------
    Sensitivities
        Sorted, the input that moves the onset most first. Where the load follows the rotor's
        weight, the mass moves both, and "load" moves the load alone.

    Raises
    ------
    ValueError
        Where there is no such input.
    """
    moved = [_moved(machine, field, share) for field in inputs]
    pairs = [
        (step, [_machine_or_none(machine, {step[0]: value}) for value in step[1:]])
        for step in moved
        if step[1] < step[2] < np.inf
    ]
    steps = [step for step, pair in pairs if None not in pair]
    machines = [one for _, pair in pairs if None not in pair for one in pair if one is not None]
    onset, *onsets = onset_speeds([machine, *machines])
    known = {step[0] for step in steps}
    found = [
        Sensitivity(field, low, high, float(onset_low), float(onset_high))
        for (field, low, high), onset_low, onset_high in zip(
            steps, onsets[::2], onsets[1::2], strict=True
        )
    ]
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

    The onset need not rise or fall throughout: it is scanned over the range, and each crossing of
    the target closed in on, also those that hide beside an extreme between two values of the scan.

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
        The solutions, and what the scan saw of the onset.

    Raises
    ------
    ValueError
        Where there is no such input, the range is empty or its ends make no machine, or the
        target is not positive and finite.
    """
    if not 0.0 < target < np.inf:
        raise ValueError(f"target = {target} rad/s: must be positive and finite")
    if not -np.inf < low < high < np.inf:
        raise ValueError(
            f"low = {low}, high = {high}: must both be finite, and high the greater; a range to "
            "infinity cannot be searched"
        )

    def onset(value: float) -> float:
        return float(onset_speeds([varied(machine, {vary: value})])[0])

    def beside_target(value: float) -> float:
        return _beside(onset(value), target)

    values = _scan_values(machine, vary, low, high)
    onsets = onset_speeds([varied(machine, {vary: float(value)}) for value in values])
    values, onsets = _with_extremes(values, onsets, onset)
    above = onsets >= target
    roots = [
        float(
            brentq(beside_target, values[i], values[i + 1], xtol=1e-13 * (high - low), rtol=1e-13)
        )
        for i in np.flatnonzero(above[1:] != above[:-1])
    ]
    # Where the onset jumps past the target, no value gives it.
    hits = [root for root in roots if abs(onset(root) / target - 1.0) < _HIT]
    return OnsetSolution(
        field=vary, target=target, solutions=np.array(hits), values=values, onset=onsets
    )


def _machine_or_none(machine: Machine, values: Mapping[str, float]) -> Machine | None:
    try:
        return varied(machine, values)
    except ValueError:
        for field in values:
            # An unknown input is an error; values that make no machine are not.
            address(machine, field)
        return None


def _onsets_where_made(rows: Sequence[Sequence[Machine | None]]) -> Array:
    made = np.array([[one is not None for one in row] for row in rows], dtype=bool)
    speed = np.full(made.shape, np.nan)
    speed[made] = onset_speeds([one for row in rows for one in row if one is not None])
    return speed


def _moved(machine: Machine, field: str, share: float) -> tuple[str, float, float]:
    """Return an input with the values to which it is moved, down and up."""
    value = value_of(machine, field)
    if address(machine, field)[-1] in ("temperature", "reference_temperature"):
        return field, value - TEMPERATURE_STEP, value + TEMPERATURE_STEP
    return field, value * (1.0 - share), value * (1.0 + share)


def _movement(one: Sensitivity, onset: float) -> float:
    """Return the larger of an input's two movements of the onset; 0 from infinite to infinite."""
    ends = (one.onset_low, one.onset_high)
    return max(0.0 if end == onset else abs(end - onset) for end in ends)


def _scan_values(machine: Machine, field: str, low: float, high: float) -> Array:
    ends = [varied(machine, {field: value}) for value in (low, high)]
    points = _SCAN if all(covers(end) for end in ends) else _SLOW_SCAN
    return np.geomspace(low, high, points) if low > 0.0 else np.linspace(low, high, points)


def _with_extremes(
    values: Array, onsets: Array, onset: Callable[[float], float]
) -> tuple[Array, Array]:
    """Return a scan with its local extremes added, each where it truly lies."""
    before, here, after = onsets[:-2], onsets[1:-1], onsets[2:]
    tops = np.flatnonzero((here > before) & (here >= after) & np.isfinite(here))
    bottoms = np.flatnonzero((here < before) & (here <= after))
    extremes = [
        _extreme(onset, sign, float(values[i]), float(values[i + 2]))
        for sign, found in ((-1.0, tops), (1.0, bottoms))
        for i in found
    ]
    all_values = np.concatenate([values, extremes])
    all_onsets = np.concatenate([onsets, [onset(value) for value in extremes]])
    order = np.argsort(all_values)
    return all_values[order], all_onsets[order]


def _extreme(onset: Callable[[float], float], sign: float, low: float, high: float) -> float:
    def signed(value: float) -> float:
        return sign * onset(value)

    found = minimize_scalar(
        signed, bounds=(low, high), method="bounded", options={"xatol": 1e-5 * (high - low)}
    )
    return float(found.x)


def _beside(onset: float, target: float) -> float:
    """Return a measure of an onset that is 0 at the target and finite also where it is infinite."""
    return 0.5 if np.isinf(onset) else onset / (onset + target) - 0.5
