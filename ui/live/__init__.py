"""Charts that are redrawn in place, sliders that send while they move, and what joins the two.

Three Streamlit components, each a small script beside this file. While a thumb is held, its values
go through the feed, which answers with charts and numbers alone; let go, the page runs. With
ROTORCALC_LIVE=off nothing here is used, and pages have Streamlit's own charts and sliders.
"""

from ui.live.chart import show as show_chart
from ui.live.preview import show as show_feed
from ui.live.slider import Slider
from ui.live.slider import show as show_sliders

__all__ = ["Slider", "show_chart", "show_feed", "show_sliders"]
