"""Chart of bearings side by side: the speeds at which one machine begins to whirl on them."""

from collections.abc import Sequence

import numpy as np

from rotorcalc.arrays import Array
from rotorcalc.comparison import BearingResult
from rotorcalc.figures import style
from rotorcalc.figures.style import Chart, Trace, titled
from rotorcalc.units import Units


def onsets(
    found: Sequence[BearingResult], names: Sequence[str], speed: float, units: Units
) -> Chart:
    """Return the onset of whirl on each bearing as a bar, the highest on top.

    Bars of bearings on which the machine whirls at the running speed, `speed` [rad/s], are red. A
    bearing on which no onset was found has a bar over the whole axis, one that has no answer none.
    """
    onset = units.speed.of(np.array([one.onset for one in found]))
    order = np.argsort(onset, kind="stable")[: int(np.sum(~np.isnan(onset)))]
    here, ends = float(units.speed.of(speed)), onset[order]
    top = style.ceiling([*(1.15 * ends[np.isfinite(ends)]), 1.2 * here])
    x = style.axis(titled("Onset of whirl", "Ω_on", units.speed.name), 0.0, top)
    y = style.axis(
        "", -0.6, len(order) - 0.4, tickvals=np.arange(len(order), dtype=float),
        ticktext=[_named(names[int(i)], float(onset[i])) for i in order], showgrid=False,
    )  # fmt: skip
    mark = style.line([here, here], y["range"], "running speed", style.GREY, dash="dash", width=2.0)
    return style.chart(
        [_bars(np.minimum(ends, top), ends, here), mark], x, y, showlegend=False, bargap=0.25,
        height=130 + 28 * len(order), margin={"l": 190, "r": 28, "t": 28, "b": 60},
        annotations=[
            {"text": f"running speed, {here:.0f} {units.speed.name}", "x": here, "y": 1.0,
             "yref": "paper", "yanchor": "bottom", "showarrow": False}
        ],
    )  # fmt: skip


def _named(name: str, onset: float) -> str:
    """Return a bearing's name with its onset, which stands there clear of the running speed."""
    return f"{name}  <b>{onset:.0f}</b>" if np.isfinite(onset) else name


def _bars(lengths: Array, onsets: Array, here: float) -> Trace:
    words = ["" if np.isfinite(onset) else "no onset found" for onset in onsets]
    return {
        "type": "bar", "orientation": "h", "name": "onset", "hoverinfo": "skip",
        "x": lengths, "y": np.arange(len(lengths), dtype=float), "text": words,
        "textposition": "inside", "insidetextanchor": "end", "constraintext": "none",
        "textfont": {"size": 14},
        "marker": {"color": [style.UNSTABLE if onset <= here else style.BLUE for onset in onsets]},
    }  # fmt: skip
