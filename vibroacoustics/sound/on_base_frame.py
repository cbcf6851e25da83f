"""Runs of machines that share a base frame: all housings on it radiate what it drives."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import xarray as xr

from ..base.arrays import Array, ComplexArray
from ..machine.cases import Cases
from ..machine.machine import Machine
from ..machine.source import CaseKey
from ..mechanics.bushings import RigidBody
from ..mechanics.loads import Lines, PortLoads, summed
from ..mechanics.ports import BodyPort
from ..mechanics.received_sound import ReceivedSound
from ..study.machine_studies import turn_of
from ..study.study import Study
from ..transfer.base_frame import FRAME, MachinesOnFrame, Standing
from ..transfer.contributions import Transmission
from ..transfer.feet import Stand
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


Lined = dict[str, complex]
"""Complex peaks by name of the line, Pa."""


@dataclass(frozen=True)
class FrameSound:
    """Change of the sound of the machines on a base frame.

    Attributes
    ----------
    frame : the machines on it
    runs : runs of the machines on the floor, by name
    """

    frame: MachinesOnFrame
    runs: Mapping[str, MachineRun]

    def driven_by(self, name: str) -> tuple[Lines, ComplexArray]:
        """Return the lines of a machine and the motion of all bodies, shape (line, body, 6)."""
        lines = self.runs[name].lines
        return lines, self.frame.motion(name, _on_bodies(lines), lines.frequency_hz)

    def lines(self, name: str, on_floor: Mapping[str, Lined]) -> dict[str, Lined]:
        """Change the lines of a machine to those on the frame, by common receiver.

        P (p + Δp)/p, where p is the sum of its sources with the same loads as Δp, and P may be
        at the median levels of samples; Δp where p is silent.

        Parameters
        ----------
        name : name of the machine
        on_floor : complex peaks by common receiver and name of the line, Pa
        """
        run = self.runs[name]
        received = run.received()
        change = self._change(name, received)
        pressure = received.pressure.sum(axis=0)
        changed: dict[str, Lined] = {}
        for receiver, lined in on_floor.items():
            row = run.row(receiver)
            by_name = dict(lined)
            for number, line in enumerate(received.lines.names):
                of_line = change[row, number]
                if received.lines.frequency_hz[number] > 0.0 and of_line != 0.0:
                    alone = pressure[row, number]
                    ratio = lined.get(line, 0.0) / alone if alone != 0.0 else 1.0
                    by_name[line] = ratio * (alone + of_line)
            changed[receiver] = by_name
        return changed

    def _change(self, name: str, received: ReceivedSound) -> ComplexArray:
        """Pressure of all housings on the frame less that of the machine's on the floor, Pa.

        Shape (receiver of the machine, line); rows of receivers that are not common stay 0.
        """
        lines, motion = self.driven_by(name)
        run, hertz = self.runs[name], lines.frequency_hz
        velocity = self.frame.housing_velocity(motion, hertz)
        velocity[name] = velocity[name] - _alone(run.body, _on_bodies(lines), hertz)
        change = np.zeros(received.pressure.shape[1:], dtype=complex)
        for other, of_other in velocity.items():
            radiating = self.runs[other]
            per_velocity = radiating.microphones(hertz)
            for receiver in run.common:
                of_receiver = per_velocity[radiating.row(receiver)]
                radiated = np.einsum("mf,fm->f", of_receiver, of_other)
                change[run.row(receiver)] += radiating.behind(radiated, hertz)
        return change


def on_base_frame(study: Study, runs: Mapping[str, MachineRun]) -> FrameSound | None:
    """Put the machines of a study on its base frame; None where each stands on the floor.

    Parameters
    ----------
    study : with tables of several machines
    runs : runs of the machines, by name
    """
    settings = study.base_frame
    if settings is None:
        return None
    centre_m = np.array([*settings.position_m, settings.height_m])
    stand = Stand(settings.mounts, -settings.height_m, settings.feet)
    standing = {}
    for name, run in runs.items():
        machine = study.machines[name]
        origin_m = np.array([*machine.position_m, -run.machine.shell.floor_z_m])
        standing[name] = Standing(run.body, origin_m, turn_of(machine))
    body = settings.body
    moments = (body.inertia_xx_kg_m2, body.inertia_yy_kg_m2, body.inertia_zz_kg_m2)
    frame = RigidBody(FRAME, body.mass_kg, np.diag(moments), centre_m)
    return FrameSound(MachinesOnFrame(frame, stand, standing), runs)


def _on_bodies(lines: Lines) -> PortLoads:
    """Loads of all sources on rigid bodies by port, shape (6, line)."""
    total = summed(lines.loads.values())
    return {port: load for port, load in total.items() if isinstance(port, BodyPort)}


def _alone(body: MachineOnMounts, loads: PortLoads, frequency_hz: Array) -> ComplexArray:
    """Velocity of the housing of a machine whose mounts end on the floor, shape (line, 6)."""
    total = np.zeros((frequency_hz.size, 6), dtype=complex)
    for port, load in loads.items():
        if isinstance(port, BodyPort):
            total += body.response(load.T, frequency_hz, port).velocity
    return total
