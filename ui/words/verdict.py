"""One sentence: whether the machine is stable, its onset speed, and how it whirls."""

import math
from dataclasses import dataclass
from typing import Literal

from rotorcalc.units import Units
from ui.computed import Computed
from ui.format import above, amount, digits, lower
from ui.preview import Kind, Text
from ui.results.stability import fastest_growing
from ui.ring import has_ring
from ui.words import validity
from ui.words.citation import without_load
from ui.words.own import begins_unstable
from ui.words.ring import BEYOND


@dataclass(frozen=True)
class Verdict:
    """A sentence and its level: "outside" where the model does not hold for the machine."""

    level: Literal["stable", "unstable", "outside"]
    sentence: str


_SHOWN_AS: dict[str, Kind] = {"stable": "success", "unstable": "error", "outside": "warning"}

_NO_ONSET = "the speed at which it becomes unstable could not be computed."
_COARSE = "Coarse mesh: K and C to some 4 %"


def text(computed: Computed, units: Units) -> Text:
    """Return the verdict as a page shows it, with the headline of the model's assumptions."""
    judged = verdict(computed, units)
    draft = f" :orange-badge[{_COARSE}]" if _is_coarse(computed) else ""
    words = f"{judged.sentence}{_marked(computed)} {validity.badge(computed)}{draft}"
    return Text(words, _SHOWN_AS[judged.level])


def beside(computed: Computed) -> str:
    """Return in plain words what the page says beside its verdict, for the report."""
    draft = f" {_COARSE}." if _is_coarse(computed) else ""
    return f"{validity.headline(computed)}.{_marked(computed)}{draft}"


def _marked(computed: Computed) -> str:
    marked = computed.is_outside or computed.onset_is_outside
    return " Numbers in brackets lie outside the model's range." if marked else ""


def _is_coarse(computed: Computed) -> bool:
    return computed.machine.bearing.model == "coarse"


def verdict(computed: Computed, units: Units) -> Verdict:
    """Return the verdict on a machine at its running speed."""
    level = "stable" if computed.is_stable else "unstable"
    sentence = _sentence(computed, units)
    if not computed.is_outside:
        return Verdict(level, sentence)
    return Verdict(
        "outside",
        "No verdict: the model does not hold for this machine. By the model it is "
        f"{lower(sentence)}",
    )


def _sentence(computed: Computed, units: Units) -> str:
    running = amount(units.speed, computed.speed)
    if computed.is_stable:
        return f"Stable at {running}: {_outlook(computed, units)}"
    often = f" {BEYOND}" if has_ring(computed) else ""
    if computed.onset.speed == 0.0:
        return (
            f"Unstable at {running}: {without_load(computed)}, and the machine whirls at any "
            f"speed.{often}"
        )
    return f"Unstable at {running}: {_past(computed, units)}{often}"


def _outlook(computed: Computed, units: Units) -> str:
    onset = computed.onset
    if math.isinf(onset.speed):
        return _never(computed, units)
    if math.isnan(onset.speed):
        return _NO_ONSET
    if onset.speed > computed.speed:
        margin = above(onset.speed / computed.speed)
        beyond = " (outside the model's range)" if computed.onset_is_outside else ""
        where = f"{amount(units.speed, onset.speed)}{beyond}, {margin}"
        # Short: with the model's badge it stands in one line of 960 pixels.
        return f"it becomes unstable at {where}{_whirl(computed, units, ', whirling')}."
    if onset.speed == 0.0:
        return "it is above its range of whirl, which begins at the slowest speed searched."
    return (
        f"it is above its range of whirl, which begins at {amount(units.speed, onset.speed)}"
        f"{_whirl(computed, units, ', where it whirls')}."
    )


def _never(computed: Computed, units: Units) -> str:
    """Return that no onset was found, and up to which speed, where the search ended."""
    if not computed.onset_is_unknown:
        return "no speed makes this machine whirl."
    limit = amount(units.speed, computed.onset.searched_to)
    if computed.has_own:
        return f"no whirl up to {limit}, where its own coefficients end."
    if computed.machine.supply is None:
        return f"no whirl up to {limit}, the highest speed searched."
    return f"no whirl up to {limit}; above, the oil supplied is too little to carry the heat."


def _past(computed: Computed, units: Units) -> str:
    onset, growing = computed.onset, fastest_growing(computed)
    now = f"{_growing(computed, growing, units)}; " if growing.real > 0.0 else ""
    if math.isinf(onset.speed):
        return f"{now}no onset was found."
    if math.isnan(onset.speed):
        return f"{now}{_NO_ONSET}"
    if begins_unstable(computed):
        first = amount(units.speed, onset.speed)
        return f"{now}it is so from {first} on, where its own coefficients begin."
    below = digits((1.0 - onset.speed / computed.speed) * 100.0)
    return f"{now}it became unstable at {amount(units.speed, onset.speed)}, {below} % below."


def _growing(computed: Computed, value: complex, units: Units) -> str:
    """Return how the unstable mode whirls, which is not as the machine whirls at its onset."""
    return (
        f"it whirls at {_frequency(value.imag, units)}, {value.imag / computed.speed:.3g} of the "
        f"running speed, growing at {amount(units.growth, value.real)}"
    )


def _whirl(computed: Computed, units: Units, words: str) -> str:
    """Return after some words how it whirls at an onset above 0; nothing where that is unknown."""
    speed, frequency = computed.onset.speed, computed.onset.whirl_frequency
    if not frequency > 0.0:
        return ""
    return f"{words} at {_frequency(frequency, units)}, {frequency / speed:.3g} of that speed"


def _frequency(value: float, units: Units) -> str:
    return f"{amount(units.speed, value)} ({amount(units.frequency, value)})"
