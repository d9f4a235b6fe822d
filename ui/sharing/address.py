"""The address bar: kept values to query parameters and back.

A link holds the preset and every value that differs from it, always in SI as engineers write it, so
it means the same whatever units are shown. A supply of oil stands in place of a film temperature.
A bearing of another kind than the preset's is named,
with those of its fields that are not at their default. Cases follow in one parameter, each as its
name, the number of its colour, and what differs from the preset, with ~ between and ~~ between
cases: letters and ~ stay as they are in an address.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from rotorcalc.figures.cases import COLOURS
from rotorcalc.units import AMPLITUDES, SYSTEMS
from ui.bearing import (
    FILM,
    KIND,
    Field,
    Values,
    fields_of,
    kinds,
    without_shape,
    written,
)
from ui.bores import FILMS
from ui.cases import Case, added
from ui.choices import NAMES
from ui.format import quoted, short, typed_number
from ui.input_record import tidy
from ui.inputs import (
    DEFAULT_PRESET,
    GAS,
    INPUTS,
    LAW,
    LAWS,
    OPTIONAL,
    PRESET_VALUES,
    SUPPLY,
    has_gas,
    has_supply,
    machine_of,
    usual_values,
)
from ui.own import in_link

CASES = "cases"
# Parameters that are no value of the machine.
_NOT_VALUES = frozenset(("preset", "units", "amplitude", "present", CASES))


@dataclass
class Link:
    """What a link says: the preset, all values, the units shown, and what could not be used."""

    preset: str = DEFAULT_PRESET
    values: Values = field(default_factory=lambda: dict(PRESET_VALUES[DEFAULT_PRESET]))
    units: str = "SI"
    amplitude: str = "0-p"
    # The chart that a presentation shows, "1" for the first; "" at a desk.
    present: str = ""
    problems: list[str] = field(default_factory=list)
    cases: tuple[Case, ...] = ()
    choices: dict[str, str] = field(default_factory=dict)


def read(params: Mapping[str, str]) -> Link:
    """Return what query parameters say; a value that cannot be used leaves the preset's."""
    link = Link()
    link.preset = _word(params, "preset", DEFAULT_PRESET, PRESET_VALUES, link.problems)
    link.present = params.get("present", "").removesuffix("0")
    link.units = _word(params, "units", "SI", SYSTEMS, link.problems)
    link.amplitude = _word(params, "amplitude", "0-p", AMPLITUDES, link.problems)
    link.choices = {key: word for key, word in params.items() if key in NAMES}
    given = {key: word for key, word in params.items() if key not in _NOT_VALUES | NAMES}
    link.values = checked_values(given, link.preset, link.problems)
    link.cases = _read_cases(params.get(CASES, ""), link.preset, link.problems)
    return link


def write(preset: str, values: Values, units: str, cases: Sequence[Case] = ()) -> dict[str, str]:
    """Return the query parameters that `read` turns into the same."""
    params = _differing(preset, values)
    if units != "SI":
        params["units"] = units
    if cases:
        params[CASES] = "~~".join(_case(preset, case) for case in cases)
    return params


def _case(preset: str, case: Case) -> str:
    differing = _differing(preset, case.values)
    differing.pop("preset", None)
    parts = [case.name, f"{COLOURS.index(case.colour) + 1}"]
    return "~".join([*parts, *(part for pair in differing.items() for part in pair)])


def _read_cases(text: str, preset: str, problems: list[str]) -> tuple[Case, ...]:
    """Return the cases of a link; what cannot be used of them is reported."""
    cases: tuple[Case, ...] = ()
    for written_case in filter(None, text.split("~~")):
        name, *rest = written_case.split("~")
        number, *words = rest or [""]
        found: list[str] = []
        values = checked_values(dict(zip(words[::2], words[1::2], strict=False)), preset, found)
        problems += (f"Case {quoted(name)}: {problem}" for problem in found)
        try:
            cases = added(cases, name, values, number)
        except ValueError as error:
            problems.append(f"Case {quoted(name)} was left out: {error}.")
    return cases


def _differing(preset: str, values: Values) -> dict[str, str]:
    """Return the preset, and the values that differ from it, as a link has them."""
    params = {} if preset == DEFAULT_PRESET else {"preset": preset}
    usual = usual_values(preset, values)
    for key, value in values.items():
        if key not in usual or value != usual[key]:
            params[key] = "weight" if key == "load" and value is None else in_link(written(value))
    if values[KIND] != PRESET_VALUES[preset][KIND]:
        params[KIND] = str(values[KIND])
    return params


def checked_values(given: Mapping[str, object], preset: str, problems: list[str]) -> Values:
    """Return a preset's values with the given ones in place, as far as they can be used."""
    kind = given.get(KIND, PRESET_VALUES[preset][KIND])
    if kind not in kinds():
        problems.append(
            f"{KIND} = {quoted(kind)} is not one of {', '.join(kinds())}; {_kept(KIND, preset)}"
        )
        kind = PRESET_VALUES[preset][KIND]
    fields = fields_of(kind)
    values = dict(usual_values(preset, {KIND: str(kind)}))
    for key, word in given.items():
        if key in INPUTS:
            _take_number(values, key, word, preset, problems)
        elif key in fields:
            _take_field(values, fields[key], word, problems)
        elif key == FILM:
            _take_film(values, word, problems)
        elif key == LAW:
            values[LAW] = _word({LAW: f"{word}"}, LAW, str(values[LAW]), LAWS, problems)
        elif key != KIND:
            problems.append(f"{quoted(key)} is not an input of this machine and was left out.")
    _settle_lubricant(values, problems)
    _settle_supply(values, given, preset, problems)
    return _made(values, preset, problems)


