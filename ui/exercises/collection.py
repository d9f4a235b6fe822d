"""The exercises: what is given, what is asked, and how each is answered.

An exercise draws a machine, in the words of a link; its text names the numbers that a student
needs, and the answers are results of that machine, computed by the code behind the pages.
"""

import math
import random
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from rotorcalc import criteria, orbit_ellipse, rpm
from ui.bores import Values
from ui.computed import Computed, computed_from
from ui.criteria import GRADE
from ui.format import digits
from ui.inputs import PRESET_VALUES
from ui.results.stability import least_damped

# Share by which an answer may differ from the program's: what rounding on the way leaves.
TOLERANCE = 0.02
Draw = Callable[[random.Random], Mapping[str, float]]


@dataclass(frozen=True)
class Ask:
    """What is asked: its words with symbol, its unit, and its value of the machine."""

    words: str
    unit: str
    value: Callable[[Computed], float]


@dataclass(frozen=True)
class Exercise:
    """One exercise; `text` has the machine's inputs by key, and what `known` adds, in braces."""

    title: str
    text: str
    draw: Draw
    asks: tuple[Ask, ...]
    hint: str
    page: str
    solution: str
    preset: str = "friswell-5-5-1"
    known: Callable[[Computed], Mapping[str, str]] = lambda _: {}
    # What its page is to show, by the keys of the choices there.
    chosen: Mapping[str, str] = field(default_factory=dict)

    def values(self, seed: int) -> Values:
        """Return the kept values of a student's machine."""
        dice = random.Random(f"{seed} {self.title}")  # noqa: S311 - numbers of an exercise
        return PRESET_VALUES[self.preset] | dict(self.draw(dice))

    def told(self, computed: Computed, values: Values) -> str:
        """Return the text with a student's numbers."""
        shown = {
            key: digits(value) for key, value in values.items() if isinstance(value, int | float)
        }
        return self.text.format_map(shown | dict(self.known(computed)))

    def answers(self, computed: Computed) -> tuple[float, ...]:
        """Return the answers, each in its unit."""
        return tuple(ask.value(computed) for ask in self.asks)


def of_student(exercise: Exercise, seed: int) -> tuple[str, tuple[float, ...]]:
    """Return an exercise's text and answers with a student's numbers."""
    values = exercise.values(seed)
    computed = computed_from(values)
    return exercise.told(computed, values), exercise.answers(computed)


def is_right(given: float, value: float) -> bool:
    """Return whether an answer is within the tolerance."""
    return abs(given - value) <= TOLERANCE * abs(value)


def _short_bearing(dice: random.Random) -> Mapping[str, float]:
    """Draw a short bearing, its oil and speed, and the load of an eccentricity ratio in its middle.

    The load is rounded, as a student gets it.
    """
    D = dice.choice((60.0, 80.0, 100.0, 120.0, 150.0))
    L = round(D * dice.choice((0.25, 0.3, 0.4)))
    C = round(D * dice.choice((0.8, 1.0, 1.2)))
    mu, n = dice.choice((12.0, 16.0, 20.0, 28.0)), dice.choice((2400.0, 3000.0, 3600.0, 4500.0))
    eps = dice.uniform(0.3, 0.6)
    sigma = (1 - eps**2) ** 2 / (eps * math.sqrt(16 * eps**2 + math.pi**2 * (1 - eps**2)))
    turned = mu * 1e-3 * n * rpm * L * D / 2 * 1e-6
    load = turned / (4 * sigma) * (L * 1e3 / C) ** 2
    half = float(f"{load:.3g}")
    return {"D": D, "L": L, "C": C, "mu": mu, "rpm": n, "load": half, "mass": 2 * half / 9.80665}


def _sheet(low: float, high: float) -> Draw:
    return lambda dice: {"rpm": round(dice.uniform(low, high), -2)}


