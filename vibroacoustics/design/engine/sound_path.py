"""Paths from motion and loads to the microphones, made by the pipeline's stages."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Final

import numpy as np

from ...base.arrays import Array, ComplexArray
from ...base.plain_bytes import canonical_json, sha256
from ...base.progress import no_progress
from ...levels.by_source import GAIN_BANDS, a_weight_by_band, membership
from ...machine.machine import Machine
from ...machine.shell_structure import ShellStructure, ShellVariation
from ...machine.source import Shared
from ...mechanics.ports import BodyPort, Port
from ...radiation.given import Radiation
from ...radiation.pressure import pressure_per_shell_velocity
from ...radiation.transfer_vectors import pressure_per_velocity
from ...stages.shell import shell_path
from ...study.study import Study
from ...transfer.bending import BendingShell, bending_shell
from ...transfer.contributions import Transmission
from ...transfer.load_path import LoadPath
from ...transfer.machine import on_mounts
from ...transfer.observers import Observers
from .layout import Layout, RandomLoad
from .memo import Budget

SHELL_BYTES: Final = 1_500_000
"""Memory of frame and gas in an elastic shell."""
_VECTORS: Final = ("transfer_vector", "pattern_transfer_vector")


@dataclass(frozen=True)
class RandomResponse:
    """Mean square pressure of random loads of a source per density of these.

    Attributes
    ----------
    source : number of the source
    per_density : shape (line, force times force, receiver), Pa² Hz per unit
    a_weight, member : share of each line in each gain band, A-weighted and not, shape (line, band)
    """

    source: int
    per_density: ComplexArray
    a_weight: Array
    member: Array


@dataclass(frozen=True)
class Responses:
    """Pressure per motion and load at the lines of one speed.

    Attributes
    ----------
    per_velocity : pressure per velocity of the rigid motions, shape (receiver, 6, line), Pa s/m
    per_load : pressure per load on the ports in the shell, shape (receiver, component, line), Pa/N
    random : responses to random loads
    """

    per_velocity: ComplexArray
    per_load: ComplexArray
    random: tuple[RandomResponse, ...]


@dataclass(frozen=True)
class SoundPath:
    """Path from velocity and loads to pressure.

    Attributes
    ----------
    content : hash of the transfer vectors
    transmission : microphones, and the elastic shell where a source drives it
    highest_hz : highest frequency of the transfer vectors, Hz; higher lines are silent
    """

    content: str
    transmission: Transmission
    highest_hz: float

    def path(self, machine: Machine) -> "PathOfDesign":
        """Return the path from the loads on a machine.

        Parameters
        ----------
        machine : machine with the values of a design, and with bodies of an option where loads
            act on these
        """
        shell = self.transmission.shell
        return PathOfDesign(self, machine, None if shell is None else bending_shell(machine, shell))


@dataclass(frozen=True)
class PathOfDesign:
    """Path from the loads of a design to the microphones; responses are kept by frequency.

    Attributes
    ----------
    sound_path : path from motion to the microphones
    machine : machine with the values of the design
    shell : elastic shell; none where it is rigid
    """

    sound_path: SoundPath
    machine: Machine
    shell: BendingShell | None
    _known: dict[tuple[Port, ...], dict[float, ComplexArray]] = field(
        default_factory=dict, repr=False
    )

    @property
    def nbytes(self) -> int:
        """Bytes of the responses so far and, roughly, of the shell."""
        by_ports = self._known.values()
        columns = sum(column.nbytes for columns in by_ports for column in columns.values())
        return columns + (0 if self.shell is None else SHELL_BYTES)

    def responses(self, layouts: Sequence[Layout]) -> tuple[Responses, ...]:
        """Compute the pressure per motion and load at each speed.

        Parameters
        ----------
        layouts : lines and ports by speed
        """
        shell = None
        if self.shell is not None:  # what it keeps is large, and few frequencies come again
            shell = replace(self.shell, _known=Shared(), _of_parts={})
        return tuple(self._of_speed(shell, layout) for layout in layouts)

    def _of_speed(self, shell: BendingShell | None, layout: Layout) -> Responses:
        hertz, rigid = layout.hertz, self.sound_path.transmission.microphones.rigid
        per_velocity = rigid(np.minimum(hertz, self.sound_path.highest_hz))
        per_load: ComplexArray = np.zeros((len(per_velocity), 0, hertz.size), dtype=complex)
        if layout.ports:
            per_load = self._per_load(shell, layout.ports, layout.frequency_hz)
        random = tuple(self._of_random(shell, load) for load in layout.random)
        return Responses(per_velocity, per_load, random)

    def _of_random(self, shell: BendingShell | None, load: RandomLoad) -> RandomResponse:
        hertz = np.array(load.frequency_hz)
        ports, matrices = zip(*load.loads, strict=True)
        per_load = self._per_load(shell, ports, load.frequency_hz)
        per_force = np.einsum("ocf,ci->ofi", per_load, np.concatenate(matrices))
        square = per_force.conj()[..., None] * per_force[..., None, :] * (hertz[1] - hertz[0])
        per_density = np.moveaxis(square.reshape(*square.shape[:2], -1), 0, -1)
        member = membership(hertz, GAIN_BANDS)
        return RandomResponse(load.source, per_density, a_weight_by_band(hertz), member)

    def _per_load(
        self, shell: BendingShell | None, ports: tuple[Port, ...], frequency_hz: Sequence[float]
    ) -> ComplexArray:
        """Pressure per load on ports, shape (receiver, component, line)."""
        columns = self._known.setdefault(ports, {})
        new = [hertz for hertz in frequency_hz if hertz not in columns]
        if new:
            computed = self._computed(shell, ports, np.array(new))
            columns.update(zip(new, np.moveaxis(computed, -1, 0), strict=True))
        return np.stack([columns[hertz] for hertz in frequency_hz], axis=-1)

    def _computed(
        self, shell: BendingShell | None, ports: tuple[Port, ...], hertz: Array
    ) -> ComplexArray:
        observers, lines = self.sound_path.transmission.microphones, np.arange(hertz.size)
        if shell is None or any(isinstance(port, BodyPort) for port in ports):
            return LoadPath(on_mounts(self.machine), shell).response(observers, ports, hertz)
        each = [shell.response(observers, port, hertz, lines) for port in ports]
        return np.concatenate(each, axis=1)


@dataclass
class SoundPaths:
    """Paths of the designs, each made once for all designs that share it.

    Attributes
    ----------
    radiation : computes the transfer vectors
    criteria : values of criteria by design, which all samples of the machine share
    budget : memory of the results of designs of all samples
    """

    radiation: Radiation
    criteria: Shared = field(default_factory=Shared, repr=False)
    budget: Budget = field(default_factory=Budget, repr=False)
    _known: dict[str, SoundPath] = field(default_factory=dict, repr=False)

    def __call__(self, study: Study) -> SoundPath:
        """Return the path of a study; those of designs differ in shell and modes alone."""
        machine = study.machine
        material: list[object] = [machine.shell.model_dump(mode="json")]
        if machine.has_table(ShellStructure):
            structure = machine.table(ShellStructure)
            of_modes = (*structure.changes_modes, "span_m")
            material += [getattr(structure, name) for name in of_modes]
        if machine.has_table(ShellVariation):
            material.append(machine.table(ShellVariation).frequency_factor_ratio)
        key = canonical_json([*material, [item.name for item in study.ranges]])
        if key not in self._known:
            self._known[key] = self._made(study)
        return self._known[key]

    def _made(self, study: Study) -> SoundPath:
        path = shell_path(study)
        motions = () if path is None else path.modes
        radiated, _ = self.radiation(study, no_progress, motions)
        vectors = radiated["transfer_vector"]
        modes = None if path is None else pressure_per_shell_velocity(radiated)
        return SoundPath(
            sha256(b"".join(v.values.tobytes() for n, v in radiated.items() if n in _VECTORS)),
            Transmission(study, Observers(pressure_per_velocity(vectors), modes), path),
            float(vectors["frequency"].max()),
        )
