"""Where the model holds: what a machine at one speed asks of the short-bearing, linear theory.

The program computes outside these limits too; it says so beside the result.
"""

from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from rotorcalc.analysis import Sweep
from rotorcalc.arguments import checked
from rotorcalc.films import film_of
from rotorcalc.unbalance_response import orbit_ellipse

Level: TypeAlias = Literal["good", "caution", "outside"]

# Composite roughness of ground or honed surfaces [m], an assumption.
ROUGHNESS = 1e-6


@dataclass(frozen=True)
class Check:
    """One assumption of the model, checked.

    Attributes
    ----------
    name : str
        What is checked, in words with its symbol.
    value : float
        The number that is judged [-].
    caution, limit : float
        From `caution` on the model is strained, from `limit` on it fails; for a film thickness
        the values below which that is so.
    level : "good", "caution" or "outside"
        The verdict.
    reason : str
        What goes wrong, in a sentence.
    """

    name: str
    value: float
    caution: float
    limit: float
    level: Level
    reason: str


@checked
def validity(point: Sweep) -> tuple[Check, ...]:
    """Return how far a machine at one speed keeps to what the model assumes.

    Parameters
    ----------
    point : Sweep
        The machine at one speed: `analyse(machine, speed)` of a scalar.

    Returns
    -------
    tuple of Check
        What the film model assumes of the bearing, for the short one length over diameter;
        Reynolds number of the film, ρΩRC/μ, against that at which Taylor's vortices appear,
        41.1√(R/C) (Taylor 1923), with turbulence at 2000; smallest film against an assumed
        roughness of 1 µm, full film above 3 of it, and against the clearance; the journal's
        imbalance orbit and the rotor's static sag against the clearance.
    """
    machine = point.machine
    bearing = machine.bearing
    R, C = bearing.radius, bearing.radial_clearance
    film = float(point.minimum_film_thickness)
    reynolds = machine.oil.density * float(point.speed) * R * C / machine.viscosity
    vortices = min(41.1 * float(np.sqrt(R / C)), 2000.0)
    orbit = orbit_ellipse(point.journal_response)
    swing = float(orbit.semi_major) / C
    return (
        *(_above(one.name, one.value, one.caution, one.outside, one.reason)
          for one in film_of(bearing).limits),
        _above("Reynolds number of the film, ρΩRC/μ", reynolds, vortices, 2000.0,
               "vortices, and then turbulence, replace the laminar flow"),
        _below("Smallest film over roughness of 1 µm", film / ROUGHNESS, 10.0, 3.0,
               "the surfaces' roughness reaches through the film"),
        _below("Smallest film over clearance, h_min/C", film / C, 0.1, 0.03,
               "so thin a film heats up and bends its walls, which the model leaves out"),
        _above("Imbalance orbit over clearance", swing, 0.1, max(film / C, 0.1),
               "linear coefficients hold for small orbits; at the limit it reaches the wall"),
        _above("Static sag over clearance, Γ/C", machine.static_sag / C, 1.0, 10.0,
               "so flexible a shaft slopes in its bearings, which the model takes as aligned"),
    )  # fmt: skip


def _above(name: str, value: float, caution: float, limit: float, reason: str) -> Check:
    level: Level = "outside" if value > limit else "caution" if value > caution else "good"
    return Check(name, value, caution, limit, level, reason)


def _below(name: str, value: float, caution: float, limit: float, reason: str) -> Check:
    level: Level = "outside" if value < limit else "caution" if value < caution else "good"
    return Check(name, value, caution, limit, level, reason)
