"""Texts and tables of the modes at the running speed."""

import math

import streamlit as st

from rotorcalc import modes
from rotorcalc.arrays import ComplexArray
from rotorcalc.modes import ModeShapes
from rotorcalc.onset import Onset
from rotorcalc.root_locus import Locus
from rotorcalc.unbalance_response import orbit_ellipse
from rotorcalc.units import Units
from ui.choices import choose
from ui.computed import Computed
from ui.format import digits, minus
from ui.words.citation import as_far_as, capital, source, without_load

ALTS = {
    "locus": "Eigenvalues in the complex plane as the speed rises: left of the imaginary axis a "
    "mode decays, right of it the mode grows. A slider below the chart sets the speed.",
    "growth": "Real part of each eigenvalue against speed; positive is unstable.",
    "frequency": "Frequency of each mode against speed, with the speed and half of it.",
    "damping": "Damping ratio of each mode against speed.",
    "natural": "Natural frequency of each mode against speed, beside that of a rigid rotor on the "
    "film and of the shaft alone.",
    "decrement": "Logarithmic decrement of each mode against speed.",
    "shape": "Orbits of disk, journal and floating ring in one mode, seen along the shaft.",
}
CAPTIONS = {
    "locus": "Eigenvalues λ of Eq. 5.38 (rigid) and of the calculation sheet (flexible), the upper "
    "half-plane; the lower one is its mirror image. Dotted rays: constant damping ratio ζ.",
    "growth": "Real part of λ: unstable as soon as one is positive. Eq. 5.42 holds at zero.",
    "frequency": "Imaginary part of λ. Imbalance excites a mode where it crosses 1×.",
    "damping": "ζ = −Re λ/|λ|: zero at the onset; 1, dotted, where a mode does not oscillate.",
    "natural": r"|λ|, beside $\sqrt{K_{eq}/M}$ of a rigid rotor on the film (Eq. 5.47) and "
    r"$\sqrt{K_{rot}/M}$ of the shaft in rigid bearings. The rigid rotor's onset is where its mode "
    r"meets $\sqrt{K_{eq}/M}$.",
    "decrement": "δ = −2π Re λ/|Im λ|: each cycle's amplitude is $e^{-δ}$ times that of the one "
    "before.",
    "shape": "Right eigenvector of λ, scaled to a largest displacement of 1, about equilibrium. X "
    "points down along the load, the shaft turns counterclockwise, from X to Y.",
}
_HOW_TO_READ = r"""
**How to read these charts**

- Modes are numbered by rising frequency at the lowest speed, and keep their number where curves
  cross.
- Two eigenvalues that are mirror images are one mode; only the one with Im λ ≥ 0 is drawn.
- A **real eigenvalue does not oscillate**: the journal creeps back through the film. It has a
  growth rate, drawn dotted, but no frequency and no decrement.
- The rigid rotor's curve $\sqrt{K_{eq}/M}$ is its whirl frequency *at* the onset.
"""
_HALF_SPEED = " Below the onset its mode follows half the running speed instead."
ABOUT_MODES = """
In a whirl, film and shaft act in series: the disk moves more than the journals by the bending of
the shaft. Near the onset the orbit is nearly a circle and turns **forward**, with the shaft: the
cross-coupled stiffness $K_{XY} − K_{YX}$ can feed only a forward whirl.

The table gives the direction and the ratio of the orbit's axes, minor to major. A real eigenvalue
has no orbit: disk and journals creep along a line.
"""


def choose_shaft(computed: Computed) -> bool:
    """Show the choice between the shaft as it is and a rigid one; return whether it bends."""
    if computed.machine.rotor.is_rigid:
        st.caption("The shaft is rigid: disk and journals move as one.")
        return False
    about = "The shaft as set in the sidebar, or the same rotor on a rigid shaft."
    return choose("Shaft", ["flexible", "rigid"], "locus_shaft", help=about) != "rigid"


