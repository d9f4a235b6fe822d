"""A session without a browser has Streamlit's own sliders and charts: AppTest moves no others."""

import pytest


@pytest.fixture(autouse=True)
def streamlits_own(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROTORCALC_LIVE", "off")
