"""Texts and matrices of the force coefficients page."""

import numpy as np
import streamlit as st

from rotorcalc.analysis import Axes, ForceCoefficients
from rotorcalc.coefficients import BULK_FLOW, LAMINAR
from rotorcalc.units import Unit, Units
from ui.computed import Computed
from ui.format import amount, digits, minus, tex
from ui.words.citation import cited, is_stiff_unloaded, remark, source

FRAMES: dict[Axes, str] = {"XY": "X, Y: along the load", "rt": "r, t: line of centres"}
# From these shares of the rotor's mass on, the film's added mass is small, or worth counting.
_SMALL, _LARGE = 0.01, 0.1


def matrix(symbol: str, values: np.ndarray, unit: Unit, axes: Axes = "XY") -> str:
    """Return the LaTeX of a 2×2 matrix of coefficients: its elements' names and their values."""
    names = [[rf"{symbol}_{{{row}{column}}}" for column in axes] for row in axes]
    numbers = [[tex(float(value)) for value in row] for row in unit.of(values)]
    return f"{_bracket(names)}={_bracket(numbers)}{_unit(unit)}"


def show_matrices(computed: Computed, axes: Axes, units: Units) -> None:
    """Show K, C and k, c at the running speed."""
    here, film = computed.coefficients_here(axes), computed.film_coefficients_here(axes)
    left, right = st.columns(2)
    with left:
        st.latex(matrix("K", here.stiffness, units.stiffness, axes))
        _without_dimensions("k", film, film.stiffness, computed)
    with right:
        st.latex(matrix("C", here.damping, units.damping, axes))
        _without_dimensions("c", film, film.damping, computed)
    words = (
        "K and C per bearing at the running speed, Kᵢⱼ = −∂Fᵢ/∂Xⱼ (Eq. 5.14); "
        "k = KC/Fₒ and c = CΩC/Fₒ (Eq. 5.32)."
    )
    st.caption(f"{cited(words, computed, axes)} {remark(computed, axes)}")


def _without_dimensions(
    symbol: str, film: ForceCoefficients, values: np.ndarray, computed: Computed
) -> None:
    if computed.unloaded:
        st.caption(f"{symbol} is in units of the load, so it is undefined without load.")
    else:
        st.latex(matrix(symbol, values, Unit("-"), film.axes))


def dimensionless_caption(computed: Computed, symbol: str, against: str) -> str:
    """Return the caption of the charts of k and c."""
    unit = "k = KC/Fₒ" if symbol == "k" else "c = CΩC/Fₒ"
    words = (
        f"{unit}; dashed: negative values, drawn as −{symbol}. The unit is the load, so the trend "
        "is not that of K and C themselves."
    )
    rotor = "Eqs. 5.32, 5.45" if symbol == "k" else "Eq. 5.32"
    return cited(words, computed, f"over {against}", symbol, rotor=rotor)


def say_unloaded(computed: Computed) -> None:
    """Show why the dimensionless charts have no point without load."""
    if computed.unloaded:
        st.info(
            "Without load σ is infinite, and k and c, which are in units of the load, are "
            "undefined: the charts show no running speed. K and C against speed do."
        )


def say_other_centre(computed: Computed, units: Units) -> bool:
    """Show the stiffness without load of a film that names no equation for it; return whether."""
    if source(computed, "centre"):
        return False
    st.info(
        "This film has direct stiffness without load: it holds its journal, and cross-coupling is "
        "not alone there. At this machine's speed, its load taken off:"
        if is_stiff_unloaded(computed)
        else "This film has no direct stiffness without load. At this machine's speed, its load "
        "taken off:"
    )
    st.latex(matrix("K", computed.centred.stiffness, units.stiffness))
    return True