def caption(key: str, computed: Computed) -> str:
    """Return the caption of a chart."""
    if key == "frequency" and (half := source(computed, "half speed")):
        return f"{CAPTIONS[key]} The film's whirl follows ½× ({half.equation})."
    return CAPTIONS[key]


def how_to_read(computed: Computed) -> str:
    """Return how to read the charts against speed, Markdown."""
    return _HOW_TO_READ.rstrip() + (_HALF_SPEED if source(computed, "half speed") else "")


def crossing(computed: Computed, onset: Onset, units: Units) -> str:
    """Return a text that says where a mode crosses the imaginary axis."""
    if computed.ends_unanswered(onset):
        return f"No mode crosses the imaginary axis, {as_far_as(computed)}."
    if math.isinf(onset.speed):
        return "No mode crosses the imaginary axis: this film cannot make this rotor whirl."
    speed = f"{float(units.speed.of(onset.speed)):.0f} {units.speed.name}"
    if onset.speed == 0.0:
        return f"{capital(without_load(computed))}, and the rotor whirls at any speed."
    if onset.speed > computed.top_speed:
        return f"The onset, {speed}, lies above the top speed of this chart."
    whirl = f"{float(units.speed.of(onset.whirl_frequency)):.0f} {units.speed.name}"
    ratio = f"{onset.whirl_frequency / onset.speed:.3g}"
    return (
        f"A mode crosses the imaginary axis at {speed}, whirling at {whirl}, {ratio} of the speed."
    )


def choose_mode(locus: Locus) -> int:
    """Show the choice of a mode, by its number in the table; return its index."""
    chosen = st.selectbox(
        "Mode",
        range(len(locus.here.eigenvalues)),
        index=locus.least_damped,
        format_func=lambda i: locus.name(i).removeprefix("mode "),
        key="locus_mode",
    )
    return locus.least_damped if chosen is None else chosen


def same_mode(locus: Locus, mode: int | None) -> int:
    """Return a mode's index in another locus: the least damped one's where it has no such mode."""
    return locus.least_damped if mode is None or mode >= len(locus.here.eigenvalues) else mode


def table(locus: Locus, units: Units) -> str:
    """Return the modes at the running speed as a Markdown table, narrow enough for a phone."""
    here, speed = locus.here, locus.running_speed
    count = len(here.eigenvalues)
    columns = (_column(here, i, speed, units) for i in range(count))
    names = (
        "Mode", f"Mode frequency [{units.speed.name}]", "× speed",
        f"Growth rate [{units.growth.name}]", "Damping ratio ζ", "Log. decrement δ",
        "Disk's orbit", "Journal's orbit",
    )  # fmt: skip
    head, *rows = zip(names, *columns, strict=True)
    if any(locus.moving):
        rows.append(("Moving part", *(part or "rotor" for part in locus.moving)))
    lines = (head, (":--", *["--:"] * count), *rows)
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def _column(here: ModeShapes, i: int, speed: float, units: Units) -> tuple[str, ...]:
    value = complex(here.eigenvalues[i])
    rate = minus(digits(value.real))
    if value.imag <= 0.0:
        words = "does not oscillate" if value.imag == 0.0 else "mirror image of another mode"
        return f"{i + 1}", words, "–", rate, "–", "–", "–", "–"
    ratio, decrement = float(modes.damping_ratio(value)), float(modes.logarithmic_decrement(value))
    return (
        f"{i + 1}",
        f"{float(units.speed.of(value.imag)):.0f}",
        digits(value.imag / speed),
        rate,
        minus(digits(ratio)),
        minus(digits(decrement)),
        _direction(here.disk[i]),
        _direction(here.journal[i]),
    )


def _direction(phasors: ComplexArray) -> str:
    orbit = orbit_ellipse(phasors)
    roundness = float(orbit.semi_minor / orbit.semi_major)
    if math.isnan(roundness) or abs(roundness) < 0.005:
        return "along a line"
    return f"{'forward' if roundness > 0 else 'backward'}, {abs(roundness):.2f}"
