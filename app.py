"""rotorcalc's app: python -m streamlit run app.py

Streamlit imports this file once, for the server, and runs it for a visitor of the home page.
"""

import streamlit as st

from ui.serving import settings

if __name__ != "__main__":
    # Before what reads them: a wrong setting ends the start with one line.
    settings.end_where_wrong()

from ui.serving import log, server
from ui.words import home

if __name__ == "__main__":
    home.draw()
else:
    app = st.App(  # `streamlit run` looks for these words
        __file__,
        routes=server.routes(),
        middleware=server.middleware(),
        lifespan=server.life,
        on_script_error=log.failed,
    )
