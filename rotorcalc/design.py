"""What if: how the onset speed follows from the inputs, for many machines at once.

A machine with massless journals and no midspan damping goes unstable where Ω = Ω_sf(ε(Ω)). With
σ = sΩ/F_o, s = μLR(L/C)²/4, that is the root in σ of

    σ² (1/p_s² + (Γ/C) ω̄²) = s²/(M C F_o)        (Eqs. 5.8, 5.45, 5.46 and 5.50)

whose left side is the film's alone but for the static sag, and rises with σ. So whole grids of
machines are solved at once. Other machines' onsets are sought on their characteristic polynomials,
and where these leave doubt on the eigenvalues, one by one.

Inputs are named by the fields of the records, "bearing.radial_clearance" or "radial_clearance".

Source: San Andrés, Notes 5.
"""

import functools
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq, elementwise, minimize_scalar

from rotorcalc.films import film_coefficients, film_state
from rotorcalc.fleet import sure_onsets
from rotorcalc.machine import JournalBearing, Machine, Oil, Rotor
from rotorcalc.roots import narrow_root
from rotorcalc.stability import Onset, onset_speed, whirl_onset
from rotorcalc.typing import Array

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

# Film models whose k and c depend on σ alone, so that one curve serves every bearing.
_ONE_CURVE = frozenset({"short"})
# Modified Sommerfeld numbers between which a root is bracketed. Below no film can whirl, above it
# is all but centred, where the left side of the equation grows as σ².
_SIGMA = np.geomspace(1e-3, 1e3, 241)
_ROOT: Any = {"xatol": 0.0, "xrtol": 1e-15, "fatol": 0.0, "frtol": 0.0}
# From so many machines on their onsets are sooner found together than one by one.
_FLEET = 4
# Blocks of rows, or one more, by which a map that is not solved in one go tells its progress.
_BLOCKS = 3
# Values at which `solve_onset` looks before it closes in: where the onset is cheap, where not.
_SCAN, _SLOW_SCAN = 200, 24
# An onset this near to the target, relative, is the target.
_HIT = 1e-6


@dataclass(frozen=True, eq=False)
class OnsetMap:
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
    """

    onset: float
    inputs: tuple[Sensitivity, ...]


@dataclass(frozen=True, eq=False)
class OnsetSolution:
    """The values of one input that put the onset at a speed.

    Attributes
    ----------
    field : str
        The input.
    target : float
        Onset speed asked for [rad/s].
    solutions : array, (k,)
        All values that give it, rising; none where the onset never takes the target's value.
    values, onset : array, (n,)
        Values over the range that was searched, and the onset there [rad/s].
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


def value_of(machine: Machine, field: str) -> float:
    """Return the value of an input.

    Parameters
    ----------
    machine : Machine
        The machine.
    field : str
        The input, "bearing.radial_clearance" or "radial_clearance".

    Returns
    -------
    float
        Its value in SI; for a load that follows the rotor's weight, half that weight.

    Raises
    ------
    ValueError
        Where there is no such input.
    """
    record, name = _address(field)
    if name == "load":
        return machine.static_load
    return float(getattr(getattr(machine, record) if record else machine, name))


def varied(machine: Machine, values: Mapping[str, float]) -> Machine:
    """Return a machine with other values of some inputs.

    Parameters
    ----------
    machine : Machine
        The machine; a load of None goes on following the rotor's mass.
    values : mapping of str to float
        Inputs and their values in SI.

    Returns
    -------
    Machine
        The other machine.

    Raises
    ------
    ValueError
        Where there is no such input, or the values make no machine.

    Examples
    --------
    >>> from rotorcalc import PRESETS
    >>> varied(PRESETS["sheet-1e8"].machine, {"radial_clearance": 80e-6}).bearing.radial_clearance
    8e-05
    """
    changes: dict[str, dict[str, float]] = {}
    for field, value in values.items():
        record, name = _address(field)
        changes.setdefault(record, {})[name] = value
    own = changes.pop("", {})
    records = {record: replace(getattr(machine, record), **new) for record, new in changes.items()}
    return replace(machine, **own, **records)


def has_closed_form(machine: Machine) -> bool:
    """Return whether Eqs. 5.45 to 5.50 give the machine's onset, and no eigenvalues are needed."""
    rotor = machine.rotor
    massless = rotor.journal_mass == 0.0 or rotor.is_rigid
    return massless and rotor.disk_damping == 0.0 and machine.bearing.film in _ONE_CURVE


