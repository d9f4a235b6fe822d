"""The results that pages show: each with its equation, that one's number, and numbers put in.

Equations are filled with SI values, in which they hold as they stand; results have the units shown.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import streamlit as st

from rotorcalc import analyse, modes
from rotorcalc.onset import closed_form
from rotorcalc.unbalance_peaks import ResponsePeaks
from rotorcalc.unbalance_response import orbit_ellipse
from rotorcalc.units import Unit, Units
from ui.computed import Computed


@dataclass(frozen=True)
class Result:
    """A number that pages show.

    `equation` is LaTeX, `number` where it stands in the notes, `filled` its right-hand side with
    this machine's SI values, `remark` what the equation does not say, `nought` a word for zero.
    """

    key: str
    label: str
    kind: str
    value: Callable[[Computed], float]
    number: str
    equation: str
    filled: Callable[[Computed], str]
    remark: str = ""
    nought: str = ""

    def unit(self, units: Units) -> Unit:
        """Return the unit in which the result is shown."""
        return getattr(units, self.kind)

    def shown(self, computed: Computed, units: Units) -> str:
        """Return the result with its unit, in words where it is no number."""
        value = self.value(computed)
        if math.isnan(value):
            return "none"
        if math.isinf(value):
            return "no limit"
        if value == 0.0 and self.nought:
            return self.nought
        unit = self.unit(units)
        number = digits(float(unit.of(value)))
        return number + {"-": "", "°": "°"}.get(unit.name, f" {unit.name}")

    def change(self, computed: Computed, baseline: Computed) -> str | None:
        """Return the change from the baseline's result, or nothing where that is no number."""
        live, pinned = self.value(computed), self.value(baseline)
        if not (math.isfinite(live) and math.isfinite(pinned)) or pinned == 0.0:
            return None
        change = (live / pinned - 1.0) * 100.0
        return f"{'+' if change >= 0.0 else '−'}{digits(abs(change))} % vs A"


def row_key(keys: tuple[str, ...]) -> str:
    """Return the key of a row of results."""
    return f"results_{keys[0]}"


def show_results(computed: Computed, baseline: Computed | None, units: Units, *keys: str) -> None:
    """Show results in a row, each above a popover that explains it.

    The page's style lays out the pairs: a column each would be an element more.
    """
    with st.container(key=row_key(keys)):
        for key in keys:
            result = RESULTS[key]
            change = None if baseline is None else result.change(computed, baseline)
            st.metric(
                result.label,
                result.shown(computed, units),
                change,
                delta_color="off",
                delta_arrow="off",
            )
            _explain(result, computed, units)


def _explain(result: Result, computed: Computed, units: Units) -> None:
    opened = st.popover(
        result.number, type="tertiary", key=f"explain_{result.key}", on_change="rerun"
    )
    if opened.open:
        with opened:
            st.latex(result.equation)
            if computed.unloaded:
                st.caption("Without load: the limit ε → 0.")
            else:
                st.latex(f"= {result.filled(computed)}")
            st.markdown(f"{result.label}: **{result.shown(computed, units)}**")
            if result.remark:
                st.caption(result.remark)


def digits(value: float) -> str:
    """Return a number to four digits, whole from a thousand to a million."""
    if 1e3 <= abs(value) < 1e6:
        return f"{value:.0f}"
    return f"{value:.4g}"


def tex(value: float, unit: str = "") -> str:
    """Return a number in LaTeX, to four digits, with its SI unit."""
    if math.isnan(value):
        return r"\text{none}"
    if math.isinf(value):
        return r"\infty"
    mantissa, _, power = digits(value).partition("e")
    number = mantissa + (rf"\cdot 10^{{{int(power)}}}" if power else "")
    words = unit.replace(" ", r"\,")
    return number + (rf"\ \mathrm{{{words}}}" if unit else "")


def leading(computed: Computed) -> complex:
    """Return the eigenvalue of the oscillating mode nearest to growth at running speed [1/s]."""
    values = computed.point.flexible_eigenvalues
    waves = values[values.imag > 0.0]
    return complex(waves[np.argmax(waves.real)]) if len(waves) else complex(math.nan)


