"""The kept values of a bearing: its kind, the fields of its bore, its film model.

A kind's fields stand beside the inputs under their own names, in the units of the address bar:
angles in °, lengths in mm, clearances and depths in µm, pressures in MPa, flows in l/min.
"""

import functools
import math
from collections.abc import Mapping
from dataclasses import MISSING, dataclass

from rotorcalc import CoefficientTable, JournalBearing
from rotorcalc.coefficient_table import OWN, UnknownBore
from rotorcalc.geometry import Geometry
from rotorcalc.machine import Bearing
from rotorcalc.records import Bound, Choice, Rule, rules
from rotorcalc.units import SI, Unit, Units
from ui.bores import BORES, FILM, FILMS, KIND, OWN_FILM, Value, Values
from ui.own import TABLE, described, rows_of, table_of, text_of

# Keys of the address bar that mean something else: a bore's field "load" is "bearing_load" there.
_TAKEN = frozenset((
    "mass", "load", "T", "T_in", "flow", "share", "mu", "TR", "alpha", "rho", "cp", "law", "C", "D",
    "L", "k", "u", "cs", "mj", "rpm", "rpm_max", "bearing", "film", "preset", "units", "tab",
    "present", "amplitude", "mu_gas", "TR_gas", "S_gas",
))  # fmt: skip
_UNITS = {
    "rad": "angle", "m": "length", "Pa": "pressure", "m³/s": "flow", "kg": "mass",
    "N·m/rad": "rotational_stiffness", "kg·m²": "inertia", "N/m³": "foundation",
}  # fmt: skip


# What a bore is made around, and its units.
_JOURNAL = {"D": "length", "L": "length", "C": "film"}


@dataclass(frozen=True)
class Field:
    """A field of a bore: its key among the kept values, its name in the record and in words, and
    what it accepts.
    """

    key: str
    name: str
    label: str
    rule: Rule

    def unit(self, units: Units) -> Unit:
        """Return the unit in which a visitor sees it."""
        if not isinstance(self.rule.check, Bound):
            return units.number
        word = self.rule.check.unit
        small = word == "m" and any(part in self.name for part in ("clearance", "depth"))
        kind = "film" if small else _UNITS.get(word)
        return getattr(units, kind) if kind else Unit(word)

    def name_in(self, units: Units) -> str:
        """Return label and unit, as beside a number."""
        unit = self.unit(units).name
        return self.label + ("" if unit == "-" else f" [{unit}]")

    def kept(self, value: object) -> Value:
        """Return a record's value as it is kept: the shortest that gives it back."""
        if not isinstance(value, float | int):
            return value  # type: ignore[return-value]
        unit = self.unit(SI)
        reading = float(unit.of(value))
        # The change of unit rounds in the last two digits.
        shorter = (float(f"{reading:.{digits}g}") for digits in (14, 15, 16))
        return next((short for short in shorter if unit.to_si(short) == value), reading)

    def taken(self, word: object) -> Value:
        """Return the kept value of a link's or a file's text, or raise ValueError."""
        # A link has no None; "none" is its word for it.
        if self.rule.optional and word in (None, "none"):
            return None
        if isinstance(self.rule.check, Choice):
            if word not in self.rule.check.words:  # said without the word, which may be markup
                raise ValueError(f"must be one of {', '.join(self.rule.check.words)}")
            return str(word)
        try:
            value = float(word)  # type: ignore[arg-type]
        except (TypeError, ValueError):
            raise ValueError("is not a number") from None
        self.rule.check.check(self.key, self.unit(SI).to_si(value))  # type: ignore[union-attr]
        return value

    def si(self, value: Value) -> Value:
        """Return a kept value as the record has it."""
        return self.unit(SI).to_si(value) if isinstance(value, float | int) else value

    def shown(self, value: Value, units: Units) -> str:
        """Return a kept value as text, in a visitor's unit."""
        if value is None or isinstance(value, str):
            return value or "–"
        return f"{float(self.unit(units).of(self.unit(SI).to_si(value))):.6g}"


@dataclass(frozen=True)
class OwnField(Field):
    """The field of a bearing's own coefficients: their table, as one text."""

    def taken(self, word: object) -> Value:
        """Return the text of a link or a file where it is a table, or raise ValueError."""
        table_of(str(word))
        return str(word)

    def shown(self, value: Value, units: Units) -> str:
        """Return how many rows it has, and between which speeds."""
        return described(rows_of(value), units) if isinstance(value, str) else "–"


