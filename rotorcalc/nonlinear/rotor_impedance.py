"""The rotor's impedance at the journal: disk, shaft and journal mass.

The rotor is linear, so this holds exactly at each harmonic of a motion.
"""

from rotorcalc.arrays import Array, ComplexArray
from rotorcalc.machine import Rotor


def impedance(rotor: Rotor, omega: Array) -> tuple[ComplexArray, ComplexArray]:
    """Return the rotor's impedance at the journal for motion at ω, and its derivative by ω.

    Z = z/(1 + s z) − ω²M_j with z = −ω²m_d + jωC_s of the disk and s = 1/K_rot of the shaft.

    Parameters
    ----------
    rotor : Rotor
        The rotor.
    omega : array, (n,)
        Frequencies of the journal's motion, ω [rad/s].

    Returns
    -------
    impedance, slope : complex array, (n,)
        Z [N/m], and dZ/dω [N·s/m].
    """
    s = 1.0 / rotor.shaft_stiffness
    z = disk_impedance(rotor, omega)
    dz = -2.0 * omega * rotor.disk_mass + 1j * rotor.disk_damping
    # Disk and shaft act in series, the journal's mass beside them; s = 0 for a rigid shaft.
    series = 1.0 + s * z
    Z = z / series - omega**2 * rotor.journal_mass
    return Z, dz / series**2 - 2.0 * omega * rotor.journal_mass


def disk_impedance(rotor: Rotor, omega: Array) -> ComplexArray:
    """Return the disk's own impedance at ω, z = −ω²m_d + jωC_s [N/m]."""
    return -(omega**2) * rotor.disk_mass + 1j * omega * rotor.disk_damping
