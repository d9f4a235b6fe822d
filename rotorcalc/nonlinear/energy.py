"""Where the energy of a motion goes: the balance of an integrated motion, term by term.

    work of imbalance + work of load
        = change of kinetic and strain energy + loss in the film + loss in the damper

per bearing, over any interval. The film's term is the work that the journal does on it beyond what
the drive puts into shearing it; it is negative where the film feeds the whirl. The terms are
integrals over the samples by a polynomial of seventh degree, piece by piece.

Source: the equations of motion, Eq. 5.1 with imbalance forward, each times its velocity.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import make_interp_spline

from rotorcalc.arrays import Array
from rotorcalc.display import Result
from rotorcalc.films import film_motion
from rotorcalc.machine import Machine
from rotorcalc.nonlinear.transient import Transient

_DEGREE = 7


@dataclass(frozen=True, eq=False)
class EnergyBalance(Result):
    """The energy of a motion since its start, per bearing, each of shape (n,) [J].

    Attributes
    ----------
    time : array
        t [s].
    imbalance_work : array
        Work of the imbalance's force on the disk.
    load_work : array
        Work of the static load.
    kinetic : array
        Change of the kinetic energy of disk and journal.
    strain : array
        Change of the strain energy of the shaft.
    film_loss : array
        Taken up by the film; falls where the film feeds the motion.
    damper_loss : array
        Taken up by the midspan damper.
    """

    time: Array
    imbalance_work: Array
    load_work: Array
    kinetic: Array
    strain: Array
    film_loss: Array
    damper_loss: Array

    @property
    def residual(self) -> Array:
        """What is left of the balance, (n,) [J]: zero but for the errors of integration."""
        given = self.imbalance_work + self.load_work
        return given - self.kinetic - self.strain - self.film_loss - self.damper_loss

    @property
    def exchanged(self) -> float:
        """Largest of all terms [J], to judge the residual by."""
        terms = (
            self.imbalance_work, self.load_work, self.kinetic, self.strain, self.film_loss,
            self.damper_loss,
        )  # fmt: skip
        return max(float(np.abs(term).max()) for term in terms)


def energy_balance(machine: Machine, motion: Transient) -> EnergyBalance:
    """Return the energy balance of a motion, from its start to each of its samples.

    Parameters
    ----------
    machine : Machine
        The machine that moved.
    motion : Transient
        Its motion, sampled finely enough for its fastest part. Where a journal with mass is let go
        at rest the film takes hold of it within a fraction of a revolution, which hundreds of
        samples a revolution resolve; 64 serve what comes after.

    Returns
    -------
    EnergyBalance
        Each term from the motion alone; over an interval it is the difference of two samples.
    """
    rotor = machine.rotor
    journal, disk = motion.journal_velocity, motion.disk_velocity
    sag = motion.disk - motion.journal
    stiffness = 0.0 if rotor.is_rigid else rotor.shaft_stiffness
    kinetic = 0.5 * rotor.disk_mass * _square(disk) + 0.5 * rotor.journal_mass * _square(journal)
    strain = 0.5 * stiffness * _square(sag)
    integral = _integral(motion.time)
    return EnergyBalance(
        time=motion.time,
        imbalance_work=integral(np.sum(imbalance_force(machine, motion) * disk, axis=1)),
        load_work=machine.static_load * (motion.disk[:, 0] - motion.disk[0, 0]),
        kinetic=kinetic - kinetic[0],
        strain=strain - strain[0],
        film_loss=integral(-np.sum(film_force(machine, motion) * journal, axis=1)),
        damper_loss=integral(rotor.disk_damping * _square(disk)),
    )


def film_force(machine: Machine, motion: Transient) -> Array:
    """Return the film's force on the journal along a motion.

    Parameters
    ----------
    machine : Machine
        The machine that moved.
    motion : Transient
        Its motion.

    Returns
    -------
    array, (n, 2)
        In X, Y [N].
    """
    bearing, C = machine.bearing, machine.bearing.radial_clearance
    force, _ = film_motion(bearing)
    velocity = motion.journal_velocity / (C * motion.speed[:, None])
    states = np.concatenate([motion.journal / C, velocity], axis=1).tolist()
    unit = machine.viscosity * motion.speed * bearing.radius * bearing.length**3 / C**2
    return unit[:, None] * np.array([force(*state) for state in states])


def imbalance_force(machine: Machine, motion: Transient) -> Array:
    """Return the force of the imbalance on the disk along a motion, one side.

    Parameters
    ----------
    machine : Machine
        The machine that moved.
    motion : Transient
        Its motion.

    Returns
    -------
    array, (n, 2)
        m_d u (Ω² e + Ω̇ e⊥) in X, Y [N], with e = (cos θ, sin θ) and e⊥ = (sin θ, −cos θ).
    """
    rotor, turn = machine.rotor, motion.angle[-1] - motion.angle[0]
    spin = (motion.speed[-1] ** 2 - motion.speed[0] ** 2) / (2.0 * turn)
    cos, sin = np.cos(motion.angle), np.sin(motion.angle)
    square = motion.speed**2
    e = np.stack([square * cos + spin * sin, square * sin - spin * cos], axis=-1)
    return rotor.disk_mass * rotor.imbalance * e


def _square(velocity: Array) -> Array:
    return np.sum(velocity**2, axis=1)


def _integral(time: Array) -> Callable[[Array], Array]:
    """Return the running integral over time from the first sample on."""

    def integral(power: Array) -> Array:
        if not np.any(power):
            return np.zeros_like(power)
        primitive = make_interp_spline(time, power, k=min(_DEGREE, len(time) - 1)).antiderivative()
        return primitive(time) - primitive(time[0])

    return integral