def closed_form_onset(machine: Machine, *, flexible: bool = True) -> Onset:
    """Return the onset of a machine by the module's equation, without its eigenvalues.

    Parameters
    ----------
    machine : Machine
        A machine with `has_closed_form`; with a rigid shaft it may have journal mass.
    flexible : bool
        Whether the shaft bends; a rigid shaft never does.

    Returns
    -------
    Onset
        As `onset_speed` gives it.

    Raises
    ------
    ValueError
        Where the machine has midspan damping, or journal mass on a shaft that bends.
    """
    if not flexible:
        machine = replace(machine, rotor=replace(machine.rotor, shaft_stiffness=math.inf))
    if not has_closed_form(machine):
        raise ValueError("no closed form for a machine with midspan damping or journal mass")
    M, K_rot, F, s, C = _numbers(machine)
    if F == 0.0:
        return Onset(speed=0.0, whirl_frequency=0.0, eccentricity_ratio=0.0)
    film, sag, wanted = machine.bearing.film, F / (K_rot * C), s**2 / (M * C * F)
    low, high = _bracket(film, sag=np.array([sag]), wanted=np.array([wanted]))
    sigma = narrow_root(lambda sigma: _residual(film, sigma, sag, wanted), low[0], high[0])
    state = film_state(machine.bearing, sigma)
    speed = sigma * F / s
    return Onset(
        speed=speed,
        whirl_frequency=float(whirl_onset(state.k, state.c).whirl_ratio) * speed,
        eccentricity_ratio=float(state.eccentricity_ratio),
    )


