"""Display of numbers, with digits and unit, in LaTeX; and safe display of a visitor's input."""

import math
import re
import reprlib

import numpy as np
from numpy.typing import ArrayLike

from rotorcalc.arrays import Array
from rotorcalc.units import Unit

_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_EXPONENT = re.compile(r"(?<=\d)e([+-]?\d+)\b")
# From this ratio on a multiple says more than per cent.
_MULTIPLE = 3.0


def digits(value: float) -> str:
    """Return a number to four digits, whole from a thousand on, with powers of ten far from one."""
    mantissa, power = _parts(value)
    return mantissa + (f"·10{power.translate(_RAISED)}" if power else "")


def _parts(value: float) -> tuple[str, str]:
    """Return a number to four digits, and the power of ten with which it is to be multiplied."""
    # 12345 rpm reads more easily than 1.234·10⁴.
    if 1e3 <= abs(value) < 1e6:
        return f"{value:.0f}", ""
    mantissa, _, power = f"{value:.4g}".partition("e")
    return mantissa, f"{int(power)}" if power else ""


def above(ratio: float) -> str:
    """Return in words how far a speed lies above another: in per cent, or as a multiple."""
    if ratio < _MULTIPLE:
        return f"{digits(100.0 * (ratio - 1.0))} % above"
    return f"{ratio:.3g} times as high"


def amount(unit: Unit, value: ArrayLike) -> str:
    """Return an SI value in a unit, with the unit's name."""
    return f"{minus(digits(float(unit.of(value))))} {unit.name}"


def powers(text: str) -> str:
    """Return a number as computers write it with its power of ten as people do: 1.5·10⁸."""
    return _EXPONENT.sub(lambda found: f"·10{f'{int(found[1])}'.translate(_RAISED)}", text)


def minus(text: str) -> str:
    """Return a number with a typographic minus sign."""
    return text.replace("-", "−") if any(c.isdigit() for c in text) else text


def tex(value: float, unit: str = "") -> str:
    """Return a number in LaTeX, to four digits, with its SI unit."""
    if math.isnan(value):
        return r"\text{none}"
    if math.isinf(value):
        return r"\infty"
    mantissa, power = _parts(value)
    number = mantissa + (rf"\cdot 10^{{{power}}}" if power else "")
    words = unit.replace(" ", r"\,")
    return number + (rf"\ \mathrm{{{words}}}" if unit else "")


def tex_base(value: float) -> str:
    """Return a number in LaTeX that a power can follow."""
    number = tex(value)
    return f"({number})" if "^" in number else number


def display(tex: str) -> str:
    """Return LaTeX as an equation on lines of its own, Markdown."""
    return f"$$\n{tex}\n$$"


def lower(text: str) -> str:
    """Return a text for the middle of a sentence: without its first capital, but for a name's."""
    return text if text.startswith("Reynolds") else text[:1].lower() + text[1:]


def quoted(word: object) -> str:
    """Return a visitor's input, shortened and without markup."""
    # In backticks Markdown is text; a backtick of the visitor's own would end them.
    text = reprlib.repr(word).replace("`", "'")
    return f"`{text}`"


def literal(message: str, most: int = 400) -> str:
    """Return a message that may hold a visitor's input, whole up to a length, without markup."""
    shown = message if len(message) <= most else f"{message[:most]} …"
    return f"`{' '.join(shown.split()).replace('`', chr(39))}`"


def escaped(text: str) -> str:
    """Return a text that may hold a visitor's input without markup, coefficients typeset."""
    parts = _COEFFICIENT.split(" ".join(text.split()))
    return "".join(
        f"${part[0]}_{{{part[2:]}}}$" if place % 2 else _MARKUP.sub(r"\\\g<0>", part)
        for place, part in enumerate(parts)
    )


_COEFFICIENT = re.compile(r"\b([KCM]_[xyXY]{2})\b")
_MARKUP = re.compile(r"[\\`*_{}\[\]()#+!|<>~$:&-]")


def short(value: float) -> str:
    """Return a number to six digits, as a field shows it."""
    mantissa, _, power = f"{value:.6g}".partition("e")
    return mantissa + (f"e{int(power)}" if power else "")


def typed_number(word: object) -> float:
    """Return a visitor's input as a number, or raise ValueError with a clear message.

    A decimal comma and separators of thousands are understood where only one number can be meant.
    One dot alone is a decimal point, as everywhere in this program.
    """
    meant = numbers_meant(word)
    if len(meant) > 1:
        raise ValueError(f"can mean {' or '.join(meant)}: type the one you mean")
    (written,) = meant
    value = float(written)
    if math.isinf(value) and "inf" not in written.lower():  # 1e999, for a shaft it would be rigid
        raise ValueError("is too large a number for this program")
    if value == 0.0 and re.search("[1-9]", written.lower().partition("e")[0]):
        raise ValueError("is too small a number for this program")
    return value


def numbers_meant(word: object) -> list[str]:
    """Return the numbers that a visitor's input can mean, as Python writes them.

    "2,785" means 2.785 to some readers and 2785 to others.
    """
    text = re.sub(r"\s", " ", str(word).strip()).replace("\N{MINUS SIGN}", "-")
    if text.lower().lstrip("+-") in ("inf", "infinity", "nan"):
        return [text]
    found = _NUMBER.fullmatch(text)
    sign, mantissa, power = found.groups(default="") if found else ("", "", "")
    meant = sorted(f"{sign}{reading}{power}" for reading in _readings(mantissa))
    if not meant:
        raise ValueError("is not a number")
    return meant


_NUMBER = re.compile(r"([+-]?)([0-9.,' ’_]+)(e[+-]?[0-9]+)?", re.IGNORECASE)
# 1,334.5 and 1.334,5 and 1 334,5 and 1'334.5: separator of thousands, decimal separator.
_GROUPED = [
    re.compile(
        rf"(?P<whole>[1-9][0-9]{{0,2}}(?:{thousands}[0-9]{{3}})+)({decimal}(?P<rest>[0-9]*))?"
    )
    for thousands, decimal in ((",", r"\."), (r"\.", ","), (" ", "[.,]"), ("['’_]", "[.,]"))
]


def _readings(mantissa: str) -> set[str]:
    """Return the numbers that digits with separators can mean, as Python writes them."""
    if re.fullmatch(r"[0-9]+\.?[0-9]*|\.[0-9]+", mantissa):
        return {mantissa}
    found = set[str]()
    if re.fullmatch(r"[0-9]+,[0-9]*|,[0-9]+", mantissa):
        found.add(mantissa.replace(",", "."))
    for grouped in _GROUPED:
        if match := grouped.fullmatch(mantissa):
            found.add(
                re.sub("[^0-9]", "", match["whole"])
                + "." * bool(match["rest"])
                + (match["rest"] or "")
            )
    return found


def without_noise(matrices: Array) -> Array:
    """Return matrices, (..., 2, 2), with zero for elements that are the rounding of others."""
    largest = np.abs(matrices).max(axis=(-2, -1), keepdims=True)
    return np.where(np.abs(matrices) < 1e-12 * largest, 0.0, matrices)
