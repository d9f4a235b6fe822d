"""Units of speed, stiffness and damping as headers of tables spell them."""

import re
from collections.abc import Iterable
from typing import Literal, TypeAlias

from scipy import constants
from scipy.constants import inch, kgf, lbf

from rotorcalc.units import Unit, rpm

Quantity: TypeAlias = Literal["speed", "stiffness", "damping", "angle", "number"]
SI_NAMES: dict[Quantity, str] = {
    "speed": "rad/s", "stiffness": "N/m", "damping": "N·s/m", "angle": "rad", "number": "-",
}  # fmt: skip

_PER_INCH = lbf / inch
# Value in SI of one of each, and its spellings; the first is the one shown.
_KNOWN: dict[Quantity, tuple[tuple[float, tuple[str, ...]], ...]] = {
    "speed": (
        (1.0, ("rad/s", "rad/sec", "rads/s", "1/s", "s-1")),
        (rpm, ("rpm", "r/min", "rev/min", "1/min", "min-1", "U/min", "cpm")),
        (1e3 * rpm, ("krpm",)),
        (2.0 * constants.pi, ("Hz", "rps", "rev/s", "rev/sec", "cps")),
    ),
    "stiffness": (
        (1.0, ("N/m",)),
        (1e3, ("kN/m", "N/mm")),
        (1e6, ("MN/m", "kN/mm", "N/µm", "N/um")),
        (1e9, ("GN/m", "MN/mm", "kN/µm", "kN/um")),
        (_PER_INCH, ("lbf/in", "lb/in", "lbs/in", "lbf/inch", "lb/inch")),
        (1e3 * _PER_INCH, ("klbf/in", "klb/in", "kip/in")),
        (1e6 * _PER_INCH, ("Mlbf/in", "Mlb/in")),
        (kgf / 1e-3, ("kgf/mm",)),
    ),
    "damping": (
        (1.0, ("N·s/m", "N/(m/s)", "N-sec/m", "kg/s")),
        (1e3, ("kN·s/m", "N·s/mm", "kN/(m/s)")),
        (1e6, ("MN·s/m", "kN·s/mm", "N·s/µm", "N·s/um")),
        (1e9, ("GN·s/m",)),
        (_PER_INCH, ("lbf·s/in", "lb·s/in", "lbf·sec/in", "lb·sec/in", "lb·s/inch", "lbs·s/in")),
        (1e3 * _PER_INCH, ("klbf·s/in", "klb·s/in", "kip·s/in")),
        (kgf / 1e-3, ("kgf·s/mm",)),
    ),
    "angle": ((1.0, ("rad",)), (constants.degree, ("°", "deg", "degree", "degrees"))),
    "number": ((1.0, ("-", "1", "dimensionless")),),
}


def _plain(spelling: str) -> str:
    """Return a spelling without signs of multiplication, spaces and brackets."""
    if spelling.strip() in ("-", "—", "−"):
        return "-"
    return re.sub(r"[\s·⋅*.^()\[\]−-]", "", spelling.replace("μ", "µ"))


_UNITS: dict[Quantity, dict[str, Unit]] = {
    quantity: {
        _plain(spelling): Unit(spellings[0], 1.0 / factor, in_si=factor)
        for factor, spellings in known
        for spelling in spellings
    }
    for quantity, known in _KNOWN.items()
}


def names(quantity: Quantity) -> list[str]:
    """Return the units of a quantity, by the spelling shown."""
    return [spellings[0] for _, spellings in _KNOWN[quantity]]


def unit_of(quantity: Quantity, spelling: str) -> Unit | None:
    """Return the unit of a spelling, None where it is none of this quantity."""
    wanted, known = _plain(spelling[:40]), _UNITS[quantity]
    if wanted in known:
        return known[wanted]
    # In small or capital letters alone: "RPM", "LB/IN"; a milli is no mega, though.
    alike = {name: unit for name, unit in known.items() if name.lower() == wanted.lower()}
    fits = [unit for name, unit in alike.items() if not (wanted[:1] == "m" and name[:1] == "M")]
    return fits[0] if len({unit.name for unit in fits}) == 1 else None


def wrong(quantity: Quantity, spelling: str) -> str:
    """Return in words that a spelling is no unit of a quantity."""
    return f"{spelling[:40]!r}: no unit of {quantity}; known are {', '.join(names(quantity))}"


def is_unit(spelling: str) -> bool:
    """Return whether a spelling is a unit of anything here."""
    return any(unit_of(quantity, spelling) for quantity in _KNOWN)


def marks(texts: Iterable[str]) -> dict[str, str]:
    """Return the first text with pounds or inches in it under "lb", with revolutions under "rpm".

    So ROSS tells the units of a sheet: by a word in any of its cells.
    """
    found: dict[str, str] = {}
    for text in texts:
        words = text.lower()
        if "lb" not in found and re.search(r"inch|\blb|lbf|lbm", words):
            found["lb"] = text
        if "rpm" not in found and "rpm" in words:
            found["rpm"] = text
    return found
