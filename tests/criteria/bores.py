"""Machines on other bores than the plain one, with films in closed form and films of the tests."""

from dataclasses import replace

from rotorcalc import AxialGrooves, Elliptical, Lobes, OffsetHalves, PartialArc
from tests.films.models import Lossy, Ringed
from tests.machines import SHEET

GEOMETRIES = {
    "grooves": AxialGrooves(),
    "partial arc": PartialArc(),
    "lemon": Elliptical(),
    "offset": OffsetHalves(),
    "lobes": Lobes(),
    "impedance": Lossy(),
    "ring": Ringed(),
    "ring with mass": Ringed(ring_mass=0.5),
}


def on(geometry, rotor=SHEET.rotor, machine=SHEET):
    """Return a machine with another bore, on the short film, and another rotor."""
    bearing = replace(machine.bearing, geometry=geometry, film="short")
    return replace(machine, bearing=bearing, rotor=rotor)
