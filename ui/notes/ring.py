"""The two whirls on floating rings, computed beside what the source prints."""

import functools
import math
from dataclasses import replace

import numpy as np

from rotorcalc import PRESETS, FloatingRing, Rotor, ring_speed, ring_whirl

# As good as no load, and a rotor that a film cannot feel [N, kg].
_LOAD, _MASS = 1e-3, 2e-4
_RPM = np.array([3000.0, 6000.0, 12000.0])


@functools.cache
def whirls() -> str:
    """Return the whirl ratios of a light rotor on rings around the sheet's journal, Markdown."""
    sheet = PRESETS["sheet-1e7"].machine
    b = sheet.bearing
    ring = FloatingRing.around(b.diameter, b.length, b.radial_clearance)
    machine = replace(sheet, bearing=replace(b, geometry=ring), rotor=Rotor(mass=_MASS), load=_LOAD)
    speed = _RPM * math.pi / 30.0
    found, r = ring_whirl(machine, speed), ring_speed(machine, speed) / speed
    columns = (
        r, found.inner_whirl_ratio, 0.5 * (1.0 + r), found.outer_whirl_ratio, 0.5 * r,
        np.full(r.shape, 0.5),
    )  # fmt: skip
    rows = (
        f"| {rpm:.0f} rpm | " + " | ".join(f"{value:.5f}" for value in row) + " |"
        for rpm, row in zip(_RPM, np.stack(columns, axis=-1), strict=True)
    )
    return "\n".join((
        "| Ω | r = Ω_R/Ω | inner film, eigenvalue | ½(1 + r) | outer film, eigenvalue | ½ r | "
        "as printed |".replace("Ω_R", "$Ω_R$"),
        "|:--" + "|--:" * len(columns) + "|",
        *rows,
    ))  # fmt: skip
