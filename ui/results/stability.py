"""Results of stability: equivalent stiffness, thresholds, the onset, the least damped mode."""

import math

import numpy as np

from rotorcalc import analyse, modes
from rotorcalc.films import film_of
from rotorcalc.films.model import Source
from rotorcalc.onset import closed_form
from ui.computed import Computed
from ui.format import tex, without_noise
from ui.notes.equations import equation
from ui.results.record import Result
from ui.words.citation import whirl_without_load


def fastest_growing(computed: Computed) -> complex:
    """Return λ of the oscillating mode that grows fastest at running speed [1/s]."""
    return complex(modes.leading(computed.point.flexible_eigenvalues))


def least_damped(computed: Computed) -> complex:
    """Return λ of the oscillating mode with the smallest log decrement at running speed [1/s]."""
    return complex(modes.least_damped(computed.point.flexible_eigenvalues))


def _stiffness(computed: Computed) -> str:
    p = computed.point
    return (
        rf"{tex(float(p.equivalent_stiffness), 'N/m')}\quad\text{{of}}\quad "
        rf"K={_matrix(p.stiffness)},\ C={_matrix(p.damping)}"
    )


def _matrix(matrix: np.ndarray) -> str:
    shown = without_noise(matrix)
    rows = (" & ".join(tex(float(value)) for value in row) for row in shown)
    return r"\begin{bmatrix}" + r" \\ ".join(rows) + r"\end{bmatrix}"


def _ratio(computed: Computed) -> str:
    p = computed.point
    ratio = tex(float(p.whirl_ratio))
    return rf"{ratio}\quad\text{{with}}\quad K_{{eq}} = {tex(float(p.equivalent_stiffness), 'N/m')}"


def _critical_mass(computed: Computed) -> str:
    p, k = computed.point, computed.machine.rotor.shaft_stiffness
    if not math.isfinite(float(p.critical_mass)):
        return _no_mass(computed)
    series = rf"\frac{{1}}{{1+{tex(float(p.equivalent_stiffness))}/{tex(k)}}}"
    return rf"{tex(float(p.critical_mass))}\cdot {series} = {tex(computed.critical_mass, 'kg')}"


def _no_mass(computed: Computed) -> str:
    """Return why there is no critical mass: none whirls, or, with a negative stiffness, all do."""
    if math.isnan(float(computed.point.critical_mass)):
        return r"\text{none, as }K_{eq}<0"
    return r"\infty\ \text{(no whirl in this equilibrium)}"


def _rigid_critical_mass(computed: Computed) -> str:
    p = computed.point
    if not math.isfinite(float(p.critical_mass)):
        return _no_mass(computed)
    product = rf"({tex(float(p.whirl_ratio))}\cdot {tex(computed.speed)})^2"
    top = tex(float(p.equivalent_stiffness))
    return rf"\frac{{{top}}}{{{product}}} = {tex(float(p.critical_mass), 'kg')}"


def _threshold(computed: Computed) -> str:
    K_eq, ratio = float(computed.point.equivalent_stiffness), float(computed.point.whirl_ratio)
    M, omega = computed.machine.rotor.half_mass, float(computed.point.rigid_threshold)
    if ratio == 0.0:
        return r"\infty\ \text{(no whirl in this equilibrium)}"
    root = rf"\sqrt{{\frac{{{tex(K_eq)}}}{{{tex(M)}}}}}"
    return rf"\frac{{1}}{{{tex(ratio)}}}{root} = {tex(omega, 'rad/s')}"


def _flexible(computed: Computed) -> str:
    p, k = computed.point, computed.machine.rotor.shaft_stiffness
    series = rf"1+{tex(float(p.equivalent_stiffness))}/{tex(k)}"
    top = tex(float(p.rigid_threshold))
    return rf"\frac{{{top}}}{{\sqrt{{{series}}}}} = {tex(float(p.flexible_threshold), 'rad/s')}"


def _margin(computed: Computed) -> float:
    return computed.onset.speed / computed.speed - 1.0


def _onset(computed: Computed, flexible: bool) -> str:
    """Return the notes' equation with the numbers at the onset."""
    onset = computed.onset if flexible else computed.rigid_onset
    speed = tex(onset.speed, "rad/s")
    if not math.isfinite(onset.speed):
        return speed
    there = analyse(computed.machine, onset.speed)
    K_eq, ratio = tex(float(there.equivalent_stiffness)), tex(float(there.whirl_ratio))
    M, K_rot = tex(computed.machine.rotor.half_mass), tex(computed.machine.rotor.shaft_stiffness)
    root = rf"\frac{{1}}{{{ratio}}}\sqrt{{\frac{{{K_eq}}}{{{M}}}}}"
    series = rf"\frac{{1}}{{\sqrt{{1+{K_eq}/{K_rot}}}}}\," if flexible else ""
    return rf"{series}{root} = {speed}"


