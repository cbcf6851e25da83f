"""The run of one of several machines, with what drives and radiates its sound."""

from dataclasses import dataclass

import numpy as np
import xarray as xr

from ..base.arrays import Array, ComplexArray
from ..machine.cases import Cases
from ..machine.machine import Machine
from ..machine.source import CaseKey
from ..mechanics.loads import Lines
from ..mechanics.received_sound import ReceivedSound
from ..transfer.contributions import Transmission
from ..transfer.machine import MachineOnMounts, on_mounts
from .ingredients import Ingredients, ingredients


@dataclass(frozen=True)
class MachineRun:
    """A finished run of the study of one machine.

    Attributes
    ----------
    results : results of the run
    key : speed in rpm and option at which the machine runs beside others
    common : names of the receivers that all machines have
    transmission : from its loads to its receivers
    cases : with nominal values or, with samples, those of the representative one
    """

    results: xr.Dataset
    key: CaseKey
    common: tuple[str, ...]
    transmission: Transmission
    cases: Cases

    @property
    def machine(self) -> Machine:
        """The machine with its option."""
        return self.cases.cases[self.key].machine

    @property
    def body(self) -> MachineOnMounts:
        """The machine on its mounts."""
        return on_mounts(self.machine)

    @property
    def lines(self) -> Lines:
        """Lines of all its sources."""
        return self.transmission.lines(self.key, self.cases)

    def sound(self, receiver: str) -> Ingredients:
        """Return lines and noise at a receiver."""
        speed_rpm, option = self.key
        return ingredients(self.results, option, receiver, speed_rpm)

    def received(self) -> ReceivedSound:
        """Compute the sound of its loads at its receivers."""
        return self.transmission.received(self.cases.some([self.key]))[self.key]

    def microphones(self, frequency_hz: Array) -> ComplexArray:
        """Return pressure per velocity of the housing, shape (receiver, 6, frequency), Pa s/m."""
        return np.asarray(self.transmission.microphones.rigid(frequency_hz))

    def row(self, receiver: str) -> int:
        """Return the number of a receiver among those of the run."""
        return list(self.transmission.study.receivers).index(receiver)

    def behind(self, pressure_pa: ComplexArray, frequency_hz: Array) -> ComplexArray:
        """Return what the insertion loss of its option leaves of its airborne sound, Pa."""
        loss = self.transmission.study.option_of(self.key).insertion_loss()
        factor = 1.0 if loss is None else loss.amplitude_factor(frequency_hz)
        return np.asarray(pressure_pa * factor)
