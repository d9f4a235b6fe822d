"""The report: one HTML file with a machine's inputs, results and charts, that prints well.

It needs nothing but itself: Plotly's own bundle, as the wheel brings it, is in the file.
"""

import datetime as dt
import functools
import importlib.resources
import math
import re
import string
from collections.abc import Iterable, Iterator, Mapping, Sequence
from html import escape
from pathlib import Path
from types import MappingProxyType
from typing import TypeAlias

import numpy as np
import plotly.io

from rotorcalc import __version__, modes
from rotorcalc.arrays import Array
from rotorcalc.units import Unit, Units
from rotorcalc.validity import validity
from ui import comparison, criteria
from ui.bearing import fields_of, film_name
from ui.bores import KIND, Values, name_of
from ui.cases import Shown
from ui.computed import Computed
from ui.criteria import Asked
from ui.format import amount, digits, minus, without_noise
from ui.inputs import GROUPS, INPUTS, applies, in_units, law_of, values_of
from ui.results.table import RESULTS
from ui.sharing import report_charts
from ui.sharing.labels import Labels
from ui.sharing.report_charts import Figure
from ui.words import citation, recesses
from ui.words import criteria as criteria_words
from ui.words import validity as validity_words
from ui.words.verdict import beside, verdict

# Speeds in the table of coefficients.
_ROWS = 20
# Results that only an oil's film has.
_OF_OIL = ("viscosity", "film_temperature")
_COEFFICIENT = re.compile(r"\b([KC])_([XY]{2})\b")
# Text, and the class of its cell.
Cell: TypeAlias = tuple[str, str]


def report(  # noqa: PLR0913, PLR0917 - a machine, what stands beside it, and how it is shown
    computed: Computed, cases: Sequence[Shown], units: Units, link: str, labels: Labels,
    chosen: Mapping[str, object] = MappingProxyType({}),
) -> bytes:  # fmt: skip
    """Return the report as HTML.

    `link` reproduces the machine, cases stand beside it, and what its criteria ask is `chosen`.
    """
    judged = verdict(computed, units)
    asked, problem = _asked(computed, chosen)
    charts = report_charts.charts(computed, cases, units, asked)
    told = {report_charts.CRITERIA: _criteria(computed, asked, problem, units)}
    page = string.Template(Path(__file__).with_suffix(".html").read_text(encoding="utf-8"))
    body = (
        _inputs(computed, units),
        _results(computed, units),
        _recesses(computed, units),
        _compared(computed, cases, units),
        _matrices(computed, units),
        _over_speed(computed, units),
        _modes(computed, units),
        _validity(computed, units),
        _reading(computed, cases),
        *(
            _section(
                title,
                _rows(computed, figures, charts),
                told.get(title, ""),
                report_charts.left_out(computed, title, asked),
            )
            for title, figures in report_charts.sections(computed, asked).items()
        ),
    )
    return page.substitute(
        title=escape(labels.title or "Rotor on two journal bearings"),
        labels=_labels(labels),
        subtitle=escape(_subtitle(computed, cases, units)),
        level=judged.level,
        verdict=escape(judged.sentence),
        validity=validity_words.level(computed),
        beside=escape(beside(computed)),
        body="\n".join(body),
        version=escape(__version__),
        date=dt.datetime.now(dt.UTC).date().isoformat(),
        link=_anchor(link),
        film=escape(_film(computed)),
        plotly=_plotly(),
        charts=_script(charts),
    ).encode()


def _film(computed: Computed) -> str:
    """Return what the film's model takes for granted; of own coefficients nothing is known."""
    more = "" if computed.has_own else "; laminar, of one viscosity, aligned"
    return f"{citation.film(computed)}{more}"


@functools.cache
def _plotly() -> str:
    return (importlib.resources.files("plotly") / "package_data/plotly.min.js").read_text("utf-8")


def _script(charts: report_charts.Charts) -> str:
    """Return charts as JSON; Plotly writes it so that it cannot end the script it stands in."""
    members = (
        f'"{key}":{plotly.io.to_json(chart, validate=False)}' for key, chart in charts.items()
    )
    return f"{{{','.join(members)}}}"


def _anchor(link: str) -> str:
    text = escape(link)
    return f'<a href="{text}">{text}</a>' if link.startswith(("http://", "https://")) else text


