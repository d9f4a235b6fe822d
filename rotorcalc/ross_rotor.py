"""A machine as a rotor of Petrobras' open program ROSS: the file that its `Rotor.load` reads.

Three nodes: the journals in their bearings at 0 and 2, the disk at 1. Each half of the shaft is one
beam element without shear, rotary inertia and gyroscopic effect, whose end deflects under a force
as this program's shaft does, K_rot = 3EI/l³. It is all but massless: ROSS inverts the mass matrix.
Journal masses are disks too, damping at midspan is a bearing of the disk without stiffness. The
bearings are tables over speed; between the speeds ROSS interpolates by PCHIP.

ROSS's x is horizontal and its y up, the shaft turning from x to y; X here points down, along the
load: x = Y and y = −X. The format is that of `Rotor.save` of ROSS 2.3; its licence is Apache 2.0,
and none of its code is here.
"""

import math
from collections.abc import Iterator, Mapping
from typing import TypeAlias

import numpy as np

from rotorcalc.analysis import Sweep
from rotorcalc.arguments import checked
from rotorcalc.arrays import Array
from rotorcalc.coefficients import rising_speed
from rotorcalc.machine import Rotor

Value: TypeAlias = str | float | int | bool | list[float]
# Name and values of a table of the file.
Table: TypeAlias = tuple[str, Mapping[str, Value]]

VERSION = "2.3.0"
# Length of half the shaft [m], which this program does not have, and Young's modulus of steel [Pa].
_HALF, _YOUNG, _SHEAR = 0.5, 2.1e11, 8.1e10
# The shaft's mass over the rotor's, the radii of gyration of disk and journals [m], and, of a shaft
# that is rigid here, its stiffness over MΩ² at the highest speed of the table.
_LIGHT, _GYRATION, _OF_JOURNAL, _RIGID = 1e-7, 0.1, 1e-3, 1e4
# (x, y) of ROSS from (X, Y): a rotation by −90°.
_TO_ROSS = np.array([[0.0, 1.0], [-1.0, 0.0]])
_ENTRIES = ("xx", "xy", "yx", "yy")
_HEAD = (
    "A rotor on two journal bearings, for ROSS: `ross.Rotor.load(file)` reads this file.",
    "Nodes: journals at 0 and 2, the disk at 1. The shaft is massless, without shear.",
    "SI units. ROSS's axes: x horizontal, y up, rotation from x to y; the load acts along -y.",
    "From X along the load, Y at +90 degrees in the sense of rotation: x = Y, y = -X.",
)


def ross_axes(coefficients: Array) -> Array:
    """Return force coefficients of shape (..., 2, 2) in ROSS's axes."""
    # 0.0 is added so that an unloaded film's −0 becomes 0.
    return _TO_ROSS @ coefficients @ _TO_ROSS.T + 0.0


@checked
def ross_rotor(sweep: Sweep) -> str:
    """Return a machine as the text of a rotor's file of ROSS.

    Parameters
    ----------
    sweep : Sweep
        A machine over rising speeds, (n,): those of the bearings' tables.

    Returns
    -------
    str
        TOML, exact to the last bit. An imbalance is no part of a rotor there; a comment has the
        arguments of `Rotor.run_unbalance_response`.

    Raises
    ------
    ValueError
        Where the speeds do not rise.
    """
    speed = rising_speed(sweep.speed, name="sweep.speed")
    rotor = sweep.machine.rotor
    stiffness = rotor.shaft_stiffness
    unbalance = 2.0 * rotor.disk_mass * rotor.imbalance
    notes = [*_HEAD, f"Imbalance: node=1, unbalance_magnitude={unbalance!r} kg m."]
    if rotor.is_rigid:
        stiffness = _RIGID * rotor.half_mass * float(speed[-1]) ** 2
        notes.append(f"The shaft is rigid; here it has {stiffness:.4g} N/m a side, all but rigid.")
    tables: list[Table] = [
        ("parameters", {}),
        *_shaft(rotor, stiffness),
        *_masses(rotor),
        *_bearings(sweep),
    ]
    head = "".join(f"# {line}\n" for line in notes)
    return f'{head}\nross_version = "{VERSION}"\n\n' + "\n".join(
        _table(name, values) for name, values in tables
    )


def _shaft(rotor: Rotor, stiffness: float) -> Iterator[Table]:
    """Yield the two halves of the shaft, of one side's stiffness [N/m]."""
    second_moment = stiffness * _HALF**3 / (3.0 * _YOUNG)
    diameter = (64.0 * second_moment / math.pi) ** 0.25
    density = _LIGHT * rotor.mass / (2.0 * _HALF * math.pi * diameter**2 / 4.0)
    for n in (0, 1):
        yield f"ShaftElement_half {n}", {
            "L": _HALF, "idl": 0.0, "odl": diameter, "idr": 0.0, "odr": diameter, "n": n,
            "axial_force": 0.0, "torque": 0.0, "shear_effects": False, "rotary_inertia": True,
            "gyroscopic": False, "shear_method_calc": "cowper", "tag": f"half {n}", "alpha": 0.0,
            "beta": 0.0,
        }  # fmt: skip
        yield f"ShaftElement_half {n}.material", {
            "name": "massless", "rho": density, "E": _YOUNG, "G_s": _SHEAR, "color": "#525252",
        }  # fmt: skip


def _masses(rotor: Rotor) -> Iterator[Table]:
    """Yield the disk, which does not tilt in the motion here, and the journals' masses, which do.

    As disks, the journals with next to no inertia: with a point mass ROSS counts a node more.
    """
    masses = {"journal 0": (0, rotor.journal_mass), "disk": (1, 2.0 * rotor.disk_mass),
              "journal 2": (2, rotor.journal_mass)}  # fmt: skip
    for tag, (n, m) in masses.items():
        if m > 0.0:
            inertia = m * (_GYRATION if tag == "disk" else _OF_JOURNAL) ** 2
            yield f"DiskElement_{tag}", {
                "n": n, "m": m, "Id": inertia, "Ip": inertia, "tag": tag, "scale_factor": 1.0,
                "color": "Firebrick",
            }  # fmt: skip


def _bearings(sweep: Sweep) -> Iterator[Table]:
    """Yield the bearings' tables, and the damping at midspan."""
    given: dict[str, Value] = {"frequency": sweep.speed.tolist()}
    for letter, matrix in (("k", sweep.stiffness), ("c", sweep.damping)):
        columns = ross_axes(matrix).reshape(-1, 4).T.tolist()
        given |= dict(zip((f"{letter}{entry}" for entry in _ENTRIES), columns, strict=True))
    for n in (0, 2):
        yield f"BearingElement_bearing {n}", {"n": n, **given, "tag": f"bearing {n}"}
    if (C_s := 2.0 * sweep.machine.rotor.disk_damping) > 0.0:
        yield "BearingElement_damper", {
            "n": 1, "kxx": 0.0, "kyy": 0.0, "cxx": C_s, "cyy": C_s, "tag": "damper",
        }  # fmt: skip


def _table(name: str, values: Mapping[str, Value]) -> str:
    """Return a table of TOML; a name after a point is that of a table within it."""
    outer, _, inner = name.partition(".")
    path = f'"{outer}"' + (f".{inner}" if inner else "")
    return f"[{path}]\n" + "".join(f"{key} = {_text(value)}\n" for key, value in values.items())


def _text(value: Value) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return f'"{value}"'
    return repr(value)  # the shortest text that gives a float back; a list of them too
