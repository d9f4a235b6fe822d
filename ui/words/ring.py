"""What the pages say of a floating ring: its balance, its two films and their two whirls."""

import math

from rotorcalc.onset import ModeOnset
from rotorcalc.units import Units
from ui import ring
from ui.computed import Computed
from ui.format import amount, digits, minus
from ui.preview import Text
from ui.words import limit_cycles
from ui.words.citation import cited

# Said where a rotor on rings is past its onset.
BEYOND = "Floating rings often run so, on a limit cycle of their films: see Orbits."
_BEYOND = """
These are the onsets of small motions. Rotors on floating rings, such as turbochargers, run far
above them: the whirl grows only up to a limit cycle, on which the nonlinear films hold it.
"""
_NOT_YET = "How large it is has not been computed yet: the tab Limit cycles of Orbits does it."


def whirls(computed: Computed, units: Units) -> Text:
    """Return both whirls in a table: where each sets in, and how it is at the running speed."""
    shown = ring.whirls(computed)
    here = shown.here
    now = (
        (here.inner_whirl_ratio, here.inner_growth, here.inner_limit),
        (here.outer_whirl_ratio, here.outer_growth, here.outer_limit),
    )
    columns = [
        _column(computed, onset, tuple(float(one) for one in at), units)
        for onset, at in zip(shown.onsets, now, strict=True)
    ]
    names = (
        "Whirl in the", f"Onset [{units.speed.name}]", f"Frequency there [{units.speed.name}]",
        "× that speed", f"Frequency now [{units.speed.name}]", "× running speed",
        "Its limit, × running speed", f"Growth rate now [{units.growth.name}]",
    )  # fmt: skip
    head, *rows = zip(names, *columns, strict=True)
    lines = (head, (":--", "--:", "--:"), *rows)
    table = "\n".join(f"| {' | '.join(line)} |" for line in lines)
    return Text(f"{table}\n{_missing(shown.onsets)}{_BEYOND}{_cycle(computed, units)}")


def _missing(onsets: tuple[ModeOnset, ...]) -> str:
    """Return which onsets could not be computed."""
    hidden = [one.mode for one in onsets if math.isnan(one.speed)]
    return "".join(
        f"\nThe onset of the whirl in the {mode} is missing: rounding errors are larger there "
        "than its growth.\n"
        for mode in hidden
    )


def _cycle(computed: Computed, units: Units) -> str:
    """Return on which cycle a machine past an onset runs, where that has been computed."""
    if not 0.0 < computed.onset.speed < computed.speed:
        return ""
    branches, speed = limit_cycles.known_of_all(computed), computed.speed
    if not branches:
        return _NOT_YET
    within = [one for one in branches if one.speed.min() <= speed <= one.speed.max()]
    holding = [one for one in within if one.held_at(speed) is not None]
    if not within:
        return f"None of the limit cycles followed so far reaches {amount(units.speed, speed)}."
    # What else is said of a branch belongs beside its chart.
    return limit_cycles.held((holding or within)[0], speed, units)[0]


def _column(
    computed: Computed, onset: ModeOnset, now: tuple[float, ...], units: Units
) -> tuple[str, ...]:
    ratio, growth, limit = now
    speed, whirl = (units.speed.of(one) for one in (onset.speed, onset.whirl_frequency))
    swings = not math.isnan(ratio)
    return (
        onset.mode,
        _onset(onset, float(speed)),
        _number(float(whirl) if onset.speed > 0.0 else math.nan),
        _number(onset.whirl_ratio),
        _number(float(units.speed.of(ratio * computed.speed))),
        _number(ratio),
        digits(limit),
        minus(digits(float(units.growth.of(growth * computed.speed)))) if swings else "–",
    )


def _onset(onset: ModeOnset, shown: float) -> str:
    if math.isnan(shown):
        return "not computed"
    return "any speed" if onset.speed == 0.0 else _number(shown, "none found")


def _number(value: float, otherwise: str = "–") -> str:
    return digits(value) if math.isfinite(value) else otherwise


WHIRLS = (
    "Frequencies of the two whirls, red where they grow. The inner film's limit is half of shaft "
    "and ring together, ½(1 + r) Ω, the outer film's half of the ring's speed, ½ r Ω."
)


def balance(computed: Computed, units: Units) -> Text:
    """Return why the ring turns as it does, in a sentence."""
    found = ring.here(computed)
    T = amount(units.torque, float(found.outer.drag_torque))
    return Text(
        f"The ring turns at {digits(float(found.speed_ratio))} of the running speed: there the "
        f"inner film drives it with as much torque as the outer film resists, {T}. Both films "
        "carry the whole load."
    )


def films(computed: Computed) -> str:
    """Return the caption of the films' eccentricity ratios."""
    return cited("Each film's own, over its own clearance.", computed, "eccentricity")