def _subtitle(computed: Computed, cases: Sequence[Shown], units: Units) -> str:
    speed, bearing = units.speed, computed.machine.bearing
    size = " × ".join(digits(float(units.length.of(x))) for x in (bearing.diameter, bearing.length))
    rotor = amount(units.mass, computed.machine.rotor.mass)
    names = ", ".join(shown.case.name for shown in cases)
    beside = f" It is compared with the cases {names}." if names else ""
    on = "bearings with own coefficients" if computed.has_own else (
        f"bearings of {size} {units.length.name}"
    )  # fmt: skip
    return (
        f"A rotor of {rotor} on {on}, at "
        f"{amount(speed, computed.speed)}; charts run to {amount(speed, computed.top_speed)}."
        f"{beside}"
    )


def _inputs(computed: Computed, units: Units) -> str:
    live = values_of(computed.machine, computed.speed, computed.top_speed)
    rows: list[str] = []
    for group in GROUPS:
        if group == "Oil" and computed.has_own:  # which nothing depends on
            continue
        rows.append(f'<tr class="group"><th colspan="4">{escape(group)}</th></tr>')
        rows += (
            _input(key, live, units, computed)
            for key, item in INPUTS.items()
            if item.group == group and applies(key, live)
        )
        if group == "Oil":
            rows.append(
                _row(
                    [
                        ("Viscosity law", ""),
                        ("", ""),
                        (law_of(live), "n"),
                        ("", ""),
                    ]
                )
            )
        if group == "Bearing":
            rows += _bearing(live, units)
    head = _head("Input", "Symbol", ("Value", "n"), "Unit")
    return f"<h2>Inputs</h2>{_table(head, rows)}"


def _bearing(live: Values, units: Units) -> Iterator[str]:
    """Yield rows of the kind of the bearing, its film model, and the fields of its bore."""
    rows = [
        ("Kind of bearing", name_of(live[KIND]), "-"),
        ("Film model", film_name(live), "-"),
        *(
            (field.label, field.shown(live.get(field.key), units), field.unit(units).name)
            for field in fields_of(live[KIND]).values()
        ),
    ]
    for label, text, unit in rows:
        yield _row([(label, ""), ("", ""), (minus(text), "n"), (unit.removeprefix("-"), "")])


def _input(key: str, live: Values, units: Units, computed: Computed) -> str:
    item, value, follows = INPUTS[key], live[key], ""
    if key == "load" and value is None:
        value, follows = computed.machine.static_load, ", half the weight"
    known = isinstance(value, float | int) and math.isfinite(value)
    unit = item.unit(units).name + follows if known else ""
    text = comparison.shown(key, live | {key: value}, units)
    return _row([(item.label, ""), (item.symbol, ""), (text, "n"), (unit, "")])


def _results(computed: Computed, units: Units) -> str:
    rows = (
        _row([
            (result.label, ""),
            (minus(result.shown(computed, units)), "n"),
            (result.cited(computed), ""),
        ])
        for result in RESULTS.values() if result.belongs(computed)
        and not (computed.has_own
                 and (result.key in _OF_OIL or math.isnan(result.value(computed))))
    )  # fmt: skip
    head = _head("Result", ("Value", "n"), "Equation")
    return f"<h2>Results at the running speed</h2>{_table(head, rows)}"


def _recesses(computed: Computed, units: Units) -> str:
    """Return pressures, flows and powers of a bearing with recesses."""
    if not computed.has_recesses:
        return ""
    first, *numbers = recesses.head(units)
    each = _table(
        _head(first, *((one, "n") for one in numbers)),
        (_row([(row[0], ""), *((text, "n") for text in row[1:])])
         for row in recesses.each(computed, units)),
    )  # fmt: skip
    supply = [("Supply pressure", amount(units.pressure, recesses.supply(computed)))]
    rows = (*supply, *recesses.totals(computed, units), *recesses.rest(computed, units))
    whole = _table(
        _head("One bearing", ("Value", "n")), (_row([(a, ""), (b, "n")]) for a, b in rows)
    )
    return f'<h2>Recesses at the running speed</h2><div class="beside">{each}{whole}</div>'


def _compared(computed: Computed, cases: Sequence[Shown], units: Units) -> str:
    return f"<h2>Cases</h2>{comparison.table(computed, cases, units)}" if cases else ""


def _matrices(computed: Computed, units: Units) -> str:
    K, C = map(without_noise, (computed.point.stiffness, computed.point.damping))
    return (
        "<h2>Force coefficients at the running speed</h2>"
        f'<div class="beside">{_matrix("Stiffness K", K, units.stiffness)}'
        f"{_matrix('Damping C', C, units.damping)}</div>"
    )


