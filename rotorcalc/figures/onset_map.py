"""Map of the onset speed over two inputs: its levels, and the side that is unstable."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, TypeAlias

import numpy as np
from scipy.ndimage import distance_transform_edt

from rotorcalc.arrays import Array, BoolArray
from rotorcalc.design import OnsetMap
from rotorcalc.figures import style
from rotorcalc.figures.design import Quantity, this_machine
from rotorcalc.figures.stability import LEGEND
from rotorcalc.figures.style import Axis, Chart, Trace
from rotorcalc.units import Units

# A place on a map, as shares of its width and height.
Place: TypeAlias = tuple[float, float]

# One hue from dark to light, legible to colour-blind readers and in grey; dark is a low onset.
_SEQUENCE = [
    [0.0, "#06264d"], [0.2, "#0b4a85"], [0.4, "#2b7bba"],
    [0.6, "#6aaed6"], [0.8, "#b0d2e8"], [1.0, "#eff6fc"],
]  # fmt: skip
# Of the levels at which a map changes colour: steps within a decade, and how many at least.
_LADDER, _FEWEST = (1.0, 1.5, 2.0, 3.0, 5.0, 7.0), 5
# Words keep this share of the map's width or height from its marks and from each other.
_APART = 0.13
# Between which shares of the map's width and height words in a region have their middle.
_WITHIN = (0.06, 0.94), (0.04, 0.96)
_UNSTABLE = "rgba(209,84,31,0.45)"


def onset_map(
    shown: OnsetMap,
    quantities: tuple[Quantity, Quantity],
    here: tuple[float, float],
    speed: float,
    units: Units,
) -> Chart:
    """Return the onset speed over two inputs, with a machine on it.

    `here` is the machine's place in SI, `speed` the running speed [rad/s]: a line divides the
    machines stable at it from those unstable, which are shaded, where the map has both.
    """
    (across, up), (x, y) = quantities, (quantity.axis() for quantity in quantities)
    grid = _Grid(x, y, across.unit.of(shown.xs), up.unit.of(shown.ys))
    left, bottom = across.place(here[0]), up.place(here[1])
    grid.take(left, bottom)
    onset, running = units.speed.of(shown.speed), float(units.speed.of(speed))
    levels = _levels(onset, running)
    name = units.speed.name
    # The levels first: their labels then stay while the running speed moves the division.
    notes = [
        grid.note(f"{level:.0f}", place)
        for level in levels
        if (place := grid.crossing(onset, level))
    ] + _sides(onset, running, grid)
    return style.chart(
        [
            *_fields(onset, levels, grid, name),
            *_division(onset, running, grid, name),
            *this_machine(x, y, left, bottom, across.beyond(here[0]) or up.beyond(here[1], "↓↑")),
        ],
        x,
        y,
        height=500,
        legend=LEGEND,
        margin={"l": 64, "r": 28, "t": 16, "b": 84},
        annotations=notes,
    )


@dataclass(frozen=True, eq=False)
class _Grid:
    """A map's points on its axes, and the places taken by marks and words."""

    x: Axis
    y: Axis
    xs: Array
    ys: Array
    taken: list[Place] = field(default_factory=list[Place])

    def take(self, x: float, y: float) -> None:
        """Keep words away from a point."""
        self.taken.append((_share(x, self.x), _share(y, self.y)))

    def note(self, text: str, place: Place, size: int = 12) -> dict[str, Any]:
        """Return words at a place, and keep others away."""
        self.taken.append(place)
        # Along the axes, not the plot: axes can be widened for other machines' marks.
        x, y = (_along(share, axis) for share, axis in zip(place, (self.x, self.y), strict=True))
        return style.note(text, x, y, xref="x", yref="y", font={"size": size})

    def crossing(self, onset: Array, level: float) -> Place | None:
        """Return the place on a contour that is farthest from what is there, None where close."""
        places = [*_crossings(onset, level), *((x, y) for y, x in _crossings(onset.T, level))]
        inside = [place for place in places if all(0.06 < share < 0.94 for share in place)]
        return self._freest(inside, apart=_APART)

    def middle(self, inside: BoolArray) -> Place | None:
        """Return the place deepest in a region, None where there is no such region."""
        # Beyond the map is outside every region, so that words do not stand at its edge.
        depth = distance_transform_edt(np.pad(inside, 1))[1:-1, 1:-1]
        rows, columns = np.nonzero(depth >= 0.7 * max(depth.max(), 1.0))
        height, width = (size - 1 for size in inside.shape)
        # A thin region may lie along an edge, where words would stand across it.
        (left, right), (low, high) = _WITHIN
        return self._freest([
            (min(max(c / width, left), right), min(max(r / height, low), high))
            for r, c in zip(rows, columns, strict=True)
        ])  # fmt: skip

    def _freest(self, places: Sequence[Place], apart: float = 0.0) -> Place | None:
        if not places:
            return None
        room, place = max((self._room(place), place) for place in places)
        return place if room >= apart else None

    def _room(self, place: Place) -> float:
        return min((math.dist(place, other) for other in self.taken), default=1.0)


def _share(value: float, axis: Axis) -> float:
    """Return the place of a value along an axis, 0 at its low end and 1 at its high one."""
    low, high = axis["range"]
    at = math.log10(value) if axis["type"] == "log" else value
    return (at - low) / (high - low)