def _solved(computed: Computed, flexible: bool) -> Source:
    """Return what gave the onset: the notes' equation, or another where that does not hold."""
    machine = computed.machine
    holds = closed_form.has_closed_form if flexible else closed_form.covers
    if holds(machine):
        return Source(_FLEXIBLE if flexible else _RIGID)
    onset = computed.onset if flexible else computed.rigid_onset
    if onset.method == "film":
        return Source("no whirl", r"K_{XY} = K_{YX}")
    if onset.method == "closed form":  # undamped, with a journal mass
        return Source("force balance", _BALANCE)
    return Source("eigenvalues", r"\max\mathrm{Re}\,\lambda(\Omega_{on}) = 0")


def _solved_mass(computed: Computed) -> Source:
    """Return what gave the critical mass: the notes' equation, or another."""
    rotor, film = computed.machine.rotor, film_of(computed.machine.bearing)
    if rotor.disk_damping > 0.0 or film.frequency_dependent:
        return Source("eigenvalues", r"\max\mathrm{Re}\,\lambda(M_c) = 0")
    if rotor.journal_mass > 0.0 and not rotor.is_rigid:
        return Source("force balance", _BALANCE)
    return Source(_FLEXIBLE)


def _onset_ratio(computed: Computed) -> float:
    onset = computed.onset
    return onset.whirl_frequency / onset.speed if 0.0 < onset.speed < math.inf else math.nan


def _solved_frequency(computed: Computed) -> Source:
    """Return what gave the whirl's frequency at the onset."""
    solved = _solved(computed, True)
    if solved.equation == _FLEXIBLE:
        return Source(_RATIO)
    return Source(solved.equation, r"\omega_{on} = |\mathrm{Im}\,\lambda(\Omega_{on})|")


def _whirl(computed: Computed) -> str:
    onset = computed.onset
    if not 0.0 < onset.speed < math.inf:
        return tex(onset.whirl_frequency, "rad/s")
    ratio = tex(onset.whirl_frequency / onset.speed)
    return rf"{ratio}\cdot {tex(onset.speed)} = {tex(onset.whirl_frequency, 'rad/s')}"


def _ratio_of_speeds(computed: Computed) -> str:
    onset, ratio = computed.onset, _onset_ratio(computed)
    if math.isnan(ratio):
        return tex(ratio)
    return rf"\frac{{{tex(onset.whirl_frequency)}}}{{{tex(onset.speed)}}} = {tex(ratio)}"


# Where the notes have the threshold of a rigid and of a flexible rotor, and the whirl ratio.
_RIGID, _FLEXIBLE, _RATIO = "Eq. 5.45", "Eq. 5.50", "Eq. 5.46"
_CITED = {number: equation(number.removeprefix("Eq. ")) for number in (_RIGID, _FLEXIBLE, _RATIO)}
_BALANCE = r"(K_{eq}-M_jX)(K_{rot}-m_dX) = K_{rot}\,m_dX,\quad X = (\bar\omega\,\Omega)^2"
_DECISIVE = (
    "For the least damped mode at the running speed: of all that oscillate, forward or backward, "
    "the one with the smallest log decrement δ."
)
_ONSET_REMARK = "With the equilibrium at the onset speed itself."

