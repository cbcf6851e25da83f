"""Received sound from the loads of every case."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from ..machine.cases import Cases
from ..machine.machine import Machine
from ..machine.source import CaseKey, Shared
from ..mechanics.contributions import Contributions
from ..mechanics.loads import Lines, Loads, lines_of
from ..mechanics.received_sound import NoisePower, ReceivedSound
from ..study.study import Study
from .bending import bending_shell
from .contributions import contributions
from .load_path import LoadPath
from .machine import on_mounts
from .observers import Observers
from .path import ShellPath


@dataclass(frozen=True)
class Transmission:
    """Transmission of loads to sound, whatever values are sampled.

    Attributes
    ----------
    study : options, highest frequency and order
    microphones : pressure per velocity of the rigid motions and, where a source drives it, of the
        shell's modes
    shell : its modes and joints; none where no source drives it
    """

    study: Study
    microphones: Observers
    shell: ShellPath | None

    def to(self, receivers: Sequence[int]) -> "Transmission":
        """Return the transmission to some of the receivers alone, the dimension kept."""
        return replace(self, microphones=self.microphones.to(list(receivers)))

    def received(self, cases: Cases) -> dict[CaseKey, ReceivedSound]:
        """Compute the sound of every case behind its option's insertion loss."""
        shared, sound = Shared(), {}
        for key, case in cases.cases.items():
            path = self.path(shared, case.machine, cases.loads[key])
            received = self._of_case(self.lines(key, cases), cases.loads[key], path)
            sound[key] = received.behind(self.study.option_of(key).insertion_loss())
        return sound

    def contributions(self, cases: Cases) -> Iterator[tuple[CaseKey, Contributions]]:
        """Compute the sound by path, without insertion loss, one case at a time."""
        shared = Shared()
        for key, case in cases.cases.items():
            path = self.path(shared, case.machine, cases.loads[key])
            lines = self.lines(key, cases)
            yield key, contributions(path, self.microphones, lines, cases.loads[key])

    def path(self, shared: Shared, machine: Machine, loads: Mapping[str, Loads]) -> LoadPath:
        """Return the path of a machine, shared by those that differ in no table its ports read."""
        read = dict.fromkeys(
            table for load in loads.values() for port in load.ports for table in port.tables
        )
        tables = tuple(machine.table(each) for each in read if machine.has_table(each))
        body = on_mounts(machine)
        shell = None
        if self.shell is not None:
            shell = shared(tables, partial(bending_shell, machine, self.shell))
        return shared((body, tables), lambda: LoadPath(body, shell))

    def _of_case(self, lines: Lines, loads: Mapping[str, Loads], path: LoadPath) -> ReceivedSound:
        receivers = len(self.microphones.rigid(lines.frequency_hz[:1]))
        pressure = np.zeros((len(loads), receivers, lines.frequency_hz.size), dtype=complex)
        for number, load in enumerate(lines.loads.values()):
            pressure[number] += path.observed(self.microphones, load, lines.frequency_hz)
        noise = [
            NoisePower(number, part.frequency_hz, path.noise_power(self.microphones, part))
            for number, load in enumerate(loads.values())
            for part in load.noise
        ]
        return ReceivedSound(lines, pressure, tuple(noise))

    def lines(self, key: CaseKey, cases: Cases) -> Lines:
        """Lay the loads of a case on lines: as many orders as the wrenches have, more on a shell.

        On an elastic shell the orders reach up to the highest frequency.
        """
        case = cases.cases[key]
        highest = self.study.highest_order(case.speed_rpm)
        if self.study.drives_shell:
            highest = max(highest, case.maximum_order)
        return lines_of(cases.loads[key], case.shaft_frequency_hz, highest, cases.wrenches[key])
