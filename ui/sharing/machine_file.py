"""The machine's file: the core's JSON, and beside it how the machine is shown.

Under "app" it holds name and note, and in the words of a link preset, units,
amplitudes, speeds and cases. A
file without it is read as the machine alone.
"""

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from rotorcalc import Machine
from rotorcalc.machine import APP
from rotorcalc.records import parsed
from ui.format import quoted
from ui.inputs import speeds_of, values_of
from ui.session import Session
from ui.sharing import address
from ui.sharing.labels import Labels

_SPEEDS = ("rpm", "rpm_max")
_SHOWN = ("preset", "units", "amplitude")


@dataclass
class Loaded:
    """What a file says, and what of it could not be used."""

    link: address.Link
    name: str
    note: str
    has_cases: bool
    problems: list[str] = field(default_factory=list)


def write(machine: Machine, visitor: Session, labels: Labels) -> bytes:
    """Return a machine's file; `Machine.from_json` reads the machine in it too, equal."""
    shown = address.write(visitor.preset, visitor.values, visitor.units_name, visitor.cases)
    app: dict[str, Any] = {
        "name": labels.name, "note": labels.note, "preset": visitor.preset,
        "units": visitor.units_name, "amplitude": visitor.amplitude,
        **{key: visitor.values[key] for key in _SPEEDS},
        "cases": shown.get(address.CASES, ""),
    }  # fmt: skip
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
    return Loaded(link, name, note, address.CASES in app, link.problems)
