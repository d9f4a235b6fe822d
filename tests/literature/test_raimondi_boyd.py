"""A. A. Raimondi and J. Boyd, A solution for the finite journal bearing and its application to
analysis and design, III, ASLE Transactions 1 (1958): the full bearing, film broken at ambient.

Characteristic number S = μN/P·(R/C)², attitude angle, side flow as (Q/RCNL)·(Q_s/Q) and the ratio
of mean to highest pressure. They let the film begin where it is thickest, the program where
pressure and slope vanish, a little before it. Their differences give the
highest pressure, between their nodes, to 3 %.
"""

import math

import numpy as np
import pytest

from rotorcalc import JournalBearing
from rotorcalc.films import film_state
from rotorcalc.films.finite.results import peak, side_flow
from rotorcalc.films.finite.reynolds import films, mesh
from rotorcalc.films.finite.sweeps import settled_pressures
from rotorcalc.films.pads import Pad

# L/D: ε, S, φ [°], Q/RCNL, Q_s/Q, P/p_max.
TABLE = {
    1.0: [
        (0.2, 0.631, 74.02, 3.59, 0.280, 0.529),
        (0.4, 0.264, 63.10, 3.99, 0.497, 0.484),
        (0.6, 0.121, 50.58, 4.33, 0.680, 0.415),
        (0.8, 0.0446, 36.24, 4.62, 0.842, 0.313),
        (0.9, 0.0188, 26.45, 4.74, 0.919, 0.247),
    ],
    0.5: [
        (0.2, 2.03, 74.94, 3.72, 0.318, 0.506),
        (0.4, 0.779, 61.45, 4.29, 0.552, 0.441),
        (0.6, 0.319, 48.14, 4.85, 0.730, 0.365),
        (0.8, 0.0923, 33.31, 5.41, 0.874, 0.267),
        (0.9, 0.0313, 23.66, 5.69, 0.939, 0.206),
    ],
}
ROWS = [(ratio, *row) for ratio, rows in TABLE.items() for row in rows]


ALL = pytest.mark.parametrize("row", ROWS)


@ALL
def test_printed_row(row):
    """The film begins at its thickest place: a pad that is cut open there."""
    ratio, eps, S, phi, flow, share, pressure = row
    grid = mesh((Pad(-math.pi, math.pi),), 1.0 / ratio**2, 160, 3)
    film = films(grid, np.array([[eps, 0.0]]))
    at = settled_pressures(film, np.ones((1, *grid.shape), dtype=bool))
    F_x, F_y = at.force[0]
    assert 1.0 / (math.pi * math.hypot(F_x, F_y)) == pytest.approx(S, rel=0.015)
    assert math.degrees(math.atan2(F_y, -F_x)) == pytest.approx(phi, rel=0.015)
    # N is in rev/s: ΩRLC is 2π RCNL.
    found = 2.0 * math.pi * float(side_flow(film, at.pressure)[0])
    assert found == pytest.approx(flow * share, rel=0.015)
    # P = W/(LD) is half the force in μΩR³L/C², in μΩ(R/C)².
    highest = float(peak(film, at.pressure).pressure[0])
    assert 0.5 * math.hypot(F_x, F_y) / highest == pytest.approx(pressure, rel=0.03)


@ALL
def test_where_the_film_begins_hardly_matters_to_the_eccentricity(row):
    ratio, eps, S, *_ = row
    bearing = JournalBearing(diameter=0.1, length=0.1 * ratio, radial_clearance=1e-4, film="finite")
    film = film_state(bearing, math.pi * S * ratio**2)
    assert float(film.eccentricity_ratio) == pytest.approx(eps, rel=0.015)
