"""One sentence: whether the machine is stable, its onset speed, and its whirl frequency there."""

import math
from dataclasses import dataclass
from typing import Literal

from rotorcalc.units import Units
from ui.computed import Computed
from ui.format import amount, digits
from ui.words.citation import without_load


@dataclass(frozen=True)
class Verdict:
    """A sentence and its level."""

    level: Literal["stable", "unstable"]
    sentence: str


def verdict(computed: Computed, units: Units) -> Verdict:
    """Return the verdict on a machine at its running speed."""
    running = amount(units.speed, computed.speed)
    if computed.is_stable:
        return Verdict("stable", f"Stable at {running}: {_outlook(computed, units)}")
    if computed.onset.speed == 0.0:
        return Verdict(
            "unstable",
            f"Unstable at {running}: {without_load(computed)}, and the machine whirls at any "
            "speed.",
        )
    return Verdict("unstable", f"Unstable at {running}: {_past(computed, units)}")


def _outlook(computed: Computed, units: Units) -> str:
    onset = computed.onset
    if math.isinf(onset.speed):
        return "no speed makes this machine whirl."
    if onset.speed > computed.speed:
        margin = (onset.speed / computed.speed - 1.0) * 100.0
        where = f"{amount(units.speed, onset.speed)}, {digits(margin)} % above"
        return f"it goes unstable at {where}, {_whirl(computed, units)}."
    return (
        f"it is above its range of whirl, which begins at {amount(units.speed, onset.speed)}, "
        f"{_whirl(computed, units)}."
    )


def _past(computed: Computed, units: Units) -> str:
    onset = computed.onset
    excess = (1.0 - onset.speed / computed.speed) * 100.0
    where = f"{amount(units.speed, onset.speed)}, {digits(excess)} % below"
    return f"it went unstable at {where}, {_whirl(computed, units)}."


def _whirl(computed: Computed, units: Units) -> str:
    onset = computed.onset
    frequency = amount(units.frequency, onset.whirl_frequency)
    ratio = onset.whirl_frequency / onset.speed if onset.speed > 0.0 else math.nan
    return (
        f"and then whirls at {amount(units.speed, onset.whirl_frequency)} "
        f"({frequency}), {ratio:.3f} of that speed"
    )