def onset_speeds(machines: Sequence[Machine]) -> Array:
    """Return the onset speeds of many machines.

    Parameters
    ----------
    machines : sequence of Machine, n
        The machines.

    Returns
    -------
    array, (n,)
        Onset speed, Ω_s [rad/s], as `onset_speed` gives it for each.

    Raises
    ------
    RuntimeError
        Where the search does not end.
    """
    speeds = np.full(len(machines), np.nan)
    films: dict[str, list[int]] = {}
    others: list[int] = []
    for i, machine in enumerate(machines):
        if has_closed_form(machine):
            films.setdefault(machine.bearing.film, []).append(i)
        elif machine.bearing.film in _ONE_CURVE:
            others.append(i)
    for indices in films.values():
        speeds[indices] = _closed_onsets([machines[i] for i in indices])
    if len(others) >= _FLEET:
        speeds[others] = sure_onsets([machines[i] for i in others])
    for i, machine in enumerate(machines):
        if math.isnan(speeds[i]):
            speeds[i] = onset_speed(machine).speed
    return speeds


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
    if _address(x) == _address(y):
        raise ValueError(f"y = {y!r}: must differ from x")
    xs, ys = np.asarray(xs, dtype=float), np.asarray(ys, dtype=float)
    rows = [[_machine_or_none(machine, {x: a, y: b}) for a in xs] for b in ys]
    made = [row_machine for row in rows for row_machine in row if row_machine is not None]
    whole = all(has_closed_form(one) for one in made)
    speed = np.empty((len(ys), len(xs)))
    # In one go where that is cheapest, else by blocks of rows, so that the progress can be told.
    height = max(1, len(ys) if whole else len(ys) // _BLOCKS)
    for top in range(0, len(ys), height):
        part = slice(top, top + height)
        speed[part] = _onsets_where_made(rows[part])
        if progress is not None:
            progress(min(1.0, (top + height) / len(ys)))
    return OnsetMap(x=x, y=y, xs=xs, ys=ys, speed=speed)


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
        The inputs. One at zero or infinite has no share of its value and is left out.

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
    steps = [step for step in moved if step[1] < step[2] < np.inf]
    machines = [
        varied(machine, {field: value}) for field, low, high in steps for value in (low, high)
    ]
    onset, *onsets = onset_speeds([machine, *machines])
    found = [
        Sensitivity(field, low, high, float(onset_low), float(onset_high))
        for (field, low, high), onset_low, onset_high in zip(
            steps, onsets[::2], onsets[1::2], strict=True
        )
    ]
    return Sensitivities(
        onset=float(onset),
        inputs=tuple(sorted(found, key=lambda one: _movement(one, float(onset)), reverse=True)),
    )


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
    if not low < high:
        raise ValueError(f"high = {high}: must be greater than low, {low}")

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


@functools.cache
def _address(field: str) -> tuple[str, str]:
    """Return the record and the name of an input; the machine's own record is ""."""
    known = {
        (record, item.name)
        for record, cls in (
            ("", Machine),
            ("oil", Oil),
            ("bearing", JournalBearing),
            ("rotor", Rotor),
        )
        for item in fields(cls)
        if item.name not in ("oil", "bearing", "rotor", "film")
    }
    record, _, name = field.rpartition(".")
    for address in known:
        if address == (record, name) or (not record and address[1] == name):
            return address
    names = ", ".join(sorted(".".join(filter(None, address)) for address in known))
    raise ValueError(f"{field[:80]!r}: no input of a machine; known are {names}")


def _machine_or_none(machine: Machine, values: Mapping[str, float]) -> Machine | None:
    try:
        return varied(machine, values)
    except ValueError:
        for field in values:
            _address(field)  # an unknown input is an error, values that make no machine are not
        return None


def _onsets_where_made(rows: Sequence[Sequence[Machine | None]]) -> Array:
    made = np.array([[one is not None for one in row] for row in rows], dtype=bool)
    speed = np.full(made.shape, np.nan)
    speed[made] = onset_speeds([one for row in rows for one in row if one is not None])
    return speed


def _closed_onsets(machines: Sequence[Machine]) -> Array:
    """Return the onsets of machines with one film model and a closed form."""
    numbers = np.array([_numbers(machine) for machine in machines])
    speeds = np.zeros(len(machines))  # without load the onset is at speed 0
    loaded = numbers[:, 2] > 0.0
    M, K_rot, F, s, C = numbers[loaded].T
    sigma = _root(machines[0].bearing.film, sag=F / (K_rot * C), wanted=s**2 / (M * C * F))
    speeds[loaded] = sigma * F / s
    return speeds


def _numbers(machine: Machine) -> tuple[float, ...]:
    """Return M, K_rot, F_o, s = σF_o/Ω, C of a machine."""
    bearing, rotor = machine.bearing, machine.rotor
    L, C = bearing.length, bearing.radial_clearance
    s = machine.viscosity * L * bearing.radius * (L / C) ** 2 / 4.0
    return rotor.half_mass, rotor.shaft_stiffness, machine.static_load, s, C


def _root(film: str, *, sag: Array, wanted: Array) -> Array:
    """Return the lowest σ at which the left side of the module's equation is the right one."""

    def residual(sigma: Array, sag: Array, wanted: Array) -> Array:
        return _residual(film, sigma, sag, wanted)

    bracket = _bracket(film, sag=sag, wanted=wanted)
    # The stubs lack what find_root returns for arrays of arguments.
    found: Any = elementwise.find_root(residual, bracket, args=(sag, wanted), tolerances=_ROOT)
    if not np.all(found.success):
        raise RuntimeError("no onset found within the search's iterations")
    return np.asarray(found.x, dtype=float)


def _bracket(film: str, *, sag: Array, wanted: Array) -> tuple[Array, Array]:
    """Return σ below and above the root, where the left side first passes the right one."""
    rigid, flexible = _curve(film)
    table = rigid + sag[:, None] * flexible
    first = np.argmax(table >= wanted[:, None], axis=1)
    beyond = table[:, -1] < wanted  # where the film is centred
    far = 2.0 * _SIGMA[-1] * np.sqrt(wanted / table[:, -1])
    low = np.where(beyond, _SIGMA[-1], _SIGMA[np.maximum(first - 1, 0)])
    high = np.where(beyond, far, _SIGMA[first])
    return low, high


def _residual(film: str, sigma: Any, sag: Any, wanted: Any) -> Any:
    """Return how far the left side is above the right one, relative; of floats or arrays."""
    rigid, flexible = _left_side(film, sigma)
    return (rigid + sag * flexible) / wanted - 1.0


@functools.cache
def _curve(film: str) -> tuple[Array, Array]:
    return _left_side(film, _SIGMA)


def _left_side(film: str, sigma: Array) -> tuple[Array, Array]:
    """Return σ²/p_s² and σ²ω̄², the two terms of the module's equation."""
    any_bearing = JournalBearing(diameter=1.0, length=1.0, radial_clearance=1.0, film=film)
    k, c = film_coefficients(any_bearing, sigma)
    onset = whirl_onset(k, c)  # p_s² in film units, not in the load's
    return sigma / (4.0 * onset.critical_mass), (sigma * onset.whirl_ratio) ** 2


def _moved(machine: Machine, field: str, share: float) -> tuple[str, float, float]:
    """Return an input with the values to which it is moved, down and up."""
    value = value_of(machine, field)
    if _address(field)[1] in ("temperature", "reference_temperature"):
        return field, value - TEMPERATURE_STEP, value + TEMPERATURE_STEP
    return field, value * (1.0 - share), value * (1.0 + share)


def _movement(one: Sensitivity, onset: float) -> float:
    """Return the larger of an input's two movements of the onset; 0 from infinite to infinite."""
    ends = (one.onset_low, one.onset_high)
    return max(0.0 if end == onset else abs(end - onset) for end in ends)


def _scan_values(machine: Machine, field: str, low: float, high: float) -> Array:
    ends = [varied(machine, {field: value}) for value in (low, high)]
    points = _SCAN if all(has_closed_form(end) for end in ends) else _SLOW_SCAN
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
