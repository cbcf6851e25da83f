"""From the loads of every case to its sound at the receivers."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
import xarray as xr

from ..base.arrays import ComplexArray
from ..machine.machine import Machine
from ..machine.source import Case, CaseKey, Shared
from ..mechanics.contributions import Contributions
from ..mechanics.loads import Lines, Loads, lines_of
from ..mechanics.received_sound import NoisePower, ReceivedSound
from ..study.study import Study
from .bending import BendingShell, bending_shell
from .contributions import contributions
from .load_path import LoadPath
from .machine import on_mounts
from .observers import Observers
from .path import ShellPath

BySource = Mapping[str, ComplexArray]


@dataclass(frozen=True)
class Transmission:
    """What turns loads into sound, whatever values are drawn.

    Attributes
    ----------
    study : options, highest frequency and order
    microphones : pressure per velocity of the rigid motions and, where a source drives it, of the
        shell's modes
    shell : its modes and joints; none where no source drives it
    wrench_pressure : of the wrenches over crank angle, by case and source, (receiver, order), Pa
    """

    study: Study
    microphones: Observers
    shell: ShellPath | None
    wrench_pressure: Mapping[CaseKey, BySource]

    def to(self, receivers: Sequence[int]) -> "Transmission":
        """To some of the receivers alone, the dimension kept."""
        rows = list(receivers)
        return replace(
            self,
            microphones=self.microphones.to(rows),
            wrench_pressure={
                key: {source: pressure[rows] for source, pressure in by_source.items()}
                for key, by_source in self.wrench_pressure.items()
            },
        )

    def received(
        self,
        cases: Mapping[CaseKey, Case],
        loads: Mapping[CaseKey, Mapping[str, Loads]],
    ) -> dict[CaseKey, ReceivedSound]:
        """Sound of every case behind its option's insertion loss.

        Parameters
        ----------
        cases : speeds and options, with the values of one draw
        loads : of all sources in each
        """
        known, sound = Shared(), {}
        for key, case in cases.items():
            path = self._path(known, case.machine, loads[key])
            received = self._of_case(case, loads[key], self.wrench_pressure[key], path)
            sound[key] = received.behind(self.study.option_of(key).insertion_loss())
        return sound

    def contributions(
        self,
        cases: Mapping[CaseKey, Case],
        loads: Mapping[CaseKey, Mapping[str, Loads]],
        of_wrenches: Mapping[CaseKey, BySource],
    ) -> Iterator[tuple[CaseKey, Contributions]]:
        """Sound of every case by path, behind its option's insertion loss, one case at a time.

        Parameters
        ----------
        cases, loads : as for `received`
        of_wrenches : pressure of the wrenches by motion of the housing, (receiver, 6, order), Pa
        """
        known = Shared()
        for key, case in cases.items():
            path = self._path(known, case.machine, loads[key])
            orders = self._orders(case, next(iter(of_wrenches[key].values())))
            lines = self._lines(case, loads[key], orders)
            wrenches = {name: values[..., :orders] for name, values in of_wrenches[key].items()}
            split = contributions(path, self.microphones, lines, loads[key], wrenches)
            yield key, split.behind(self.study.option_of(key).insertion_loss())

    def _path(self, known: Shared, machine: Machine, loads: Mapping[str, Loads]) -> LoadPath:
        """Path of a machine, shared by machines that differ in no table that its ports read."""
        read = dict.fromkeys(
            table for load in loads.values() for port in load.ports for table in port.tables
        )
        tables = tuple(machine.table(each) for each in read if machine.has_table(each))
        body = on_mounts(machine)
        shell = known(tables, partial(self._bending_shell, machine))
        return known((body, tables), lambda: LoadPath(body, shell))

    def _bending_shell(self, machine: Machine) -> BendingShell | None:
        return None if self.shell is None else bending_shell(machine, self.shell)

    def _of_case(
        self, case: Case, loads: Mapping[str, Loads], of_wrenches: BySource, path: LoadPath
    ) -> ReceivedSound:
        first = next(iter(of_wrenches.values()))
        receivers, orders = len(first), self._orders(case, first)
        lines = self._lines(case, loads, orders)
        pressure = np.zeros((len(loads), receivers, lines.frequency_hz.size), dtype=complex)
        for number, of_source in enumerate(path.by_source(self.microphones, lines).values()):
            pressure[number] += of_source
        for number, source in enumerate(loads):
            if source in of_wrenches:
                pressure[number, :, :orders] += of_wrenches[source][:, :orders]
        noise = [
            NoisePower(number, part.frequency_hz, path.noise_power(self.microphones, part))
            for number, load in enumerate(loads.values())
            for part in load.noise
        ]
        return ReceivedSound(lines, pressure, tuple(noise))

    def _orders(self, case: Case, of_wrench: ComplexArray) -> int:
        """Orders from zero that the wrenches sound at; silent beyond."""
        return min(of_wrench.shape[-1], self.study.highest_order(case.speed_rpm) + 1)

    def _lines(self, case: Case, loads: Mapping[str, Loads], orders: int) -> Lines:
        """With as many orders as the wrenches have; on a shell up to the highest frequency."""
        highest = orders - 1
        if self.study.drives_shell:
            highest = max(highest, case.maximum_order)
        return lines_of(loads, case.shaft_frequency_hz, highest)


def by_case_and_source(
    pressure: xr.DataArray, source_of_wrench: Mapping[str, str]
) -> dict[CaseKey, BySource]:
    """Pressure of the wrenches, shape (receiver, ..., order), summed over those of one source.

    Parameters
    ----------
    pressure : of every wrench, which the dimension source names, Pa
    source_of_wrench : by the wrench's name
    """
    values = pressure.transpose("speed", "option", "source", "receiver", ..., "order").values
    sources = np.array([source_of_wrench[str(name)] for name in pressure["source"].values])
    rows = {source: np.flatnonzero(sources == source) for source in dict.fromkeys(sources.tolist())}
    return {
        (float(speed), str(option)): {
            source: values[s, o, row].sum(axis=0) for source, row in rows.items()
        }
        for s, speed in enumerate(pressure["speed"].values)
        for o, option in enumerate(pressure["option"].values)
    }
