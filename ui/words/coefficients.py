"""Texts and matrices of the force coefficients preview."""

from typing import Literal

import numpy as np
import streamlit as st

from rotorcalc.analysis import Axes
from rotorcalc.coefficients import BULK_FLOW, LAMINAR
from rotorcalc.films import film_of
from rotorcalc.machine import oil_of
from rotorcalc.units import Unit, Units
from ui.computed import Computed
from ui.format import amount, digits, display, minus, tex
from ui.preview import Preview, Text
from ui.words.citation import at_one_speed, cited, is_stiff_unloaded, remark, source

FRAMES: dict[Axes, str] = {"XY": "X, Y: along the load", "rt": "r, t: line of centres"}
# What acts on a centred journal: the film that its rotation makes, and beside it supplied recesses.
_SELF_ACTING = (
    "Displace a centred journal slightly. The film becomes thinner on that side, and the "
    "turning surface drags oil into the narrowing gap: the pressure rises a quarter turn "
    "**before** the thinnest place and pushes the journal sideways, in the sense of rotation. "
    "Nothing pushes it back: there is no direct stiffness, only $K_{XY} = -K_{YX}$. If the "
    "journal whirls at half the shaft's speed, the thinnest place travels as fast as the oil "
    "does on average, and no pressure builds up: stiffness and damping cancel, so $K_{XY} = "
    "\\tfrac{\\Omega}{2}C_{XX}$."
)
_SUPPLIED = (
    "Displace a centred journal slightly. Oil leaves the recess that it nears less easily, so the "
    "pressure there rises and pushes it back: the supply gives direct stiffness, at rest and at "
    "any speed. But the turning surface drags oil over the lands as in any film, and where the "
    "film is thinner that pushes the journal sideways, in the sense of rotation: $K_{XY} = "
    "-K_{YX} = \\tfrac{\\Omega}{2}C_{XX}$. A whirl slower than half the shaft's speed is fed, a "
    "faster one is damped: the whirl ratio is ½, whatever the supply. Its stiffness raises the "
    "speed at which the rotor whirls, not that ratio."
)
# From these shares of the rotor's mass on, the film's added mass is small, or worth counting.
_SMALL, _LARGE = 0.01, 0.1


def matrix(symbol: str, values: np.ndarray, unit: Unit, axes: Axes = "XY") -> str:
    """Return the equation of a 2×2 matrix of coefficients: its elements' names and values."""
    # What rounding leaves beside entries that are zero.
    values = np.where(np.abs(values) > 1e-12 * np.abs(values).max(), values, 0.0)
    names = [[rf"{symbol}_{{{row}{column}}}" for column in axes] for row in axes]
    numbers = [[tex(float(value)) for value in row] for row in unit.of(values)]
    return display(f"{_bracket(names)}={_bracket(numbers)}{_unit(unit)}")


def show_matrices(preview: Preview, axes: Axes) -> None:
    """Show K, C and k, c at the running speed."""
    units = preview.units
    left, right = st.columns(2)
    with left:
        preview.say("K", lambda c: Text(
            matrix("K", c.coefficients_here(axes).stiffness, units.stiffness, axes)
        ))  # fmt: skip
        preview.say("k", lambda c: _without_dimensions("k", c, axes))
    with right:
        preview.say("C", lambda c: Text(
            matrix("C", c.coefficients_here(axes).damping, units.damping, axes)
        ))  # fmt: skip
        preview.say("c", lambda c: _without_dimensions("c", c, axes))
    words = (
        "K and C per bearing at the running speed, Kᵢⱼ = −∂Fᵢ/∂Xⱼ (Eq. 5.14); "
        "k = KC/Fₒ and c = CΩC/Fₒ (Eq. 5.32)."
    )
    st.caption(f"{cited(words, preview.computed, axes)} {remark(preview.computed, axes)}")


def _without_dimensions(symbol: Literal["k", "c"], computed: Computed, axes: Axes) -> Text:
    if computed.has_own:
        return Text(f"{symbol} is in units of load and clearance, which is not known.", "caption")
    if computed.unloaded:
        return Text(
            f"{symbol} is in units of the load, so it is undefined without load.", "caption"
        )
    film = computed.film_coefficients_here(axes)
    return Text(matrix(symbol, film.stiffness if symbol == "k" else film.damping, Unit("-"), axes))


def dimensionless_caption(computed: Computed, symbol: str, against: str) -> str:
    """Return the caption of the charts of k and c."""
    unit = "k = KC/Fₒ" if symbol == "k" else "c = CΩC/Fₒ"
    words = (
        f"{unit}; dashed: negative values, drawn as −{symbol}. The unit is the load, so the trend "
        f"is not that of K and C themselves. {at_one_speed(computed)}"
    ).strip()
    rotor = "Eqs. 5.32, 5.45" if symbol == "k" else "Eq. 5.32"
    return cited(words, computed, f"over {against}", symbol, rotor=rotor)


def unloaded(computed: Computed) -> Text | None:
    """Return why the dimensionless charts have no point without load."""
    if not computed.unloaded:
        return None
    return Text(
        "Without load σ is infinite, and k and c, which are in units of the load, are "
        "undefined: the charts show no running speed. K and C against speed do.",
        "info",
    )


