"""Texts on charts: quantities with their unit, hover texts, remarks."""

from typing import Any

from numpy.typing import ArrayLike

from rotorcalc.figures import style
from rotorcalc.units import Unit

# Prefixes by the number from which on they are used; the units that take them.
_PREFIXES = {"M": 1e7, "k": 1e4}
_PREFIXED = {"N"}
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def amount(unit: Unit, value: ArrayLike) -> str:
    """Return an SI value in a unit, to at least four digits, with the unit's name: 1334 N, 20 kN.

    An angle's sign follows its number without a space.
    """
    shown = float(unit.of(value))
    if unit.name == "°":
        return f"{number(shown)}°"
    for prefix, size in _PREFIXES.items():
        if unit.name in _PREFIXED and abs(shown) >= size:
            return f"{number(shown / (size / 10.0))} {prefix}{unit.name}"
    return f"{number(shown)} {unit.name}"


def number(value: float, digits: int = 4) -> str:
    """Return a number to a few digits: 25000 whole, 2.5·10⁷ and 4·10⁻⁶ with powers of ten."""
    if 1e3 <= abs(value) < 1e7:
        return f"{value:.0f}".replace("-", "−")
    mantissa, _, power = f"{value:.{digits}g}".partition("e")
    tens = f"·10{str(int(power)).translate(_RAISED)}" if power else ""
    return mantissa.replace("-", "−") + tens


def hover(place: str, unit: Unit) -> str:
    """Return a line's hover text: `place`, the value with its unit, the line's name."""
    name = "" if unit.name == "-" else f" {unit.name}"
    return f"{place}<br>%{{y:.4g}}{name}<extra>%{{fullData.name}}</extra>"


def remark(text: str, x: float, y: float, **extra: Any) -> dict[str, Any]:
    """Return a text that ends at a point given in fractions of the plot."""
    return style.note(text, x, y, **{"xanchor": "right", **extra})
