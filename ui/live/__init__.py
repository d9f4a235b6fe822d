"""Charts redrawn in place, sliders that send while they move, previews, links, the connection.

Five Streamlit components, each a small script beside this file. While a slider is dragged its
values ask for a preview, which has charts and numbers alone; on release the page runs. With
ROTORCALC_LIVE=off nothing here is used, and pages have Streamlit's own charts and sliders.
"""

from ui.live.chart import show as show_chart
from ui.live.connection import keep
from ui.live.connection import show as show_connection
from ui.live.links import show as show_links
from ui.live.preview import show as show_preview
from ui.live.slider import Slider
from ui.live.slider import show as show_sliders

__all__ = [
    "Slider", "keep", "show_chart", "show_connection", "show_links", "show_preview", "show_sliders",
]  # fmt: skip
