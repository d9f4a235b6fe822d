"""A preview: a page's content at the value to which an input is being dragged."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from rotorcalc.figures import Chart, themed, with_baseline
from rotorcalc.units import Units
from ui.bearing import Values
from ui.computed import Computed, computed_from
from ui.inputs import input_named
from ui.results.row import row_key
from ui.results.table import RESULTS

Draw = Callable[[Computed], Chart]


@dataclass
class Preview:
    """A page as last drawn: its machine, the pinned one, and its charts and results."""

    values: Values
    baseline: Computed | None
    units: Units
    dark: bool
    charts: dict[str, Draw] = field(default_factory=dict)
    rows: list[tuple[str, ...]] = field(default_factory=list)

    def at(self, name: str, value: str) -> dict[str, Any]:
        """Return the charts by key, and the texts of each row of results, at an input's value.

        Raises ValueError where there is no such input, or the value makes no machine.
        """
        # The other inputs are those of the page as last drawn, which its charts show beside it.
        computed = computed_from(self.values | {name: input_named(name).taken(value, self.units)})
        return {
            "charts": {key: self._still(draw, computed) for key, draw in self.charts.items()},
            "rows": {
                row_key(keys): [RESULTS[key].shown(computed, self.units) for key in keys]
                for keys in self.rows
            },
        }

    def _still(self, draw: Draw, computed: Computed) -> Chart:
        """Return a chart without its frames: no animation plays while a slider is dragged."""
        chart = dict(compared(draw, computed, self.baseline))
        chart.pop("frames", None)
        return themed(chart, dark=self.dark)


def compared(draw: Draw, computed: Computed, baseline: Computed | None) -> Chart:
    """Return a chart of a machine, the pinned one's thin and grey behind it."""
    chart = draw(computed)
    if baseline is None:
        return chart
    try:
        return with_baseline(chart, draw(baseline))
    except ValueError:  # the pinned machine's film does not give this result
        return chart
