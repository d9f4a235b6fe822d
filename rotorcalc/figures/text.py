"""Words on charts: amounts with their unit, what a pointer reads, remarks."""

from typing import Any

from numpy.typing import ArrayLike

from rotorcalc.figures import style
from rotorcalc.units import Unit


def amount(unit: Unit, value: ArrayLike) -> str:
    """Return an SI value in a unit, to four digits or more, with the unit's name."""
    number = float(unit.of(value))
    words = f"{number:.0f}" if 1e4 <= abs(number) < 1e7 else f"{number:.4g}"
    return f"{words} {unit.name}".replace("-", "−")


def hover(place: str, unit: Unit) -> str:
    """Return what a pointer on a line reads: `place`, the value with its unit, the line's name."""
    name = "" if unit.name == "-" else f" {unit.name}"
    return f"{place}<br>%{{y:.4g}}{name}<extra>%{{fullData.name}}</extra>"


def remark(text: str, x: float, y: float, **extra: Any) -> dict[str, Any]:
    """Return a text whose right end is at a place given in fractions of the plot."""
    return style.note(text, x, y, **{"xanchor": "right", **extra})
