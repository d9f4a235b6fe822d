"""The app as a host runs it: python -m streamlit run serve.py.

`streamlit run app.py` serves the same pages; this adds what a server needs: a health check of the
core at /healthz, a structured log, and an id for what went wrong, in the log and on the page.
"""

from pathlib import Path

import streamlit as st

from ui import log, server

app = st.App(  # `streamlit run` looks for these words
    Path(__file__).with_name("app.py"),
    routes=server.routes(),
    middleware=server.middleware(),
    lifespan=server.life,
    on_script_error=log.failed,
)