def _highest(peaks: ResponsePeaks) -> float:
    """Return the speed of the highest peak [rad/s], not a number where there is none."""
    return float(peaks.speed[np.argmax(peaks.amplitude)]) if len(peaks.speed) else math.nan


def _orbit(response: np.ndarray) -> tuple[complex, complex, float]:
    orbit = orbit_ellipse(response)
    return complex(orbit.forward), complex(orbit.backward), float(orbit.semi_major)


def _circles(response: np.ndarray) -> str:
    forward, backward, size = _orbit(response)
    return f"{tex(abs(forward))} + {tex(abs(backward))} = {tex(size, 'm')}"


def _threshold(computed: Computed) -> str:
    K_eq, ratio = float(computed.point.equivalent_stiffness), float(computed.point.whirl_ratio)
    M, omega = computed.machine.rotor.half_mass, float(computed.point.rigid_threshold)
    if ratio == 0.0:
        return r"\infty\ \text{(no whirl at this eccentricity)}"
    root = rf"\sqrt{{\frac{{{tex(K_eq)}}}{{{tex(M)}}}}}"
    return rf"\frac{{1}}{{{tex(ratio)}}}{root} = {tex(omega, 'rad/s')}"


def _sommerfeld(computed: Computed) -> str:
    machine, b = computed.machine, computed.machine.bearing
    top = r"\cdot ".join(map(tex, (machine.viscosity, computed.speed, b.length, b.radius)))
    squared = rf"\left(\frac{{{tex(b.length)}}}{{{tex(b.radial_clearance)}}}\right)^2"
    sigma = tex(float(computed.point.sommerfeld))
    return rf"\frac{{{top}}}{{4\cdot {tex(machine.static_load)}}}{squared} = {sigma}"


def _sag(computed: Computed) -> str:
    machine = computed.machine
    load, k = tex(machine.static_load), tex(machine.rotor.shaft_stiffness)
    return rf"\frac{{{load}}}{{{k}}} = {tex(machine.static_sag, 'm')}"


def _eccentricity(computed: Computed) -> str:
    eps, sigma = (
        tex(float(computed.point.eccentricity_ratio)),
        tex(float(computed.point.sommerfeld)),
    )
    return (
        rf"{sigma} = \frac{{(1-{eps}^2)^2}}{{{eps}\sqrt{{16\cdot {eps}^2+\pi^2(1-{eps}^2)}}}},"
        rf"\quad \varepsilon = {eps}"
    )


def _attitude(computed: Computed) -> str:
    eps, phi = tex(float(computed.point.eccentricity_ratio)), float(computed.point.attitude_angle)
    return (
        rf"\arctan\frac{{\pi\sqrt{{1-{eps}^2}}}}{{4\cdot {eps}}} = {tex(phi, 'rad')}"
        rf" = {tex(math.degrees(phi))}^\circ"
    )


def _film(computed: Computed) -> str:
    C, eps = computed.machine.bearing.radial_clearance, float(computed.point.eccentricity_ratio)
    return rf"{tex(C)}\,(1-{tex(eps)}) = {tex(float(computed.point.minimum_film_thickness), 'm')}"


def _power(computed: Computed) -> str:
    power = float(computed.point.power_loss)
    return rf"{tex(computed.speed)}\cdot {tex(power / computed.speed, 'N m')} = {tex(power, 'W')}"


def _flow(computed: Computed) -> str:
    b, eps = computed.machine.bearing, float(computed.point.eccentricity_ratio)
    factors = (computed.speed, b.radius, b.length, b.radial_clearance, eps)
    product = r"\cdot ".join(map(tex, factors))
    return rf"{product} = {tex(float(computed.point.side_flow), 'm^3/s')}"


def _matrix(matrix: np.ndarray) -> str:
    rows = (" & ".join(tex(float(value)) for value in row) for row in matrix)
    return r"\begin{bmatrix}" + r" \\ ".join(rows) + r"\end{bmatrix}"


