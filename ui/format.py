"""Numbers as readers see them, with digits, unit, in LaTeX; and what a visitor typed, harmless."""

import math
import reprlib

from numpy.typing import ArrayLike

from rotorcalc.units import Unit


def digits(value: float) -> str:
    """Return a number to four digits, whole from a thousand to a million."""
    if 1e3 <= abs(value) < 1e6:
        return f"{value:.0f}"
    return f"{value:.4g}"


def amount(unit: Unit, value: ArrayLike) -> str:
    """Return an SI value in a unit, with the unit's name."""
    return f"{digits(float(unit.of(value)))} {unit.name}"


def minus(text: str) -> str:
    """Return a number with the sign that print uses for minus."""
    return text.replace("-", "−") if any(c.isdigit() for c in text) else text


def tex(value: float, unit: str = "") -> str:
    """Return a number in LaTeX, to four digits, with its SI unit."""
    if math.isnan(value):
        return r"\text{none}"
    if math.isinf(value):
        return r"\infty"
    mantissa, _, power = digits(value).partition("e")
    number = mantissa + (rf"\cdot 10^{{{int(power)}}}" if power else "")
    words = unit.replace(" ", r"\,")
    return number + (rf"\ \mathrm{{{words}}}" if unit else "")


def quoted(word: object) -> str:
    """Return what a visitor typed, short, and with nothing that a page could take for markup."""
    text = reprlib.repr(word).replace("`", "'")
    return f"`{text}`"


def typed_number(word: object) -> float:
    """Return what a visitor wrote as a number, or raise ValueError in words.

    Infinity is written as such: a number too large for this program is not meant so.
    """
    try:
        value = float(str(word))
    except ValueError:
        raise ValueError("is not a number") from None
    if math.isinf(value) and any(digit.isdigit() for digit in str(word)):
        raise ValueError("is too large a number for this program")
    return value
