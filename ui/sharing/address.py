"""The address bar: kept values to query parameters and back.

A link holds the preset and every value that differs from it, always in SI as engineers write it, so
it means the same whatever units are shown.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

from rotorcalc.units import SYSTEMS
from ui.inputs import DEFAULT_PRESET, INPUTS, PRESET_VALUES, Values, machine_of, quoted


@dataclass
class Link:
    """What a link says: the preset, all values, the units shown, and what could not be used."""

    preset: str = DEFAULT_PRESET
    values: Values = field(default_factory=lambda: dict(PRESET_VALUES[DEFAULT_PRESET]))
    units: str = "SI"
    problems: list[str] = field(default_factory=list)


def read(params: Mapping[str, str]) -> Link:
    """Return what query parameters say; a value that cannot be used leaves the preset's."""
    link = Link()
    link.preset = _word(params, "preset", DEFAULT_PRESET, PRESET_VALUES, link.problems)
    link.units = _word(params, "units", "SI", SYSTEMS, link.problems)
    link.values = checked_values(
        {key: params[key] for key in INPUTS if key in params}, link.preset, link.problems
    )
    for key in params.keys() - INPUTS.keys() - {"preset", "units"}:
        link.problems.append(f"{quoted(key)} is no quantity of this program and was left out.")
    return link


def write(preset: str, values: Values, units: str) -> dict[str, str]:
    """Return the query parameters that `read` turns into the same."""
    params = {} if preset == DEFAULT_PRESET else {"preset": preset}
    for key, value in values.items():
        if value != PRESET_VALUES[preset][key]:
            params[key] = (
                "weight" if value is None else f"{value:.17g}" if _long(value) else f"{value:g}"
            )
    return params if units == "SI" else params | {"units": units}


def checked_values(given: Mapping[str, object], preset: str, problems: list[str]) -> Values:
    """Return a preset's values with the given ones in place, as far as they can be used."""
    values = dict(PRESET_VALUES[preset])
    for key, word in given.items():
        value, problem = _value(key, word)
        if problem:
            problems.append(
                f"{INPUTS[key].label} ({key} = {quoted(word)}) {problem}; {_kept(key, preset)}"
            )
        else:
            values[key] = value
    try:
        machine_of(values)
    except ValueError as error:
        # Each value lies in its range, so what is left is a journal mass that leaves no disk.
        problems.append(f"{error}; {_kept('mj', preset)}")
        values["mj"] = PRESET_VALUES[preset]["mj"]
    return values


def _value(key: str, word: object) -> tuple[float | None, str]:
    if key == "load" and word in ("weight", None):
        return None, ""
    try:
        value = float(word)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        return None, "is no number"
    return value, INPUTS[key].problem(value)


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
    value = PRESET_VALUES[preset][key]
    shown = "half the rotor's weight" if value is None else f"{value:g}"
    return f"the preset's {shown} is used."


def _long(value: float) -> bool:
    return float(f"{value:g}") != value
