"""The bores that a visitor can choose, by their usual names, and the inputs of each.

An angle, a share or a depth has a slider, as the machine's other inputs (`ui.inputs`); a whole
number and a word are picked from a few. `bore_inputs` narrows a slider to what goes with the
other values: pads that overlap, or a pocket beyond its pad, make no bearing.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

from ui.input_record import Input

# A number; a word; or None for a value that follows from others, as a load from the weight.
Value = float | str | None
Values = dict[str, Value]

KIND, FILM = "bearing", "film"

NAMES = {
    "plain": "Plain circular",
    "partial-arc": "Partial arc",
    "axial-grooves": "Axial grooves",
    "elliptical": "Elliptical (two-lobe)",
    "offset-halves": "Offset halves",
    "lobes": "Lobed",
    "pressure-dam": "Pressure dam",
    "multi-dam": "Multi-pocket dam",
    "tilting-pads": "Tilting pads",
    "floating-ring": "Floating ring",
    "hydrostatic": "Hydrostatic",
    "foil": "Foil",
}
# The film model of own coefficients in words; a link does not name it.
OWN_FILM = {"table": "Interpolated over speed"}
FILMS = {"short": "Short bearing", "finite": "Finite length", "coarse": "Coarse mesh"}

# The narrowest pad, and the least land beside a pocket or between grooves [°].
_LEAST_ARC, _LAND = 10.0, 2.0
# The narrowest recess [°], and the thinnest ring: its outer radius over the journal's.
_RECESS, _LEAST_RING = 10.0, 1.05
# What lies beside each of some equal angles around the bore [°].
_BESIDE = {"width": _LAND, "land_angle": _RECESS}
# How far a single pad may lie beside the load line, over its arc: further it carries nothing.
_ASIDE = 0.3


@dataclass(frozen=True)
class Pick:
    """A whole number or a word of a bore, picked from a few.

    `parts` names the angles that grow narrower with more of them, so that they fit.
    """

    key: str
    label: str
    options: tuple[float | str, ...]
    help: str
    parts: tuple[str, ...] = ()


def _angle(key: str, label: str, ends: tuple[float, float], about: str, follows: str = "") -> Input:
    return Input(
        key, f"bearing.geometry.{key}", label, "", "angle", *ends, "Bearing", about,
        step=1.0, span=360.0, follows=follows,
    )  # fmt: skip


def _share(key: str, label: str, symbol: str, ends: tuple[float, float], about: str) -> Input:
    return Input(
        key, f"bearing.geometry.{key}", label, symbol, "number", *ends, "Bearing", about, step=0.01
    )


def _depth(label: str, follows: str) -> Input:
    return Input(
        "depth", "bearing.geometry.depth", label, "d", "film", 1, 5000, "Bearing",
        "Depth below the surface of the pad; the film there is that much thicker.",
        follows=follows,
    )  # fmt: skip


def _number(label: str, least: int, about: str, *parts: str, key: str = "number") -> Pick:
    return Pick(key, label, tuple(map(float, range(least, 7))), about, parts)


def _amount(
    key: str, label: str, kind: str, ends: tuple[float, float], about: str, **more: Any
) -> Input:
    """Return a quantity on a logarithmic slider."""
    field = f"bearing.geometry.{key}"
    return Input(key, field, label, more.pop("symbol", ""), kind, *ends, "Bearing", about, **more)


_GROOVE = _angle(
    "groove_width", "Groove width", (0, 90),
    "Angle of the two grooves between the pads, at ±90° from the load line.",
)  # fmt: skip
_PRELOAD = _share(
    "preload", "Preload", "m", (0, 0.9),
    "How far each pad's centre of curvature is moved towards its pad, over C; 0 is a circular "
    "bore. C is the clearance of a pad: the assembled one is (1 − m) C.",
)  # fmt: skip
_AXIAL = _share(
    "axial_ratio", "Pocket length over L", "", (0.05, 0.95),
    "Axial length of the pocket over that of the bearing.",
)  # fmt: skip
_LOAD = Pick(
    "bearing_load", "Load points", ("on pad", "between pads"),
    "Where the load line meets the bore.",
)  # fmt: skip
_PADS = "Number of equal pads around the bore."

BORES: dict[str, tuple[Input | Pick, ...]] = {
    "plain": (),
    "partial-arc": (
        _angle("arc", "Arc of the pad", (30, 350),
               "Angle of the pad; the rest of the bore is relieved."),
        _angle("centre", "Middle of the pad", (-45, 45),
               "Angle of the pad's middle from the load line, in the sense of rotation."),
    ),
    "axial-grooves": (
        _number("Number of grooves", 1, "Number of grooves, evenly spaced.", "width"),
        _angle("width", "Groove width", (1, 60), "Angle of each groove."),
        _angle("first", "First groove", (-180, 180),
               "Angle of the middle of the first groove from the load line, in the sense of "
               "rotation.", "Grooves lie evenly beside the load line"),
    ),
    "elliptical": (_PRELOAD, _GROOVE),
    "offset-halves": (
        _share("offset", "Offset", "δ", (0, 0.8),
               "How far each half is moved sideways, over C; 0 is a circular bore."),
        _GROOVE,
    ),
    "lobes": (
        _number("Number of pads", 2, _PADS, "arc"),
        _angle("arc", "Arc of a pad", (_LEAST_ARC, 180), "Angle of each pad."),
        _PRELOAD,
        _share("offset", "Offset", "α", (0.4, 1),
               "Where on its arc a pad comes closest to a centred journal: 0.5 in its middle, 1 at "
               "its trailing edge."),
        _LOAD,
    ),
    "pressure-dam": (
        _angle("pocket_arc", "Arc of the pocket", (_LEAST_ARC, 178),
               "Angle from the unloaded pad's leading edge to the step."),
        _depth("Pocket depth", "Pocket is 2 C deep"),
        _AXIAL,
        _GROOVE,
        _PRELOAD,
        _share("track_ratio", "Relief track over L", "", (0, 0.6),
               "Width of a track around the middle of the loaded pad over the bearing's length; "
               "0 for none."),
    ),
    "multi-dam": (
        _number("Number of pads", 2, _PADS, "arc", "pocket_arc"),
        _angle("arc", "Arc of a pad", (_LEAST_ARC, 180), "Angle of each pad."),
        _angle("pocket_arc", "Arc of a pocket", (5, 178),
               "Angle from each pad's leading edge to the step."),
        _depth("Pocket depth", "Pockets are 1.5 C deep"),
        _AXIAL,
        _LOAD,
    ),
    "tilting-pads": (
        _number("Number of pads", 3, _PADS, "arc"),
        _angle("arc", "Arc of a pad", (20, 120), "Angle of each pad."),
        _PRELOAD,
        _share("pivot_offset", "Pivot offset", "α", (0.5, 0.7),
               "Where on its arc a pad is held, from its leading edge: 0.5 is its middle."),
        _LOAD,
        _amount("rotational_stiffness", "Pivot stiffness", "rotational_stiffness", (0, 1e8),
                "Stiffness of a pad's web against tilting: a flexure pivot. At 0 the pads tilt "
                "freely.", least=0.1),
        _amount("pad_inertia", "Pad inertia", "inertia", (0, 1000),
                "Moment of inertia of a pad about its pivot; 0 for pads without mass.",
                symbol="J", least=1e-8),
    ),
    "floating-ring": (
        _amount("outer_radius", "Ring's outer radius", "length", (1.6, 1800),
                "Radius of the ring's outer surface, on which the outer film runs.", symbol="Rₒ"),
        _amount("outer_length", "Outer film's length", "length", (1, 1800),
                "Axial length of the outer film.", symbol="Lₒ"),
        _amount("outer_clearance", "Outer clearance", "film", (3, 5000),
                "Radial clearance of the outer film; C is the inner film's.",
                symbol="Cₒ"),
        _amount("viscosity_ratio", "Viscosity, outer over inner", "number", (0.05, 20),
                "Viscosity of the outer film's oil, often cooler, over that of the inner film's."),
        _amount("ring_mass", "Ring mass", "mass", (0, 1000),
                "Mass of the ring; 0 for a ring without mass.", least=1e-4),
    ),
    "hydrostatic": (
        _number("Number of recesses", 3, "Number of equal recesses; the load points at one.",
                "land_angle", key="recesses"),
        _share("land_ratio", "Axial land over L", "a/L", (0.03, 0.45),
               "Width of the land at each end of the bearing, over its length."),
        _angle("land_angle", "Land between recesses", (5, 90),
               "Angle of the land between two recesses."),
        _amount("supply_pressure", "Supply pressure", "pressure", (0.05, 100),
                "Pressure of the oil before the restrictors, above ambient.",
                symbol="pₛ"),
        _share("pressure_ratio", "Pressure ratio", "β", (0.1, 0.9),
               "Pressure in the recesses over supply pressure, the journal centred and at rest: "
               "it sizes the restrictors."),
        Pick("restrictor", "Restrictor", ("capillary", "orifice"),
             "What limits each recess's flow: a capillary's grows with the pressure drop, an "
             "orifice's with its square root."),
    ),
    "foil": (
        _amount("foundation_stiffness", "Foundation stiffness", "foundation", (0.1, 1000),
                "Pressure that deflects the foil by a unit of length."),
        _share("loss_factor", "Loss factor", "η", (0, 1),
               "Share of the foil's stiffness that its friction adds a quarter of a cycle ahead."),
        _angle("slit", "Slit", (90, 270),
               "Angle of the slit between the foil's ends, from the load line; the gas there is at "
               "ambient pressure."),
        _amount("ambient_pressure", "Ambient pressure", "pressure", (0.01, 1),
                "Absolute pressure around the bearing.", symbol="pₐ"),
    ),
}  # fmt: skip


def name_of(kind: object) -> str:
    """Return the usual name of a kind of bearing."""
    return NAMES.get(str(kind), str(kind).replace("-", " ").capitalize())


def bore_inputs(values: Mapping[str, Value]) -> tuple[Input | Pick, ...]:
    """Return the inputs of a machine's bore, each with the range that goes with the others."""
    kind = str(values[KIND])
    return tuple(_fitting(kind, item, values) for item in BORES.get(kind, ()))


