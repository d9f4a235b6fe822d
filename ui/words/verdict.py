"""One sentence: is the machine stable, where does it go unstable, and how does it whirl there."""

import math
from dataclasses import dataclass
from typing import Literal

from rotorcalc.units import Units
from ui.computed import View
from ui.results import digits


@dataclass(frozen=True)
class Verdict:
    """A sentence, and whether it is good news."""

    level: Literal["stable", "unstable"]
    sentence: str


def verdict(view: View, units: Units) -> Verdict:
    """Return the verdict on a machine at its running speed."""
    running = _speed(view.speed, units)
    if view.is_stable:
        return Verdict("stable", f"Stable at {running}: {_outlook(view, units)}")
    if view.unloaded:
        return Verdict(
            "unstable",
            f"Unstable at {running}: without load the film has no direct stiffness (Eq. 5.37), and "
            "the machine whirls at any speed.",
        )
    return Verdict("unstable", f"Unstable at {running}: {_past(view, units)}")


def _outlook(view: View, units: Units) -> str:
    onset = view.onset
    if math.isinf(onset.speed):
        return "no speed makes this machine whirl."
    if onset.speed > view.speed:
        margin = (onset.speed / view.speed - 1.0) * 100.0
        where = f"{_speed(onset.speed, units)}, {digits(margin)} % above"
        return f"it goes unstable at {where}, {_whirl(view, units)}."
    return (
        f"it is past its range of whirl, which begins at {_speed(onset.speed, units)}, "
        f"{_whirl(view, units)}."
    )


def _past(view: View, units: Units) -> str:
    onset = view.onset
    excess = (1.0 - onset.speed / view.speed) * 100.0
    where = f"{_speed(onset.speed, units)}, {digits(excess)} % below"
    return f"it went unstable at {where}, {_whirl(view, units)}."


def _whirl(view: View, units: Units) -> str:
    onset = view.onset
    frequency = digits(float(units.frequency.of(onset.whirl_frequency)))
    ratio = onset.whirl_frequency / onset.speed if onset.speed > 0.0 else math.nan
    return (
        f"and then whirls at {_speed(onset.whirl_frequency, units)} "
        f"({frequency} {units.frequency.name}), {ratio:.3f} of that speed"
    )


def _speed(speed: float, units: Units) -> str:
    return f"{digits(float(units.speed.of(speed)))} {units.speed.name}"
