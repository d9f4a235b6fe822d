"""What is computed of each machine of a file: the sheet at its speed, its onset, and criteria."""

import math
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field
from typing import TypeAlias

import numpy as np

from rotorcalc.analysis import analyse
from rotorcalc.arguments import checked
from rotorcalc.batch.reading import Case, Problem
from rotorcalc.coefficient_table import CoefficientTable
from rotorcalc.comparison import log_decrement
from rotorcalc.criteria import amplification, balance_quality, level_one
from rotorcalc.machine import Machine
from rotorcalc.numerics.parts import in_parts
from rotorcalc.onset import onset_speed
from rotorcalc.onset.judge import is_unstable
from rotorcalc.tables import columns
from rotorcalc.tolerances.study import tolerance
from rotorcalc.units import rpm
from rotorcalc.validity import IMBALANCE_ORBIT, Check, validity

Value: TypeAlias = float | str
# Words of the app for an assumption that is doubtful, and one that fails.
_STATES = {"caution": "strained", "outside": "outside"}
# What a film that has no answer raises.
_NO_ANSWER = (ValueError, RuntimeError)
_SHARES = (0.05, 0.5, 0.95)


@dataclass(frozen=True)
class CaseResult:
    """What was computed of one machine.

    Attributes
    ----------
    line : int
        Of its file.
    name : str
        The machine's.
    values : mapping of str to float
        In SI, the unit in the name: "onset [rad/s]".
    refusal : str
        Why something has no value; empty where all has.
    validity : str
        Which of the model's assumptions are strained or fail at the running speed, by number and
        limit; empty where all hold.
    """

    line: int
    name: str
    values: Mapping[str, float] = field(default_factory=dict[str, float])
    refusal: str = ""
    validity: str = ""


@checked
def result(case: Case) -> CaseResult:
    """Return the onset of a machine, and at its running speed the sheet and the criteria.

    Of its critical speeds their number, and the one whose margin lacks most or has least to spare.

    Parameters
    ----------
    case : Case
        The machine; without a running speed its onset alone is computed.

    Returns
    -------
    CaseResult
        Its values, as far as the film has an answer.
    """
    values: dict[str, float] = {}
    refusals: list[str] = []
    running = () if math.isnan(case.speed) else (_stability, _sheet, _criteria, _critical_speed)
    for compute in (_onset, *running):
        try:
            values |= compute(case)
        except _NO_ANSWER as error:
            refusals.append(str(error))
    told = "; ".join(dict.fromkeys(refusals))
    said = _validity(case, values.get("onset [rad/s]", math.nan))
    return CaseResult(case.line, case.name, values, told, said)


def _validity(case: Case, onset: float) -> str:
    """Return in words what lies outside the model's range, at the running speed and the onset."""
    if isinstance(case.machine.bearing, CoefficientTable):
        return "own coefficients: whether they hold for this machine is not known"
    parts: list[str] = []
    if case.machine.bearing.model == "coarse":
        parts.append("coarse mesh: K and C to some 4 %")
    try:
        if not math.isnan(case.speed):
            parts += _judged(case.machine, case.speed)
        if 0.0 < onset < math.inf:
            # The onset is that of a small motion, whatever the imbalance.
            parts += [f"at the onset {words}" for words in _judged(case.machine, onset)
                      if words.startswith("outside") and IMBALANCE_ORBIT not in words]  # fmt: skip
    except _NO_ANSWER:  # the refusal is told already
        pass
    return "; ".join(parts)


def _judged(machine: Machine, speed: float) -> list[str]:
    """Return each assumption that is strained or fails at a speed, with its number and limit."""
    return [
        f"{_STATES[one.worst]}: {one.name} = {float(one.value):.4g}, limit {_limit(one):.4g}"
        for one in validity(analyse(machine, speed)) if one.worst != "good"
    ]  # fmt: skip


def _limit(check: Check) -> float:
    return float(check.limit if check.worst == "outside" else check.caution)


def _onset(case: Case) -> dict[str, float]:
    found = onset_speed(case.machine)
    return {
        "speed [rad/s]": case.speed,
        "onset [rad/s]": found.speed,
        "onset [rpm]": found.speed / rpm,
        "onset_searched_to [rad/s]": found.searched_to,
        "whirl_frequency_at_onset [rad/s]": found.whirl_frequency,
        "margin [-]": found.speed / case.speed - 1.0,
    }


def _stability(case: Case) -> dict[str, float]:
    return {"unstable [-]": float(is_unstable(case.machine, case.speed))}


def _sheet(case: Case) -> dict[str, float]:
    sheet = columns(analyse(case.machine, case.speed), rows=1)
    return {name: float(column[0]) for name, column in sheet.items()}


def _criteria(case: Case) -> dict[str, float]:
    found = level_one(case.machine, case.speed, 0.0)
    quality = balance_quality(case.machine.rotor, speed=case.speed)
    return {
        "log_decrement [-]": log_decrement(analyse(case.machine, case.speed)),
        "forward_log_decrement [-]": float(found.forward_decrement),
        "zero_decrement_cross_coupling [N/m]": found.zero_decrement,
        "balance_quality [m/s]": float(quality),
    }


