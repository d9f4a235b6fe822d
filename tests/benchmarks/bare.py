"""A bare page to measure against: a slider and some charts of 200 points, drawn one way or another.

The address says how: ?charts=4&chart=streamlit|live&slider=streamlit|live
"""

import numpy as np
import plotly.graph_objects as go
import streamlit as st

from ui import live

params = st.query_params
way, number = params.get("chart", "streamlit"), int(params.get("charts", "4"))

if params.get("slider", "streamlit") == "live":
    now = st.session_state.get("value", 50.0)
    live.show_sliders(
        [live.Slider("value", "Value", "", now, 0.0, 100.0, 50.0, step=1.0, span=100.0)],
        key="slider",
        frame=0,
        on_move=lambda name, value, _: st.session_state.update({name: value}),
    )
    value = st.session_state.get("value", 50.0)
else:
    value = st.slider("Value", 0.0, 100.0, 50.0, 1.0)

x = np.linspace(0.0, 10.0, 200)
for i in range(number):
    trace = {"type": "scatter", "mode": "lines", "x": x, "y": np.sin(x + value / 10.0 + i)}
    layout = {
        "height": 250, "uirevision": "keep",
        "xaxis": {"range": [0, 10]}, "yaxis": {"range": [-1.2, 1.2]},
    }  # fmt: skip
    chart = {"data": [trace], "layout": layout}
    if way == "live":
        live.show_chart(chart, key=f"chart_{i}", alt=f"Chart {i}", config={})
    else:
        st.plotly_chart(go.Figure(chart), key=f"chart_{i}", theme=None)
