"""What all charts share: round axes, the mark of the running speed."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotorcalc.figures import SI, US, style, text, themed
from rotorcalc.units import SYSTEMS, with_amplitudes
from tests.figures.charts import beside


def drawn(top):
    x, y = style.axis("x [-]", 0.0, 10.0), style.axis("y [-]", 0.0, style.ceiling(top))
    return style.chart(
        [style.line([0.0, 10.0], [0.0, top], "line", style.BLUE), *style.here(5.0, top / 2, x, y)],
        x, y,
    )  # fmt: skip


@given(st.floats(1e-9, 1e12))
def test_an_axis_contains_its_values_and_little_empty_space(top):
    assert top <= style.ceiling(top) * (1 + 1e-12)
    assert style.ceiling(top) <= 1.3334 * top * (1 + 1e-9)


def test_an_axis_does_not_move_while_its_values_move_a_little():
    assert style.ceiling(44.0) == style.ceiling(48.0) == 50.0


def test_infinite_and_missing_values_set_no_axis():
    assert style.ceiling([np.inf, np.nan, 3.7]) == 4.0
    assert style.ceiling([np.nan]) == 1.0


def test_the_running_speed_has_guides_to_both_axes():
    chart = drawn(4.0)
    guide = chart["data"][1]
    assert guide["x"].tolist() == [0.0, 5.0, 5.0]
    assert guide["y"].tolist() == [2.0, 2.0, 0.0]


def test_text_is_light_on_dark_and_dark_on_light():
    light, dark = (themed(drawn(1.0), dark=dark) for dark in (False, True))
    assert light["layout"]["font"]["color"] < dark["layout"]["font"]["color"]


@pytest.mark.parametrize("system", SYSTEMS.values(), ids=SYSTEMS)
@given(value=st.floats(-1e6, 1e6))
def test_every_unit_leads_to_si_and_back(system, value):
    for kind in ("mass", "force", "film", "viscosity", "temperature", "power", "flow", "speed"):
        unit = getattr(system, kind)
        assert unit.to_si(float(unit.of(value))) == pytest.approx(value, rel=1e-12, abs=1e-9)


@pytest.mark.parametrize(
    ("kind", "si", "us"),
    [
        ("mass", 0.45359237, 1.0),
        ("force", 4.4482216152605, 1.0),
        ("length", 0.0254, 1.0),
        ("film", 25.4e-6, 1.0),
        ("viscosity", 6894.757293168361e-6, 1.0),
        ("temperature", 100.0, 212.0),
        ("shaft_stiffness", 175.12683524647645, 1.0),
        ("power", 745.6998715822702, 1.0),
        ("flow", 3.785411784e-3 / 60.0, 1.0),
        ("pressure", 6894.757293168361, 1.0),
    ],
)
def test_us_units_are_the_defined_ones(kind, si, us):
    assert float(getattr(US, kind).of(si)) == pytest.approx(us, rel=1e-12)
    assert getattr(SI, kind).name != getattr(US, kind).name


@pytest.mark.parametrize("system", SYSTEMS.values(), ids=SYSTEMS)
def test_peak_to_peak_is_twice_zero_to_peak_and_changes_nothing_else(system):
    assert with_amplitudes(system, "0-p") == system
    twice = with_amplitudes(system, "p-p")
    assert float(twice.amplitude.of(1e-5)) == pytest.approx(2.0 * float(system.film.of(1e-5)))
    assert twice.amplitude.name == f"{system.film.name} p-p"
    assert replace(twice, amplitude=system.amplitude) == system
    with pytest.raises(ValueError, match="must be '0-p' or 'p-p'"):
        with_amplitudes(system, "rms")


@pytest.mark.parametrize("most", [4, 6])
@pytest.mark.parametrize(
    ("low", "high"),
    [(0.0, 12000.0), (0.0, 15000.0), (0.0, 11350.5), (0.0, 1.2), (-600.0, 600.0), (200.0, -200.0)],
)
def test_ticks_are_few_and_reach_both_ends_of_the_axis(low: float, high: float, most: int) -> None:
    values = style.ticks(low, high, most)["tickvals"]
    assert (values[0], values[-1]) == tuple(sorted((low, high)))
    assert 2 <= len(values) <= most + 2
    assert np.diff(values).min() > 0.5 * np.diff(values).max()


@given(st.floats(1e-6, 1e6), st.floats(-1e6, 1e6))
def test_ticks_lie_within_any_axis_one_at_most_a_step_from_each_end(span: float, at: float) -> None:
    low, high = at, at + span
    values = style.ticks(low, high)["tickvals"]
    assert values == sorted(values)
    assert low <= values[0]
    assert values[-1] <= high
    assert 2 <= len(values) <= 8


def test_an_axis_that_a_case_widens_has_ticks_for_its_new_range() -> None:
    def chart(top: float) -> style.Chart:
        x = style.axis("x", 0.0, top)
        return style.chart([style.line([0.0, top], [0.0, 1.0], "a", style.BLUE)], x, x)

    both = beside(chart(100.0), chart(1200.0))
    assert both["layout"]["xaxis"]["tickvals"][-1] == 1200.0


@pytest.mark.parametrize(
    ("plain", "typeset"),
    [
        ("K_ij", "<i>K<sub>ij</sub></i>"),
        ("ω_s/Ω_s", "<i>ω<sub>s</sub></i>/Ω<i><sub>s</sub></i>"),
        ("Re λ", "Re <i>λ</i>"),
        ("p_s²", "<i>p<sub>s</sub></i>²"),
        ("√(K_eq/M)", "√(<i>K<sub>eq</sub></i>/<i>M</i>)"),
    ],
)
def test_symbols_are_typeset_as_in_an_equation(plain: str, typeset: str) -> None:
    assert style.symbols(plain) == typeset


@pytest.mark.parametrize(
    ("value", "words"),
    [(25000.0, "25000"), (2e7, "2·10⁷"), (-4e-6, "−4·10⁻⁶"), (0.34447, "0.3445"), (0.0, "0")],
)
def test_numbers_on_charts_have_no_e(value: float, words: str) -> None:
    assert text.number(value) == words