def _stiffness(computed: Computed) -> str:
    p = computed.point
    return (
        rf"{tex(float(p.equivalent_stiffness), 'N/m')}\quad\text{{of}}\quad "
        rf"K={_matrix(p.stiffness)},\ C={_matrix(p.damping)}"
    )


def _ratio(computed: Computed) -> str:
    p = computed.point
    ratio = tex(float(p.whirl_ratio))
    return rf"{ratio}\quad\text{{with}}\quad K_{{eq}} = {tex(float(p.equivalent_stiffness), 'N/m')}"


def _critical_mass(computed: Computed) -> str:
    p = computed.point
    if not math.isfinite(float(p.critical_mass)):
        return r"\infty\ \text{(no whirl at this eccentricity)}"
    product = rf"({tex(float(p.whirl_ratio))}\cdot {tex(computed.speed)})^2"
    top = tex(float(p.equivalent_stiffness))
    return rf"\frac{{{top}}}{{{product}}} = {tex(float(p.critical_mass), 'kg')}"


def _flexible(computed: Computed) -> str:
    p, k = computed.point, computed.machine.rotor.shaft_stiffness
    series = rf"1+{tex(float(p.equivalent_stiffness))}/{tex(k)}"
    top = tex(float(p.rigid_threshold))
    return rf"\frac{{{top}}}{{\sqrt{{{series}}}}} = {tex(float(p.flexible_threshold), 'rad/s')}"


def _margin(computed: Computed) -> float:
    return computed.onset.speed / computed.speed - 1.0


def _viscosity(computed: Computed) -> str:
    oil, T = computed.machine.oil, computed.machine.temperature
    power = rf"-{tex(oil.temperature_coefficient)}({tex(T)}-{tex(oil.reference_temperature)})"
    viscosity = tex(computed.machine.viscosity, "Pa s")
    return rf"{tex(oil.reference_viscosity)}\,e^{{{power}}} = {viscosity}"


def _load(computed: Computed) -> str:
    load = tex(computed.machine.static_load, "N")
    if computed.machine.load is not None:
        return rf"{load}\quad\text{{given}}"
    return rf"\tfrac12\cdot {tex(computed.machine.rotor.mass)}\cdot 9.80665 = {load}"


def _onset(computed: Computed, flexible: bool) -> str:
    """Return Eq. 5.50 with the numbers at the onset, or what holds there where it does not."""
    onset = computed.onset if flexible else computed.rigid_onset
    speed = tex(onset.speed, "rad/s")
    if not math.isfinite(onset.speed) or not closed_form.has_closed_form(computed.machine):
        return speed
    there = analyse(computed.machine, onset.speed)
    K_eq, ratio = tex(float(there.equivalent_stiffness)), tex(float(there.whirl_ratio))
    M, K_rot = tex(computed.machine.rotor.half_mass), tex(computed.machine.rotor.shaft_stiffness)
    root = rf"\frac{{1}}{{{ratio}}}\sqrt{{\frac{{{K_eq}}}{{{M}}}}}"
    series = rf"\frac{{1}}{{\sqrt{{1+{K_eq}/{K_rot}}}}}\," if flexible else ""
    return rf"{series}{root} = {speed}"


_ONSET_REMARK = (
    "With the equilibrium at that very speed. With midspan damping or journal mass, for which the "
    "equation does not hold, it is found on the machine's eigenvalues: max Re λ = 0."
)

