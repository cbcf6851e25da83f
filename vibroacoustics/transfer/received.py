"""From the loads of every case to its sound at the receivers."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
import xarray as xr

from ..base.arrays import ComplexArray
from ..base.parameters import Parameters
from ..machine.cavities import DischargeDome, SuctionAnnulus
from ..machine.frame import Frame
from ..machine.machine import Machine
from ..machine.shell_structure import ShellStructure, ShellVariation
from ..machine.source import Case, CaseKey, Shared
from ..machine.stator_yoke import StatorYoke
from ..mechanics.contributions import Contributions
from ..mechanics.loads import Lines, Loads, lines_of
from ..mechanics.received_sound import NoisePower, ReceivedSound
from ..mechanics.scroll_shaft import ScrollShaft
from ..study.study import Study
from .bending import bending_shell
from .contributions import contributions
from .force_sound import ForceSound, OfReceivers, PressurePerVelocity
from .machine import on_mounts
from .path import ShellPath
from .sound_path import BendingShell, SoundPath

BySource = Mapping[str, ComplexArray]


@dataclass(frozen=True)
class Transmission:
    """What turns loads into sound, whatever values are drawn.

    Attributes
    ----------
    study : options, highest frequency and order
    rigid : pressure per velocity of the rigid motions
    modes : of the shell's modes; none where no source drives it
    shell : its modes and joints; none where no source drives it
    wrench_pressure : of the wrenches over crank angle, by case and source, (receiver, order), Pa
    """

    study: Study
    rigid: PressurePerVelocity
    modes: PressurePerVelocity | None
    shell: ShellPath | None
    wrench_pressure: Mapping[CaseKey, BySource]

    def to(self, receivers: Sequence[int]) -> "Transmission":
        """To some of the receivers alone, the dimension kept."""
        rows = list(receivers)
        return replace(
            self,
            rigid=_to(self.rigid, rows),
            modes=None if self.modes is None else _to(self.modes, rows),
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
            machine = case.machine
            path = known(_path_tables(machine), partial(self._sound_path, machine))
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
            machine = case.machine
            path = known(_path_tables(machine), partial(self._sound_path, machine))
            orders = self._orders(case, next(iter(of_wrenches[key].values())))
            lines = self._lines(case, loads[key], orders)
            wrenches = {name: values[..., :orders] for name, values in of_wrenches[key].items()}
            split = contributions(path, on_mounts(machine), lines, loads[key], wrenches)
            yield key, split.behind(self.study.option_of(key).insertion_loss())

    def _sound_path(self, machine: Machine) -> SoundPath:
        return SoundPath(self.rigid, self._bending_shell(machine))

    def _bending_shell(self, machine: Machine) -> BendingShell | None:
        if self.shell is None or self.modes is None:
            return None
        return bending_shell(machine, self.shell, self.modes, self.rigid)

    def _of_case(
        self, case: Case, loads: Mapping[str, Loads], of_wrenches: BySource, path: SoundPath
    ) -> ReceivedSound:
        first = next(iter(of_wrenches.values()))
        receivers, orders = len(first), self._orders(case, first)
        lines = self._lines(case, loads, orders)
        pressure = np.zeros((len(loads), receivers, lines.frequency_hz.size), dtype=complex)
        for number, of_source in enumerate(path.pressure(on_mounts(case.machine), lines).values()):
            pressure[number] += of_source
        for number, source in enumerate(loads):
            if source in of_wrenches:
                pressure[number, :, :orders] += of_wrenches[source][:, :orders]
        noise = [
            NoisePower(number, part.frequency_hz, path.noise_power(part))
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


def _to(pressure: PressurePerVelocity, rows: list[int]) -> PressurePerVelocity:
    if isinstance(pressure, OfReceivers):
        return pressure.to(rows)
    return lambda frequency_hz: pressure(frequency_hz)[rows]


def _path_tables(machine: Machine) -> tuple[Parameters, ...]:
    """What tells the paths of two machines apart."""
    tables = (ShellStructure, ShellVariation, Frame, ScrollShaft, StatorYoke, DischargeDome,
              SuctionAnnulus)  # fmt: skip
    return (machine.housing, *(machine.table(each) for each in tables if machine.has_table(each)))


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


def wrench_pressure_by_motion(
    results: xr.Dataset,
    cases: Mapping[CaseKey, Case],
    source_of_wrench: Mapping[str, str],
    sound: ForceSound,
) -> dict[CaseKey, dict[str, ComplexArray]]:
    """Compute the measured pressure of wrenches by motion, (receiver, 6, order), Pa.

    Parameters
    ----------
    results : with `velocity_order` and `order_frequency` of the cases; of a single option where the
        cases are those of the published level
    cases : with their machines
    source_of_wrench : by the wrench's name
    sound : measured pressure per force
    """
    pressure: dict[CaseKey, dict[str, ComplexArray]] = {}
    options = results["option"].values.tolist()
    for key, case in cases.items():
        option = key[1] if key[1] in options else options[0]
        of_case = results.sel(speed=key[0], option=option)
        velocity = of_case["velocity_order"].transpose("source", "dof", "order")
        vectors = sound.of(on_mounts(case.machine))(of_case["order_frequency"].values)
        by_source: dict[str, ComplexArray] = {}
        for name, of_wrench in zip(velocity["source"].values, velocity.values, strict=True):
            source = source_of_wrench[str(name)]
            by_source[source] = by_source.get(source, 0.0) + of_wrench * vectors
        pressure[key] = by_source
    return pressure