def _critical_speed(case: Case) -> dict[str, float]:
    """Return the critical speed that lacks most of its margin, or has least to spare."""
    found = amplification(case.machine, maximum_speed=case.speed)
    number = len(found.critical_speed)
    columns = (
        found.critical_speed, found.amplification_factor, found.separation_margin,
        found.required_margin,
    )  # fmt: skip
    spare = found.separation_margin - found.required_margin
    row = [float(one[spare.argmin()]) if number else math.nan for one in columns]
    names = (
        "critical_speed [rad/s]", "amplification_factor [-]", "separation_margin [-]",
        "required_margin [-]",
    )  # fmt: skip
    return {"critical_speeds [-]": float(number), **dict(zip(names, row, strict=True))}


@dataclass(frozen=True)
class Spread:
    """The tolerances of a file's machines: spreads as `tolerance` takes them, samples and seed."""

    spreads: Mapping[str, object]
    samples: int
    seed: int


def tolerance_result(
    case: Case,
    spread: Spread,
    executor: Executor | None = None,
    progress: Callable[[float], object] | None = None,
) -> CaseResult:
    """Return the onset of a machine within tolerances.

    Parameters
    ----------
    case : Case
        The machine; without a running speed there is no probability.
    spread : Spread
        Of its inputs.
    executor : concurrent.futures.Executor, optional
        Computes samples at the same time.
    progress : callable, optional
        Called with the share that is done, from above 0 to 1.

    Returns
    -------
    CaseResult
        Quantiles of the onset, the probability of being unstable, first-order indices.
    """
    speed = None if math.isnan(case.speed) else case.speed
    try:
        found = tolerance(
            case.machine, spread.spreads, spread.samples, spread.seed, executor,
            speed=speed, progress=progress,
        )  # fmt: skip
    except ValueError as error:
        return CaseResult(case.line, case.name, refusal=str(error))
    try:
        onset = onset_speed(case.machine).speed
    except _NO_ANSWER:  # the study has answers beside the nominal machine
        onset = math.nan
    known = found.onset[~np.isnan(found.onset)]
    quantiles = np.quantile(known, _SHARES, method="inverted_cdf") if known.size else [math.nan] * 3
    values = {
        f"onset_quantile_{share:g} [rad/s]": float(onset)
        for share, onset in zip(_SHARES, quantiles, strict=True)
    }
    if speed is not None:
        chance = found.probability_unstable
        values |= {
            "probability_unstable [-]": chance.value,
            "probability_low [-]": chance.low,
            "probability_high [-]": chance.high,
        }
    values["unanswered [-]"] = float(np.count_nonzero(~found.answered))
    for one in found.influences:
        values[f"influence_{one.field} [-]"] = one.index
        values[f"influence_error_{one.field} [-]"] = one.error
    return CaseResult(
        case.line, case.name, values, _in_short(found.refusals), _validity(case, onset)
    )


def _in_short(refusals: Sequence[str]) -> str:
    """Return the first of many refusals, nearly alike, and how many more there are."""
    more = f"; and {len(refusals) - 1} more" if len(refusals) > 1 else ""
    return f"{refusals[0]}{more}" if refusals else ""


@checked
def results(
    cases: Sequence[Case],
    *,
    executor: Executor | None = None,
    seconds: float = math.inf,
    progress: Callable[[float], object] | None = None,
) -> list[CaseResult]:
    """Return what is computed of the machines of a file.

    Parameters
    ----------
    cases : sequence of Case
        The machines.
    executor : concurrent.futures.Executor, optional
        Computes machines at the same time.
    seconds : float
        After this time no further machine is begun [s]; what is left says so.
    progress : callable, optional
        Called with the share that is done, from above 0 to 1.

    Returns
    -------
    list of CaseResult
        In the order of the cases.
    """
    return within(
        in_parts(result, cases, executor=executor, progress=progress), cases, seconds=seconds
    )


def within(
    each: Iterable[CaseResult], cases: Sequence[Case], *, seconds: float
) -> list[CaseResult]:
    """Return results as far as a time goes; the other cases say that they were not computed."""
    end = time.monotonic() + seconds
    found: list[CaseResult] = []
    for one in each:
        found.append(one)
        if time.monotonic() > end:
            break
    words = f"not computed: the time of {seconds:g} s was over"
    return found + [CaseResult(one.line, one.name, refusal=words) for one in cases[len(found) :]]


@checked
def table(
    results: Sequence[CaseResult], problems: Sequence[Problem] = ()
) -> dict[str, list[Value]]:
    """Return results and problems as columns, a row for each line of the file.

    Parameters
    ----------
    results : sequence of CaseResult
        What was computed.
    problems : sequence of Problem, optional
        Of lines that are no machine: rows with the reason alone.

    Returns
    -------
    dict of str to list
        "line", "name", every value with its unit, "validity" and "problem"; NaN where a row has
        no value.
        `pandas.DataFrame` takes it as it is.
    """
    wrong = [CaseResult(one.line, one.name, refusal=str(one)) for one in problems]
    rows = sorted([*results, *wrong], key=lambda row: row.line)
    names = dict.fromkeys(name for row in rows for name in row.values)
    return {
        "line": [row.line for row in rows],
        "name": [row.name for row in rows],
        **{name: [row.values.get(name, math.nan) for row in rows] for name in names},
        "validity": [row.validity for row in rows],
        "problem": [row.refusal for row in rows],
    }