def with_pick(values: Values, item: Pick, value: Value) -> Values:
    """Return values with another number or word; more pads or grooves are narrower where they must.

    They keep their share of the circle.
    """
    changed: Values = values | {item.key: value}
    if not item.parts:
        return changed
    widest = 360.0 / _number_of(changed, item.key)
    room = widest - _BESIDE.get(item.parts[0], 0.0)
    if _number_of(values, item.parts[0]) <= room:
        return changed
    share = widest * _number_of(values, item.key) / 360.0
    narrower = {part: min(share * _number_of(values, part), room) for part in item.parts}
    return changed | {part: float(f"{angle:.10g}") for part, angle in narrower.items()}


def _fitting(kind: str, item: Input | Pick, values: Mapping[str, Value]) -> Input | Pick:
    """Return an input with the range that the others leave it, if they leave any."""
    if isinstance(item, Pick) or (kind, item.key) not in _ROOMS:
        return item
    low, high = _ROOMS[kind, item.key](values)
    low, high = max(item.low, low), min(item.high, high)
    return replace(item, low=low, high=high) if low < high else item


def _pitch(values: Mapping[str, Value]) -> float:
    return 360.0 / _number_of(values, "number")


def _about(angle: float) -> tuple[float, float]:
    return -angle, angle


def _half_without(values: Mapping[str, Value], key: str) -> float:
    return 180.0 - _number_of(values, key) - _LAND


