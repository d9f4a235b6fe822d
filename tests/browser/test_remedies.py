"""A remedy is applied by one button and undone; the map names its sides in the browser too."""

import re

import pytest
from playwright.sync_api import expect

from tests.browser.app_page import AppPage


@pytest.mark.parametrize("query", [{"rpm": "10000"}, {"load": "0"}])
def test_a_remedy_makes_the_machine_stable_and_is_undone(
    app: AppPage, query: dict[str, str]
) -> None:
    app.open("Stability", tab="Remedies", **query)
    verdict = app.page.locator(".st-key-said_verdict")
    expect(verdict).to_contain_text("Unstable at")
    before = app.query()
    with app.run():
        app.page.get_by_role("button", name=re.compile("^Apply ")).first.click()
    expect(verdict).to_contain_text("Stable at")
    assert app.metrics()["Margin to onset"] == "20 %"
    assert app.query() != before
    with app.run():
        app.page.get_by_role("button", name="Undo", exact=True).click()
    expect(verdict).to_contain_text("Unstable at")
    assert app.query() == before


def test_the_answer_follows_a_moved_slider(app: AppPage) -> None:
    app.open("Stability", tab="Remedies")
    answer = app.page.locator(".st-key-said_answer")
    shown = answer.inner_text()
    assert "20 % above today's onset" in shown
    app.press("Film temperature", "PageUp")
    expect(answer).not_to_have_text(shown)


@pytest.mark.parametrize(
    ("query", "words", "line"),
    [
        ({}, {"stable", "unstable"}, True),
        ({"cs": "50000"}, {"stable"}, False),
        ({"load": "0", "x": "C"}, {"unstable"}, False),
    ],
)
def test_the_map_names_its_sides(
    app: AppPage, query: dict[str, str], words: set[str], line: bool
) -> None:
    app.open("Stability", tab="Map", **query)
    chart = app.page.locator(".js-plotly-plot")
    said = chart.locator(".annotation-text").all_text_contents()
    assert {text for text in said if not text.isdigit()} == words
    legend = " ".join(chart.locator(".legendtext").all_text_contents())
    assert ("running speed" in legend) == line
    assert any(text.isdigit() for text in said) == (query.get("load") != "0")
