"""What the page Criteria and the report say: each criterion in words, and the verdict on all."""

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from typing import Literal

from rotorcalc.criteria import Criterion, balance_quality, grade_of_imbalance
from rotorcalc.criteria.unbalance import API_RESIDUAL
from rotorcalc.units import Units
from ui import criteria
from ui.computed import Computed
from ui.criteria import Asked
from ui.format import amount, digits, lower, minus
from ui.inputs import in_units
from ui.preview import Text

State = Literal["good", "failed", "unknown"]
WORDS: dict[State, str] = {"good": "✓ met", "failed": "✗ not met", "unknown": "? unknown"}
HEADS = ("Criterion", "Value", "Limit", "Verdict", "Source")
SOURCES = (
    "The standards' own texts were not at hand: numbers are those that public programs and papers "
    "state, above all Petrobras' open program ROSS, which cites API 684 by its paragraphs. Check "
    "them against your own copy before you hand anything in."
)
LEFT_OUT = (
    "Left out, as no public text states their numbers whole: the residual unbalance that API "
    "allows at high speeds; the chart of the critical speed ratio over the gas density, which "
    "between Q₀/Qₐ = 2 and 10 asks for a second level of analysis; where unbalances are placed "
    "for each mode, as here all of it sits at the disk; the zones of vibration of ISO 20816."
)
RULES = (
    "**Separation margin.** A critical speed $N_c$ is a peak of the disk's response, and "
    "$AF = N_c/(N_2 - N_1)$, between the speeds at which the response is 0.707 of the peak. Below "
    "AF = 2.5 no margin is required; else 17 % (1 − 1/(AF − 1.5)) of the minimum speed, at most "
    "16 %, where $N_c$ lies below it, and 10 % more of the maximum speed, at most 26 %, above."
)
FORMULA = (
    r"q_A = \frac{B\,P}{\Omega\,D\,H}\,\frac{\rho_2}{\rho_1},\qquad Q_A = \sum q_A,\qquad "
    r"B = 3\ \text{(impeller)},\ 1.5\ \text{(blades)}"
)
STABLE = (
    "A stiffness $Q$ at midspan stands for all that drives the disk forward. At $Q_A$ the first "
    "forward mode (the least damped, if several) must have δ ≥ 0.1, and $Q_0$, where δ vanishes, "
    "must be at least 2 $Q_A$. A backward mode, which $Q$ damps, is not judged, and drawn only "
    "where it is damped less; a machine that it makes unstable fails. API 617, level I."
)
CAMPBELL = (
    "Solid: forward modes, broken: backward ones. A mode on the line ω = Ω is driven by the "
    "imbalance, one near ω = Ω/2 by the film."
)


@dataclass(frozen=True)
class Row:
    """A criterion as it is read, in a visitor's units."""

    name: str
    value: str
    limit: str
    state: State
    source: str
    remark: str


def rows(computed: Computed, asked: Asked, units: Units) -> list[Row]:
    """Return the criteria as they are read; raises ValueError where the film has no answer."""
    return [_row(one, units) for one in criteria.judged(computed, asked)]


def _row(one: Criterion, units: Units) -> Row:
    bound = "at most" if one.at_most else "at least"
    known = not math.isnan(one.limit)
    return Row(
        name=_name(one, units),
        value=_number(one.value, one, units),
        limit=f"{bound} {_number(one.limit, one, units)}" if known else "–",
        state=_state(one),
        source=one.source,
        remark=" ".join(part for part in (one.unjudged, one.remark) if part),
    )


def _name(one: Criterion, units: Units) -> str:
    where = (
        "" if one.speed is None else f" of the critical speed at {amount(units.speed, one.speed)}"
    )
    return f"{one.name}{where}"


def _number(value: float, one: Criterion, units: Units) -> str:
    if math.isnan(value):
        return "–"
    if math.isinf(value):
        return "no limit"
    unit = getattr(units, one.kind)
    if unit.name == "-":
        return minus(digits(value))
    return amount(unit, value)


def _state(one: Criterion) -> State:
    return {True: "good", False: "failed", None: "unknown"}[one.passed]  # type: ignore[return-value]


def verdict(computed: Computed, asked: Asked, units: Units) -> Text:
    """Return how many criteria are met, which are not, and which are unknown."""
    try:
        found = rows(computed, asked, units)
        speeds = _speeds(computed, asked, units)
    except ValueError as error:
        return Text(
            f":orange-badge[? Not judged] {in_units(f'{error}', units)}.".replace("..", ".")
        )
    return Text(f"{_badge(found)} {speeds}{_lists(found)}")


def sentence(found: Sequence[Row]) -> str:
    """Return the verdict in plain words, as the report has it."""
    return f"{_count(found)}{_lists(found)}"


def _count(found: Sequence[Row]) -> str:
    failed, unknown = (_of(found, state) for state in ("failed", "unknown"))
    if failed:
        return f"Not met: {len(failed)} of {len(found)}"
    if unknown:
        return f"Met: {len(found) - len(unknown)} of {len(found)}"
    return f"All {len(found)} criteria are met"


def _badge(found: Sequence[Row]) -> str:
    failed, unknown = (_of(found, state) for state in ("failed", "unknown"))
    colour, sign = ("red", "✗") if failed else ("orange", "?") if unknown else ("green", "✓")
    return f":{colour}-badge[{sign} {_count(found)}]"


def _lists(found: Sequence[Row]) -> str:
    """Return which criteria are not met, with value and limit, and which are unknown."""
    failed, unknown = (_of(found, state) for state in ("failed", "unknown"))
    bad = "; ".join(f"{_begun(row.name)}, {row.value}, must be {row.limit}" for row in failed)
    open_ = ", ".join(_begun(row.name) for row in unknown)
    return tidy((f": {bad}." if bad else ".") + (f" Unknown: {open_}." if open_ else ""))


