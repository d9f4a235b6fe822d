"""A machine with other values: its inputs by name, read and changed.

Inputs are named by the fields of the records, "bearing.radial_clearance" or "radial_clearance".
"""

import functools
from collections.abc import Mapping
from dataclasses import fields, replace

from rotorcalc.arguments import checked
from rotorcalc.machine import JournalBearing, Machine, Oil, Rotor


@checked
def value_of(machine: Machine, field: str) -> float:
    """Return the value of an input.

    Parameters
    ----------
    machine : Machine
        The machine.
    field : str
        The input, "bearing.radial_clearance" or "radial_clearance".

    Returns
    -------
    float
        Its value in SI; for a load that follows the rotor's weight, half that weight.

    Raises
    ------
    ValueError
        Where there is no such input.
    """
    record, name = address(field)
    if name == "load":
        return machine.static_load
    return float(getattr(getattr(machine, record) if record else machine, name))


@checked
def varied(machine: Machine, values: Mapping[str, float]) -> Machine:
    """Return a machine with other values of some inputs.

    Parameters
    ----------
    machine : Machine
        The machine; a load of None goes on following the rotor's mass.
    values : mapping of str to float
        Inputs and their values in SI.

    Returns
    -------
    Machine
        The other machine.

    Raises
    ------
    ValueError
        Where there is no such input, or the values make no machine.

    Examples
    --------
    >>> from rotorcalc import PRESETS
    >>> varied(PRESETS["sheet-1e8"].machine, {"radial_clearance": 80e-6}).bearing.radial_clearance
    8e-05
    """
    changes: dict[str, dict[str, float]] = {}
    for field, value in values.items():
        record, name = address(field)
        changes.setdefault(record, {})[name] = value
    own = changes.pop("", {})
    records = {record: replace(getattr(machine, record), **new) for record, new in changes.items()}
    return replace(machine, **own, **records)


@functools.cache
def address(field: str) -> tuple[str, str]:
    """Return the record and the name of an input; the machine's own record is ""."""
    known = {
        (record, item.name)
        for record, cls in (
            ("", Machine),
            ("oil", Oil),
            ("bearing", JournalBearing),
            ("rotor", Rotor),
        )
        for item in fields(cls)
        if item.name not in ("oil", "bearing", "rotor", "film")
    }
    record, _, name = field.rpartition(".")
    for address in known:
        if address == (record, name) or (not record and address[1] == name):
            return address
    names = ", ".join(sorted(".".join(filter(None, address)) for address in known))
    raise ValueError(f"{field[:80]!r}: no input of a machine; known are {names}")
