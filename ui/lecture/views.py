"""The views that a step may show, by their names: each one chart."""

from collections.abc import Callable

from rotorcalc.figures import (
    Chart,
    coefficients,
    equilibrium,
    film,
    heat,
    machine,
    orbits,
    response,
    root_locus,
    stability,
)
from ui.frame.page import Page
from ui.preview import not_at_once
from ui.words import bearings as compared
from ui.words import on_demand
from ui.words import root_locus as on_locus
from ui.words import stability as on_stability
from ui.words.citation import cited

View = Callable[[Page], object]


def _bearing(page: Page) -> None:
    page.chart(
        lambda c: machine.cross_section(
            c.point, c.middle_film, page.units, to_scale=False, others=c.other_speeds, parts=c.parts
        ),
        "lecture_bearing",
        while_dragging=lambda c: machine.cross_section(
            c.point, c.middle_film, page.units, to_scale=False, parts=c.parts
        ),
        alt="Cross-section of the bearing with the journal, the load and the film's pressure",
        caption=cited(
            "Seen along the shaft, the clearance exaggerated.", page.computed, "pressure"
        ),
    )


def _film(page: Page) -> None:
    page.chart(
        lambda c: film.film_around(c.film, c.point, page.units),
        "lecture_film",
        at_one_speed=True,
        alt="Thickness and pressure of the film once around the journal, and the load.",
        caption=cited("At mid-length, above ambient.", page.computed, "thickness", "pressure"),
    )


def _locus(page: Page) -> None:
    page.chart(
        lambda c: equilibrium.locus(c.path, c.point, page.units),
        "lecture_locus",
        alt="Path of the journal in its clearance, from the wall to the middle.",
        caption=cited(
            "Path of the journal's centre, speeds in rpm along it.",
            page.computed, "attitude", "eccentricity",
        ),
    )  # fmt: skip


def _forces(page: Page) -> None:
    page.chart(
        lambda c: film.force_balance(c.forces, c.sweep, c.point, page.units),
        "lecture_forces",
        alt="Right-angled triangle of load, tangential and radial film force.",
        caption=cited(
            "The forces close a triangle. Grey: its corner at other speeds.",
            page.computed, "attitude", rotor="Eq. 5.4",
        ),
    )  # fmt: skip


def _stiffness(page: Page) -> None:
    page.chart(
        lambda c: coefficients.stiffness_against_speed(
            c.sweep, c.point, c.coefficients("XY"), c.coefficients_here("XY"), page.units
        ),
        "lecture_stiffness",
        alt="Stiffness coefficients and equivalent stiffness of one bearing against speed.",
        caption=cited(
            "Per bearing, each speed at its own equilibrium.",
            page.computed, "stiffness", rotor="Eq. 5.45",
        ),
    )  # fmt: skip


def _energy(page: Page) -> None:
    if not on_stability.has_orbit(page.computed):
        return
    page.chart(
        lambda c: stability.energy(
            on_stability.energies(c), on_stability.crossing(c), page.units
        ),
        "lecture_energy",
        alt="Energy fed in and dissipated in the whirl orbit over running speed.",
        caption="Per turn, orbit area and bearing; the lines meet at the onset. Appendix A.",
    )  # fmt: skip


def _threshold(page: Page) -> None:
    _over_speed(
        page, stability.threshold, "lecture_threshold",
        "Threshold speed over running speed, with the line of equal speeds and their crossing.",
        on_stability.meets(page.computed),
    )  # fmt: skip


def _whirl_frequency(page: Page) -> None:
    _over_speed(
        page, stability.whirl_frequency, "lecture_whirl_frequency",
        "Whirl frequency at the threshold over running speed, with half the speed.",
        "At the threshold the rotor whirls at its natural frequency. Eq. 5.47.",
    )  # fmt: skip


def _over_speed(page: Page, draw: Callable[..., Chart], key: str, alt: str, caption: str) -> None:
    if on_stability.can_whirl(page.computed):
        page.chart(
            lambda c: on_stability.over_speed(draw, c, page.units), key, alt=alt, caption=caption
        )


def _root_locus(page: Page) -> None:
    page.chart(
        lambda c: root_locus.still(c.locus(True), c.onset, page.units),
        "lecture_root_locus",
        alt=on_locus.ALTS["locus"],
        caption=lambda c: on_locus.crossing(c, c.onset, page.units),
    )


def _modes(page: Page) -> None:
    page.chart(
        lambda c: root_locus.at_running_speed(c.locus(True), page.units),
        "lecture_modes",
        alt="The modes at the running speed in the complex plane: growth rate and frequency.",
        caption="Each mode at the running speed.",
    )


def _response(page: Page) -> None:
    page.chart(
        lambda c: response.amplitude(c.response, "axes", page.units),
        "lecture_response",
        alt="Amplitudes of disk and journal against speed, with peaks and unstable range.",
        caption="Diamonds mark the largest orbits of disk and journal. Eq. 5.38.",
    )


def _limit_cycles(page: Page) -> None:
    if not on_demand.has_motion(page.computed.machine.bearing):
        return
    if (branch := on_demand.ask_cycles(page)) is None:
        return
    page.chart(
        lambda c: orbits.cycles(branch, on_demand.swept(branch, c), c.speed, page.units),
        "lecture_cycles",
        while_dragging=not_at_once,
        alt="Size of the limit cycles over speed, stable and unstable, and two sweeps.",
        caption="Without imbalance: harmonic balance, stability by Floquet.",
    )


def _temperatures(page: Page) -> None:
    page.chart(
        lambda c: heat.temperatures(c.sweep, c.point, page.units),
        "lecture_temperatures",
        alt="Temperatures of inlet, film and outlet over running speed.",
        caption="The film is at the mean of inlet and outlet. ISO 7902-1.",
    )


def _bearings(page: Page) -> None:
    compared.compare(page, draw=compared.onsets)


VIEWS: dict[str, View] = {
    "bearing": _bearing,
    "film": _film,
    "locus": _locus,
    "forces": _forces,
    "stiffness": _stiffness,
    "energy": _energy,
    "threshold": _threshold,
    "whirl frequency": _whirl_frequency,
    "modes": _modes,
    "root locus": _root_locus,
    "response": _response,
    "limit cycles": _limit_cycles,
    "temperatures": _temperatures,
    "bearings": _bearings,
}