def show_centred(computed: Computed, units: Units) -> None:
    """Explain why a centred bearing has only cross-coupling, with this machine's numbers."""
    centred, here = computed.centred, computed.unloading_here
    unit = units.stiffness
    st.markdown(
        "Push a centred journal aside by a little. The film is now thinner where the journal went, "
        "and the turning surface drags oil towards that place: pressure rises a quarter turn "
        "**before** it, and pushes the journal sideways, on in the sense of rotation. Nothing "
        "pushes it back: no direct stiffness, only $K_{XY} = -K_{YX}$. If the journal whirls at "
        "half the shaft's speed, the narrow place travels as fast as the oil does on average, and "
        "no pressure rises at all: stiffness and damping cancel, so $K_{XY} = "
        "\\tfrac{\\Omega}{2}C_{XX}$. At this machine's speed, its load taken off:"
    )
    damping = tex(float(unit.of(centred.whirl_damping[0, 0])))
    st.latex(matrix("K", centred.stiffness, unit))
    st.latex(rf"\tfrac{{\Omega}}{{2}}C_{{XX}} = {damping}{_unit(unit)}")
    st.caption(cited("", computed, "centre"))
    st.markdown(_distance_from_centre(computed, here.stiffness, units))


def _distance_from_centre(computed: Computed, K: np.ndarray, units: Units) -> str:
    if computed.unloaded:
        return "This machine has no load: it runs exactly there, in the centre."
    unit = units.stiffness
    direct, cross = (minus(digits(float(unit.of(K[place])))) for place in ((0, 0), (0, 1)))
    return (
        f"Under its load it runs at ε = {digits(float(computed.point.eccentricity_ratio))}, with "
        f"$K_{{XX}}$ = {direct} and $K_{{XY}}$ = {cross} {unit.name}."
    )


def knows_added_mass(computed: Computed) -> bool:
    """Return whether the film's model has an added mass; say so if it has none."""
    try:
        computed.added_mass_here(LAMINAR)
    except ValueError as error:
        st.info(f"No added mass can be shown. {error}.")
        return False
    return True


def show_added_mass(computed: Computed, units: Units) -> None:
    """Show the film's added mass, its assumptions, and whether it matters."""
    laminar, bulk = computed.added_mass_here(LAMINAR), computed.added_mass_here(BULK_FLOW)
    share = float(laminar.to_rotor)
    st.latex(matrix("M", laminar.mass, units.mass))
    st.latex(r"M_{ij} = \alpha_m\frac{\rho R L^3}{12\,C}\,I_{ij}(\varepsilon)")
    density = amount(units.density, computed.machine.oil.density)
    st.markdown(
        f"**{_percent(share)} of half the rotor's mass**: {_verdict(share)} With a flat profile of "
        f"velocity (bulk flow, αₘ = 1) it is {_percent(float(bulk.to_rotor))}. At running speed "
        f"the force of the film's inertia is {_percent(float(laminar.to_damping))} of the force of "
        "its damping."
    )
    st.caption(
        "Assumes laminar flow, αₘ = 6/5, temporal inertia only, the film over half the "
        f"circumference, and the oil's density of {density} (sidebar, Oil). "
        "Definition: Eq. 5.14. The rest of the program neglects added mass, as the notes do."
    )


def _verdict(share: float) -> str:
    if share < _SMALL:
        return "negligible."
    if share < _LARGE:
        return "small; it would lower frequencies by about half as much at most."
    return "not negligible; it would lower natural frequencies and the onset, which neglect it."


def _percent(share: float) -> str:
    return f"{100.0 * share:.2g} %"


def _unit(unit: Unit) -> str:
    """Return the LaTeX of a unit; KaTeX has no raised three of its own."""
    if unit.name == "-":
        return ""
    return r"\ \text{" + unit.name.replace("³", "}^3\\text{") + "}"


def _bracket(rows: list[list[str]]) -> str:
    return r"\begin{bmatrix}" + r"\\".join(" & ".join(row) for row in rows) + r"\end{bmatrix}"
