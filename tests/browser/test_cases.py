"""Cases over a reload, undo of each kind of change, and a link that reproduces the view."""

import re

import pytest
from playwright.sync_api import expect

from tests.browser.app_page import AppPage


def _press(app: AppPage, name: str) -> None:
    with app.run():
        app.page.get_by_role("button", name=name, exact=True).click()


def _choose_preset(app: AppPage) -> None:
    with app.run():
        app.page.get_by_role("combobox", name=re.compile("Preset")).click()
        app.page.get_by_role("option", name="600 lbf rotor, flexible shaft").click()


def _use_grade(app: AppPage) -> None:
    app.open_group("Oil")
    app.open_popover("Oil library")
    _press(app, "Use this grade")
    app.close_popover()


def test_cases_survive_a_reload_and_another_page(app: AppPage) -> None:
    app.open("Root locus")
    _press(app, "Keep as A")
    app.press("Radial clearance", "PageUp")
    _press(app, "Keep as B")
    app.press("Film temperature", "PageUp")
    table = app.page.locator("table.cases")
    shown = table.inner_text()
    assert "rpm" in shown
    app.page.reload()
    app.rest()
    assert table.inner_text() == shown
    app.go("Response")
    assert table.inner_text() == shown
    named = [{"A", "B"} <= set(chart) for chart in app.traces()]
    assert named
    assert all(named)


def test_each_kind_of_change_is_undone(app: AppPage) -> None:
    # Here no run draws an animation, which takes most of a run of this page.
    app.open("Orbits", C="70", tab="Spectrum")
    changes = {
        "slider": lambda: app.press("Film temperature", "ArrowRight"),
        "case": lambda: _press(app, "Keep as A"),
        "demonstration": lambda: _press(app, "Subcritical: small kick, sets all"),
        "preset": lambda: _choose_preset(app),
        "oil": lambda: _use_grade(app),
    }
    links = [app.query()]
    for change in changes.values():
        change()
        links.append(app.query())
    assert len({str(sorted(link.items())) for link in links}) == len(links)
    machine = [{k: v for k, v in one.items() if k not in ("kick", "revolutions")} for one in links]
    for wanted in machine[-2::-1]:
        _press(app, "Undo")
        _see_machine(app, wanted)
    expect(app.page.get_by_role("button", name="Undo", exact=True)).to_be_disabled()
    for wanted in machine[1:]:
        with app.run():
            app.page.keyboard.press("Control+Shift+Z")
        _see_machine(app, wanted)
    with app.run():
        app.page.keyboard.press("Control+Z")
    _see_machine(app, machine[-2])
    app.page.reload()
    expect(app.page.get_by_role("button", name="Redo", exact=True)).to_be_enabled()
    app.rest()
    for button, wanted in (("Redo", -1), ("Undo", -2), ("Undo", -3), ("Undo", -4)):
        _press(app, button)
        _see_machine(app, machine[wanted])
    assert "kick" not in app.query()  # as before the demonstration


def _see_machine(app: AppPage, wanted: dict[str, str]) -> None:
    # A page that computes, or is loaded again, may run for itself: not the run that is waited for.
    assert app.changes(lambda: _of_machine(app) == wanted, before=False), wanted


def _of_machine(app: AppPage) -> dict[str, str]:
    return {k: v for k, v in app.query().items() if k not in ("kick", "revolutions")}


def test_undo_units_and_sharing_stay_in_sight_and_undo_leaves_typing_alone(app: AppPage) -> None:
    app.open("Machine", C="70")
    app.page.get_by_text("Where the model holds").scroll_into_view_if_needed()
    for name in ("Undo", "Units and settings", "Share and keep"):
        expect(app.page.get_by_role("button", name=name, exact=True)).to_be_in_viewport(ratio=1)
    app.press("Radial clearance", "ArrowRight")
    before = app.query()
    field = app.page.get_by_role("textbox", name=re.compile("^Radial clearance"))
    field.focus()
    app.page.keyboard.type("9")
    with app.run():  # its own undo is the field's: what then runs is the value typed last
        app.page.keyboard.press("Control+Z")
        app.page.keyboard.type("72")
        app.page.keyboard.press("Enter")
    expect(app.page.get_by_role("button", name="Redo", exact=True)).to_be_disabled()
    assert app.query() != before


@pytest.mark.parametrize(
    ("name", "query"),
    [
        ("Stability", {"tab": "Figures of the notes", "over": "ε", "cases": "Wide~3~C~95"}),
        ("Orbits", {"tab": "Spectrum", "kick": "0.5", "cases": "Thin oil~1~T~90"}),
    ],
)
def test_a_link_reproduces_tab_choice_and_cases(
    app: AppPage, elsewhere: AppPage, name: str, query: dict[str, str]
) -> None:
    app.open(name, **query)
    assert app.query() == query
    assert app.page.locator("[role=tab][aria-selected=true]").inner_text() == query["tab"]
    app.open_popover("Share and keep")
    link = app.page.get_by_test_id("stPopoverBody").get_by_test_id("stCode").inner_text().strip()
    elsewhere.page.goto(link)
    elsewhere.rest()
    assert elsewhere.query() == query
    assert elsewhere.traces() == app.traces()
    assert elsewhere.page.locator("table.cases").inner_text() == (
        app.page.locator("table.cases").inner_text()
    )


def test_a_tab_is_kept_when_pages_change(app: AppPage) -> None:
    app.open("Equilibrium")
    app.open_tab("Forces")
    assert app.query() == {"tab": "Forces"}
    app.go("Response")
    assert app.query() == {}
    app.go("Equilibrium")
    assert app.query() == {"tab": "Forces"}
    assert app.page.locator("[role=tab][aria-selected=true]").inner_text() == "Forces"
