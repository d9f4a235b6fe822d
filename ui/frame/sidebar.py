"""The sidebar: presets, inputs in groups, the oil library, and display settings."""

from collections.abc import Callable
from contextlib import suppress
from typing import Literal

import streamlit as st
from streamlit.delta_generator import DeltaGenerator

from rotorcalc import PRESETS, Oil, oils
from rotorcalc.oils import ISO_VG, fitted_oil, iso_oil
from rotorcalc.units import AMPLITUDES, SI, SYSTEMS, Unit, Units
from ui.format import amount
from ui.frame import bore, supply
from ui.input_record import Input
from ui.inputs import (
    GROUPS,
    INPUTS,
    LAW,
    LAWS,
    OPEN_GROUPS,
    applies,
    fitting,
    has_gas,
    has_own,
    machine_of,
    number,
)
from ui.own import OF_OIL
from ui.session import Session, session
from ui.supply import film_temperature
from ui.widgets import show_inputs

# Pixels: its sliders are then so long that one pixel changes no input by more than 0.5 %.
WIDTH = 384
# On a narrower screen the sidebar leaves more to the page; where it covers the page, none.
_STYLE = """<style>
[data-testid=stSidebarContent] {padding-left: 0.75rem; padding-right: 0.75rem;}
[data-testid=stSidebarUserContent] {padding-left: 0; padding-right: 0;}
[data-testid=stSidebar] [data-testid=stExpanderDetails] {
  padding-left: 0.5rem; padding-right: 0.5rem;}
@media (max-width: 900px) {[data-testid=stSidebar] {max-width: 300px;}}
@media (max-width: 640px) {
  [data-testid=stSidebar][data-collapsed=false] {
    width: 100vw !important; min-width: 100vw; max-width: 100vw;}
}
</style>"""

_LOAD = INPUTS["load"]
_READINGS = {"0-p": "zero to peak", "p-p": "peak to peak"}


def draw_inputs() -> DeltaGenerator | None:
    """Draw the inputs in their groups; return the place of the bore's picture."""
    st.html(_STYLE)
    bearing = None
    for group in GROUPS:
        with st.expander(_title(group), expanded=group in OPEN_GROUPS):
            if group == "Bearing":
                bearing = bore.draw()
            _group(group)
            if group == "Oil" and has_own(session().values):
                st.caption(OF_OIL)
            elif group == "Oil" and not has_gas(session().values):
                _law()
                _oil_library()
    return bearing


def _title(group: str) -> str:
    return "Gas" if group == "Oil" and has_gas(session().values) else group


def draw_presets() -> None:
    """Draw the choice of a preset."""
    visitor = session()
    visitor.mirror("preset", visitor.preset)
    st.selectbox(
        "Preset",
        options=list(PRESETS),
        format_func=lambda key: PRESETS[key].title,
        key="preset",
        help=PRESETS[visitor.preset].note,
        on_change=lambda: visitor.set_preset(st.session_state["preset"]),
    )


def _group(group: str) -> None:
    """Draw a group's sliders, those of one stretch together, with the switches before some."""
    values, together, place = session().values, list[Input](), group
    for key, item in INPUTS.items():
        if item.group != group:
            continue
        if key in _SWITCHES and not (key == "T" and (has_gas(values) or has_own(values))):
            _sliders(place, together)
            place, together = f"{group}, after {key}", []
            _SWITCHES[key]()
        if applies(key, values) and key not in _ALONE:
            together.append(fitting(item, values))
    _sliders(place, together)


def _sliders(group: str, items: list[Input]) -> None:
    if items:
        show_inputs(group, items)


def _load() -> None:
    visitor = session()
    follows = visitor.values["load"] is None
    visitor.mirror("load_follows", follows)
    st.toggle("Load is half the rotor's weight", key="load_follows", on_change=_toggle_load)
    if not follows:
        show_inputs("Static load", [_LOAD])


def _toggle_load() -> None:
    visitor = session()
    if st.session_state["load_follows"]:
        visitor.set_value("load", None)
    else:
        # The weight does not depend on the journals' mass, which may leave no disk: no machine.
        weight = machine_of(visitor.values | {"load": None, "mj": 0.0}).static_load
        visitor.set_value("load", float(f"{weight:.5g}"))


# Switches that stand before an input, and inputs that their switch draws.
_SWITCHES: dict[str, Callable[[], None]] = {"load": _load, "T": supply.draw_switch}
_ALONE = frozenset(("load",))


def _law() -> None:
    """Draw the choice of the viscosity's law."""
    visitor = session()
    visitor.mirror("oil_law", visitor.values[LAW])
    st.segmented_control(
        "Viscosity law", list(LAWS), format_func=LAWS.__getitem__, key="oil_law", required=True,
        help="Both have the reference viscosity and its slope α at the reference temperature. The "
        "exponential law, the notes', keeps that slope; by Walther's law it flattens, as that of "
        "mineral oils does.",
        on_change=lambda: visitor.set_law(st.session_state["oil_law"]),
    )  # fmt: skip


def _oil_library() -> None:
    # Its content is drawn only while it is open, as every run of the page would pay for it.
    library = st.popover("Oil library", width="stretch", key="oil_library", on_change="rerun")
    if library.open:
        with library:
            _grades()
            st.divider()
            _fit()