# None where a link names no table: then there is no machine.
_OWN = {TABLE: OwnField(TABLE, TABLE, "Coefficients", Rule(Choice(()), True, None))}


def kinds() -> Mapping[str, type[Geometry]]:
    """Return the kinds of bearings by their words, those defined later too."""
    return Geometry.kinds() | {OWN: UnknownBore}


def fields_of(kind: object) -> dict[str, Field]:
    """Return the fields of a kind of bearing by their keys."""
    if kind == OWN:
        return dict(_OWN)
    return _fields(kinds()[str(kind)])


@functools.cache
def _fields(geometry: type[Geometry]) -> dict[str, Field]:
    keys = {name: f"{KIND}_{name}" if name in _TAKEN else name for name in rules(geometry)}
    words = {item.key: item.label for item in BORES.get(geometry.kind, ())}
    found = (
        # A field that no slider has: its name tells a bearing's load from the machine's.
        Field(key, name, words.get(key, key.replace("_", " ").capitalize()), rules(geometry)[name])
        for name, key in keys.items()
    )
    return {field.key: field for field in found}


def film_model(values: Mapping[str, Value]) -> str:
    """Return the film model of kept values: that of the kind where they name none."""
    film = values[FILM]
    return film if isinstance(film, str) else kinds()[str(values[KIND])].models[0]


def film_name(values: Mapping[str, Value]) -> str:
    """Return the film model of kept values in words."""
    model = film_model(values)
    return (FILMS | OWN_FILM).get(model, model)


def bearing_values(bearing: Bearing) -> Values:
    """Return kind, film model and fields of a bearing as they are kept."""
    if isinstance(bearing, CoefficientTable):
        return {KIND: OWN, FILM: None, TABLE: text_of(bearing)}
    geometry = bearing.geometry
    fields = fields_of(geometry.kind)
    return {KIND: geometry.kind, FILM: bearing.film} | {
        key: field.kept(getattr(geometry, field.name)) for key, field in fields.items()
    }


def defaults_of(kind: str, like: Mapping[str, Value]) -> Values:
    """Return the default values of a kind of bearing; some follow from the journal of others."""
    usual = _around(kind, like)
    return {KIND: kind, FILM: None} | {
        key: usual.get(key, field.kept(field.rule.default))
        for key, field in fields_of(kind).items()
        if key in usual or field.rule.default is not MISSING
    }


def _around(kind: str, like: Mapping[str, Value]) -> Values:
    """Return what is usual around a journal for fields without defaults."""
    fields = fields_of(kind)
    needed = [key for key, field in fields.items() if field.rule.default is MISSING]
    if not needed:
        return {}
    D, L, C = (getattr(SI, unit).to_si(like[key]) for key, unit in _JOURNAL.items())
    found = kinds()[kind].around(D, L, C)
    return {key: fields[key].kept(getattr(found, fields[key].name)) for key in needed}


def without_shape(values: Mapping[str, Value]) -> Values:
    """Return kept values without the kind, film model and fields of their bearing."""
    shape = {KIND, FILM, *fields_of(values[KIND])}
    return {key: value for key, value in values.items() if key not in shape}


def bearing_of(values: Mapping[str, Value], journal: Mapping[str, float]) -> Bearing:
    """Return the bearing of kept values around a journal of D, L and C, or raise ValueError."""
    if values[KIND] == OWN:
        return rows_of(values.get(TABLE))
    geometry, film = shape_of(values)
    return JournalBearing(**journal, geometry=geometry, film=film)


def shape_of(values: Mapping[str, Value]) -> tuple[Geometry, str | None]:
    """Return the bore and the film model that kept values describe, or raise ValueError."""
    kind, film = values[KIND], values[FILM]
    fields = fields_of(kind)
    given = {field.name: field.si(values[key]) for key, field in fields.items() if key in values}
    for key, field in fields.items():
        if field.name not in given:
            raise ValueError(f"{key}: missing; a bearing of kind {kind} needs it")
    return kinds()[str(kind)](**given), film if isinstance(film, str) else None


def written(value: Value) -> str:
    """Return a kept value as written in a link: the shortest text that gives it exactly."""
    if value is None or isinstance(value, str):
        return value or "none"
    # NaN equals nothing, itself included, and has no longer form.
    short = f"{value:g}"
    return short if float(short) == value or math.isnan(value) else repr(value)