def _begun(name: str) -> str:
    """Return a name for the middle of a sentence; that of a symbol keeps its capital."""
    return name if name[1:2] == "_" else lower(name)


def _of(found: Sequence[Row], state: State) -> list[Row]:
    return [row for row in found if row.state == state]


def _speeds(computed: Computed, asked: Asked, units: Units) -> str:
    low, high = asked.operation(computed)
    if low == high:
        return f"At {amount(units.speed, high)}"
    return f"From {digits(float(units.speed.of(low)))} to {amount(units.speed, high)}"


def tidy(text: str) -> str:
    """Return a text with the names of cross-coupling typeset by letters of their own."""
    return text.replace("Q_A", "Qₐ").replace("Q_0", "Q₀")


def table(computed: Computed, asked: Asked, units: Units) -> Text | None:
    """Return the criteria as a table, HTML; nothing where the film has no answer."""
    try:
        found = rows(computed, asked, units)
    except ValueError:  # which the verdict says
        return None
    head = "".join(f"<th scope=col>{one}</th>" for one in HEADS)
    body = "".join(_html(row) for row in found)
    parts = f"<thead><tr>{head}</tr></thead><tbody>{body}</tbody>"
    return Text(f"<table class=criteria>{parts}</table>", "html")


def _html(row: Row) -> str:
    remark = f"<small>{_typeset(row.remark)}</small>" if row.remark else ""
    cells = (row.value, row.limit, WORDS[row.state], row.source)
    styles = ("n", "n", row.state, "source")
    rest = "".join(
        f'<td class={style} data-head="{head}">{_typeset(cell)}</td>'
        for style, head, cell in zip(styles, HEADS[1:], cells, strict=True)
    )
    return f"<tr><th scope=row>{_typeset(row.name)}{remark}</th>{rest}</tr>"


def _typeset(text: str) -> str:
    return re.sub(r"\b([A-Z])_(\w)", r"<i>\1</i><sub>\2</sub>", escape(text))


def imbalance(computed: Computed, asked: Asked, units: Units) -> Text:
    """Return the imbalance's own grade, and what the button changes."""
    rotor = computed.machine.rotor
    try:
        _, speed = asked.operation(computed)
        wanted = criteria.graded_imbalance(computed, asked)
    except ValueError:  # which the verdict says
        return Text("", "caption")
    now = amount(units.film, rotor.imbalance)
    quality = 1e3 * float(balance_quality(rotor, speed=speed))
    grade = grade_of_imbalance(rotor, speed=speed)
    met = "beyond G 40" if grade is None else f"within {grade}"
    permits = amount(units.film, wanted)
    return Text(
        f"Imbalance u = {now}, {met}: the mass centre goes round at eΩ = "
        f"{digits(float(f'{quality:.3g}'))} mm/s. At {amount(units.speed, speed)} "
        f"{_grade(asked)} permits u = {permits}: the button sets the machine's imbalance to it, "
        "Undo takes it back.",
        "caption",
    )


def _grade(asked: Asked) -> str:
    return "4W/N (API)" if asked.grade == API_RESIDUAL else f"{asked.grade} (ISO 21940-11)"


def coupling(computed: Computed, asked: Asked, units: Units) -> Text:
    """Return the anticipated cross-coupling, and of how many stages."""
    try:
        Q_A = asked.cross_coupling(computed)
        _, speed = asked.operation(computed)
    except ValueError:
        return Text("", "caption")
    if Q_A is None:
        return Text("Without all four numbers of a stage there is no $Q_A$.", "caption")
    number = len(asked.stages)
    whose = f"{number} stage{'s' if number > 1 else ''}"
    return Text(
        f"$Q_A$ = **{amount(units.stiffness, Q_A)}** of {whose} at {amount(units.speed, speed)}. "
        f"${FORMULA}$",
        "caption",
    )


def inputs(computed: Computed, asked: Asked, units: Units) -> str:
    """Return what was asked, in a sentence for the report."""
    Q_A = asked.cross_coupling(computed)
    known = "not known" if Q_A is None else amount(units.stiffness, Q_A)
    stages = "".join(
        f" Stage {i}: {amount(units.power, one.power)}, D {amount(units.length, one.diameter)}, "
        f"H {amount(units.length, one.width)}, ρ₂/ρ₁ {digits(one.ratio)}, B {one.factor:g}."
        for i, one in enumerate(asked.stages, start=1)
    )
    return (
        f"{_speeds(computed, asked, units)}. Anticipated cross-coupling Qₐ: {known}.{stages} "
        f"Imbalance against {_grade(asked)}."
    )


def of_critical_speeds(computed: Computed, asked: Asked, units: Units) -> str:
    """Return the caption of the critical speeds' chart."""
    shown = criteria.critical(computed, asked)
    beyond = shown.found.critical_speed[shown.found.critical_speed > shown.speed[-1]]
    speeds = " and ".join(amount(units.speed, one) for one in beyond)
    above = f" Beyond the chart's top speed: {speeds}." if beyond.size else ""
    none = "" if shown.found.critical_speed.size else " The response has no peak."
    balanced = (
        " The rotor is balanced: amplitudes are over its imbalance." if shown.is_balanced else ""
    )
    return (
        "Green: speeds of operation. Grey: the largest margin required beside them; no critical "
        f"speed may lie there.{none}{above}{balanced} Eq. 5.38; API 684, SP6.8.2."
    )
