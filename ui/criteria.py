"""What a machine's criteria ask besides the machine, and their results, each kept once computed.

A visitor gives the speeds of operation, the anticipated cross-coupling and a grade of balancing.
They are choices (`ui.choices`), in a link and a file as words in SI as engineers write it.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from rotorcalc import Machine
from rotorcalc.criteria import (
    Amplification,
    Campbell,
    Criterion,
    LevelOne,
    amplification,
    anticipated_cross_coupling,
    campbell,
    checks,
    imbalance_of_grade,
    level_one,
)
from rotorcalc.criteria.level_one import AXIAL, CENTRIFUGAL
from rotorcalc.criteria.unbalance import API_RESIDUAL, GRADES
from rotorcalc.figures.criteria import CriticalSpeeds, Stability
from rotorcalc.films import film_of
from rotorcalc.units import SI
from ui.computed import Computed
from ui.format import typed_number
from ui.input_record import Input

SLOWEST, FASTEST, COUPLING, GIVEN, STAGES, GRADE = (
    f"criteria_{name}" for name in ("slowest", "fastest", "coupling", "qa", "stages", "grade")
)
KEYS = (SLOWEST, FASTEST, COUPLING, GIVEN, STAGES, GRADE)
# Where the anticipated cross-coupling comes from, by the word of a link.
COUPLINGS = {"none": "not known", "given": "given", "stages": "of stages"}
MOST_STAGES = 12
NO_STAGE = "____c"

FIELDS: dict[str, Input] = {
    SLOWEST: Input(
        "slowest", "minimum_speed", "Minimum speed", "", "speed", 1, 400_000, "",
        "Lowest speed of continuous operation. Empty: operation at one speed, the maximum.",
        follows="the maximum",
    ),
    FASTEST: Input(
        "fastest", "maximum_speed", "Maximum speed", "", "speed", 1, 400_000, "",
        "Highest speed of continuous operation. Empty: the running speed, which it then follows.",
        follows="running speed",
    ),
    GIVEN: Input(
        "qa", "cross_coupling", "Value of Qₐ", "", "stiffness", 0, 1e6, "",
        "Cross-coupled stiffness of the whole machine, all stages together.",
    ),
}  # fmt: skip
# The numbers of a stage, in the order of their words.
STAGE: tuple[Input, ...] = (
    Input("power", "", "Power", "P", "power", 0, 1e6, "", "Of this stage alone."),
    Input("diameter", "", "Diameter", "D", "length", 1, 1e5, "",
          "Outer diameter of the impeller, or mean diameter of the blades."),
    Input("width", "", "Width", "H", "length", 0.1, 1e4, "",
          "The smaller of the widths of impeller outlet and diffuser, or the blades' height."),
    Input("ratio", "", "Density ratio", "ρ₂/ρ₁", "number", 0.1, 1e3, "",
          "Density of the gas at discharge over suction; 1 for a row of blades."),
)  # fmt: skip
KINDS = {"c": "impeller, B = 3", "a": "blades, B = 1.5"}
_FACTORS = {"c": CENTRIFUGAL, "a": AXIAL}
# Places of Q on the chart; its end over Q_0 and over Q_A.
_PLACES, _OVER_Q_0, _OVER_Q_A = 80, 1.3, 2.2
# Of the sweep's speeds every fifth, where a slider is held.
_WHILE_DRAGGING = 5


@dataclass(frozen=True)
class Stage:
    """An impeller or a row of blades, in SI, with the factor B."""

    power: float
    diameter: float
    width: float
    ratio: float
    factor: float

    def cross_coupling(self, speed: float) -> float:
        """Return q_A [N/m]; a stage without power has none."""
        if self.power == 0.0:
            return 0.0
        return float(anticipated_cross_coupling(
            self.power, speed=speed, diameter=self.diameter, width=self.width,
            density_ratio=self.ratio, factor=self.factor,
        ))  # fmt: skip


@dataclass(frozen=True)
class Asked:
    """What is asked of a machine; speeds [rad/s] and Q_A [N/m] are None where not given."""

    slowest: float | None = None
    fastest: float | None = None
    given: float | None = None
    stages: tuple[Stage, ...] = ()
    grade: str = API_RESIDUAL

    def operation(self, computed: Computed) -> tuple[float, float]:
        """Return minimum and maximum continuous speed of a machine [rad/s].

        Raises ValueError where the first is above the second.
        """
        high = computed.speed if self.fastest is None else self.fastest
        low = high if self.slowest is None else self.slowest
        if low > high:
            raise ValueError(
                f"Minimum speed = {low:.9g} rad/s: must be at most the maximum speed, "
                f"{high:.9g} rad/s"
            )
        return low, high

    def cross_coupling(self, computed: Computed) -> float | None:
        """Return the anticipated cross-coupling of the whole machine, Q_A [N/m]."""
        if self.stages:
            _, speed = self.operation(computed)
            return sum(stage.cross_coupling(speed) for stage in self.stages)
        return self.given


NOTHING = Asked()


def asked_of(chosen: Mapping[str, object]) -> Asked:
    """Return what is asked by a visitor's choices; raises ValueError where one cannot be used."""
    source = chosen.get(COUPLING, "none")
    return Asked(
        slowest=value_of(FIELDS[SLOWEST], chosen.get(SLOWEST, "")),
        fastest=value_of(FIELDS[FASTEST], chosen.get(FASTEST, "")),
        given=value_of(FIELDS[GIVEN], chosen.get(GIVEN, "")) if source == "given" else None,
        stages=_stages(str(chosen.get(STAGES, NO_STAGE))) if source == "stages" else (),
        grade=grade if (grade := str(chosen.get(GRADE, API_RESIDUAL))) in GRADES else API_RESIDUAL,
    )


