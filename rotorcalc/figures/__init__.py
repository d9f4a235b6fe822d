"""Charts of results as Plotly figures, without any computation.

Each function takes result records and returns one dict; `figure` makes a `go.Figure` of it.
"""

from rotorcalc.figures.cases import Case, widened, with_cases
from rotorcalc.figures.style import Chart, figure, themed
from rotorcalc.units import SI, SYSTEMS, US, Unit, Units

__all__ = [
    "SI", "SYSTEMS", "US", "Case", "Chart", "Unit", "Units", "figure", "themed",
    "widened", "with_cases",
]  # fmt: skip
