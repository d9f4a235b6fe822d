"""Charts of force coefficients: valid for every machine, and true to the results they show."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotorcalc import PRESETS, Machine, analyse, film_curves
from rotorcalc.analysis import ForceCoefficients, force_coefficients
from rotorcalc.coefficients import (
    BULK_FLOW,
    LAMINAR,
    added_mass,
    equilibrium,
    over_whirl_ratio,
    unloading,
)
from rotorcalc.figures import SI, US, Units, coefficients
from rotorcalc.films import OperatingPoints, film_of, short
from tests.figures.charts import check_case_is_behind, check_plotly_takes_it, curves_in_window

MACHINES: dict[str, Machine] = {key: preset.machine for key, preset in PRESETS.items()}
SHEET = MACHINES["sheet-1e8"]
MACHINES |= {
    "no load": replace(SHEET, load=0.0),
    "heavy": replace(SHEET, load=20000.0),
    "wide": replace(SHEET, bearing=replace(SHEET.bearing, radial_clearance=500e-6)),
    "tight": replace(SHEET, bearing=replace(SHEET.bearing, radial_clearance=10e-6)),
}
SPEED = 600.0
SIGMA = np.geomspace(1e-2, 1e2, 60)


def _charts(machine: Machine, units: Units, axes: Any) -> Iterator[dict[str, Any]]:
    sweep, point = analyse(machine, np.linspace(10.0, 1200.0, 60)), analyse(machine, SPEED)
    curve, here = force_coefficients(sweep, axes=axes), force_coefficients(point, axes=axes)
    yield coefficients.stiffness_against_speed(sweep, point, curve, here, units)
    yield coefficients.damping_against_speed(sweep, point, curve, here, units)
    film = force_coefficients(film_curves(machine.bearing, SIGMA), axes=axes)
    film_here = force_coefficients(film_curves(machine.bearing, point.sommerfeld), axes=axes)
    for against in ("ε", "σ"):
        yield coefficients.dimensionless(film, film_here, "k", against)
        yield coefficients.dimensionless(film, film_here, "c", against)
    states = [unloading(machine, SPEED, sommerfeld=s) for s in (SIGMA, point.sommerfeld, np.inf)]
    yield coefficients.unloading(*states, units)
    laminar, bulk = (added_mass(machine, sweep.speed, factor=f) for f in (LAMINAR, BULK_FLOW))
    yield coefficients.added_mass(laminar, bulk, added_mass(machine, SPEED), units)
    over = over_whirl_ratio(machine, SPEED, whirl_ratio=np.linspace(0.1, 2.0, 20))
    yield coefficients.over_whirl_ratio(over, point, "K", units)
    yield coefficients.over_whirl_ratio(over, point, "C", units)


@pytest.mark.parametrize("units", [SI, US], ids=lambda units: units.name)
@pytest.mark.parametrize("axes", ["XY", "rt"])
@pytest.mark.parametrize("machine", MACHINES.values(), ids=MACHINES.keys())
def test_every_chart_is_a_plotly_figure(machine: Machine, axes: str, units: Units) -> None:
    for chart in _charts(machine, units, axes):
        check_plotly_takes_it(chart)
        assert curves_in_window(chart)
        for axis in (chart["layout"]["xaxis"], chart["layout"]["yaxis"]):
            assert np.all(np.isfinite(axis["range"]))
            assert axis["range"][0] != axis["range"][1]


@pytest.mark.parametrize("axes", ["XY", "rt"])
def test_a_case_stands_behind_every_chart(axes: str) -> None:
    # What is against ε or σ is the film's own; another machine's mark alone differs there.
    other = MACHINES["friswell-5-5-1"]
    for chart, pinned in zip(_charts(SHEET, SI, axes), _charts(other, SI, axes), strict=True):
        check_case_is_behind(chart, pinned)


def _film(axes: Any, sigma: Any = SIGMA) -> ForceCoefficients:
    return force_coefficients(film_curves(SHEET.bearing, sigma), axes=axes)


def test_negative_coefficients_are_dashed_and_named_so() -> None:
    chart = coefficients.dimensionless(_film("XY"), _film("XY", 1.0), "k", "ε")
    lines = {trace["name"]: trace for trace in chart["data"] if trace["mode"] == "lines"}
    positive, negative = lines["<i>k<sub>YX</sub></i>"], lines["−<i>k<sub>YX</sub></i>"]
    k_YX = _film("XY").stiffness[:, 1, 0]
    assert negative["line"]["dash"] == "dash"
    assert np.any(k_YX > 0.0)
    assert np.any(k_YX < 0.0)
    assert_allclose(positive["y"][k_YX > 0.0], k_YX[k_YX > 0.0])
    assert_allclose(negative["y"][k_YX < 0.0], -k_YX[k_YX < 0.0])
    assert np.all(np.isnan(positive["y"][k_YX < 0.0]))


def test_the_axis_grows_by_decades_where_the_running_speed_leaves_it() -> None:
    here = _film("XY", 1e4)
    chart = coefficients.dimensionless(_film("XY"), here, "k", "ε")
    assert chart["layout"]["yaxis"]["range"][1] == np.ceil(np.log10(here.stiffness[0, 1]))
    usual = coefficients.dimensionless(_film("XY"), _film("XY", 1.0), "k", "σ")
    assert usual["layout"]["xaxis"]["range"] == pytest.approx([-2.0, 2.0])


def test_a_chart_without_load_has_no_mark_but_all_lines() -> None:
    chart = coefficients.dimensionless(_film("XY"), _film("XY", np.inf), "k", "σ")
    assert all(trace["mode"] == "lines" for trace in chart["data"])


def test_coefficients_along_the_line_of_centres_are_those_of_eq_5_34() -> None:
    eps = _film("rt").eccentricity_ratio
    unit = (4.0 * SIGMA)[:, None, None]
    assert_allclose(_film("rt").stiffness, short.radial_stiffness(eps) * unit, rtol=1e-9)
    assert_allclose(_film("rt").damping, short.radial_damping(eps) * unit, rtol=1e-9)


def test_equivalent_stiffness_is_the_same_in_both_frames() -> None:
    turned = _film("rt")
    (k_rr, k_rt), (k_tr, k_tt) = np.moveaxis(turned.stiffness, 0, -1)
    (c_rr, c_rt), (c_tr, c_tt) = np.moveaxis(turned.damping, 0, -1)
    k_eq = (k_rr * c_tt + k_tt * c_rr - c_tr * k_rt - c_rt * k_tr) / (c_rr + c_tt)
    assert_allclose(k_eq, _film("XY").equivalent_stiffness, rtol=1e-9)


def test_an_unloaded_film_has_only_cross_coupling_of_half_the_damping() -> None:
    centred = unloading(SHEET, SPEED, sommerfeld=np.inf)
    K, half = centred.stiffness, centred.whirl_damping
    assert_allclose(np.diag(K), 0.0, atol=0.0)
    assert_allclose([K[0, 1], -K[1, 0]], half[0, 0], rtol=1e-12)
    assert_allclose(half[0, 1], 0.0, atol=0.0)


def test_unloading_passes_through_the_machines_own_coefficients() -> None:
    point = analyse(SHEET, SPEED)
    own = unloading(SHEET, SPEED, sommerfeld=point.sommerfeld)
    assert_allclose(own.stiffness, point.stiffness, rtol=1e-12)
    assert_allclose(own.whirl_damping, SPEED / 2.0 * point.damping, rtol=1e-12)


def test_added_mass_of_a_centred_film_weighs_as_density_over_viscosity() -> None:
    """Without load I = π/2 and C = μRL³/C³·π/2, so M/C_XX = α_m ρC²/(12μ)."""
    machine = MACHINES["no load"]
    found = added_mass(machine, SPEED, factor=1.1)
    damping = equilibrium(machine, SPEED).damping[0, 0]
    C = machine.bearing.radial_clearance
    expected = 1.1 * machine.oil.density * C**2 / (12.0 * machine.viscosity) * damping
    assert_allclose(found.mass, expected * np.eye(2), rtol=1e-12, atol=1e-12 * expected)
    assert_allclose(found.to_rotor, expected / machine.rotor.half_mass, rtol=1e-12)
    assert_allclose(found.to_damping, SPEED * expected / damping, rtol=1e-12)


def test_added_mass_is_a_mass_and_goes_with_the_factor() -> None:
    speeds = np.linspace(10.0, 2000.0, 20)
    laminar, bulk = (added_mass(SHEET, speeds, factor=f).mass for f in (LAMINAR, BULK_FLOW))
    assert_allclose(laminar, laminar.swapaxes(-1, -2), rtol=1e-12)
    assert np.all(np.linalg.eigvalsh(laminar) > 0.0)
    assert_allclose(laminar, 1.2 * bulk, rtol=1e-12)


def test_a_film_answers_with_its_added_mass_through_the_seam() -> None:
    eps = short.eccentricity_ratio(SIGMA)
    assert_allclose(
        film_of(SHEET.bearing).added_mass(OperatingPoints.at_sommerfeld(SHEET.bearing, SIGMA)),
        short.added_mass(eps),
        rtol=1e-12,
    )
