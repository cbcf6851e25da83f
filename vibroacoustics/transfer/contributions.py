"""The loads of one case, path by path, to sound at the receivers; nothing is summed."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from ..base.arrays import Array, ComplexArray, IndexArray
from ..base.decibel import amplitude_of_level
from ..base.vocabulary import RIGID_BODY_DOFS
from ..machine.cases import Cases
from ..machine.frame import PARTS, Part
from ..machine.machine import Machine
from ..machine.source import CaseKey, Shared
from ..mechanics.contributions import Contributions, NoiseContribution, PathName
from ..mechanics.loads import Lines, Loads, Noise, PortLoads, in_shell, lines_of
from ..mechanics.ports import HOUSING, WRENCH, BodyPort, Port
from ..mechanics.received_sound import NoisePower, ReceivedSound
from ..study.study import Study
from .bending import BendingShell, bending_shell, rows_of
from .load_path import LoadPath
from .machine import on_mounts
from .observers import Observers
from .path import ShellPath
from .shell_modes.projection import velocity_per_force


def by_motion(
    shell: BendingShell, observers: Observers, loads: PortLoads, frequency_hz: Array
) -> ComplexArray:
    """Pressure of all loads in the shell by radiating motion.

    The sum over the motions is `LoadPath.observed`.

    Parameters
    ----------
    shell : with one set of values
    observers : microphones
    loads : on ports in the shell, of all sources together, shape (component, line)
    frequency_hz : shape (line,)

    Returns
    -------
    complex peaks, shape (mode and then rigid motion, receiver, line), Pa
    """
    gain = amplitude_of_level(shell.variation.mobility_change_db)
    per_velocity = [gain * observers.of_modes(frequency_hz), observers.rigid(frequency_hz)]
    velocity = velocities(shell, loads, frequency_hz)
    return np.moveaxis(np.concatenate(per_velocity, axis=1) * velocity, 0, 1)


def velocities(shell: BendingShell, loads: PortLoads, frequency_hz: Array) -> ComplexArray:
    """Velocities of the shell's modes and then of its six rigid motions, (motion, line)."""
    on_parts = np.zeros((len(PARTS) * len(WRENCH), frequency_hz.size), dtype=complex)
    joined = np.zeros((len(shell.path.modes), frequency_hz.size), dtype=complex)
    beside = np.zeros_like(joined)
    for port, amplitudes in loads.items():
        if isinstance(port, Part):
            on_parts[rows_of(port)] = amplitudes
        else:
            forces = shell.modal_forces(port, frequency_hz)
            on_modes = joined if shell.frame_under(port) else beside
            on_modes += np.einsum("mcf,cf->mf", forces, amplitudes)
    if shell.frame is None:
        beside += shell.path.forces_of_parts()[..., 0] @ on_parts
        velocity: ComplexArray = np.zeros((len(joined) + 6, frequency_hz.size), dtype=complex)
    else:
        velocity = shell.frame.velocities(on_parts, joined, frequency_hz)
    velocity[:-6] += _moving(shell, frequency_hz) * beside
    return velocity


def _moving(shell: BendingShell, frequency_hz: Array) -> ComplexArray:
    """Velocity of each mode per generalised force."""
    natural_hz = shell.variation.frequency_factor_ratio * shell.path.natural_hz
    masses, loss = shell.path.modal_mass_kg, shell.loss_factor_ratio
    return velocity_per_force(natural_hz, masses, loss, frequency_hz)


Paths = dict[PathName, ComplexArray]
"""Pressure at the lines by path, (receiver, line)."""


def contributions(
    path: LoadPath,
    microphones: Observers,
    lines: Lines,
    loads: Mapping[str, Loads],
) -> Contributions:
    """Sound of one case by path; the sum over the paths is `LoadPath.observed`."""
    every: Paths = {}
    for source in loads:
        every |= _of_source(path, microphones, lines, source)
    pressure = {name: values for name, values in every.items() if values.any()}
    noise = [
        (per_force, part)
        for source, load in loads.items()
        for part in load.noise
        if part.density.any()  # key impacts
        and (per_force := _per_force(path, microphones, part, source))
    ]
    for per_force, _ in noise:
        for name, each in per_force.items():  # a path that only noise takes
            pressure.setdefault(name, np.zeros((len(each), len(lines.names)), dtype=complex))
    pressure = pressure or every  # of a machine without sound
    names = tuple(pressure)
    stacked = np.array([pressure[name] for name in names])
    of_noise = tuple(_of_noise(per_force, part, names) for per_force, part in noise)
    radiated = [
        _by_motion(path, microphones, lines, source, dict(zip(names, stacked, strict=True)))
        for source in loads
    ]
    modes = () if path.shell is None else path.shell.path.modes
    return Contributions(
        names, lines.frequency_hz, stacked, of_noise,
        (*RIGID_BODY_DOFS, *(mode.name for mode in modes)), tuple(loads),
        np.stack(radiated, axis=1),
    )  # fmt: skip


