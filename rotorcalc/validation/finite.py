"""Checks of the film of finite length: printed tables, and states that other programs computed.

Lund and Thomsen (1978) have K and C of bores with two grooves; Raimondi and Boyd (1958) the plain
bore, whose film begins where it is thickest; Nicholas, Barrett and Leader (1980) pressure dams and
their thresholds by finite elements. The second program solves Reynolds' equation by finite volumes
on a uniform grid, with sparse matrices, and has K and C by differences; it shares nothing with
this one. Clearances are those of the pads, angles from the load in the sense of rotation.
"""

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from scipy.constants import degree, inch, lbf, mil, psi

from rotorcalc.films import FilmUnits, film_state
from rotorcalc.films.state import FilmState
from rotorcalc.geometry import (
    AxialGrooves,
    Elliptical,
    Geometry,
    Lobes,
    OffsetHalves,
    PartialArc,
    Plain,
    PressureDam,
)
from rotorcalc.machine import JournalBearing
from rotorcalc.onset import whirl
from rotorcalc.units import rpm
from rotorcalc.validation.case import Case, alike


class Row(NamedTuple):
    """A printed or computed state: bore, L/D, S or σ, ε, φ [°], k (4,) and c_XX, c_XY, c_YY."""

    geometry: Geometry
    ratio: float
    number: float
    place: tuple[float, float]
    k: tuple[float, ...]
    c: tuple[float, ...]


_GROOVES, _ELLIPTICAL = AxialGrooves(), Elliptical()
# Pads of 160°; their S = μNDL/W·(R/C)² with N in rev/s is σ = πS(L/D)².
LUND_THOMSEN = (
    Row(_GROOVES, 0.5, 1.656, (0.244, 65.85), (1.69, 5.06, -2.20, 1.95), (9.93, 2.15, 4.80)),
    Row(_GROOVES, 0.5, 0.917, (0.372, 57.45), (2.12, 4.01, -1.30, 1.85), (7.70, 2.06, 3.23)),
    Row(_GROOVES, 0.5, 0.580, (0.477, 51.01), (2.67, 3.70, -0.78, 1.75), (6.96, 1.94, 2.40)),
    Row(_GROOVES, 0.5, 0.379, (0.570, 45.43), (3.33, 3.64, -0.43, 1.68), (6.76, 1.87, 1.89)),
    Row(_GROOVES, 0.5, 0.244, (0.655, 40.25), (4.21, 3.74, -0.13, 1.64), (6.87, 1.82, 1.54)),
    Row(_GROOVES, 1.0, 0.991, (0.150, 70.58), (1.56, 7.29, -2.16, 1.52), (14.66, 1.58, 4.49)),
    Row(_GROOVES, 1.0, 0.635, (0.224, 63.54), (1.62, 5.33, -1.57, 1.56), (10.80, 1.70, 3.41)),
    Row(_GROOVES, 1.0, 0.235, (0.460, 49.27), (2.19, 3.57, -0.80, 1.55), (7.36, 1.89, 2.19)),
    Row(_GROOVES, 1.0, 0.159, (0.559, 44.33), (2.73, 3.36, -0.48, 1.48), (6.94, 1.78, 1.74)),
    Row(_GROOVES, 1.0, 0.108, (0.650, 39.72), (3.45, 3.34, -0.23, 1.44), (6.89, 1.72, 1.43)),
    Row(_ELLIPTICAL, 1.0, 0.211, (0.260, 87.79), (6.65, 4.36, -3.21, 0.86), (13.09, -2.23, 3.70)),
    # φ is printed as 83.29, which breaks the column.
    Row(_ELLIPTICAL, 1.0, 0.161, (0.304, 85.29), (5.63, 3.84, -2.32, 1.01), (10.75, -1.02, 3.07)),
    Row(_ELLIPTICAL, 1.0, 0.120, (0.350, 81.80), (4.99, 3.54, -1.52, 1.14), (9.04, -0.01, 2.49)),
    Row(_ELLIPTICAL, 1.0, 0.097, (0.381, 78.65), (4.82, 3.46, -1.01, 1.21), (8.26, 0.56, 2.10)),
)  # fmt: skip
# L/D, ε, S of the full bearing.
RAIMONDI_BOYD = (
    (1.0, 0.2, 0.631), (1.0, 0.4, 0.264), (1.0, 0.6, 0.121), (1.0, 0.8, 0.0446), (1.0, 0.9, 0.0188),
    (0.5, 0.2, 2.03), (0.5, 0.4, 0.779), (0.5, 0.6, 0.319), (0.5, 0.8, 0.0923), (0.5, 0.9, 0.0313),
)  # fmt: skip
# σ in place of S.
SECOND_PROGRAM = (
    Row(Plain(), 1.0, 0.5, (0.5311, 56.63), (2.099, 3.187, -0.935, 2.002), (5.895, 2.103, 3.194)),
    Row(PartialArc(arc=120 * degree), 1.0, 0.3, (0.7054, 31.67), (4.603, 3.675, -0.105, 1.220),
        (7.954, 1.576, 0.972)),
    Row(_GROOVES, 0.5, 0.5, (0.4557, 52.38), (2.524, 3.750, -0.899, 1.789), (7.085, 2.003, 2.598)),
    Row(_ELLIPTICAL, 0.5, 0.5, (0.2150, 85.69), (9.633, 4.841, -5.214, 0.995),
        (16.141, -4.254, 5.116)),
    Row(OffsetHalves(), 0.5, 0.5, (0.2526, 1.29), (4.727, 8.238, -0.415, 6.466),
        (10.754, 5.647, 7.435)),
    Row(Lobes(), 0.5, 0.5, (0.1583, 58.68), (6.605, 5.442, -5.378, 3.217), (13.787, -0.251, 8.942)),
)  # fmt: skip
# Clearance and depth of the pocket [mil], its step from the split [°], L_d/L; ε, Ω_s√(c/g).
NICHOLAS = (
    ("set 1, bearing 1", (2.2, 2.4, 145, 0.75), (0.29, 7.5)),
    ("set 1, bearing 2", (2.5, 3.5, 145, 0.75), (0.29, 7.0)),
    ("set 3, bearing 1", (2.4, 13.4, 150, 0.75), (0.21, 4.6)),
    ("set 4, bearing 1", (2.4, 5.5, 90, 0.75), (0.22, 4.6)),
    ("set 5, bearing 1", (2.1, 22.5, 140, 0.50), (0.09, 3.0)),
)


