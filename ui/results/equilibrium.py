"""Results of the static equilibrium: load, film, journal's position, losses."""

import math

from scipy.constants import zero_Celsius

from rotorcalc.films.model import Source
from rotorcalc.gas import Gas
from rotorcalc.machine import oil_of
from ui.computed import Computed
from ui.format import tex, tex_base
from ui.notes.equations import equation
from ui.results.record import Result


def _viscosity(computed: Computed) -> str:
    T = float(computed.point.temperature)
    if isinstance(gas := computed.machine.oil, Gas):
        return _viscosity_of(gas, T, computed.viscosity)
    oil = oil_of(computed.machine)
    power = rf"-{tex(oil.temperature_coefficient)}({tex(T)}-{tex(oil.reference_temperature)})"
    return rf"{tex(oil.reference_viscosity)}\,e^{{{power}}} = {tex(computed.viscosity, 'Pa s')}"


def _viscosity_of(gas: Gas, T: float, viscosity: float) -> str:
    """Return Sutherland's law with a gas's numbers, its temperatures absolute."""
    warm, cold, S = (tex(one) for one in (
        T + zero_Celsius, gas.reference_temperature + zero_Celsius, gas.sutherland_temperature
    ))  # fmt: skip
    return (
        rf"{tex(gas.reference_viscosity)}\left(\frac{{{warm}}}{{{cold}}}\right)^{{1.5}}"
        rf"\frac{{{cold}+{S}}}{{{warm}+{S}}} = {tex(viscosity, 'Pa s')}"
    )


def _law(computed: Computed) -> Source:
    """Return the law of the lubricant's viscosity."""
    if computed.has_gas:
        return Source("Sutherland's law", _SUTHERLAND)
    if oil_of(computed.machine).law == "exponential":
        return Source(_SHEET, _EXPONENTIAL)
    return Source("ASTM D341", r"\lg\lg(\nu + 0.7) = A - B\,\lg T,\quad \mu = \rho\nu")


def _load(computed: Computed) -> str:
    load = tex(computed.machine.static_load, "N")
    if computed.machine.load is not None:
        return rf"{load}\quad\text{{given}}"
    return rf"\tfrac12\cdot {tex(computed.machine.rotor.mass)}\cdot 9.80665 = {load}"


def _sag(computed: Computed) -> str:
    machine = computed.machine
    load, k = tex(machine.static_load), tex(machine.rotor.shaft_stiffness)
    return rf"\frac{{{load}}}{{{k}}} = {tex(machine.static_sag, 'm')}"


def _sommerfeld(computed: Computed) -> str:
    machine, b = computed.machine, computed.machine.bearing
    top = r"\cdot ".join(map(tex, (computed.viscosity, computed.speed, b.length, b.radius)))
    squared = rf"\left(\frac{{{tex(b.length)}}}{{{tex(b.radial_clearance)}}}\right)^2"
    sigma = tex(float(computed.point.sommerfeld))
    return rf"\frac{{{top}}}{{4\cdot {tex(machine.static_load)}}}{squared} = {sigma}"


def _eccentricity(computed: Computed) -> str:
    ratio, sigma = (
        float(computed.point.eccentricity_ratio), tex(float(computed.point.sommerfeld))
    )  # fmt: skip
    eps, square = tex(ratio), f"{tex_base(ratio)}^2"
    return (
        rf"{sigma} = \frac{{(1-{square})^2}}{{{eps}\sqrt{{16\cdot {square}+\pi^2(1-{square})}}}},"
        rf"\quad \varepsilon = {eps}"
    )


def _attitude(computed: Computed) -> str:
    ratio, phi = float(computed.point.eccentricity_ratio), float(computed.point.attitude_angle)
    root = rf"\sqrt{{1-{tex_base(ratio)}^2}}"
    return (
        rf"\arctan\frac{{\pi{root}}}{{4\cdot {tex(ratio)}}} = {tex(phi, 'rad')}"
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


_SHEET = "the notes' calculation sheet"
_EXPONENTIAL = r"\mu = \mu_R\, e^{-\alpha(T-T_R)}"
_SUTHERLAND = (
    r"\mu = \mu_R \left(\tfrac{T}{T_R}\right)^{1.5} \frac{T_R+S}{T+S},\quad T, T_R\ \text{in K}"
)
EQUILIBRIUM: tuple[Result, ...] = (
    Result(
        "viscosity", "Viscosity μ", "viscosity", lambda c: c.viscosity, _SHEET, _EXPONENTIAL,
        _viscosity, modelled=False, solved=_law,
    ),
    Result(
        "static_load", "Load per bearing Fₒ", "force", lambda c: c.machine.static_load,
        "Eq. 5.3",
        r"F_o = M g", _load, modelled=False,
    ),
    Result(
        "static_sag", "Static sag Γ", "film", lambda c: c.machine.static_sag, "Eq. 5.50",
        r"\Gamma = \frac{F_o}{K_{rot}}",
        _sag, modelled=False, cites=equation("5.50"),
    ),
    Result(
        "sommerfeld", "Sommerfeld number σ", "number", lambda c: float(c.point.sommerfeld),
        "Definition",
        r"\sigma = \frac{\mu\Omega L R}{4F_o}\left(\frac{L}{C}\right)^2", _sommerfeld,
        "The modified one. The classical Sommerfeld number is S = σ(D/L)²/π.", modelled=False,
        boundless="infinite",
    ),
    Result(
        "eccentricity_ratio", "Eccentricity ratio ε", "number",
        lambda c: float(c.point.eccentricity_ratio), "Eq. 5.8",
        r"\sigma = \frac{(1-\varepsilon^2)^2}"
        r"{\varepsilon\sqrt{16\varepsilon^2+\pi^2(1-\varepsilon^2)}}",
        _eccentricity, "Solved for ε by iteration.", source="eccentricity",
    ),
    Result(
        "attitude_angle", "Attitude angle φ", "angle", lambda c: float(c.point.attitude_angle),
        "Eq. 5.7", r"\phi = \arctan\frac{\pi\sqrt{1-\varepsilon^2}}{4\varepsilon}", _attitude,
        source="attitude",
    ),
    Result(
        "minimum_film_thickness", "Smallest film h", "film",
        lambda c: float(c.point.minimum_film_thickness), "Eq. 5.19",
        r"h_{min} = C(1-\varepsilon)", _film, source="thickness",
    ),
    Result(
        "power_loss", "Power loss", "power", lambda c: float(c.point.power_loss),
        _SHEET, r"P = \Omega\left(\frac{2\pi\mu\Omega R^3L}{C\sqrt{1-\varepsilon^2}}"
        r"+\tfrac12 e F_o\sin\phi\right)", _power,
        "Per bearing: shear at the journal's surface, and half the couple of the load, which "
        "drives the pressure flow.", unknown="not known", source="drag",
    ),
    Result(
        "side_flow", "Side flow", "flow", lambda c: float(c.point.side_flow),
        _SHEET, r"Q = \Omega R L C\,\varepsilon", _flow, "Per bearing, both ends together.",
        unknown="not known", source="flow",
    ),
)  # fmt: skip
