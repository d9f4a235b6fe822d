# ruff: noqa: E501 - an equation reads best in as few lines as it can be written
"""The equations of the notes that the program uses: number, LaTeX, function and page."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Equation:
    """An equation: its number, or whose it is, and which functions and pages use it."""

    number: str
    title: str
    latex: str
    functions: tuple[str, ...]
    pages: str


EQUATIONS: dict[str, tuple[Equation, ...]] = {
    "Oil and static equilibrium": (
        Equation(
            "Calculation sheet", "Viscosity falls with temperature", r"\mu = \mu_R\,e^{-\alpha(T-T_R)}",
            ("machine.Oil.viscosity",), "all",
        ),
        Equation(
            "5.3, 5.4", "The film carries the load", r"F_{X_o} = -F_o,\qquad F_{Y_o} = 0",
            ("coefficients.equilibrium",), "Equilibrium",
        ),
        Equation(
            "5.5", "Radial and tangential force",
            r"F_r = -\frac{\mu\Omega RL^3}{C^2}\frac{\varepsilon^2}{(1-\varepsilon^2)^2},\qquad "
            r"F_t = \frac{\mu\Omega RL^3}{C^2}\frac{\pi\varepsilon}{4(1-\varepsilon^2)^{3/2}}",
            ("films.short.static_force",), "Equilibrium",
        ),
        Equation(
            "5.7", "Attitude angle (sign corrected)",
            r"\tan\varphi = \frac{\pi\sqrt{1-\varepsilon^2}}{4\varepsilon}",
            ("films.short.attitude_angle",), "Equilibrium",
        ),
        Equation(
            "5.6, 5.8", "Modified Sommerfeld number",
            r"\sigma = \frac{\mu\Omega LR}{4F_o}\left(\frac LC\right)^2 = "
            r"\frac{(1-\varepsilon^2)^2}{\varepsilon\sqrt{16\varepsilon^2+\pi^2(1-\varepsilon^2)}}",
            ("coefficients.modified_sommerfeld", "films.short.modified_sommerfeld",
             "films.short.eccentricity_ratio"), "Equilibrium",
        ),
        Equation(
            "5.19", "Film thickness", r"H = \frac hC = 1+\varepsilon\cos\theta",
            ("films.short.film_thickness",), "Machine, Equilibrium",
        ),
        Equation(
            "5.22, 5.25", "Pressure of the short bearing",
            r"p-p_a = \mu\Omega\left(\frac LC\right)^2\frac{3\varepsilon\sin\theta}{H^3}"
            r"\left(\frac14-\frac{z^2}{L^2}\right),\qquad 0\le\theta\le\pi",
            ("films.short.pressure",), "Machine, Equilibrium",
        ),
    ),
    "Film of finite length": (
        Equation(
            "Reynolds", "Pressure over each pad, in μΩ(R/C)²; films in C, ζ = 2z/L, τ = Ωt",
            r"\frac{\partial}{\partial\beta}\left(h^3\frac{\partial p}{\partial\beta}\right)"
            r"+\left(\frac DL\right)^2\frac{\partial}{\partial\zeta}\left(h^3\frac{\partial p}{\partial\zeta}\right)"
            r"=6\,\frac{\partial h}{\partial\beta}+12\,\frac{\partial h}{\partial\tau}",
            ("films.finite.reynolds.solved",), "all, on a film of finite length",
        ),
        Equation(
            "Swift, Stieber", "Where the film breaks and forms again",
            r"p\ge0,\qquad p=\frac{\partial p}{\partial n}=0\ \text{at the front}",
            ("films.finite.table.settled_pressures",), "all, on a film of finite length",
        ),
        Equation(
            "Lund, Thomsen", "Stiffness and damping by adjoint pressures λ, A p = r",
            r"K_{ij}=-\lambda_i\cdot\left(\frac{\partial r}{\partial x_j}-\frac{\partial A}{\partial x_j}\,p\right),\qquad "
            r"C_{ij}=12\,\lambda_i\cdot g_j",
            ("films.finite.fronts.coefficients",), "Coefficients",
        ),
    ),
    "Power and flow": (
        Equation(
            "Beyond the notes", "Side flow, both ends together", r"Q = \Omega RLC\,\varepsilon",
            ("films.short.side_flow",), "Equilibrium",
        ),
        Equation(
            "Beyond the notes", "Drag torque; power is torque times speed",
            r"T = \frac{2\pi\mu\Omega R^3L}{C\sqrt{1-\varepsilon^2}}+\tfrac12 eF_o\sin\varphi",
            ("films.short.drag",), "Equilibrium",
        ),
    ),
    "Heat": (
        Equation(
            "ISO 7902-1", "The film's temperature follows from the oil supplied; share s of the loss P",
            r"T_{out} = T_{in}+\frac{s\,P}{\rho c\,(Q+q)},\qquad T = \tfrac12\,(T_{in}+T_{out})",
            ("heat.film_temperature", "heat.outlet_temperature"), "Heat; all, with a supply of oil",
        ),
        Equation(
            "ISO 7902-1", "Flow through the grooves with which the oil warms by ΔT",
            r"q = \frac{s\,P}{\rho c\,\Delta T}-Q",
            ("heat.flow_for_rise",), "Heat",
        ),
        Equation(
            "ASTM D341", "Walther's law: ν = μ/ρ in mm²/s, T in kelvin",
            r"\ln(\nu+0.7) = \ln(\nu_R+0.7)\left(\frac{T}{T_R}\right)^{-B},\qquad "
            r"B = \frac{\alpha\,\nu_R T_R}{(\nu_R+0.7)\ln(\nu_R+0.7)}",
            ("machine.Oil.viscosity",), "Heat; all, where it is chosen",
        ),
    ),
    "Force coefficients": (
        Equation(
            "5.14", "Definition",
            r"K_{ij} = -\frac{\partial F_i}{\partial X_j},\qquad "
            r"C_{ij} = -\frac{\partial F_i}{\partial\dot X_j}",
            ("coefficients.equilibrium",), "Coefficients",
        ),
        Equation(
            "5.30", r"Stiffness in (r, t), in μΩRL³/C³",
            r"K_{rr} = \frac{2\varepsilon(1+\varepsilon^2)}{(1-\varepsilon^2)^3},\ "
            r"K_{rt} = \frac{\pi}{4(1-\varepsilon^2)^{3/2}},\ "
            r"K_{tr} = -\frac{\pi(1+2\varepsilon^2)}{4(1-\varepsilon^2)^{5/2}},\ "
            r"K_{tt} = \frac{\varepsilon}{(1-\varepsilon^2)^2}",
            ("films.short.radial_stiffness",), "Coefficients",
        ),
        Equation(
            "5.31", r"Damping in (r, t), in μRL³/C³",
            r"C_{rr} = \frac{\pi(1+2\varepsilon^2)}{2(1-\varepsilon^2)^{5/2}},\ "
            r"C_{rt} = C_{tr} = -\frac{2\varepsilon}{(1-\varepsilon^2)^2},\ "
            r"C_{tt} = \frac{\pi}{2(1-\varepsilon^2)^{3/2}}",
            ("films.short.radial_damping",), "Coefficients",
        ),
        Equation(
            "5.11, 5.16", "From (r, t) to (X, Y)",
            r"K_{(X,Y)} = Q\,K_{(r,t)}\,Q^{\mathsf T},\qquad Q = \begin{bmatrix}\cos\varphi&-\sin\varphi\\"
            r"\sin\varphi&\cos\varphi\end{bmatrix}",
            ("frames.rotate",), "Coefficients",
        ),
        Equation(
            "5.32", "Dimensionless coefficients",
            r"k_{ij} = K_{ij}\frac{C}{F_o},\qquad c_{ij} = C_{ij}\frac{\Omega C}{F_o}",
            ("films.state.FilmState",), "Coefficients",
        ),
        Equation(
            "5.35", r"k and c in (X, Y), k_YY and c_YY corrected; f_r = cos φ, f_t = sin φ",
            r"\begin{aligned}"
            r"k_{XX} &= \tfrac{f_r}{\varepsilon(1-\varepsilon^2)}\{f_r^2+1+2\varepsilon^2\}\\"
            r"k_{XY} &= \tfrac{f_t}{\varepsilon(1-\varepsilon^2)}\{f_r^2+1+2\varepsilon^2\}\\"
            r"k_{YX} &= \tfrac{f_t}{\varepsilon(1-\varepsilon^2)}\{f_r^2-1+\varepsilon^2\}\\"
            r"k_{YY} &= \tfrac{f_r}{\varepsilon(1-\varepsilon^2)}\{f_t^2+1-\varepsilon^2\}\\"
            r"c_{XX} &= \tfrac{2f_t}{\varepsilon(1-\varepsilon^2)}\{(2+\varepsilon^2)f_r^2+1-\varepsilon^2\}\\"
            r"c_{XY} &= \tfrac{2f_r}{\varepsilon(1-\varepsilon^2)}\{(2+\varepsilon^2)f_t^2-1+\varepsilon^2\}\\"
            r"c_{YY} &= \tfrac{2f_t}{\varepsilon(1-\varepsilon^2)}\{(2+\varepsilon^2)f_t^2-1+\varepsilon^2\}\\"
            r"c_{YX} &= c_{XY}\end{aligned}",
            ("films.short.stiffness", "films.short.damping"), "Coefficients",
        ),
        Equation(
            "5.37", "Without load: only cross-coupling",
            r"K_{XX} = K_{YY} = 0,\quad K_{XY} = -K_{YX} = \tfrac\Omega2 C_{XX},\quad "
            r"C_{XX} = C_{YY} = \frac{\mu RL^3}{C^3}\frac\pi2",
            ("films.short.film_stiffness", "films.short.film_damping"), "Coefficients",
        ),
        Equation(
            "Beyond the notes", "Added mass of the film",
            r"M_{ij} = \alpha_m\frac{\rho RL^3}{12C}I_{ij},\quad I_{rr} = \tfrac{\pi}{\varepsilon^2}"
            r"\left(\tfrac1{\sqrt{1-\varepsilon^2}}-1\right),\quad I_{tt} = \tfrac{\pi}{\varepsilon^2}"
            r"\left(1-\sqrt{1-\varepsilon^2}\right)",
            ("films.short.added_mass",), "Coefficients",
        ),
    ),
    "Stability": (
        Equation(
            "5.41–5.44", "Whirl without damping at the threshold",
            r"\det\left[k-p_s^2\bar\omega^2 I+j\bar\omega c\right] = 0",
            ("onset.whirl_onset",), "Stability",
        ),
        Equation(
            "5.45", "Equivalent stiffness",
            r"p_s^2\bar\omega^2 = k_{eq} = \frac{k_{XX}c_{YY}+k_{YY}c_{XX}-c_{YX}k_{XY}-c_{XY}k_{YX}}"
            r"{c_{XX}+c_{YY}}",
            ("onset.whirl_onset",), "Stability",
        ),
        Equation(
            "5.46", "Whirl frequency ratio",
            r"\bar\omega^2 = \left(\frac{\omega_s}{\Omega_s}\right)^2 = \frac{(k_{eq}-k_{XX})"
            r"(k_{eq}-k_{YY})-k_{XY}k_{YX}}{c_{XX}c_{YY}-c_{XY}c_{YX}}",
            ("onset.whirl_onset",), "Stability",
        ),
        Equation(
            "5.47", "It whirls at its natural frequency", r"\omega_s = \sqrt{K_{eq}/M} = \omega_n",
            ("modes.undamped_frequency",), "Root locus",
        ),
        Equation(
            "5.48, 5.49", "Half speed, and so twice the natural frequency at most",
            r"\bar\omega\to\tfrac12,\qquad \Omega_{max} = 2\omega_n\qquad(\varepsilon\to0)",
            ("onset.whirl_onset",), "Stability",
        ),
        Equation(
            "5.50", "Threshold of the flexible rotor; Γ = Fₒ/K_rot",
            r"p_{sf}^2 = \frac{p_s^2}{1+k_{eq}\,\Gamma/C}",
            ("onset.flexible_threshold", "onset.onset_speed"), "Stability",
        ),
    ),
    "Modes and response": (
        Equation(
            "5.17, 5.38", "Rigid rotor on linear films",
            r"M\begin{bmatrix}\ddot X\\\ddot Y\end{bmatrix}+C\begin{bmatrix}\dot X\\\dot Y\end{bmatrix}"
            r"+K\begin{bmatrix}X\\Y\end{bmatrix} = Mu\Omega^2\begin{bmatrix}\cos\Omega t\\"
            r"\sin\Omega t\end{bmatrix}",
            ("modes.state_matrix", "unbalance_response.synchronous_response"), "Root locus, Response",
        ),
        Equation(
            "Calculation sheet", "Disk (capital) and journal (small) of the flexible rotor",
            r"\begin{aligned}&(M-M_j)\ddot X+C_s\dot X+K_{rot}(X-x)\\"
            r"&\qquad = (M-M_j)u\Omega^2\cos\Omega t\\"
            r"&M_j\ddot x+(C\dot x)_X+(Kx)_X+K_{rot}(x-X) = 0\end{aligned}",
            ("modes.state_matrix", "modes.mode_shapes", "unbalance_response.synchronous_response"),
            "Root locus, Response",
        ),
        Equation(
            "Calculation sheet", "Damping of a mode",
            r"\zeta = -\frac{\mathrm{Re}\,\lambda}{|\lambda|},\qquad "
            r"\delta = -2\pi\frac{\mathrm{Re}\,\lambda}{|\mathrm{Im}\,\lambda|}",
            ("modes.damping_ratio", "modes.logarithmic_decrement"), "Root locus",
        ),
        Equation(
            "Beyond the notes", "Ellipse of an orbit",
            r"f = \tfrac12(X+jY),\quad b = \tfrac12\overline{(X-jY)},\quad "
            r"\text{semi-axes}\ |f|+|b|,\ |f|-|b|",
            ("unbalance_response.orbit_ellipse",), "Response",
        ),
    ),
    "Nonlinear motion": (
        Equation(
            "5.1", "Rotor on the film's full force, imbalance forward",
            r"M\begin{bmatrix}\ddot X\\\ddot Y\end{bmatrix} = "
            r"\mathbf F(X,Y,\dot X,\dot Y)+\begin{bmatrix}F_o\\0\end{bmatrix}"
            r"+Mu\Omega^2\begin{bmatrix}\cos\Omega t\\\sin\Omega t\end{bmatrix}",
            ("films.short.film_force", "nonlinear.transient.simulate", "nonlinear.energy.energy_balance"), "Orbits",
        ),
        Equation(
            "Beyond the notes", "Size a of the whirl near its onset",
            r"\dot a = (\mathrm{Re}\,\lambda)\,a+\ell\left(\frac aC\right)^2 a,\qquad "
            r"\ell>0\ \text{below}\ \varepsilon = 0.1411\ \text{(rigid rotor)}",
            ("nonlinear.hopf.hopf", "nonlinear.limit_cycles.bifurcation"), "Orbits",
        ),
    ),
}  # fmt: skip


def equation(number: str) -> str:
    """Return the LaTeX of a numbered equation, as "5.50"."""
    return next(
        item.latex for group in EQUATIONS.values() for item in group
        if number in item.number.split(", ")
    )  # fmt: skip
