"""Texts on charts: quantities with their unit, hover texts, remarks."""

from typing import Any

from numpy.typing import ArrayLike

from rotorcalc.figures import style
from rotorcalc.units import Unit


def amount(unit: Unit, value: ArrayLike) -> str:
    """Return an SI value in a unit, to at least four digits, with the unit's name."""
    number = float(unit.of(value))
    # Four digits would turn 25000 into 2.5e+04: from 1e4 on an integer reads better.
    words = f"{number:.0f}" if 1e4 <= abs(number) < 1e7 else f"{number:.4g}"
    return f"{words} {unit.name}".replace("-", "−")


def hover(place: str, unit: Unit) -> str:
    """Return a line's hover text: `place`, the value with its unit, the line's name."""
    name = "" if unit.name == "-" else f" {unit.name}"
    return f"{place}<br>%{{y:.4g}}{name}<extra>%{{fullData.name}}</extra>"


def remark(text: str, x: float, y: float, **extra: Any) -> dict[str, Any]:
    """Return a text that ends at a point given in fractions of the plot."""
    return style.note(text, x, y, **{"xanchor": "right", **extra})