def _grades() -> None:
    visitor = session()
    try:
        temperature = film_temperature(visitor.values)
    except ValueError as error:
        st.error(f"{error}.")
        return
    law = _law_of(visitor)
    grade = st.selectbox("ISO viscosity grade", list(ISO_VG), key="grade", persist_state="session")
    shown = amount(visitor.units.temperature, temperature)
    agrees = (
        f"The exponential law used here has the same viscosity and slope at the film temperature, "
        f"{shown}."
        if law == "exponential"
        else "Walther's law, used here, is the grade's at every temperature."
    )
    density, heat = (
        amount(unit, float(of(temperature)))
        for unit, of in (
            (visitor.units.density, oils.density),
            (visitor.units.heat_capacity, oils.heat_capacity),
        )
    )
    st.caption(
        "Mineral oil of viscosity index 100, by Walther's equation (ASTM D341). "
        f"{agrees} Such oils have a density of {density} (DIN 51757) and a heat capacity of {heat} "
        f"(Cragoe) at {shown}."
    )
    st.button(
        "Use this grade",
        key="use_grade",
        on_click=lambda: _take_over(iso_oil(grade, temperature=temperature, law=law), _GRADE),
    )


def _law_of(visitor: Session) -> Literal["exponential", "walther"]:
    return "walther" if visitor.values[LAW] == "walther" else "exponential"


def _fit() -> None:
    st.markdown("Fit α from two viscosities")
    columns = st.columns(2)
    visitor = session()
    units, law = visitor.units, _law_of(visitor)
    readings: list[tuple[float, float]] = []
    for column, place, T, mu in zip(columns, "12", (40.0, 80.0), (30e-3, 9e-3), strict=True):
        with column:
            warm = _reading(f"T{place}", units.temperature, T, (0.0, 150.0), units)
            thick = _reading(f"μ{place}", units.viscosity, mu, (1e-4, 5.0), units)
            readings.append((warm, thick))
    (T_1, mu_1), (T_2, mu_2) = sorted(readings)
    if not (T_1 < T_2 and mu_1 >= mu_2):
        st.error(
            "The two temperatures must differ, and the viscosity must be lower at the higher one."
        )
        return
    density = number(visitor.values, "rho")
    try:
        oil = fitted_oil(
            temperatures=(T_1, T_2), viscosities=(mu_1, mu_2), density=density, law=law
        )
    except ValueError as error:
        st.error(f"{error}.")
        return
    slope = amount(units.per_temperature, oil.temperature_coefficient)
    rule = "ln(μ1/μ2)/(T2 − T1)" if law == "exponential" else "−d ln μ/dT at T1, by Walther's law"
    st.caption(f"α = {rule} = {slope}.{_beyond((T_1, T_2), visitor)}")
    st.button("Use this fit", key="use_fit", on_click=lambda: _take_over(oil, _FIT))


def _beyond(fitted: tuple[float, float], visitor: Session) -> str:
    """Return in words that the film lies outside the temperatures of a fit, where it does."""
    with suppress(ValueError):
        T = film_temperature(visitor.values)
        if not fitted[0] <= T <= fitted[1]:
            shown = amount(visitor.units.temperature, T)
            return (
                f" The film, at {shown}, lies outside these temperatures: its viscosity is "
                "extrapolated."
            )
    return ""


def _reading(name: str, unit: Unit, usual: float, ends: tuple[float, float], units: Units) -> float:
    """Show a field of the fit, and return its value in SI."""
    low, high = (float(unit.of(end)) for end in ends)
    start = float(f"{float(unit.of(usual)):.3g}")
    key = f"fit_{name}_{units.name}"
    return unit.to_si(st.number_input(f"{name} [{unit.name}]", low, high, start, key=key))


# What a fit gives, and what a grade gives besides.
_FIT = ("mu", "TR", "alpha")
_GRADE = (*_FIT, "rho", "cp")


def _take_over(oil: Oil, keys: tuple[str, ...]) -> None:
    """Set inputs to an oil's values, and report those outside their ranges."""
    visitor = session()
    units = visitor.units
    visitor.problems.clear()
    for key in keys:
        item = INPUTS[key]
        # Six digits are more than a grade is known to, and short in a link.
        value = float(f"{float(item.unit(SI).of(getattr(oil, item.field.rpartition('.')[2]))):.6g}")
        if problem := item.problem(value, units):
            visitor.problems.append(
                f"{item.name(units)} = {item.text(value, units)} {problem}; it was left as it is."
            )
        else:
            visitor.values[key] = value


def draw_settings() -> None:
    """Draw the popover with the display settings."""
    visitor = session()
    settings = st.popover("Units and settings", width="stretch", key="settings", on_change="rerun")
    if not settings.open:
        return
    with settings:
        visitor.mirror("units", visitor.units_name)
        visitor.mirror("amplitude", visitor.amplitude)
        visitor.mirror("typed", visitor.typed)
        visitor.mirror("image_format", visitor.image_format)
        st.segmented_control(
            "Units", list(SYSTEMS), key="units", on_change=_set_units, required=True
        )
        st.segmented_control(
            "Amplitudes of vibration", list(AMPLITUDES), key="amplitude", required=True,
            format_func=_READINGS.__getitem__, on_change=_set_amplitude,
            help="In numbers, charts, report and CSV.",
        )  # fmt: skip
        st.toggle("Type values instead of sliding", key="typed", on_change=_set_typed)
        st.segmented_control(
            "Charts are saved as", ["png", "svg"], key="image_format", on_change=_set_image,
            required=True, help="The camera button above a chart saves it.",
        )  # fmt: skip


def _set_units() -> None:
    session().units_name = st.session_state["units"]


def _set_amplitude() -> None:
    session().amplitude = st.session_state["amplitude"]


def _set_typed() -> None:
    session().typed = st.session_state["typed"]


def _set_image() -> None:
    session().image_format = st.session_state["image_format"]
