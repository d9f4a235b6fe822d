"""Where Streamlit meets the core: widgets to records, charts, the address bar, export.

A page is a function of its `page.Page`, which has the machine, its results, and the methods that
show them. `page.show` draws navigation and sidebar, and redraws the content at each move of a
slider.
"""

import os

# Before NumPy is imported. Its small matrices gain nothing from threads, which wait for each other
# by busy waiting: two computations side by side took seven times as long with two threads each.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
