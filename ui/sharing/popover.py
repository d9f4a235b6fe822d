"""Share and keep: link, machine file, tables and report, each built when asked for."""

from collections.abc import Sequence
from contextlib import suppress
from urllib.parse import urlencode, urlsplit, urlunsplit

import streamlit as st

from ui import cases
from ui.cases import Shown
from ui.choices import choices
from ui.computed import Computed, computed_from
from ui.format import literal
from ui.serving.downloads import offer
from ui.session import Session, session
from ui.sharing import labels, machine_file
from ui.sharing.labels import Labels


def draw() -> None:
    """Draw the popover with all that leaves or enters the program."""
    popover = st.popover("Share and keep", width="stretch", key="share", on_change="rerun")
    if not popover.open:
        return
    with popover:
        address = _link()
        st.caption("A link to this machine")
        st.code(address, language=None, wrap_lines=True)
        visitor = session()
        with suppress(ValueError):  # no machine: said on the page
            beside, _ = cases.computed(visitor.cases)
            written = labels.draw()
            _downloads(computed_from(visitor.values), beside, visitor, address, written)
        st.file_uploader("Load a machine (JSON)", type="json", key="upload", on_change=_load)


def _link() -> str:
    parts = urlsplit(st.context.url or "")
    query = urlencode(session().link())
    return urlunsplit((parts.scheme, parts.netloc, parts.path, query, ""))


def _downloads(
    computed: Computed, beside: Sequence[Shown], visitor: Session, address: str, written: Labels
) -> None:
    from ui.sharing import export, report  # noqa: PLC0415

    # No file may read the session: it is made outside.
    units, chosen = visitor.units, dict(choices().kept())
    files = (
        (
            "Machine (JSON)", "machine.json", "application/json",
            lambda: machine_file.write(computed.machine, visitor, written, chosen),
        ),
        (
            "Sweep over speed (CSV)", "sweep.csv", "text/csv",
            lambda: export.sweep_csv(computed, units),
        ),
        (
            "K and C for ROSS (Excel)", export.ROSS_NAME, export.ROSS_MIME,
            lambda: export.ross_table(computed),
        ),
        (
            "Rotor for ROSS (TOML)", export.ROTOR_NAME, "application/toml",
            lambda: export.ross_file(computed),
        ),
        (
            "K and C over speed (CSV)", "coefficients.csv", "text/csv",
            lambda: export.coefficients_csv(computed),
        ),
        (
            "Report (HTML)", "report.html", "text/html",
            lambda: report.report(computed, beside, units, address, written, chosen),
        ),
    )  # fmt: skip
    for label, name, mime, build in files:
        offer(label, build, name, mime, key=f"save_{name}", width="stretch")
    st.caption(export.ROSS_NOTE)


def _load() -> None:
    """Take over an uploaded machine; what cannot be used is reported by name."""
    visitor = session()
    upload = st.session_state["upload"]
    if upload is None:
        return
    try:
        loaded = machine_file.read(upload.getvalue().decode("utf-8"), visitor)
    except ValueError as error:
        visitor.problems[:] = [f"{literal(upload.name, 80)} was not loaded: {literal(str(error))}"]
        return
    link = loaded.link
    visitor.preset, visitor.values, visitor.units_name = link.preset, link.values, link.units
    visitor.amplitude = link.amplitude
    if loaded.has_cases:
        visitor.cases = link.cases
    choices().restore(loaded.criteria)
    labels.name(loaded.name, loaded.note)
    visitor.problems.clear()
    visitor.refused[:] = loaded.problems
