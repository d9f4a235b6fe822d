import math

import streamlit as st

from rotorcalc.figures import style
from ui import page as frame

page = frame.begin("Machine at a glance", "test")
v = page.view
def draw(v):
    s = v.sweep
    u = page.units
    x = style.axis("Running speed Ω [rpm]", 0, float(u.speed.of(v.top_speed)))
    y = style.axis("Power", 0, style.ceiling(u.power.of(s.power_loss)))
    return style.chart([style.line(u.speed.of(s.speed), u.power.of(s.power_loss), "power", style.BLUE), *style.here(float(u.speed.of(v.speed)), float(u.power.of(v.point.power_loss)), x, y)], x, y)
page.chart(draw, "power", alt="power", caption="Eq")
st.write(v.onset)
