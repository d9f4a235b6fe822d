"""The results that pages show, of one machine, agree with each other."""

from dataclasses import replace

import numpy as np
import pytest

from rotorcalc import rpm
from rotorcalc.films import FilmUnits
from tests.films.models import BEARINGS, Ringed
from tests.machines import SHEET
from ui.computed import Computed

# A ring so heavy that the film over σ at another speed is another.
HEAVY = replace(BEARINGS["ringed"], geometry=Ringed(ring_mass=15.0))


@pytest.mark.parametrize("bearing", [*BEARINGS.values(), HEAVY], ids=[*BEARINGS, "very heavy"])
@pytest.mark.parametrize("speed", [3000.0 * rpm, 9000.0 * rpm])
def test_dimensionless_curves_pass_through_the_machines_own_point(bearing, speed):
    computed = Computed(replace(SHEET, bearing=bearing), speed, 12000.0 * rpm)
    sigma, k = computed.curves.film.sommerfeld, computed.curves.film.stiffness
    here, own = float(computed.point.sommerfeld), computed.curves_here.film.stiffness
    for i, j in np.ndindex(2, 2):
        on_curve = np.interp(np.log(here), np.log(sigma), k[:, i, j])
        assert on_curve == pytest.approx(own[i, j], rel=1e-3, abs=1e-3 * np.abs(own).max())
    unit = FilmUnits(computed.machine.bearing, computed.machine.viscosity, speed).stiffness
    assert computed.point.stiffness == pytest.approx(own * unit, rel=1e-9, abs=1e-9 * unit)
