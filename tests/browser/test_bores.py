"""Each kind of bore, chosen and dragged in turn, kept as a case, saved, and carried on."""

import re
from pathlib import Path

from playwright.sync_api import expect

from rotorcalc import Machine
from tests.browser.app_page import AppPage
from tests.browser.test_dragging import _hold, _release
from ui.bores import BORES, NAMES
from ui.input_record import Input


def _choose(app: AppPage, kind: str) -> None:
    with app.run():
        app.page.get_by_role("combobox", name=re.compile("Bearing")).click()
        app.page.get_by_role("option", name=NAMES[kind], exact=True).click()


def test_every_bore_is_chosen_dragged_and_kept(app: AppPage, tmp_path: Path) -> None:
    app.open("Machine")
    with app.run():
        app.page.get_by_role("button", name="Keep as A").click()
    for kind, inputs in BORES.items():
        if not (sliders := [one for one in inputs if isinstance(one, Input)]):
            continue
        before = app.drawn()
        _choose(app, kind)
        assert app.query() == {"bearing": kind, "cases": "A~1"}
        assert app.drawn() != before, kind
        numbers, drawn = app.metrics(), app.drawn()
        _hold(app, sliders[0].label, -0.12)
        assert app.metrics() != numbers, kind
        assert app.drawn() != drawn, kind
        _release(app)
        assert app.query().keys() == {"bearing", "cases", sliders[0].key}
        expect(app.page.locator("table.cases")).to_contain_text(sliders[0].label)
    link = app.query()
    app.open_popover("Share and keep")
    machine = Machine.from_json(app.save("Machine (JSON)", tmp_path).read_text(encoding="utf-8"))
    app.close_popover()
    assert machine.bearing.geometry.kind == link["bearing"]
    app.go("Equilibrium")
    assert app.query() == link