def _phasors(part: str) -> Callable[[Computed], Mapping[str, str]]:
    def known(c: Computed) -> Mapping[str, str]:
        x, y = (complex(value) for value in getattr(c.point, part))
        named = {"X": x, "Y": y}
        return {
            **{f"a_{key}": digits(abs(value) * 1e6) for key, value in named.items()},
            **{f"lag_{key}": _lag(value) for key, value in named.items()},
        }

    return known


def _lag(value: complex) -> str:
    return f"{math.degrees(-math.atan2(value.imag, value.real)) % 360.0:.1f}"


def _axes(part: str) -> tuple[Ask, Ask]:
    def of(name: str) -> Callable[[Computed], float]:
        return lambda c: abs(float(getattr(orbit_ellipse(getattr(c.point, part)), name))) * 1e6

    return (
        Ask("Semi-major axis a", "µm", of("semi_major")),
        Ask("Semi-minor axis b", "µm", of("semi_minor")),
    )


def _eccentricity(c: Computed) -> Mapping[str, str]:
    return {"eps": f"{float(c.point.eccentricity_ratio):.4f}"}


def _threshold(c: Computed) -> Mapping[str, str]:
    p = c.point
    return {
        "keq": digits(float(p.equivalent_stiffness) / 1e6), "ratio": digits(float(p.whirl_ratio)),
        "half": digits(c.machine.rotor.half_mass),
    }  # fmt: skip


def _mode(c: Computed) -> Mapping[str, str]:
    found = least_damped(c)
    return {"real": digits(-found.real), "imag": digits(found.imag)}


_ELLIPSE = (
    r"Split the motion into a forward and a backward circle, of the radii $f = |P_X+jP_Y|/2$ and "
    r"$g = |P_X-jP_Y|/2$ with $P = |P|e^{-j\,\mathrm{lag}}$. The semi-axes are $a = f+g$ and "
    r"$b = |f-g|$."
)
_ORBIT = (
    "The {where} moves as $X = {a_X}\\,\\cos(Ωt-{lag_X}°)$ and $Y = {a_Y}\\,\\cos(Ωt-{lag_Y}°)$, "
    "in µm, at {rpm} rpm. What are the semi-axes of its ellipse?"
)
_FILM = (
    "A short bearing has the diameter {D} mm, the length {L} mm and the radial clearance {C} µm. "
    "Its oil has the viscosity {mu} mPa·s, and the shaft turns at {rpm} rpm"
)

