"""Each kind of bore, chosen and dragged in turn, kept as a case, saved, and carried on."""

import re
from pathlib import Path

from playwright.sync_api import expect

from rotorcalc import Machine
from tests.browser.app_page import AppPage
from tests.browser.test_dragging import _hold, _release
from ui.bores import BORES, NAMES
from ui.input_record import Input

# The first slider of each kind of bore that has any.
FIRST = {
    kind: sliders[0]
    for kind, inputs in BORES.items()
    if (sliders := [one for one in inputs if isinstance(one, Input)])
}
CASE = "pressure-dam"


def _choose(app: AppPage, kind: str) -> None:
    with app.run():
        app.page.get_by_role("combobox", name=re.compile("Bearing")).click()
        app.page.get_by_role("option", name=NAMES[kind], exact=True).click()


def _see_it_drawn_and_dragged(app: AppPage, kind: str, **link: str) -> None:
    """Choose a kind of bore, and drag the first of its sliders."""
    before, item = app.drawn(), FIRST[kind]
    _choose(app, kind)
    assert app.query() == {"bearing": kind} | link
    assert app.drawn() != before, kind
    numbers, drawn = app.metrics(), app.drawn()
    _hold(app, item.label, -0.12)
    assert app.metrics() != numbers, kind
    assert app.drawn() != drawn, kind
    _release(app)
    assert app.query().keys() == {"bearing", item.key, *link}


# A case doubles all that is drawn. Of the other kinds as cases: tests/app/test_bores.py.
def test_a_bore_is_kept_beside_the_plain_one_saved_and_carried_on(
    app: AppPage, tmp_path: Path
) -> None:
    app.open("Machine")
    with app.run():
        app.page.get_by_role("button", name="Keep as A").click()
    _see_it_drawn_and_dragged(app, CASE, cases="A~1")
    expect(app.page.locator("table.cases")).to_contain_text(FIRST[CASE].label)
    link = app.query()
    app.open_popover("Share and keep")
    machine = Machine.from_json(app.save("Machine (JSON)", tmp_path).read_text(encoding="utf-8"))
    app.close_popover()
    assert machine.bearing.geometry.kind == link["bearing"]
    app.go("Equilibrium")
    assert app.query() == link


def test_every_other_bore_is_chosen_and_dragged(app: AppPage) -> None:
    app.open("Machine")
    for kind in (kind for kind in FIRST if kind != CASE):
        _see_it_drawn_and_dragged(app, kind)
