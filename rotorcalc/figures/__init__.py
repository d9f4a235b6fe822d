"""Charts of results as Plotly figures, without any computation.

Each function takes result records and returns one dict; `figure` makes a `go.Figure` of it.
"""

from rotorcalc.figures.style import Chart, figure, themed, with_baseline
from rotorcalc.units import SI, SYSTEMS, US, Unit, Units

__all__ = ["SI", "SYSTEMS", "US", "Chart", "Unit", "Units", "figure", "themed", "with_baseline"]