def _by_motion(
    path: LoadPath, microphones: Observers, lines: Lines, source: str, pressure: Paths
) -> ComplexArray:
    """Pressure of a source by the housing's motions and the shell's modes."""
    silent = np.zeros_like(next(iter(pressure.values())))
    rigid = np.array(
        [pressure.get(PathName(source, HOUSING.name, dof), silent) for dof in RIGID_BODY_DOFS]
    )
    if path.shell is None:
        return rigid
    loads = in_shell(lines.loads[source])
    loaded = np.flatnonzero(sum(load.any(axis=0) for load in loads.values()))
    of_shell = np.zeros((len(path.shell.path.modes) + 6, *silent.shape), dtype=complex)
    if loaded.size:
        at_lines = {port: load[:, loaded] for port, load in loads.items()}
        hertz = lines.frequency_hz[loaded]
        of_shell[..., loaded] = by_motion(path.shell, microphones, at_lines, hertz)
    return np.concatenate([rigid + of_shell[-6:], of_shell[:-6]])


def _of_source(
    path: LoadPath,
    microphones: Observers,
    lines: Lines,
    source: str,
) -> Paths:
    paths: Paths = {}
    for port, load in lines.loads[source].items():
        loaded = np.flatnonzero(load.any(axis=0))
        if not loaded.size:
            continue
        for path_name, rows, response in _paths(
            path, microphones, port, lines.frequency_hz, loaded
        ):
            name = PathName(source, *path_name)
            pressures = paths.setdefault(
                name, np.zeros((len(response), lines.frequency_hz.size), dtype=complex)
            )
            pressures[:, loaded] += np.einsum("rcf,cf->rf", response, load[rows][:, loaded])
    return paths


def _paths(
    path: LoadPath, microphones: Observers, port: Port, frequency_hz: Array, lines: IndexArray
) -> Iterator[tuple[tuple[str, str], IndexArray, ComplexArray]]:
    """Port and direction of each path, components that take it, pressure per load on these.

    Loads on rigid bodies take the housing's motions, all others their components.
    """
    components = np.array(port.components)
    if isinstance(port, BodyPort):
        rigid, velocity = path.by_motion(microphones, port, frequency_hz[lines])
        every = np.arange(components.size)
        for row, motion in enumerate(RIGID_BODY_DOFS):
            yield (HOUSING.name, motion), every, rigid[:, row, None] * velocity[row]
    elif path.shell is not None:
        response = path.response(microphones, [port], frequency_hz, lines)
        for direction in dict.fromkeys(port.components):
            rows = np.flatnonzero(components == direction)
            yield (port.name, direction), rows, response[:, rows]


def _per_force(path: LoadPath, microphones: Observers, noise: Noise, source: str) -> Paths:
    """Pressure per random force by path, shape (receiver, force, frequency)."""
    per_force: Paths = {}
    every = np.arange(noise.frequency_hz.size)
    for port, load in noise.loads.items():
        for path_name, rows, response in _paths(path, microphones, port, noise.frequency_hz, every):
            if load[rows].any():
                name, values = (
                    PathName(source, *path_name),
                    np.einsum("rcf,ci->rif", response, load[rows]),
                )
                per_force[name] = per_force[name] + values if name in per_force else values
    return per_force


def _of_noise(per_force: Paths, noise: Noise, names: tuple[PathName, ...]) -> NoiseContribution:
    """Mean squares by path: a* S a of its pressure a per random force, and Re{a* S Σ a}."""
    frequency = noise.frequency_hz
    step = frequency[1] - frequency[0]

    def drives(pressure: ComplexArray) -> ComplexArray:
        return np.asarray(np.einsum("ijf,rjf->rif", noise.density, pressure))

    def energy(pressure: ComplexArray, driven: ComplexArray) -> Array:
        return np.asarray(step * (pressure.conj() * driven).sum(axis=1).real)

    together = drives(np.sum([*per_force.values()], axis=0))
    return NoiseContribution(
        tuple(names.index(name) for name in per_force),
        frequency,
        np.array([energy(pressure, drives(pressure)) for pressure in per_force.values()]),
        np.array([energy(pressure, together) for pressure in per_force.values()]),
    )


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