EXERCISES: tuple[Exercise, ...] = (
    Exercise(
        "Ellipse of the journal",
        _ORBIT.replace("{where}", "journal of a rotor with a stiff shaft"),
        _sheet(3000, 8000), _axes("journal_response"),
        "Compare X and Y with the sum of two circles that turn in opposite directions.",
        "pages/5_Response.py", _ELLIPSE, preset="sheet-1e8", known=_phasors("journal_response"),
    ),
    Exercise(
        "Ellipse of the disk",
        _ORBIT.replace("{where}", "disk of a rotor with a flexible shaft"),
        _sheet(2000, 4500), _axes("disk_response"),
        "As for the journal; an orbit whose semi-axes are alike is almost a circle.",
        "pages/5_Response.py", _ELLIPSE, preset="sheet-1e7", known=_phasors("disk_response"),
    ),
    Exercise(
        "Where the journal sits",
        f"{_FILM} under a load of {{load}} N. What are the modified Sommerfeld number σ and the "
        "eccentricity ratio ε?",
        _short_bearing,
        (
            Ask("Modified Sommerfeld number σ", "-", lambda c: float(c.point.sommerfeld)),
            Ask("Eccentricity ratio ε", "-", lambda c: float(c.point.eccentricity_ratio)),
        ),
        "σ follows at once; then find ε by trial, or from the chart of ε over σ.",
        "pages/1_Equilibrium.py",
        r"$\sigma = \frac{\mu\Omega LR}{4F_o}\left(\frac LC\right)^2$ (Eq. 5.8), and ε solves "
        r"$\sigma = \frac{(1-\varepsilon^2)^2}"
        r"{\varepsilon\sqrt{16\varepsilon^2+\pi^2(1-\varepsilon^2)}}$.",
    ),
    Exercise(
        "Attitude and smallest film",
        "The journal of a short bearing with the radial clearance {C} µm runs at the eccentricity "
        "ratio ε = {eps}. At what attitude angle φ, and how thin is its film?",
        _short_bearing,
        (
            Ask("Attitude angle φ", "°", lambda c: math.degrees(c.point.attitude_angle)),
            Ask("Smallest film h", "µm", lambda c: float(c.point.minimum_film_thickness) * 1e6),
        ),
        "Both follow from ε alone.", "pages/1_Equilibrium.py",
        r"$\tan\varphi = \frac{\pi\sqrt{1-\varepsilon^2}}{4\varepsilon}$ (Eq. 5.7), "
        r"$h = C(1-\varepsilon)$ (Eq. 5.19).",
        known=_eccentricity,
    ),
    Exercise(
        "Warm oil",
        "An oil has {mu} mPa·s at {TR} °C, and its viscosity falls with the coefficient "
        "α = {alpha} 1/°C. What is its viscosity at {T} °C?",
        lambda dice: {
            "mu": dice.choice((17.0, 25.0, 32.0, 46.0)), "TR": dice.choice((40.0, 50.0)),
            "alpha": dice.choice((0.025, 0.03, 0.035)), "T": dice.choice((55.0, 60.0, 70.0, 75.0)),
        },
        (Ask("Viscosity μ", "mPa·s", lambda c: c.viscosity * 1e3),),
        "The viscosity falls by the same factor with each degree.", "pages/9_Heat.py",
        r"$\mu = \mu_R e^{-\alpha(T-T_R)}$.",
    ),
    Exercise(
        "What the film carries",
        f"{_FILM}. What load does the film carry at ε = {{eps}}?",
        _short_bearing,
        (Ask("Load Fₒ", "N", lambda c: c.machine.static_load),),
        "Find σ from ε, then the load from σ.", "pages/1_Equilibrium.py",
        r"$F_o = \frac{\mu\Omega LR}{4\sigma}\left(\frac LC\right)^2$ with σ(ε) of Eq. 5.8.",
        known=_eccentricity,
    ),
    Exercise(
        "Two stiffness coefficients",
        "A short bearing with the radial clearance {C} µm carries {load} N at ε = {eps}. What are "
        "its stiffness coefficients $K_{{XX}}$ and $K_{{XY}}$?",
        _short_bearing,
        (
            Ask("Stiffness $K_{XX}$", "MN/m", lambda c: float(c.point.stiffness[0, 0]) / 1e6),
            Ask("Stiffness $K_{XY}$", "MN/m", lambda c: float(c.point.stiffness[0, 1]) / 1e6),
        ),
        "Compute k in units of load over clearance, with the forces cos φ and sin φ.",
        "pages/2_Coefficients.py",
        r"With $n = 1/(\varepsilon(1-\varepsilon^2))$, $f_r = \cos\varphi$, $f_t = \sin\varphi$: "
        r"$k_{XX} = nf_r(f_r^2+1+2\varepsilon^2)$, $k_{XY} = nf_t(f_r^2+1+2\varepsilon^2)$, and "
        r"$K = k\,F_o/C$ (Eqs. 5.32 and 5.35).",
        known=_eccentricity,
    ),
    Exercise(
        "Critical mass",
        "At {rpm} rpm the film of one bearing acts on a whirl like a spring of "
        "$K_{{eq}}$ = {keq} MN/m, and its whirl ratio is {ratio}. With what mass per bearing would "
        "a rigid rotor be at its threshold at this speed?",
        _short_bearing,
        (Ask("Critical mass", "kg", lambda c: float(c.point.critical_mass)),),
        "At the threshold the rotor vibrates on the film at its natural frequency, which is the "
        "whirl's.", "pages/3_Stability.py",
        r"$M_c = K_{eq}/(\bar\omega\,\Omega)^2$ (Eq. 5.45).", known=_threshold,
    ),
    Exercise(
        "A shaft that bends",
        "A rotor of {half} kg per bearing runs on films with $K_{{eq}}$ = {keq} MN/m and the whirl "
        "ratio {ratio}. Each side of its shaft has the stiffness {k} N/m. At what speed would it "
        "begin to whirl, with these values?",
        lambda dice: dict(_short_bearing(dice)) | {"k": dice.choice((2e7, 3e7, 5e7))},
        (Ask("Threshold speed", "rpm", lambda c: float(c.point.flexible_threshold) / rpm),),
        "Shaft and film are springs in series.", "pages/3_Stability.py",
        r"$\Omega_s = \frac1{\bar\omega}\sqrt{\frac{K_{eq}}{M(1+K_{eq}/K_{rot})}}$ (Eq. 5.50 with "
        r"$K_{eq} = k_{eq}F_o/C$).", known=_threshold,
    ),
    Exercise(
        "What the spectrum shows",
        "A rotor whose bearings have the radial clearance {C} µm begins to whirl at "
        "{onset} rpm, with a whirl ratio of {ratio}. At what frequency does its spectrum then have "
        "the line of the whirl?",
        lambda dice: {"C": dice.choice((50.0, 60.0, 75.0, 90.0, 110.0))},
        (Ask("Frequency", "Hz", lambda c: c.onset.whirl_frequency / (2 * math.pi)),),
        "A spectrum counts turns a second.", "pages/3_Stability.py",
        r"$f = \bar\omega\,\Omega/2\pi$, with $\Omega = \pi n/30$ for $n$ in rpm.",
        preset="sheet-1e8",
        known=lambda c: {
            "onset": f"{c.onset.speed / rpm:.0f}",
            "ratio": f"{c.onset.whirl_frequency / c.onset.speed:.3f}",
        },
    ),
    Exercise(
        "How fast a mode decays",
        "At {rpm} rpm the mode of a rotor with the smallest damping ratio has the eigenvalue "
        "λ = −{real} + {imag} j, in 1/s and rad/s. What are its damping ratio and its logarithmic "
        "decrement?",
        _sheet(2500, 8000),
        (
            Ask("Damping ratio ζ", "-", lambda c: -least_damped(c).real / abs(least_damped(c))),
            Ask(
                "Logarithmic decrement δ", "-",
                lambda c: -2 * math.pi * least_damped(c).real / least_damped(c).imag,
            ),
        ),
        "δ is the logarithm of the ratio of two maxima, one period apart.", "pages/4_Root_locus.py",
        r"$\zeta = -\mathrm{Re}\,\lambda/|\lambda|$, "
        r"$\delta = -2\pi\,\mathrm{Re}\,\lambda/\mathrm{Im}\,\lambda$.",
        preset="sheet-1e8", known=_mode,
    ),
    Exercise(
        "A balance grade",
        "A rotor runs at up to {rpm} rpm and is balanced to the grade G 2.5 of ISO 21940-11. How "
        "far from the axis may its mass centre lie?",
        lambda dice: {"rpm": dice.choice((1500.0, 3000.0, 3600.0, 6000.0, 9000.0))},
        (
            Ask("Distance e", "µm", lambda c: 1e6 * float(
                criteria.permissible_eccentricity("G 2.5", speed=c.speed)
            )),
        ),
        "The number of the grade is the speed of the mass centre, in mm/s.",
        "pages/10_Criteria.py", r"$e = G/\Omega$ with $G$ = 2.5 mm/s.",
        chosen={GRADE: "G 2.5"},
    ),
)  # fmt: skip