def is_known(key: str, word: str) -> bool:
    """Return whether a file's word is one of a choice of this page; numbers are checked there."""
    options = {COUPLING: COUPLINGS, GRADE: GRADES}.get(key)
    return key in KEYS and (options is None or word in options)


def value_of(item: Input, word: object) -> float | None:
    """Return a word's value in SI, None for an empty one; raises ValueError."""
    if word == "":
        return None
    try:
        kept = typed_number(word)
    except ValueError as error:
        raise ValueError(f"{item.label}: {error}") from None
    if problem := item.problem(kept):
        raise ValueError(f"{item.label} = {word} {item.unit(SI).name} {problem}")
    return item.unit(SI).to_si(kept)


def words_of_stages(text: str) -> list[list[str]]:
    """Return the words of each stage, five each, the last one its kind."""
    number = len(STAGE)
    found: list[list[str]] = []
    for stage in text.split("~")[:MOST_STAGES]:
        *words, kind = [*stage.split("_"), ""][: number + 1] if stage else [""]
        padded = [*words, *[""] * number][:number]
        found.append([*padded, kind if kind in KINDS else "c"])
    return found


def text_of_stages(stages: list[list[str]]) -> str:
    """Return stages as one text, which `words_of_stages` reads."""
    return "~".join("_".join(word.translate(_APART) for word in stage) for stage in stages)


_APART = str.maketrans("_~", "  ")


def _stages(text: str) -> tuple[Stage, ...]:
    """Return the stages of which all numbers are given; a stage without any is none."""
    found: list[Stage] = []
    for place, (*words, kind) in enumerate(words_of_stages(text), start=1):
        if not any(words):
            continue
        values = [value_of(item, word) for item, word in zip(STAGE, words, strict=True)]
        missing = [
            item.label.lower() for item, value in zip(STAGE, values, strict=True) if value is None
        ]
        if missing:
            raise ValueError(f"Stage {place}: {' and '.join(missing)} missing")
        power, diameter, width, ratio = (value or 0.0 for value in values)
        found.append(Stage(power, diameter, width, ratio, _FACTORS[kind]))
    return tuple(found)


def judged(computed: Computed, asked: Asked) -> tuple[Criterion, ...]:
    """Return the criteria of a machine; raises ValueError where its film has no answer."""
    low, high = asked.operation(computed)
    return _checks(computed.machine, high, low, asked.cross_coupling(computed), asked.grade)


