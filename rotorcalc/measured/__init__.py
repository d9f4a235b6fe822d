"""Vibration measured on a machine, read from files: orbits, and amplitude and phase over speed."""

from rotorcalc.measured.orbits import orbit_table, read_orbit
from rotorcalc.measured.over_speed import (
    MeasuredResponse,
    read_vibration_over_speed,
    response_table,
)
from rotorcalc.nonlinear.sampled import MeasuredOrbit

__all__ = [
    "MeasuredOrbit",
    "MeasuredResponse",
    "orbit_table",
    "read_orbit",
    "read_vibration_over_speed",
    "response_table",
]
