"""Figs. 5.5 to 5.10 on any bore: the notes' own bearing, short and plain, stands behind them."""

from typing import Any

import numpy as np
import pytest

from rotorcalc.films import short
from tests.app.session import charts, faults, open_part, session_of, visit

COEFFICIENTS, STABILITY = "pages/2_Coefficients.py", "pages/3_Stability.py"
BEHIND = "short plain bearing"
# Page, its tab, and the charts there.
FIGURES = [
    (COEFFICIENTS, ("coefficients_tab", "Against ε"), ("k_ε", "c_ε")),
    (COEFFICIENTS, ("coefficients_tab", "Against σ"), ("k_σ", "c_σ")),
    (
        STABILITY,
        ("stability_tab", "Figures of the notes"),
        ("whirl_ratio", "critical_mass_number", "threshold_speed", "flexible_threshold"),
    ),
]
every_figure = pytest.mark.parametrize(("page", "tab", "keys"), FIGURES)


def legend(chart: dict[str, Any]) -> list[str]:
    return [
        trace["name"]
        for trace in chart["data"]
        if trace.get("showlegend", True) and trace.get("name")
    ]


def behind(chart: dict[str, Any]) -> list[dict[str, Any]]:
    return [trace for trace in chart["data"] if trace.get("name", "").startswith(f"{BEHIND}: ")]


@every_figure
def test_the_short_plain_bearing_is_behind_each_also_while_a_slider_is_dragged(
    page: str, tab: tuple[str, str], keys: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ROTORCALC_LIVE", "drag")
    at = visit(page, bearing="elliptical")
    open_part(at, *tab)
    visitor = session_of(at)
    assert visitor.preview is not None
    dragged = visitor.preview.at("preload", "0.3")["charts"]
    for key in keys:
        chart = dragged[f"chart_{key}"]
        assert legend(chart).count(BEHIND) == 1, key
        assert behind(chart), key
        # Thin, and the same whatever the bore.
        assert all(trace["line"]["width"] < 1.5 for trace in behind(chart))
    assert faults(at) == []


@every_figure
def test_the_short_plain_bearing_has_none_but_itself(
    page: str, tab: tuple[str, str], keys: tuple[str, ...]
) -> None:
    at = visit(page)
    open_part(at, *tab)
    shown = charts(at)
    for key in keys:
        assert BEHIND not in legend(shown[f"chart_{key}"])


def test_what_is_behind_is_the_notes_closed_form() -> None:
    at = visit(STABILITY, bearing="lobes", film="finite")
    open_part(at, "stability_tab", "Figures of the notes")
    (line,) = [
        trace for trace in session_charts(at)["chart_threshold_speed"]["data"]
        if trace.get("name", "").startswith(BEHIND) and len(trace["x"]) > 100
    ]  # fmt: skip
    sigma, p_s = np.array(line["x"], dtype=float), np.array(line["y"], dtype=float)
    eps = short.eccentricity_ratio(sigma)
    k_eq, ratio = _onset(short.stiffness(eps), short.damping(eps))
    whirls = ratio > 0.0
    assert p_s[whirls] == pytest.approx(np.sqrt(k_eq[whirls] / ratio[whirls]), rel=1e-6)


def _onset(k: np.ndarray, c: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return k_eq and the square of the whirl ratio (Eqs. 5.45, 5.46)."""
    k_eq = (
        k[:, 0, 0] * c[:, 1, 1] + c[:, 0, 0] * k[:, 1, 1]
        - c[:, 0, 1] * k[:, 1, 0] - c[:, 1, 0] * k[:, 0, 1]
    ) / (c[:, 0, 0] + c[:, 1, 1])  # fmt: skip
    over = (k_eq - k[:, 0, 0]) * (k_eq - k[:, 1, 1]) - k[:, 0, 1] * k[:, 1, 0]
    return k_eq, over / np.linalg.det(c)


def session_charts(at: Any) -> dict[str, Any]:
    """Return the charts as drawn: the browser's have their arrays packed."""
    visitor = session_of(at)
    assert visitor.preview is not None
    return {key: draw(visitor.preview.computed) for key, draw in visitor.preview.charts.items()}


def test_with_a_case_it_is_named_once() -> None:
    at = visit(STABILITY, bearing="elliptical")
    open_part(at, "stability_tab", "Figures of the notes")
    at.button(key="keep").click().run()
    chart = session_charts(at)["chart_whirl_ratio"]
    assert legend(chart).count(BEHIND) == 1