@lru_cache(maxsize=64)
def _checks(
    machine: Machine, high: float, low: float, Q_A: float | None, grade: str
) -> tuple[Criterion, ...]:
    return checks(machine, high, minimum_speed=low, cross_coupling=Q_A, grade=grade)


def stability(computed: Computed, asked: Asked) -> Stability:
    """Return the log decrement over cross-coupling, up to beyond Q_A and Q_0."""
    _, speed = asked.operation(computed)
    Q_A = asked.cross_coupling(computed)
    here = _level(computed.machine, speed, (Q_A or 0.0,))
    Q_0 = here.zero_decrement
    top = max(_OVER_Q_A * (Q_A or 0.0), _OVER_Q_0 * Q_0 if np.isfinite(Q_0) else 0.0)
    if top == 0.0:  # a stiffness of the film's size
        top = float(np.abs(computed.point.stiffness).max())
    Q = np.linspace(0.0, _rounded_up(top), _PLACES)
    return Stability(
        over=_level(computed.machine, speed, tuple(Q.tolist())),
        here=LevelOne(
            speed=here.speed,
            cross_coupling=here.cross_coupling[0],
            forward_decrement=here.forward_decrement[0],
            whirl_frequency=here.whirl_frequency[0],
            backward_decrement=here.backward_decrement[0],
            zero_decrement=Q_0,
        ),
        is_known=Q_A is not None,
    )


def _rounded_up(value: float) -> float:
    """Return a number with one digit, or one and a half, at or above a value."""
    power = 10.0 ** np.floor(np.log10(value))
    return float(np.ceil(2.0 * value / power - 1e-9) / 2.0 * power)


@lru_cache(maxsize=64)
def _level(machine: Machine, speed: float, cross_coupling: tuple[float, ...]) -> LevelOne:
    return level_one(machine, speed, np.array(cross_coupling))


def critical(computed: Computed, asked: Asked) -> CriticalSpeeds:
    """Return the response with critical speeds; of a balanced rotor over its imbalance."""
    balanced = computed.machine.rotor.imbalance == 0.0
    shown = _excited(computed) if balanced else computed
    curves, operation = shown.response, asked.operation(computed)
    return CriticalSpeeds(
        speed=curves.speed,
        amplitude=curves.disk.ellipse.semi_major,
        running_speed=computed.speed,
        here=float(curves.disk_here.ellipse.semi_major),
        found=_amplification(shown.machine, *operation),
        operation=operation,
        unstable=curves.unstable,
        is_balanced=balanced,
    )


@lru_cache(maxsize=8)
def _excited(computed: Computed) -> Computed:
    """Return a machine with an imbalance of a metre: its amplitudes are those over imbalance."""
    machine = computed.machine
    rotor = replace(machine.rotor, imbalance=1.0)
    return Computed(replace(machine, rotor=rotor), computed.speed, computed.top_speed)


@lru_cache(maxsize=64)
def _amplification(machine: Machine, low: float, high: float) -> Amplification:
    return amplification(machine, minimum_speed=low, maximum_speed=high)


def modes_over_speed(computed: Computed, *, while_dragging: bool = False) -> Campbell:
    """Return the modes over the sweep; at fewer speeds while a slider is held."""
    return _campbell(computed, _WHILE_DRAGGING if while_dragging else 1)


@lru_cache(maxsize=16)
def _campbell(computed: Computed, every: int) -> Campbell:
    speed = computed.sweep.speed
    return campbell(computed.machine, speed[(len(speed) - 1) % every :: every])


def takes_long(computed: Computed) -> bool:
    """Return whether a film that is known by its impedance makes level one slow."""
    film = film_of(computed.machine.bearing)
    return film.frequency_dependent and not film.inner


def graded_imbalance(computed: Computed, asked: Asked) -> float:
    """Return the imbalance that the grade permits [m]."""
    _, speed = asked.operation(computed)
    return float(imbalance_of_grade(asked.grade, rotor=computed.machine.rotor, speed=speed))