def _settle_lubricant(values: Values, problems: list[str]) -> None:
    """Leave out a gas where the bearing takes oil, and a supply of oil where it takes a gas."""
    if has_gas(values):
        if has_supply(values):
            problems.append(
                "Supply temperature (T_in) is an oil's; a foil bearing runs on a gas, and it was "
                "left out."
            )
            values |= dict.fromkeys(SUPPLY)
        values |= {key: usual for key, usual in GAS.items() if values[key] is None}
        return
    for key in GAS:
        if values[key] is not None:
            problems.append(
                f"{INPUTS[key].label} ({key}) belongs to a gas, which a foil bearing alone takes; "
                "it was left out."
            )
            values[key] = None


def _settle_supply(
    values: Values, given: Mapping[str, object], preset: str, problems: list[str]
) -> None:
    """Give values a film temperature or a supply of oil, and not both, by what a link has."""
    for key, usual in SUPPLY.items():
        if not has_supply(values) and values[key] is not None:
            problems.append(
                f"{INPUTS[key].label} ({key}) belongs to a supply of oil, whose temperature T_in "
                "is missing; it was left out."
            )
            values[key] = None
        elif has_supply(values) and values[key] is None:
            values[key] = usual
    if has_supply(values):
        if given.get("T") not in (None, "none"):
            problems.append("Film temperature (T) follows from the supply (T_in); it was left out.")
        values["T"] = None
    elif values["T"] is None:
        problems.append(f"Film temperature (T) is missing; {_kept('T', preset)}")
        values["T"] = PRESET_VALUES[preset]["T"]


def _take_number(values: Values, key: str, word: object, preset: str, problems: list[str]) -> None:
    value, problem = _value(key, word)
    if problem:
        problems.append(
            f"{INPUTS[key].label} ({key} = {quoted(word)}) {problem}; {_kept(key, preset)}"
        )
    else:
        values[key] = value


def _take_film(values: Values, word: object, problems: list[str]) -> None:
    if word in (None, "none", *FILMS):
        values[FILM] = None if word in (None, "none") else str(word)
    else:
        problems.append(f"{FILM} = {quoted(word)} is not one of {', '.join(FILMS)}.")


def _take_field(values: Values, field: Field, word: object, problems: list[str]) -> None:
    try:
        values[field.key] = field.taken(word)
    except ValueError as error:
        usual = values.get(field.key)
        rest = "" if usual is None else f" {written(usual)} is used."
        problems.append(f"{field.label} ({field.key} = {quoted(word)}): {error}.{rest}")


def _made(values: Values, preset: str, problems: list[str]) -> Values:
    """Return values that make a machine: what stands in the way is the preset's again.

    Each value lies in its range, so what is left is a journal mass that leaves no disk, or a
    bearing whose parts do not go together.
    """
    error = _fault(values)
    if error is None:
        return values
    usual = PRESET_VALUES[preset]
    mass = {"mj": usual["mj"]}
    bearing = {key: usual[key] for key in ("D", "L", "C")} | _shape(usual)
    mended = (
        ("mj", values | mass),
        (KIND, without_shape(values) | bearing),
        (KIND, without_shape(values) | bearing | mass),
        ("preset", dict(usual)),
    )
    what, values = next(one for one in mended if _fault(one[1]) is None)
    problems.append(f"{error}; {_kept(what, preset)}")
    return values


def _fault(values: Values) -> ValueError | None:
    """Return why values make no machine, or nothing where they make one."""
    try:
        machine_of(values)
    except ValueError as error:
        return error
    return None


def _shape(values: Values) -> Values:
    return {key: value for key, value in values.items() if key not in without_shape(values)}


def _value(key: str, word: object) -> tuple[float | None, str]:
    if word in (None, "weight" if key == "load" else "none") and key in OPTIONAL:
        return None, ""
    try:
        value = typed_number(word)
    except ValueError as error:
        return None, f"{error}"
    return tidy(value), INPUTS[key].problem(value)


def _word(
    params: Mapping[str, str],
    key: str,
    default: str,
    known: Mapping[str, object],
    problems: list[str],
) -> str:
    word = params.get(key, default)
    if word in known:
        return word
    problems.append(f"{key} = {quoted(word)} is not one of {', '.join(known)}; {default} is used.")
    return default


def _kept(key: str, preset: str) -> str:
    if key == "T_in":
        return "the film's temperature is given instead."
    return f"{_used(key, preset)} is used."


def _used(key: str, preset: str) -> str:
    if key == KIND:
        return "the preset's bearing"
    if key not in INPUTS:
        return "the preset's machine"
    value = (SUPPLY | GAS).get(key, PRESET_VALUES[preset].get(key))
    if value is None:
        return "half the rotor's weight"
    shown = value if isinstance(value, str) else short(value)
    return shown if key in SUPPLY or key in GAS else f"the preset's {shown}"