def _along(share: float, axis: Axis) -> float:
    """Return the coordinate of a place along an axis, of a logarithmic one the logarithm."""
    low, high = axis["range"]
    return low + share * (high - low)


def _crossings(onset: Array, level: float) -> list[Place]:
    """Return where the rows of a map pass a level, as shares of width and height."""
    rows, columns = onset.shape
    # Where neighbours are equal no level lies between.
    with np.errstate(divide="ignore", invalid="ignore"):
        passed = (onset[:, 1:] > level) != (onset[:, :-1] > level)
        part = (level - onset[:, :-1]) / (onset[:, 1:] - onset[:, :-1])
    found = np.argwhere(passed & np.isfinite(part))
    return [((c + part[r, c]) / (columns - 1), r / (rows - 1)) for r, c in found]


def _levels(onset: Array, running: float) -> Array:
    """Return round onset speeds over the range of a map, at which its colour changes."""
    known = onset[np.isfinite(onset) & (onset > 0.0)]
    if not known.size or known.max() <= known.min() * (1.0 + 1e-9):
        return np.array([])
    low, high = float(known.min()), float(known.max())
    # An onset on its way to zero or infinity would else fill the map with its last decades.
    high = min(high, 10.0 * max(running, low))
    low = max(low, 1e-3 * high)
    powers = range(math.floor(math.log10(low)), math.ceil(math.log10(high)))
    ladder = np.array([step * 10.0**power for power in powers for step in _LADDER])
    levels = ladder[(ladder >= low) & (ladder <= high)]
    if levels.size < _FEWEST:
        levels = np.array(style.ticks(low, high, most=8)["tickvals"])
        levels = levels[(levels >= low) & (levels <= high)]
    return levels


def _fields(onset: Array, levels: Array, grid: _Grid, unit: str) -> list[Trace]:
    """Return the coloured bands between the levels; one colour where there is one onset only."""
    # The bands are as many as the levels and one: below the first, and above each.
    most = max(len(levels), 1)
    if len(levels):
        ends = np.array([levels[0] / 2.0, *levels, 2.0 * levels[-1]])
        bands = np.interp(np.clip(onset, ends[0], ends[-1]), ends, np.arange(len(ends)) - 0.5)
        bands[np.isnan(onset)] = np.nan
    else:
        bands = np.where(np.isnan(onset), np.nan, np.where(onset > 0.0, most, 0.0))
    known = np.where(np.isinf(onset), "none", np.char.mod("%.4g", onset))
    hover = f"%{{x:.4g}}, %{{y:.4g}}<br>onset %{{customdata}} {unit}<extra></extra>"
    return [
        {
            "type": "contour", "x": grid.xs, "y": grid.ys, "z": bands, "zmin": 0, "zmax": most,
            "hoverongaps": False, "colorscale": _SEQUENCE, "customdata": known,
            "contours": {
                "start": 0.5, "end": most - 0.5, "size": 1, "coloring": "fill",
            },
            "line": {"width": 0.6, "color": "rgba(255,255,255,0.6)"}, "hovertemplate": hover,
            "name": "onset", "showlegend": False, "showscale": bool(len(levels)),
            "colorbar": _colour_bar(levels, unit),
        }
    ]  # fmt: skip


def _division(onset: Array, running: float, grid: _Grid, unit: str) -> list[Trace]:
    """Return the line of onsets at the running speed and the shade of its unstable side."""
    if not (np.any(onset < running) and np.any(onset >= running)):
        return []
    # By ratios, as the onset varies by powers; limited, as infinity has no contour.
    heights = np.log(np.clip(onset, 1e-2 * running, 1e2 * running))
    place = {
        "type": "contour", "x": grid.xs, "y": grid.ys, "z": heights, "hoverinfo": "skip",
        "showscale": False, "hoverongaps": False,
    }  # fmt: skip
    level = math.log(running)
    # Plotly fills where a constraint is broken.
    name = f"onset at the running speed, {running:.0f} {unit}"
    return [
        place | {
            "name": "unstable", "showlegend": False, "fillcolor": _UNSTABLE, "line": {"width": 0},
            "contours": {"type": "constraint", "operation": ">", "value": level},
        },
        place | {
            "name": name, "showlegend": True, "line": {"width": 3, "color": style.RED},
            "contours": {"type": "constraint", "operation": "=", "value": level},
        },
    ]  # fmt: skip


def _sides(onset: Array, running: float, grid: _Grid) -> list[dict[str, Any]]:
    """Return "stable" and "unstable" where the map is so."""
    with np.errstate(invalid="ignore"):
        sides = (("unstable", onset < running), ("stable", onset >= running))
    return [
        grid.note(words, place, size=15)
        for words, side in sides
        if side.any() and (place := grid.middle(side))
    ]


def _colour_bar(levels: Array, unit: str) -> dict[str, Any]:
    return {
        "title": {"text": f"Onset<br>[{unit}]"}, "tickvals": np.arange(len(levels)) + 0.5,
        "ticktext": [f"{level:.0f}" for level in levels], "thickness": 16, "outlinewidth": 0,
    }  # fmt: skip
