"""Where Streamlit meets the core: widgets to records, charts, the address bar, export.

A page stands in `with page.framed(…)`, which draws the navigation and the sidebar and gives the
page's `Page`: the machine and its results, and the methods that show them.
"""

import os

# Before NumPy is imported. Its small matrices gain nothing from threads, which wait for each other
# by turning idly: two computations side by side took seven times as long with two threads each.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
