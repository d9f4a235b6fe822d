"""The energy balance of an integrated motion, term by term.

    work of imbalance + work of load
        = change of kinetic and strain energy + loss in the film + loss in the damper

per bearing, over any interval. The film's term is the work of the journal's motion on the film, not
the drive's work of shear; it is negative where the film drives the whirl. The works are integrated
with the equations of motion, revolution by revolution from the motion's own samples, so that coarse
samples do not impair them.

Source: the equations of motion, Eq. 5.1 with imbalance forward, each times its velocity.
"""

from dataclasses import dataclass

import numpy as np

from rotorcalc.arguments import checked
from rotorcalc.arrays import Array
from rotorcalc.display import Result
from rotorcalc.machine import Machine
from rotorcalc.nonlinear.equations import WORKS, Equations, Start, integrated
from rotorcalc.nonlinear.transient import STEPS, Transient, TransientError


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
        Dissipated in the film; falls where the film drives the motion.
    damper_loss : array
        Dissipated in the midspan damper.
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
        """Residual of the balance, (n,) [J]: zero up to errors of integration."""
        given = self.imbalance_work + self.load_work
        return given - self.kinetic - self.strain - self.film_loss - self.damper_loss

    @property
    def exchanged(self) -> float:
        """Largest of all terms [J], the scale of the residual."""
        terms = (
            self.imbalance_work, self.load_work, self.kinetic, self.strain, self.film_loss,
            self.damper_loss,
        )  # fmt: skip
        return max(float(np.abs(term).max()) for term in terms)


@checked
def energy_balance(machine: Machine, motion: Transient) -> EnergyBalance:
    """Return the energy balance of a motion, from its start to each of its samples.

    Parameters
    ----------
    machine : Machine
        The machine that moved.
    motion : Transient
        Its motion.

    Returns
    -------
    EnergyBalance
        Stored energy and the load's work are taken from the samples; the other works are integrated
        between them. Over an interval each term is the difference of two samples.

    Raises
    ------
    TransientError
        Where that integration cannot go on.
    """
    rotor = machine.rotor
    sag = motion.disk - motion.journal
    # A rigid shaft stores no energy; ∞ times its sag of 0 would be NaN.
    stiffness = 0.0 if rotor.is_rigid else rotor.shaft_stiffness
    kinetic = 0.5 * rotor.disk_mass * _square(motion.disk_velocity)
    # Without mass a journal has no kinetic energy, and its velocity is costly: see `Transient`.
    if rotor.journal_mass > 0.0:
        kinetic = kinetic + 0.5 * rotor.journal_mass * _square(motion.journal_velocity)
    strain = 0.5 * stiffness * _square(sag)
    imbalance_work, film_loss, damper_loss = _works(machine, motion).T
    return EnergyBalance(
        time=motion.time,
        imbalance_work=imbalance_work,
        # The load acts on the disk, along X.
        load_work=machine.static_load * (motion.disk[:, 0] - motion.disk[0, 0]),
        kinetic=kinetic - kinetic[0],
        strain=strain - strain[0],
        film_loss=film_loss,
        damper_loss=damper_loss,
    )


def _works(machine: Machine, motion: Transient) -> Array:
    """Return the works of imbalance, film and damper since the start, (n, 3) [J]."""
    angle = motion.angle
    works = np.zeros((len(angle), WORKS))
    if len(angle) == 1:  # a motion that failed at the start
        return works
    (first, last), turned = motion.speed[[0, -1]].tolist(), float(angle[-1])
    model = Equations(machine, first, last, turned=turned)
    states = model.initial(_states(machine, motion))
    # `turn` is the number of samples in a revolution.
    rates, turn = model.motion_and_works(), int(np.sum(angle < 2.0 * np.pi))
    for i in range(0, len(angle) - 1, turn):
        span = slice(i, i + turn + 1)
        # Each revolution starts from the motion's own sample; only the works carry on.
        start = np.concatenate([states[i], works[i]])
        found, message = integrated(rates, start, angle[span], steps=STEPS)
        if message:
            raise TransientError(f"the works could not be integrated ({message})", motion)
        works[span] = found[:, -WORKS:]
    # From the unit of energy of `Equations`, M C² Ω_0².
    return works * model.mass * (model.C * model.first) ** 2


def _states(machine: Machine, motion: Transient) -> Start:
    """Return the states of a motion; a massless journal's velocity is not among them."""
    massless = machine.rotor.journal_mass == 0.0
    return Start(
        journal=motion.journal,
        disk=motion.disk,
        journal_velocity=motion.disk_velocity if massless else motion.journal_velocity,
        disk_velocity=motion.disk_velocity,
        inner=motion.inner,
    )


def _square(velocity: Array) -> Array:
    return np.sum(velocity**2, axis=1)
