"""The columns of a table of machines: their names, and the units that a header may give.

A column is an input's full name or the end of it, "bearing.radial_clearance" or "radial_clearance",
with its unit in brackets, "radial_clearance [µm]". Besides the inputs of a machine there are a few
of its own: a name, the running speed, and what may be known in place of load, stiffness or oil.
"""

import functools
import re
from dataclasses import dataclass

from scipy import constants
from scipy.constants import bar, inch, lb, lbf, liter, mil, minute, psi, zero_Celsius

from rotorcalc.machine import Machine
from rotorcalc.records import Bound, Grid, Kind, Record, rules
from rotorcalc.units import Unit, rpm

_REYN = lbf / inch**2
_FOOT = constants.foot


def _of(factors: dict[str, float]) -> dict[str, Unit]:
    return {name: Unit(name, 1.0 / factor, in_si=factor) for name, factor in factors.items()}


# For each unit of the records the units that are read, and one of each in SI. Decimal ones of less
# than 1 are divided instead: 60/1e6 is 60e-6 to the last bit, and 60 · 1e-6 is not.
_DECIMAL: dict[str, dict[str, float]] = {
    "m": {"cm": 1e2, "mm": 1e3, "µm": 1e6},
    "kg": {"g": 1e3},
    "Pa·s": {"mPa·s": 1e3, "cP": 1e3},
    "-": {"%": 1e2},
    "s": {"ms": 1e3, "µs": 1e6},
}
_OTHERS: dict[str, dict[str, float]] = {
    "m": {"in": inch, "mil": mil},
    "kg": {"t": 1e3, "lb": lb},
    "N": {"kN": 1e3, "lbf": lbf},
    "Pa·s": {"reyn": _REYN, "µreyn": 1e-6 * _REYN},
    "1/°C": {"1/K": 1.0, "1/°F": 1.8},
    "N/m": {"kN/m": 1e3, "N/mm": 1e3, "MN/m": 1e6, "N/µm": 1e6, "lbf/in": lbf / inch},
    "N·s/m": {"kN·s/m": 1e3, "lbf·s/in": lbf / inch},
    "kg/m³": {"g/cm³": 1e3, "lb/ft³": lb / _FOOT**3},
    "J/(kg·K)": {"kJ/(kg·K)": 1e3, "Btu/(lb·°F)": 1.8 * constants.Btu / lb},
    "m³/s": {"l/min": liter / minute, "gpm": constants.gallon / minute},
    "rad": {"°": constants.degree},
    "Pa": {"kPa": 1e3, "MPa": 1e6, "bar": bar, "psi": psi},
    "rad/s": {"rpm": rpm, "Hz": 2.0 * constants.pi},
}
_TEMPERATURES = {"°F": Unit("°F", 1.8, 32.0), "K": Unit("K", 1.0, zero_Celsius)}
# Names of a column of its own, in which the kind of a bearing's bore is written.
KIND = "bearing"
KIND_PATH = ("bearing", "geometry", "type")
# What is not an input of the machine's records: unit, or none for a text.
OWN: dict[str, str | None] = {
    "name": None, "speed": "rad/s", "oil": None, KIND: None, "eccentricity_ratio": "-",
    "sommerfeld": "-", "classical_sommerfeld": "-", "natural_frequency": "rad/s",
}  # fmt: skip
# Characters of a header at most.
LONGEST = 200


@dataclass(frozen=True)
class Column:
    """A column of a table.

    Attributes
    ----------
    header : str
        As the file has it.
    path : tuple of str
        Of the machine's input, or the one name of a column of `OWN`.
    unit : Unit or None
        Of its numbers; None for texts.
    infinite : bool
        Whether "inf" is a value of it.
    """

    header: str
    path: tuple[str, ...]
    unit: Unit | None
    infinite: bool = False


def column_of(header: str) -> Column:
    """Return the column that a header names.

    Raises
    ------
    ValueError
        Where there is no such input or unit, or the unit is missing.
    """
    name, given = _name_and_unit(header)
    if name in OWN:
        unit = OWN[name]
        return Column(header.strip(), (name,), _unit(name, unit, given))
    path, rule = _input(name)
    bound = rule if isinstance(rule, Bound) else None
    unit = _unit(name, None if bound is None else bound.unit, given)
    return Column(header.strip(), path, unit, infinite=bound is not None and bound.infinite)


def _name_and_unit(header: str) -> tuple[str, str | None]:
    """Return the two parts of "load [N]"; no unit where there are no brackets."""
    name, bracket, rest = header.strip().partition("[")
    unit, end, beyond = rest.partition("]")
    if len(header) > LONGEST or beyond or (bracket and not end) or "]" in name:
        raise ValueError(f"{header[:80]!r}: must be a name, and a unit in brackets: 'load [N]'")
    return name.strip(), unit if bracket else None


def units_of(si: str) -> dict[str, Unit]:
    """Return the units in which a quantity may be given, by their spelling without accents."""
    divided = {name: Unit(name, factor) for name, factor in _DECIMAL.get(si, {}).items()}
    others = _TEMPERATURES if si == "°C" else _of(_OTHERS.get(si, {}))
    return {plain(name): unit for name, unit in ({si: Unit(si)} | divided | others).items()}


def _unit(name: str, si: str | None, given: str | None) -> Unit | None:
    if si is None:
        if given is not None:
            raise ValueError(f"{name} [{given[:40]}]: is a text and has no unit")
        return None
    known = units_of(si)
    if given is None and si != "-":
        raise ValueError(
            f"{name}: has no unit; write it in brackets, '{name} [{si}]', one of "
            f"{', '.join(unit.name for unit in known.values())}"
        )
    unit = known.get(plain(given or "-"))
    if unit is None:
        raise ValueError(
            f"{name} [{(given or '')[:40]}]: no unit of this; known are "
            f"{', '.join(unit.name for unit in known.values())}"
        )
    return unit


def plain(unit: str) -> str:
    """Return a unit's spelling without what keyboards lack: "Pa*s", "um", "kg/m3", "degF"."""
    text = re.sub(r"[\s·⋅*.^]", "", unit).replace("μ", "µ").replace("deg", "°")
    text = re.sub(r"\bu(?=m|reyn)", "µ", text)
    return text.replace("²", "2").replace("³", "3")


def _input(name: str) -> tuple[tuple[str, ...], object]:
    """Return path and rule of an input by its full name or the end of it."""
    known = _inputs()
    wanted = tuple(name.split("."))
    found = [path for path in known if path == wanted]
    found = found or [path for path in known if path[-len(wanted) :] == wanted]
    if len(found) == 1:
        return found[0], known[found[0]]
    if found:
        raise ValueError(f"{name}: may be {' or '.join(map('.'.join, found))}")
    names = ", ".join(sorted([*OWN, *map(".".join, known)]))
    raise ValueError(f"{name[:80]!r}: no input of a machine; known are {names}")


@functools.cache
def _inputs() -> dict[tuple[str, ...], object]:
    """Return the rule of each input of a machine with any bearing."""
    return {KIND_PATH: None} | dict(_fields(Machine, ()))


def _fields(record: type[Record], path: tuple[str, ...]) -> list[tuple[tuple[str, ...], object]]:
    kinds = list(record.kinds().values()) if issubclass(record, Kind) else [record]
    found: dict[tuple[str, ...], object] = {}
    for kind in kinds:
        for name, rule in rules(kind).items():
            below = (*path, name)
            if isinstance(rule.check, type):
                found |= dict(_fields(rule.check, below))
            elif not isinstance(rule.check, Grid):  # a table fits in no cell
                found.setdefault(below, rule.check)
    return list(found.items())
