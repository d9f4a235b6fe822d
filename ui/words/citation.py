"""Where what a page shows comes from: the film's own sources, and equations that hold on any film.

The only place that writes equation numbers of a film into a caption.
"""

import math
import re

from rotorcalc.films import film_of
from rotorcalc.films.model import Source
from ui.computed import Computed
from ui.format import digits

_NUMBERED = re.compile(r"(Eq|Fig)s?\. (.+)")


def source(computed: Computed, name: str) -> Source | None:
    """Return a film's source of a result, None where it names none."""
    return film_of(computed.machine.bearing).sources.get(name)


def film(computed: Computed) -> str:
    """Return what the film's model is, in words."""
    model, found = computed.machine.bearing.model, source(computed, "film")
    return found.equation if found else f"{model}, of a bearing of another kind than the notes'"


def solution(computed: Computed) -> str:
    """Return in words what was solved for the film, its boundary condition, mesh and accuracy."""
    found = film_of(computed.machine.bearing).accuracy(float(computed.point.sommerfeld))
    words = f"{capital(film(computed))}."
    if found is None:
        return words
    words = f"{words} Mesh: {found.mesh}, with splines between them."
    if math.isnan(found.place):
        return words
    place = digits(float(f"{found.place:.1g}"))
    K, C = (digits(float(f"{100.0 * one:.1g}")) for one in (found.stiffness, found.damping))
    return (
        f"{words} A mesh about twice as fine puts the journal {place} C from there, and changes K "
        f"by {K} % and C by {C} % of their largest entries."
    )


def cited(words: str, computed: Computed, *names: str, rotor: str = "") -> str:
    """Return a caption with its sources in a last sentence.

    `names` are results of the film; `rotor` has the numbers of equations that hold on any film, as
    "Eq. 5.45" or "Eqs. 5.45, 5.46".
    """
    found = [one.equation for name in names if (one := source(computed, name))]
    return " ".join(part for part in (words, *_sentences([*found, rotor])) if part)


def remark(computed: Computed, name: str, words: str = "{}.", otherwise: str = "") -> str:
    """Return what holds of a result on the machine's film alone, put into words; else others."""
    found = source(computed, name)
    return capital(words.format(found.remark)) if found and found.remark else otherwise


def capital(text: str) -> str:
    """Return a text that begins with a capital; a symbol's Greek letter stays as it is."""
    first = text[:1]
    return (first.upper() if first.isascii() else first) + text[1:]


def at_one_speed(computed: Computed) -> str:
    """Return that curves over the load are those of one speed, where a film has one for each."""
    if film_of(computed.machine.bearing).curve is not None:
        return ""
    return "At the running speed, the load alone varied: this film has another curve at each speed."


def is_stiff_unloaded(computed: Computed) -> bool:
    """Return whether the film has direct stiffness, beyond rounding, without load."""
    K = computed.centred.stiffness
    return bool(abs(K[0, 0] + K[1, 1]) > 1e-9 * abs(K[0, 1] - K[1, 0]))


def without_onset(computed: Computed) -> str:
    """Return why a machine has no onset, the beginning of a sentence."""
    if not computed.onset_is_unknown:
        return "No speed makes this machine whirl"
    return f"{capital(as_far_as(computed))}, this machine does not whirl"


def as_far_as(computed: Computed) -> str:
    """Return in words up to where an onset was sought that was not found."""
    if computed.has_own:
        return "as far as its own coefficients go"
    if computed.machine.supply is not None:
        return "as far as the oil supplied carries the heat"
    return "up to the highest speed searched"


def without_load(computed: Computed) -> str:
    """Return in words why a machine whirls at any speed."""
    if not computed.unloaded or is_stiff_unloaded(computed):
        return "its film feeds a whirl however slow the shaft"
    centre = source(computed, "centre")
    return "without load the film has no direct stiffness" + (
        f" ({centre.equation})" if centre else ""
    )


def whirl_without_load(computed: Computed) -> str:
    """Return the whirl's frequency in words where the onset is at speed zero."""
    if film_of(computed.machine.bearing).inner:  # its own frequency, not the running speed, counts
        return "a share of Ω at any speed"
    ratio = float(computed.point.whirl_ratio)
    share = "½" if abs(ratio - 0.5) < 1e-6 else f"{ratio:.3g}"
    return f"{share} Ω at any speed"


def _sentences(places: list[str]) -> list[str]:
    """Return citations joined: numbers of one kind in one list, words as sentences of their own."""
    numbers: dict[str, set[str]] = {}
    words: dict[str, None] = {}
    for place in filter(None, places):
        kind = ""
        for part in place.split(", "):
            match = _NUMBERED.fullmatch(part)
            kind, number = match.groups() if match else (kind, part)
            if kind:
                numbers.setdefault(kind, set()).add(number)
            else:
                words[f"{capital(part)}."] = None
    listed = (_listed(kind, found) for kind, found in numbers.items())
    return [*([f"{', '.join(listed)}."] if numbers else []), *words]


def _listed(kind: str, numbers: set[str]) -> str:
    several = len(numbers) > 1 or " to " in next(iter(numbers))
    ordered = sorted(numbers, key=lambda number: [int(n) for n in re.findall(r"\d+", number)])
    return f"{kind}{'s' if several else ''}. {', '.join(ordered)}"