def depends_on_whirl(computed: Computed) -> bool:
    """Return whether K and C depend on the whirl's frequency; say so if they do not."""
    if film_of(computed.machine.bearing).frequency_dependent:
        return True
    st.info(
        "This film has no parts that move and does not yield: its K and C are the same whatever "
        "the frequency of the whirl. On tilting pads, a floating ring or a foil they are not."
    )
    return False


def whirl_ratio_caption(computed: Computed, symbol: str) -> str:
    """Return the caption of K or C over the whirl ratio."""
    parts = "The foil yields and the gas is squeezed" if computed.has_gas else (
        "The film's moving parts follow the journal"
    )  # fmt: skip
    words = (
        f"{parts} at ν = ω/Ω; the mark is imbalance, ν = 1. "
        "Onset and modes take each whirl at its own ν. "
        + ("$K=\\operatorname{Re}Z(ν)$." if symbol == "K" else "$C=\\operatorname{Im}Z(ν)/(νΩ)$.")
    )
    return cited(words, computed, "stiffness" if symbol == "K" else "damping")


def say_other_centre(preview: Preview) -> bool:
    """Show the stiffness without load of a film that names no equation for it; return whether."""
    if source(preview.computed, "centre"):
        return False
    st.info(
        "This film has direct stiffness even without load, so cross-coupling does not act alone. "
        "At this machine's speed, with its load removed:"
        if is_stiff_unloaded(preview.computed)
        else "This film has no direct stiffness without load. At this machine's speed, with its "
        "load removed:"
    )
    preview.say("centred", lambda c: Text(_centred_stiffness(c, preview.units)))
    return True


def _centred_stiffness(computed: Computed, units: Units) -> str:
    return matrix("K", computed.centred.stiffness, units.stiffness)


def show_centred(preview: Preview) -> None:
    """Explain what acts on a centred journal, with this machine's numbers."""
    st.markdown(
        f"{_SUPPLIED if is_stiff_unloaded(preview.computed) else _SELF_ACTING} At this machine's "
        "speed, with its load removed:"
    )
    preview.say("centred", lambda c: Text(_centred(c, preview.units)))
    st.caption(cited("", preview.computed, "centre"))
    preview.say("distance", lambda c: Text(_distance_from_centre(c, preview.units)))


def unloading_alt(computed: Computed) -> str:
    """Return what the chart of the stiffness over the load shows, for who does not see it."""
    direct = "stays" if is_stiff_unloaded(computed) else "falls to zero"
    return f"Stiffness against eccentricity ratio: direct {direct}, cross stays."


def _centred(computed: Computed, units: Units) -> str:
    damping = tex(float(units.stiffness.of(computed.centred.whirl_damping[0, 0])))
    half = display(rf"\tfrac{{\Omega}}{{2}}C_{{XX}} = {damping}{_unit(units.stiffness)}")
    return f"{_centred_stiffness(computed, units)}\n\n{half}"


def _distance_from_centre(computed: Computed, units: Units) -> str:
    if computed.unloaded:
        return "This machine has no load, so its journal runs exactly in the centre."
    unit, K = units.stiffness, computed.unloading_here.stiffness
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
        # Without the field's name in front.
        st.info(f"No added mass can be shown: {f'{error}'.partition(': ')[2]}.")
        return False
    return True


def show_added_mass(preview: Preview) -> None:
    """Show the film's added mass, its assumptions, and whether it matters."""
    units = preview.units
    preview.say("added_mass", lambda c: Text(
        matrix("M", c.added_mass_here(LAMINAR).mass, units.mass)
    ))  # fmt: skip
    st.latex(r"M_{ij} = \alpha_m\frac{\rho R L^3}{12\,C}\,I_{ij}(\varepsilon)")
    preview.say("added_share", lambda c: Text(_share(c)))
    preview.say("added_density", lambda c: Text(_assumed(c, units), "caption"))


def _share(computed: Computed) -> str:
    laminar, bulk = computed.added_mass_here(LAMINAR), computed.added_mass_here(BULK_FLOW)
    share = float(laminar.to_rotor)
    return (
        f"**{_percent(share)} of half the rotor's mass**: {_verdict(share)} With a flat profile of "
        f"velocity (bulk flow, αₘ = 1) it is {_percent(float(bulk.to_rotor))}. At running speed "
        f"the force of the film's inertia is {_percent(float(laminar.to_damping))} of the force of "
        "its damping."
    )


def _assumed(computed: Computed, units: Units) -> str:
    density = amount(units.density, oil_of(computed.machine).density)
    return (
        "Assumes laminar flow, αₘ = 6/5, temporal inertia only, the film over half the "
        f"circumference, and the oil's density of {density} (sidebar, Oil). "
        "Definition: Eq. 5.14. The rest of the program neglects added mass, as the notes do."
    )


def _verdict(share: float) -> str:
    if share < _SMALL:
        return "negligible."
    if share < _LARGE:
        return "small; it would lower frequencies by at most about half this share."
    return "not negligible; natural frequencies and the onset, computed without it, would be lower."


def _percent(share: float) -> str:
    return f"{digits(float(f'{100.0 * share:.2g}'))} %"


def _unit(unit: Unit) -> str:
    """Return the LaTeX of a unit."""
    return "" if unit.name == "-" else rf"\ \text{{{unit.name}}}"


def _bracket(rows: list[list[str]]) -> str:
    return r"\begin{bmatrix}" + r"\\".join(" & ".join(row) for row in rows) + r"\end{bmatrix}"
