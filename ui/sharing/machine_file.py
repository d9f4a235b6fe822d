"""The machine's file: the core's JSON, and beside it how the machine is shown.

Under "app" it holds name and note, and in the words of a link preset, units,
amplitudes, speeds and cases, and what the page Criteria asks. A file without it is read as the
machine alone.
"""

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any

from rotorcalc import Machine
from rotorcalc.machine import APP
from rotorcalc.records import parsed
from ui import criteria
from ui.format import quoted
from ui.inputs import speeds_of, values_of
from ui.session import Session
from ui.sharing import address
from ui.sharing.labels import Labels

_SPEEDS = ("rpm", "rpm_max")
_SHOWN = ("preset", "units", "amplitude")
# Name of the criteria's words, and characters of each at most.
_CRITERIA, _LONGEST = "criteria", 1000


@dataclass
class Loaded:
    """What a file says, and what of it could not be used."""

    link: address.Link
    name: str
    note: str
    has_cases: bool
    problems: list[str] = field(default_factory=list)
    # What the page Criteria asks, by the key of each choice.
    criteria: dict[str, str] = field(default_factory=dict)


def write(
    machine: Machine, visitor: Session, labels: Labels,
    chosen: Mapping[str, object] = MappingProxyType({}),
) -> bytes:  # fmt: skip
    """Return a machine's file; `Machine.from_json` reads the machine in it too, equal.

    `chosen` are a visitor's choices, of which those of the page Criteria are in it.
    """
    shown = address.write(visitor.preset, visitor.values, visitor.units_name, visitor.cases)
    app: dict[str, Any] = {
        "name": labels.name, "note": labels.note, "preset": visitor.preset,
        "units": visitor.units_name, "amplitude": visitor.amplitude,
        **{key: visitor.values[key] for key in _SPEEDS},
        "cases": shown.get(address.CASES, ""),
    }  # fmt: skip
    asked = {key: chosen[key] for key in criteria.KEYS if chosen.get(key)}
    if asked:
        app[_CRITERIA] = {key.removeprefix("criteria_"): word for key, word in asked.items()}
    document = json.loads(machine.to_json()) | {APP: app}
    return json.dumps(document, indent=2, allow_nan=False, ensure_ascii=False).encode()


def read(text: str, visitor: Session) -> Loaded:
    """Return what a file says; what it leaves out is the session's. Raises ValueError."""
    machine = Machine.from_json(text)
    app = parsed(text).get(APP, {})
    if not isinstance(app, Mapping):
        raise ValueError(f"{APP} = {quoted(app)}: must be a JSON object")
    words = {
        "preset": visitor.preset, "units": visitor.units_name, "amplitude": visitor.amplitude,
    } | {key: str(app[key]) for key in (*_SHOWN, address.CASES) if key in app}  # fmt: skip
    link = address.read(words)
    values = values_of(machine, *speeds_of(visitor.values))
    speeds = {key: app[key] for key in _SPEEDS if key in app}
    link.values = address.checked_values(values | speeds, link.preset, link.problems)
    name, note = (str(app.get(key, ""))[:2000] for key in ("name", "note"))
    asked = _asked(app.get(_CRITERIA, {}), link.problems)
    return Loaded(link, name, note, address.CASES in app, link.problems, asked)


def _asked(given: object, problems: list[str]) -> dict[str, str]:
    """Return what a file asks on the page Criteria, which checks it itself."""
    if not isinstance(given, Mapping):
        problems.append(f"{_CRITERIA} = {quoted(given)} is not a JSON object and was left out.")
        return {}
    words = {f"{_CRITERIA}_{name}": str(word)[:_LONGEST] for name, word in given.items()}
    known = {key: word for key, word in words.items() if criteria.is_known(key, word)}
    problems += (
        f"{_CRITERIA}: {quoted(key.partition('_')[2])} = {quoted(word)} is nothing that the page "
        "Criteria asks, and was left out."
        for key, word in words.items() if key not in known
    )  # fmt: skip
    return known
