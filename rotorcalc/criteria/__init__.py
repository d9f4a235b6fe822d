"""What standards ask of a rotor on journal bearings: criteria, each with its source and limit."""

from rotorcalc.criteria.amplification import Amplification, amplification, required_margin
from rotorcalc.criteria.campbell import Campbell, campbell
from rotorcalc.criteria.checks import Criterion, checks, vibration_limit
from rotorcalc.criteria.level_one import LevelOne, anticipated_cross_coupling, level_one
from rotorcalc.criteria.unbalance import (
    GRADES,
    balance_quality,
    grade_of_imbalance,
    imbalance_of_grade,
    permissible_eccentricity,
)

__all__ = [
    "GRADES",
    "Amplification",
    "Campbell",
    "Criterion",
    "LevelOne",
    "amplification",
    "anticipated_cross_coupling",
    "balance_quality",
    "campbell",
    "checks",
    "grade_of_imbalance",
    "imbalance_of_grade",
    "level_one",
    "permissible_eccentricity",
    "required_margin",
    "vibration_limit",
]