RESULTS: dict[str, Result] = {
    result.key: result
    for result in (
        Result(
            "viscosity", "Viscosity μ", "viscosity", lambda c: c.machine.viscosity, "Sheet",
            r"\mu = \mu_R\, e^{-\alpha(T-T_R)}", _viscosity,
        ),
        Result(
            "static_load", "Load per bearing Fₒ", "force", lambda c: c.machine.static_load,
            "Eq. 5.3",
            r"F_o = M g", _load,
        ),
        Result(
            "static_sag", "Static sag Γ", "film", lambda c: c.machine.static_sag, "Eq. 5.50",
            r"\Gamma = \frac{F_o}{K_{rot}}",
            _sag,
        ),
        Result(
            "sommerfeld", "Sommerfeld number σ", "number", lambda c: float(c.point.sommerfeld),
            "Eq. 5.8",
            r"\sigma = \frac{\mu\Omega L R}{4F_o}\left(\frac{L}{C}\right)^2", _sommerfeld,
            "The modified one. The classical Sommerfeld number is S = σ(D/L)²/π.",
        ),
        Result(
            "eccentricity_ratio", "Eccentricity ratio ε", "number",
            lambda c: float(c.point.eccentricity_ratio), "Eq. 5.8",
            r"\sigma = \frac{(1-\varepsilon^2)^2}"
            r"{\varepsilon\sqrt{16\varepsilon^2+\pi^2(1-\varepsilon^2)}}",
            _eccentricity, "Solved for ε by iteration.",
        ),
        Result(
            "attitude_angle", "Attitude angle φ", "angle", lambda c: float(c.point.attitude_angle),
            "Eq. 5.7", r"\phi = \arctan\frac{\pi\sqrt{1-\varepsilon^2}}{4\varepsilon}", _attitude,
        ),
        Result(
            "minimum_film_thickness", "Smallest film h", "film",
            lambda c: float(c.point.minimum_film_thickness), "Eq. 5.19",
            r"h_{min} = C(1-\varepsilon)", _film,
        ),
        Result(
            "power_loss", "Power loss", "power", lambda c: float(c.point.power_loss),
            "Sheet", r"P = \Omega\left(\frac{2\pi\mu\Omega R^3L}{C\sqrt{1-\varepsilon^2}}"
            r"+\tfrac12 e F_o\sin\phi\right)", _power,
            "Per bearing: shear of the turning surface, and half the couple of the load, which "
            "drives the pressure flow.",
        ),
        Result(
            "side_flow", "Side flow", "flow", lambda c: float(c.point.side_flow),
            "Sheet", r"Q = \Omega R L C\,\varepsilon", _flow, "Per bearing, both ends together.",
        ),
        Result(
            "equivalent_stiffness", "Equivalent stiffness", "stiffness",
            lambda c: float(c.point.equivalent_stiffness), "Eq. 5.45",
            r"K_{eq} = \frac{K_{XX}C_{YY}+K_{YY}C_{XX}-C_{YX}K_{XY}-C_{XY}K_{YX}}{C_{XX}+C_{YY}}",
            _stiffness,
        ),
        Result(
            "whirl_ratio", "Whirl ratio ω̄", "number", lambda c: float(c.point.whirl_ratio),
            "Eq. 5.46", r"\bar\omega^2 = \frac{(K_{eq}-K_{XX})(K_{eq}-K_{YY})-K_{XY}K_{YX}}"
            r"{\Omega^2(C_{XX}C_{YY}-C_{XY}C_{YX})}", _ratio,
            "At this speed's equilibrium; 0 where the film cannot whirl.",
        ),
        Result(
            "critical_mass", "Critical mass per bearing", "mass",
            lambda c: float(c.point.critical_mass), "Eq. 5.45",
            r"M_c = \frac{K_{eq}}{(\bar\omega\,\Omega)^2}", _critical_mass,
            "With more mass per bearing a rigid rotor is unstable at this speed.",
        ),
        Result(
            "rigid_threshold", "Threshold, rigid shaft", "speed",
            lambda c: float(c.point.rigid_threshold), "Eq. 5.47",
            r"\Omega_s = \frac{1}{\bar\omega}\sqrt{\frac{K_{eq}}{M}}", _threshold,
            "At this speed's equilibrium.",
        ),
        Result(
            "flexible_threshold", "Threshold, flexible shaft", "speed",
            lambda c: float(c.point.flexible_threshold), "Eq. 5.50",
            r"\Omega_{sf} = \frac{\Omega_s}{\sqrt{1+K_{eq}/K_{rot}}}", _flexible,
            "At this speed's equilibrium; without midspan damping and journal mass.",
        ),
        Result(
            "onset_speed", "Onset of whirl Ωₛ", "speed", lambda c: c.onset.speed, "Eq. 5.50",
            r"\Omega = \Omega_{sf}(\varepsilon(\Omega)) \;\Leftrightarrow\; "
            r"\max\mathrm{Re}\,\lambda = 0",
            lambda c: _onset(c, flexible=True), _ONSET_REMARK, nought="any speed",
        ),
        Result(
            "rigid_onset", "Onset if the shaft were rigid", "speed", lambda c: c.rigid_onset.speed,
            "Eq. 5.47", r"\Omega = \Omega_s(\varepsilon(\Omega)) \;\Leftrightarrow\; "
            r"\max\mathrm{Re}\,\lambda = 0",
            lambda c: _onset(c, flexible=False), _ONSET_REMARK, nought="any speed",
        ),
        Result(
            "whirl_frequency", "Whirl frequency", "speed",
            lambda c: c.onset.whirl_frequency, "Eq. 5.47", r"\omega_s = |\mathrm{Im}\,\lambda|",
            lambda c: tex(c.onset.whirl_frequency, "rad/s"), "At the onset. " + _ONSET_REMARK,
            nought="half of any",
        ),
        Result(
            "margin", "Margin to onset", "percent", _margin, "Ωₛ/Ω − 1",
            r"\frac{\Omega_s}{\Omega}-1",
            lambda c: rf"\frac{{{tex(c.onset.speed)}}}{{{tex(c.speed)}}}-1 = {tex(_margin(c))}",
        ),
        Result(
            "damping_ratio", "Damping ratio ζ", "number",
            lambda c: float(modes.damping_ratio(leading(c))), "Re λ, Im λ",
            r"\zeta = -\frac{\mathrm{Re}\,\lambda}{|\lambda|}",
            lambda c: rf"{tex(float(modes.damping_ratio(leading(c))))},\quad \lambda = "
            rf"{tex(leading(c).real)} \pm {tex(abs(leading(c).imag))}\,j",
            "Of the oscillating mode that decays slowest, or grows fastest, at the running speed.",
        ),
        Result(
            "natural_frequency", "Mode's frequency", "speed",
            lambda c: abs(leading(c).imag), "Im λ", r"\omega_d = |\mathrm{Im}\,\lambda|",
            lambda c: tex(abs(leading(c).imag), "rad/s"),
            "Frequency of the oscillating mode that decays slowest at the running speed.",
        ),
        Result(
            "disk_amplitude", "Disk orbit", "film",
            lambda c: _orbit(c.point.disk_response)[2], "Eq. 5.38", r"a = |f| + |b|",
            lambda c: _circles(c.point.disk_response),
            "Semi-major axis; f and b are the orbit's forward and backward circles, (X ± jY)/2.",
        ),
        Result(
            "journal_amplitude", "Journal orbit", "film",
            lambda c: _orbit(c.point.journal_response)[2], "Eq. 5.38", r"a = |f| + |b|",
            lambda c: _circles(c.point.journal_response),
            "Semi-major axis; f and b are the orbit's forward and backward circles, (X ± jY)/2.",
        ),
        Result(
            "disk_peak", "Disk peaks at", "speed", lambda c: _highest(c.disk_peaks),
            "Eq. 5.38", r"\frac{da}{d\Omega} = 0", lambda c: tex(_highest(c.disk_peaks), "rad/s"),
            "Up to the top speed.",
        ),
        Result(
            "journal_peak", "Journal peaks at", "speed",
            lambda c: _highest(c.journal_peaks), "Eq. 5.38", r"\frac{da}{d\Omega} = 0",
            lambda c: tex(_highest(c.journal_peaks), "rad/s"),
            "Its highest peak up to the top speed.",
        ),
    )
}  # fmt: skip