def _number_of(values: Mapping[str, Value], key: str) -> float:
    value = values[key]
    return value if isinstance(value, float | int) else math.nan


# Between which angles [°] the other values leave a bearing.
_ROOMS: dict[tuple[str, str], Callable[[Mapping[str, Value]], tuple[float, float]]] = {
    ("partial-arc", "arc"): lambda v: (abs(_number_of(v, "centre")) / _ASIDE, math.inf),
    ("partial-arc", "centre"): lambda v: _about(_ASIDE * _number_of(v, "arc")),
    ("axial-grooves", "width"): lambda v: (0.0, _pitch(v) - _LAND),
    ("lobes", "arc"): lambda v: (0.0, _pitch(v)),
    ("tilting-pads", "arc"): lambda v: (0.0, _pitch(v)),
    ("floating-ring", "outer_radius"): lambda v: (_LEAST_RING * _number_of(v, "D") / 2.0, math.inf),
    ("floating-ring", "outer_clearance"): lambda v: (0.0, 100.0 * _number_of(v, "outer_radius")),
    ("hydrostatic", "land_angle"): lambda v: (0.0, 360.0 / _number_of(v, "recesses") - _RECESS),
    ("multi-dam", "arc"): lambda v: (_number_of(v, "pocket_arc") + _LAND, _pitch(v)),
    ("multi-dam", "pocket_arc"): lambda v: (0.0, _number_of(v, "arc") - _LAND),
    ("pressure-dam", "pocket_arc"): lambda v: (0.0, _half_without(v, "groove_width")),
    ("pressure-dam", "groove_width"): lambda v: (0.0, _half_without(v, "pocket_arc")),
}
