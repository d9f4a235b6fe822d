"""A session without a browser has Streamlit's own sliders and charts: AppTest moves no others."""

import pytest

from ui.words import design


@pytest.fixture(autouse=True)
def streamlits_own(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROTORCALC_LIVE", "off")


@pytest.fixture
def coarse_maps(monkeypatch: pytest.MonkeyPatch) -> None:
    """Give maps a few points, which may take a tenth of a second each: the page says the same."""
    monkeypatch.setattr(design, "_COARSE", 4)