STABILITY: tuple[Result, ...] = (
    Result(
        "equivalent_stiffness", "Equivalent stiffness", "stiffness",
        lambda c: float(c.point.equivalent_stiffness), "Eq. 5.45",
        r"K_{eq} = \frac{K_{XX}C_{YY}+K_{YY}C_{XX}-C_{YX}K_{XY}-C_{XY}K_{YX}}{C_{XX}+C_{YY}}",
        _stiffness,
    ),
    Result(
        "whirl_ratio", "Film's whirl ratio ω̄", "number", lambda c: float(c.point.whirl_ratio),
        _RATIO, r"\bar\omega^2 = \frac{(K_{eq}-K_{XX})(K_{eq}-K_{YY})-K_{XY}K_{YX}}"
        r"{\Omega^2(C_{XX}C_{YY}-C_{XY}C_{YX})}", _ratio,
        "From the film's synchronous coefficients at this speed's equilibrium, whatever the rotor; "
        "0 where the film feeds no whirl.",
    ),
    Result(
        "critical_mass", "Critical mass per bearing", "mass",
        lambda c: c.critical_mass, _FLEXIBLE,
        r"M_c = \frac{K_{eq}}{(\bar\omega\,\Omega)^2}\cdot\frac{1}{1+K_{eq}/K_{rot}}",
        _critical_mass,
        "With more mass per bearing, and the same load, shaft, damping and journal mass, this "
        "machine would be unstable at this speed.",
        cites=_CITED[_FLEXIBLE], solved=_solved_mass,
    ),
    Result(
        "rigid_critical_mass", "Critical mass, rigid rotor", "mass",
        lambda c: float(c.point.critical_mass), _RIGID,
        r"M_c = \frac{K_{eq}}{(\bar\omega\,\Omega)^2}", _rigid_critical_mass,
        "A rigid rotor with more mass per bearing is unstable at this speed.",
        cites=_CITED[_RIGID],
    ),
    Result(
        "rigid_threshold", "Threshold, rigid rotor", "speed",
        lambda c: float(c.point.rigid_threshold), _RIGID,
        r"\Omega_s = \frac{1}{\bar\omega}\sqrt{\frac{K_{eq}}{M}}", _threshold,
        "At this speed's equilibrium.", cites=_CITED[_RIGID],
    ),
    Result(
        "flexible_threshold", "Threshold, flexible shaft", "speed",
        lambda c: float(c.point.flexible_threshold), _FLEXIBLE,
        r"\Omega_{sf} = \frac{\Omega_s}{\sqrt{1+K_{eq}/K_{rot}}}", _flexible,
        "At this speed's equilibrium; without midspan damping and journal mass.",
        cites=_CITED[_FLEXIBLE],
    ),
    Result(
        "onset_speed", "Onset of whirl Ωₒₙ", "speed", lambda c: c.onset.speed, _FLEXIBLE,
        r"\Omega_{on} = \Omega_{sf}(\varepsilon(\Omega_{on}))",
        lambda c: _onset(c, flexible=True), _ONSET_REMARK, nought=lambda _: "any speed",
        cites=_CITED[_FLEXIBLE], solved=lambda c: _solved(c, True), at_onset=True,
    ),
    Result(
        "rigid_onset", "Onset if the shaft were rigid", "speed", lambda c: c.rigid_onset.speed,
        _RIGID, r"\Omega_{on} = \Omega_s(\varepsilon(\Omega_{on}))",
        lambda c: _onset(c, flexible=False), _ONSET_REMARK, nought=lambda _: "any speed",
        cites=_CITED[_RIGID], solved=lambda c: _solved(c, False), sought=lambda c: c.rigid_onset,
    ),
    Result(
        "whirl_frequency", "Whirl at onset ωₒₙ", "speed",
        lambda c: c.onset.whirl_frequency, _RATIO,
        r"\omega_{on} = \bar\omega\,\Omega_{on}",
        _whirl, "Whirl frequency of the machine at its onset. " + _ONSET_REMARK,
        nought=whirl_without_load, cites=_CITED[_RATIO], solved=_solved_frequency, at_onset=True,
    ),
    Result(
        "onset_ratio", "Whirl ratio at onset", "number", _onset_ratio, "ωₒₙ/Ωₒₙ",
        r"\frac{\omega_{on}}{\Omega_{on}}",
        _ratio_of_speeds,
        "The whirl ratio of the machine itself; without midspan damping it equals the film's.",
        at_onset=True,
    ),
    Result(
        "margin", "Margin to onset", "percent", _margin, "Ωₒₙ/Ω − 1",
        r"\frac{\Omega_{on}}{\Omega}-1",
        lambda c: rf"\frac{{{tex(c.onset.speed)}}}{{{tex(c.speed)}}}-1 = {tex(_margin(c))}",
        at_onset=True,
    ),
    Result(
        "damping_ratio", "Least damping ratio ζ", "number",
        lambda c: float(modes.damping_ratio(least_damped(c))), "Re λ, Im λ",
        r"\zeta = -\frac{\mathrm{Re}\,\lambda}{|\lambda|}",
        lambda c: rf"{tex(float(modes.damping_ratio(least_damped(c))))},\quad \lambda = "
        rf"{tex(least_damped(c).real)} \pm {tex(abs(least_damped(c).imag))}\,j",
        _DECISIVE,
    ),
    Result(
        "natural_frequency", "Least damped mode |Im\u00a0λ|", "speed",
        lambda c: abs(least_damped(c).imag), "Im λ", r"\omega_d = |\mathrm{Im}\,\lambda|",
        lambda c: tex(abs(least_damped(c).imag), "rad/s"),
        _DECISIVE,
    ),
)  # fmt: skip
