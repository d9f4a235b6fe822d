"""Machines to start from: the calculation sheet's two, Fig. 5.2's bearing, a textbook's example.

Where a source gives only a bearing, the rest of the machine is this program's choice, and the
preset's note says so.
"""

from dataclasses import dataclass, replace

from scipy.constants import g

from rotorcalc.machine import JournalBearing, Machine, Oil, Rotor
from rotorcalc.units import rpm


@dataclass(frozen=True, kw_only=True)
class Preset:
    """A named machine with its running speed and the top speed of its charts.

    Attributes
    ----------
    title : str
        Its name for readers.
    note : str
        Where its numbers come from, and which are this program's choice.
    machine : Machine
        The machine.
    speed : float
        Running speed, Ω [rad/s].
    top_speed : float
        Highest speed of the sweep [rad/s].
    """

    title: str
    note: str
    machine: Machine
    speed: float
    top_speed: float


_SHEET_STIFF = Machine(
    # The sheet's own rounded factors: with the exact pound its half mass would be 136.078 kg, not
    # the printed 136.071. 2.5e-6 reyn at 50 °C; a reyn is a lbf·s/in², 6894.757 Pa·s in the sheet.
    oil=Oil(
        reference_viscosity=2.5e-6 * 6894.757,
        reference_temperature=50.0,
        temperature_coefficient=0.030,
    ),
    bearing=JournalBearing(diameter=0.150, length=0.050, radial_clearance=60e-6),
    # 600 lbf, 4.448 N each in the sheet.
    rotor=Rotor(mass=600 * 4.448 / g, shaft_stiffness=1e8, imbalance=0.2 * 60e-6),
    temperature=60.0,
)

PRESETS: dict[str, Preset] = {
    "sheet-1e8": Preset(
        title="600 lbf rotor, stiff shaft",
        note="San Andrés, Notes 5, calculation sheet, shaft stiffness 10⁸ N/m.",
        machine=_SHEET_STIFF,
        speed=6000 * rpm,
        top_speed=12000 * rpm,
    ),
    "sheet-1e7": Preset(
        title="600 lbf rotor, flexible shaft",
        note="San Andrés, Notes 5, calculation sheet, shaft stiffness 10⁷ N/m. Its running speed "
        "is this program's choice, below the onset.",
        machine=replace(_SHEET_STIFF, rotor=replace(_SHEET_STIFF.rotor, shaft_stiffness=1e7)),
        speed=4000 * rpm,
        top_speed=12000 * rpm,
    ),
    "fig-5-2": Preset(
        title="Bearing of Fig. 5.2",
        note="San Andrés, Notes 5, Fig. 5.2: L = 50 mm, L/D = 0.25, C = 0.1 mm, 0.019 Pa·s, "
        "3000 rpm. The rotor is this program's choice: the calculation sheet's, rigid.",
        machine=Machine(
            # The figure gives one viscosity and no law: with α = 0 it holds at any temperature.
            oil=Oil(
                reference_viscosity=0.019, reference_temperature=50.0, temperature_coefficient=0.0
            ),
            bearing=JournalBearing(diameter=0.200, length=0.050, radial_clearance=100e-6),
            rotor=Rotor(mass=600 * 4.448 / g, imbalance=5e-6),
            temperature=50.0,
        ),
        speed=3000 * rpm,
        top_speed=12000 * rpm,
    ),
    "friswell-5-5-1": Preset(
        title="Friswell et al., example 5.5.1",
        note="Friswell, Penny, Garvey and Lees, Dynamics of Rotating Machines, example 5.5.1: "
        "525 N, 100 × 30 mm, C = 0.1 mm, 0.1 Pa·s, 1500 rpm. The rotor is this program's choice: "
        "rigid, and of the mass that gives this load.",
        machine=Machine(
            # Likewise one viscosity.
            oil=Oil(
                reference_viscosity=0.1, reference_temperature=50.0, temperature_coefficient=0.0
            ),
            bearing=JournalBearing(diameter=0.100, length=0.030, radial_clearance=100e-6),
            rotor=Rotor(mass=2 * 525.0 / g, imbalance=5e-6),
            temperature=50.0,
            load=525.0,
        ),
        speed=1500 * rpm,
        top_speed=9000 * rpm,
    ),
}
