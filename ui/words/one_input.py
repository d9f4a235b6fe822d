"""One input varied alone: what is computed at which of its values, and when."""

import math
from dataclasses import dataclass

import numpy as np

from rotorcalc import Machine
from rotorcalc.arrays import Array
from rotorcalc.comparison import log_decrement
from rotorcalc.figures.design import Quantity
from rotorcalc.input_sweep import InputSweep, input_sweep
from ui.computed import Computed
from ui.frame.page import Page
from ui.jobs import cache, work
from ui.jobs.queue import SHORT
from ui.words.design import choose_input, fields_of, quantity, value_of
from ui.words.on_demand import Job, attempt, on_demand
from ui.words.studies import cost

# Values of a smooth line, of a coarse one that comes at once, and at least.
_FINE, _COARSE, _FEWEST = 61, 13, 9
# Seconds of a computation that a page makes at once, and of one on request; and what a value takes
# beside its onset.
_AT_ONCE, _MOST, _BESIDE = 1.0, 4.0, 2.5e-3

_sweeps = cache.Cached(work.input_sweep, entries=64, megabytes=4)
_quick = cache.Cached(work.input_sweep, entries=64, megabytes=4, turns=SHORT)


@dataclass(frozen=True)
class Varied:
    """An input that is varied: its key, and its axis in a visitor's units."""

    key: str
    axis: Quantity

    def values(self, machine: Machine, points: int) -> Array:
        """Return its values over the axis, a machine's own among them."""
        space = np.geomspace if self.axis.log else self._round_steps
        own = value_of(machine, self.key)
        values = space(self.axis.low, self.axis.high, points)
        if not self.axis.low <= own <= self.axis.high:
            return values
        # A value that differs from the machine's own by rounding is its own.
        return np.union1d(values[~np.isclose(values, own, rtol=1e-9, atol=0.0)], [own])

    def _round_steps(self, low: float, high: float, points: int) -> Array:
        """Return about so many values between two, in round steps of the unit shown, and both."""
        unit = self.axis.unit
        first, last = float(unit.of(low)), float(unit.of(high))
        wanted = (last - first) / (points - 1)
        if not wanted > 0.0:
            return np.array([low])
        power = 10.0 ** math.floor(math.log10(wanted))
        step = min((one * power for one in (1.0, 2.0, 2.5, 5.0, 10.0)),
                   key=lambda one: abs(math.log(one / wanted)))  # fmt: skip
        counts = np.arange(math.ceil(first / step), math.floor(last / step) + 1)
        inner = np.array([unit.to_si(float(count * step)) for count in counts])
        # An end a rounding error away from a round value is that value.
        near = 1e-6 * (high - low)
        inner = inner[(inner - low > near) & (high - inner > near)]
        return np.array([low, *inner, high])

    def seconds(self, machine: Machine) -> float:
        """Return about how long one of its values takes [s]."""
        return _BESIDE + cost(machine, (self.field(machine),))

    def points(self, machine: Machine) -> int:
        """Return at how many values a machine is computed."""
        at_once, on_request = (int(time / self.seconds(machine)) for time in (_AT_ONCE, _MOST))
        return min(at_once if at_once >= _COARSE else max(on_request, _FEWEST), _FINE)

    def field(self, machine: Machine) -> str:
        """Return the core's name of the input; ValueError where a machine has none."""
        fields = fields_of(machine)
        if self.key not in fields:
            raise ValueError(f"{self.key}: no input of this machine")
        return fields[self.key]


def choose(page: Page) -> Varied:
    """Ask which input is varied."""
    machine = page.computed.machine
    key = choose_input(machine, "Input varied", "C", "tolerances_vary")
    return Varied(key, quantity(key, machine, page.units))


def ask(page: Page, varied: Varied) -> InputSweep | None:
    """Return a machine over an input: at once where that is quick, else on request."""
    c = page.computed
    request = _request(c, varied)
    seconds = varied.seconds(c.machine) * varied.points(c.machine)
    if seconds <= _AT_ONCE:
        return attempt(lambda: _quick(*request))
    known = _sweeps.known(*request)
    if known is not None:
        return known
    job = Job(
        "Compute", "tolerances_sweep",
        f"The charts will show onset, margin, log decrement and smallest film over the "
        f"{varied.axis.words.lower()}. Each value needs a film of its own: it takes about "
        f"{math.ceil(seconds)}\u00a0s.",
    )  # fmt: skip
    return on_demand(
        page, job, ("sweep", *request),
        lambda tell: attempt(lambda: _sweeps(*request, tell=tell)),
    )  # fmt: skip


def over(c: Computed, varied: Varied) -> InputSweep:
    """Return a machine over an input, of those that are quick or computed already."""
    request = _request(c, varied)
    known = _sweeps.known(*request)
    if known is not None:
        return known
    if varied.seconds(c.machine) * varied.points(c.machine) > _AT_ONCE:
        raise ValueError("computed on request")
    return _quick(*request)


def coarse(c: Computed, varied: Varied) -> InputSweep:
    """Return a machine over fewer values of an input, for a slider that is dragged."""
    if varied.seconds(c.machine) > 2.0 * _BESIDE:
        raise ValueError("computed when the slider is released")
    values = varied.values(c.machine, _COARSE)
    return input_sweep(c.machine, vary=varied.field(c.machine), values=values, speed=c.speed)


def here(c: Computed, varied: Varied) -> InputSweep:
    """Return the machine at its own value."""
    onset = c.onset.speed
    return InputSweep(
        field=varied.field(c.machine), speed=c.speed,
        values=np.array([value_of(c.machine, varied.key)]),
        onset=np.array([onset]), margin=np.array([onset / c.speed - 1.0]),
        log_decrement=np.array([log_decrement(c.point)]),
        minimum_film_thickness=np.array([float(c.point.minimum_film_thickness)]),
    )  # fmt: skip


def _request(c: Computed, varied: Varied) -> tuple[Machine, str, tuple[float, ...], float]:
    values = varied.values(c.machine, varied.points(c.machine))
    return c.machine, varied.field(c.machine), tuple(values.tolist()), c.speed


def changes(varied: Varied, found: InputSweep) -> str:
    """Return in words between which values the machine is stable at its running speed."""
    known = ~np.isnan(found.onset)
    stable = found.onset[known] > found.speed
    if not known.any():
        return "At none of these values has the film an answer."
    if stable.all() or not stable.any():
        return (
            f"Over all these values the machine is **{'stable' if stable.all() else 'unstable'}** "
            "at its running speed."
        )
    values = found.values[known].tolist()
    flips = np.flatnonzero(stable[1:] != stable[:-1])
    between = " and ".join(
        f"between {varied.axis.text(values[i])} and {varied.axis.text(values[i + 1])}"
        for i in flips[:2]
    )
    more = f" and {len(flips) - 2} times more" if len(flips) > 2 else ""
    first, then = ("stable", "unstable") if stable[0] else ("unstable", "stable")
    rest = (
        f"**{first}** below and **{then}** above" if len(flips) == 1
        else f"**{first}** below the first change, **{then}** above it, and so on"
    )  # fmt: skip
    return f"Stability changes {between}{more}: the machine is {rest}."
