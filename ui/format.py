"""Display of numbers, with digits and unit, in LaTeX; and safe display of a visitor's input."""

import math
import reprlib

from numpy.typing import ArrayLike

from rotorcalc.units import Unit


def digits(value: float) -> str:
    """Return a number to four digits, whole from a thousand to a million."""
    # 12345 rpm reads more easily than 1.234e+04.
    if 1e3 <= abs(value) < 1e6:
        return f"{value:.0f}"
    return f"{value:.4g}"


def amount(unit: Unit, value: ArrayLike) -> str:
    """Return an SI value in a unit, with the unit's name."""
    return f"{minus(digits(float(unit.of(value))))} {unit.name}"


def minus(text: str) -> str:
    """Return a number with a typographic minus sign."""
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


def display(tex: str) -> str:
    """Return LaTeX as an equation on lines of its own, Markdown."""
    return f"$$\n{tex}\n$$"


def quoted(word: object) -> str:
    """Return a visitor's input, shortened and without markup."""
    # In backticks Markdown is text; a backtick of the visitor's own would end them.
    text = reprlib.repr(word).replace("`", "'")
    return f"`{text}`"


def literal(message: str, most: int = 400) -> str:
    """Return a message that may hold a visitor's input, whole up to a length, without markup."""
    shown = message if len(message) <= most else f"{message[:most]} …"
    return f"`{' '.join(shown.split()).replace('`', chr(39))}`"


def typed_number(word: object) -> float:
    """Return a visitor's input as a number, or raise ValueError with a clear message.

    Infinity is written as such: a number too large for this program is not meant so.
    """
    try:
        value = float(str(word))
    except ValueError:
        raise ValueError("is not a number") from None
    # float("1e999") is infinite too, which for a shaft would mean rigid.
    if math.isinf(value) and any(digit.isdigit() for digit in str(word)):
        raise ValueError("is too large a number for this program")
    return value