def _labels(labels: Labels) -> str:
    """Return name, author and remarks as paragraphs, as far as they were given."""
    given = (("Case", labels.name), ("Author", labels.author), ("Remarks", labels.note))
    return "".join(
        f'<p class="label"><b>{word}:</b> {escape(text)}</p>' for word, text in given if text
    )


def _over_speed(computed: Computed, units: Units) -> str:
    """Return K and C over the sweep, at some of its speeds."""
    sweep = computed.sweep
    every = max(1, len(sweep.speed) // _ROWS)
    parts = [(f"{letter}_{ij}", unit, matrix[:, "XY".index(ij[0]), "XY".index(ij[1])])
             for letter, unit, matrix in (("K", units.stiffness, sweep.stiffness),
                                          ("C", units.damping, sweep.damping))
             for matrix in (without_noise(matrix),)
             for ij in ("XX", "XY", "YX", "YY")]  # fmt: skip
    columns = [units.speed.of(sweep.speed), *(unit.of(values) for _, unit, values in parts)]
    rows = (
        _row((minus(digits(float(value))), "n") for value in row)
        for row in np.stack(columns, axis=-1)[every - 1 :: every]
    )
    head = _head(
        (f"Ω [{units.speed.name}]", "n"),
        *((f"{name} [{unit.name}]", "n") for name, unit, _ in parts),
    )
    return f'<h2>Force coefficients over speed</h2><div class="cases">{_table(head, rows)}</div>'


def _matrix(name: str, matrix: Array, unit: Unit) -> str:
    shown = unit.of(matrix)
    rows = (
        _row([(f"on {axis}", ""), *((minus(digits(float(value))), "n") for value in row)])
        for axis, row in zip("XY", shown, strict=True)
    )
    head = _head(f"{name} [{unit.name}], force", ("by X", "n"), ("by Y", "n"))
    return _table(head, rows)


def _modes(computed: Computed, units: Units) -> str:
    locus = computed.locus(True)
    rows = (
        _mode(locus.name(i).removeprefix("mode "), complex(value), computed.speed, units)
        for i, value in enumerate(locus.here.eigenvalues)
        if value.imag >= 0.0  # else the mirror image of another
    )
    head = _head(
        "Mode", (f"Mode frequency [{units.speed.name}]", "n"), ("× speed", "n"),
        (f"Growth rate Re λ [{units.growth.name}]", "n"), ("Damping ratio ζ", "n"),
        ("Log. decrement δ", "n"),
    )  # fmt: skip
    table = f'<div class="modes">{_table(head, rows)}</div>'
    return f"<h2>Modes at the running speed</h2>{table}"


def _mode(name: str, value: complex, speed: float, units: Units) -> str:
    growth = digits(float(units.growth.of(value.real)))
    if value.imag == 0.0:
        texts = ["does not oscillate", "", growth, "", ""]
    else:
        texts = [
            digits(float(units.speed.of(value.imag))),
            f"{value.imag / speed:.3f}",
            growth,
            f"{float(modes.damping_ratio(value)):.4f}",
            f"{float(modes.logarithmic_decrement(value)):.3f}",
        ]
    return _row([(name, ""), *((minus(text), "n") for text in texts)])


def _validity(computed: Computed, units: Units) -> str:
    if computed.has_own:
        words = escape(validity_words.panel(computed, units).words)
        return f"<h2>Where the model holds</h2><p>{words}</p>"
    rows = (
        _row([
            (check.name, ""),
            *((validity_words.number(n), "n") for n in (check.value, check.caution, check.limit)),
            (validity_words.WORDS[check.worst], check.worst),
            ("" if check.worst == "good" else f"{check.reason}.", ""),
        ])
        for check in (validity_words.read(check, units) for check in validity(computed.point))
    )  # fmt: skip
    limits = ("Strained at", "n"), ("Fails at", "n")
    head = _head("Assumption", ("Here", "n"), *limits, "Model", "Reason")
    return f"<h2>Where the model holds</h2>{_table(head, rows)}"


def _reading(computed: Computed, cases: Sequence[Shown]) -> str:
    """Return how to read the charts."""
    lines = ["On every chart the yellow point is the running speed"]
    if cases:
        lines.append(", thin lines and rings are cases, in the colours of the legend")
    lines.append(".")
    if computed.machine.rotor.imbalance == 0.0:
        lines.append(" The rotor is balanced, so there is no response to show.")
    elif not computed.is_stable:
        lines.append(" Unstable at that speed, the machine has no steady response there.")
    return f'<p class="reading">{"".join(lines)}</p>'


def _section(title: str, drawn: str, told: str, left_out: Iterable[str]) -> str:
    """Return a section: what is told before its charts, the charts, and which are left out."""
    missing = (f"<p>{escape(words)}</p>" for words in left_out)
    return f"<h2>{escape(title)}</h2>{told}{drawn}{''.join(missing)}"


def _rows(computed: Computed, figures: Iterable[Figure], charts: report_charts.Charts) -> str:
    rows = (
        "".join(_figure(computed, figure, charts[figure.key]) for figure in row)
        for row in _paired(figures)
    )
    return "".join(f'<div class="charts">{row}</div>' for row in rows)


def _asked(computed: Computed, chosen: Mapping[str, object]) -> tuple[Asked, str]:
    """Return what a visitor asked, or, with the reason, what is asked where that is no use."""
    try:
        asked = criteria.asked_of(chosen)
        asked.operation(computed)
    except ValueError as error:
        return Asked(), f"{error}; instead, for the running speed alone"
    return asked, ""


def _criteria(computed: Computed, asked: Asked, problem: str, units: Units) -> str:
    """Return what was asked, the verdict, the table of criteria, and where they are from."""
    begin = f"<p>{escape(in_units(problem, units))}:</p>" if problem else ""
    try:
        found = criteria_words.rows(computed, asked, units)
        said = criteria_words.inputs(computed, asked, units)
    except ValueError as error:
        return f"{begin}<p>Not judged: {escape(in_units(str(error), units))}.</p>"
    styles = {"good": "good", "failed": "failed", "unknown": "caution"}
    rows = (
        _row([
            (criteria_words.tidy(row.name), ""), (row.value, "n"), (row.limit, "n"),
            (criteria_words.WORDS[row.state], styles[row.state]),
            (criteria_words.tidy(" ".join(filter(None, (row.remark, f"{row.source}.")))), ""),
        ])
        for row in found
    )  # fmt: skip
    head = _head("Criterion", ("Value", "n"), ("Limit", "n"), "Verdict", "Remark and source")
    count, _, rest = criteria_words.sentence(found).partition(":")
    told = f"<p>{escape(said)}</p><p><b>{escape(count)}</b>{escape(f':{rest}' if rest else '')}</p>"
    notes = (criteria_words.SOURCES, criteria_words.LEFT_OUT)
    return f"{begin}{told}{_table(head, rows)}" + "".join(f"<p>{escape(one)}</p>" for one in notes)


def _paired(figures: Iterable[Figure]) -> Iterator[list[Figure]]:
    """Yield the charts of each row: one, or two that share the page's width."""
    row: list[Figure] = []
    for figure in figures:
        if row and sum(other.width for other in row) + figure.width > report_charts.FULL:
            yield row
            row = []
        row.append(figure)
    yield row


def _figure(computed: Computed, figure: Figure, chart: report_charts.Chart) -> str:
    width, height = (chart["layout"][key] for key in ("width", "height"))
    return (
        f'<figure style="width:{width}px"><div class="plot" id="{figure.key}" '
        f'style="width:{width}px;height:{height}px"></div>'
        f"<figcaption><b>{escape(figure.title)}.</b> {escape(figure.words(computed))}</figcaption>"
        "</figure>"
    )


def _head(*cells: str | Cell) -> str:
    pairs = (cell if isinstance(cell, tuple) else (cell, "") for cell in cells)
    return _row(pairs, tag="th")


def _table(head: str, rows: Iterable[str]) -> str:
    return f"<table><thead>{head}</thead><tbody>{''.join(rows)}</tbody></table>"


def _row(cells: Iterable[Cell], style: str = "", *, tag: str = "td") -> str:
    drawn = "".join(f"<{tag}{_class(style)}>{_typeset(text)}</{tag}>" for text, style in cells)
    return f"<tr{_class(style)}>{drawn}</tr>"


def _typeset(text: str) -> str:
    """Return a text as HTML, in which K_XX has an index."""
    return _COEFFICIENT.sub(r"<i>\1<sub>\2</sub></i>", escape(text))


def _class(style: str) -> str:
    return f' class="{style}"' if style else ""
