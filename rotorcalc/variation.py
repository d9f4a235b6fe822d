"""The inputs of a machine by name: their values, and machines with other values.

Inputs are named by the fields of the records, "bearing.radial_clearance" or "radial_clearance"; a
bearing's geometry has its own, "bearing.geometry.preload".
"""

import functools
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import fields, replace
from typing import Any, cast

from rotorcalc.arguments import checked
from rotorcalc.coefficient_table import CoefficientTable
from rotorcalc.coefficients import equilibrium
from rotorcalc.machine import Machine
from rotorcalc.records import R, number_paths


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
        Its value in SI; for one that follows from others, as a load from the rotor's weight, what
        follows.

    Raises
    ------
    ValueError
        Where there is no such input.
    """
    path = address(machine, field)
    if path == ("load",):
        return machine.static_load
    value = functools.reduce(getattr, path, cast("Any", machine))
    if value is None:
        bearing = machine.bearing
        return bearing.geometry.implied(path[-1], bearing.radial_clearance)
    return float(value)


@checked
def varied(machine: Machine, values: Mapping[str, float]) -> Machine:
    """Return a machine with other values of some inputs.

    Parameters
    ----------
    machine : Machine
        The machine; a load of None still follows the rotor's mass.
    values : mapping of str to float
        Inputs and their values in SI.

    Returns
    -------
    Machine
        The other machine.

    Raises
    ------
    ValueError
        Where there is no such input, or the values are not a valid machine.

    Examples
    --------
    >>> from rotorcalc import PRESETS
    >>> varied(PRESETS["sheet-1e8"].machine, {"radial_clearance": 80e-6}).bearing.radial_clearance
    8e-05
    """
    return changed(machine, {address(machine, field): value for field, value in values.items()})


@functools.lru_cache(maxsize=256)
def address(machine: Machine, field: str) -> tuple[str, ...]:
    """Return the path of an input in a machine's records.

    Parameters
    ----------
    machine : Machine
        The machine; the inputs of its bearing's geometry are among its own.
    field : str
        The input, "bearing.radial_clearance" or "radial_clearance".

    Returns
    -------
    tuple of str
        ("bearing", "radial_clearance").

    Raises
    ------
    ValueError
        Where there is no such input, or more than one of that name.
    """
    known = list(number_paths(machine))
    if isinstance(machine.bearing, CoefficientTable):
        known = [path for path in known if path[0] == "rotor"]
    if machine.supply is not None:
        if field == "temperature":
            raise ValueError(
                "'temperature': the film's follows from the supply; vary 'supply.temperature'"
            )
        known.remove(("temperature",))
    wanted = tuple(field.split("."))
    # A full name wins over the end of another: "load" is the machine's, whatever a geometry has.
    found = [path for path in known if path == wanted]
    # "radial_clearance" alone is as good as "bearing.radial_clearance" where only one ends so.
    found = found or [path for path in known if path[-len(wanted) :] == wanted]
    if len(found) == 1:
        return found[0]
    if found:
        raise ValueError(f"{field!r}: may be {' or '.join(map('.'.join, found))}")
    names = ", ".join(sorted(map(".".join, known)))
    if isinstance(machine.bearing, CoefficientTable):
        raise ValueError(
            f"{field[:80]!r}: a table of coefficients does not depend on it, but holds for one "
            f"bearing, oil and load; of such a machine the rotor can be varied: {names}"
        )
    raise ValueError(f"{field[:80]!r}: no input of a machine; known are {names}")


def changed(record: R, changes: Mapping[tuple[str, ...], float]) -> R:
    """Return a record with the values at some paths changed, which `address` gives."""
    return maker(record, tuple(changes))(tuple(changes.values()))


def maker(record: R, paths: Sequence[tuple[str, ...]]) -> Callable[[Sequence[float]], R]:
    """Return what makes a record with other values at some paths, in their order."""
    kept = {field.name: getattr(record, field.name) for field in fields(record)}
    # Of each field that changes, the places of its values, and what makes it of them.
    parts: dict[str, tuple[list[int], Callable[[Sequence[float]], Any]]] = {}
    for name in {path[0] for path in paths}:
        places = [i for i, path in enumerate(paths) if path[0] == name]
        below = [paths[i][1:] for i in places]
        parts[name] = places, maker(kept[name], below) if below[0] else _alone

    def made(values: Sequence[float]) -> R:
        # All at once: one change at a time may pass through an invalid record.
        new = {name: make([values[i] for i in places]) for name, (places, make) in parts.items()}
        return type(record)(**kept | new)

    return made


def _alone(values: Sequence[float]) -> float:
    """Return the value of a field that is a number."""
    [value] = values
    return value


@checked
def damping_reference(machine: Machine) -> float:
    """Return a reference value of midspan damping [N·s/m].

    Parameters
    ----------
    machine : Machine
        The machine.

    Returns
    -------
    float
        Critical damping of the disk on its shaft, 2√(K_rot m_d); for a rigid shaft the centred
        film's direct damping, to which the damper's is then added, or that of a table's first row.
    """
    rotor = machine.rotor
    if rotor.is_rigid and isinstance(machine.bearing, CoefficientTable):
        return float(equilibrium(machine, machine.bearing.first).damping[0, 0])
    if rotor.is_rigid:
        # The centred film's damping does not depend on speed: any speed will do.
        centred = replace(machine, load=0.0)
        if machine.supply is not None:  # without load no oil may leave: the cold oil's, then
            centred = replace(centred, temperature=machine.supply.temperature, supply=None)
        return float(equilibrium(centred, 1.0).damping[0, 0])
    return 2.0 * math.sqrt(rotor.shaft_stiffness * rotor.disk_mass)
