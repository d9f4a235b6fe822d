"""J. W. Lund and K. K. Thomsen, A calculation method and data for the dynamic coefficients of
oil-lubricated journal bearings, in Topics in Fluid Film Bearing and Rotor Bearing System Design and
Optimization, ASME (1978): printed rows, which the live validation has too.

Their clearance is the pad's machined one, S = μNDL/W·(R/C)² with N in rev/s, so σ = πS(L/D)²; x
along the load, y in the sense of rotation; K in W/C, B in W/(CΩ). B_yx is not printed where it is
equal to B_xy.
"""

import math

import numpy as np
import pytest

from rotorcalc import JournalBearing
from rotorcalc.films import film_state
from rotorcalc.validation.finite import LUND_THOMSEN


@pytest.mark.parametrize(
    "row", LUND_THOMSEN, ids=[f"{row.geometry.kind}, S = {row.number}" for row in LUND_THOMSEN]
)
def test_printed_row(row):
    geometry, ratio, S, (eps, phi), K, B = row
    K, B = np.array(K), np.array(B)
    bearing = JournalBearing(
        diameter=0.1, length=0.1 * ratio, radial_clearance=1e-4, geometry=geometry
    )
    film = film_state(bearing, math.pi * S * ratio**2)
    found = np.delete(film.c, 2)

    assert float(film.eccentricity_ratio) == pytest.approx(eps, abs=0.0012)
    assert math.degrees(film.attitude_angle) == pytest.approx(phi, abs=0.15)
    assert film.k.ravel() == pytest.approx(K, abs=0.012 * np.abs(K).max())
    assert found == pytest.approx(B, abs=0.012 * np.abs(B).max())
