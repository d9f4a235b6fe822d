"""Where Streamlit meets the core: widgets to records, charts, the address bar, export.

A page calls `page.begin`, which draws the navigation and the sidebar and returns the page's `Page`:
the machine and its results, and the methods that show them.
"""
