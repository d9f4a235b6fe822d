"""Charts that are redrawn in place, and sliders that send while they move.

Two Streamlit components, each a small script beside this file. With ROTORCALC_LIVE=off nothing here
is used, and pages have Streamlit's own charts and sliders.
"""

from ui.live.chart import show as show_chart
from ui.live.slider import show as show_slider

__all__ = ["show_chart", "show_slider"]