def lund_thomsen() -> list[Case]:
    """Return the printed rows of Lund and Thomsen."""
    return list(_states("Film of finite length: Lund and Thomsen", "printed, 1978", LUND_THOMSEN))


def second_program() -> list[Case]:
    """Return states that a second program computed."""
    group, source = "Film of finite length: a second program", "recorded from it, σ = {}"
    found: list[Case] = []
    for row in SECOND_PROGRAM:
        of_sigma = row._replace(number=row.number / (math.pi * row.ratio**2))
        found += _states(group, source.format(row.number), (of_sigma,), loosest=0.005)
    return found


def _states(
    group: str, source: str, rows: tuple[Row, ...], *, loosest: float = 0.012
) -> Iterator[Case]:
    """Yield ε, φ, k and c of states at their S; `loosest` is allowed of the largest entry."""
    for row in rows:
        film, (eps, phi) = _film(row.geometry, row.ratio, row.number), row.place
        of = f"{row.geometry.kind}, L/D = {row.ratio:g}, S = {row.number:.3g}"
        angle = math.degrees(float(film.attitude_angle))
        k, c = film.k.reshape(1, 4), film.c[[0, 0, 1], [0, 1, 1]].reshape(1, 3)
        yield Case(group, f"ε, {of}", float(film.eccentricity_ratio), eps, 0.0012, source)
        yield Case(group, f"φ, {of}", angle, phi, 0.15, source, "°")
        for symbol, found, there in (("k", k, row.k), ("c", c, row.c)):
            pair = found, np.array([there])
            yield alike(group, f"{symbol}_ij, {of}", pair, source, tolerance=loosest)


def _film(geometry: Geometry, ratio: float, S: float) -> FilmState:
    bearing = JournalBearing(
        diameter=0.1, length=0.1 * ratio, radial_clearance=1e-4, geometry=geometry, film="finite"
    )
    return film_state(bearing, math.pi * S * ratio**2)


def raimondi_boyd() -> list[Case]:
    """Return the eccentricities of Raimondi and Boyd."""
    group = "Film of finite length: Raimondi and Boyd"
    return [
        Case(
            group, f"ε, L/D = {ratio:g}, S = {S:g}",
            float(_film(Plain(), ratio, S).eccentricity_ratio), eps, 0.015 * eps, "printed, 1958",
        )
        for ratio, eps, S in RAIMONDI_BOYD
    ]  # fmt: skip


def nicholas() -> list[Case]:
    """Return eccentricity and threshold of the pressure dams of Nicholas, Barrett and Leader."""
    group, source = "Film of finite length: Nicholas, Barrett and Leader", "Table 6, 1980"
    found: list[Case] = []
    for name, (clearance, depth, step, axial_ratio), (eps, threshold) in NICHOLAS:
        # The pocket begins at the pad's edge, 10° from the split; D = L = 1 in.
        bore = PressureDam(
            pocket_arc=(step - 10) * degree, depth=depth * mil, axial_ratio=axial_ratio
        )
        bearing = JournalBearing(
            diameter=inch, length=inch, radial_clearance=clearance * mil, geometry=bore
        )
        # The viscosity that gives the printed S back, at 8000 rpm under half of 29.8 lbf.
        units = FilmUnits(bearing, 7.60e-6 * psi, 8000 * rpm)
        film = film_state(bearing, float(units.force) / (4 * 14.9 * lbf))
        p_s = float(whirl.whirl_onset(film.k, film.c).threshold_speed)
        found += [
            Case(group, f"ε, {name}", float(film.eccentricity_ratio), eps, 0.015, source),
            Case(group, f"p_s, {name}", p_s, threshold, 0.08 * threshold, source),
        ]
    return found
