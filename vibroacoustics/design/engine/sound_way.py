"""The way from motion and loads to the microphones, made by the pipeline's stages."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Final

import numpy as np

from ...base.arrays import Array, ComplexArray
from ...base.decibel import power_of_level
from ...base.hashing import canonical_json, sha256
from ...base.progress import no_progress
from ...levels.weighting import WEIGHTING
from ...machine.machine import Machine
from ...mechanics.loads import Lines, Loads, in_shell
from ...radiation.given import Radiation
from ...radiation.pressure import pressure_per_shell_velocity
from ...radiation.transfer_vectors import pressure_per_velocity
from ...stages.shell import shell_path
from ...study.study import Study
from ...transfer.bending import bending_shell
from ...transfer.load_path import LoadPath
from ...transfer.machine import on_mounts
from ...transfer.observers import Observers
from ...transfer.path import ShellPath

Noise = list[tuple[Array, Array]]
"""Frequencies, Hz, shape (frequency,), and mean squares, shape (receiver, frequency), Pa²."""
_VECTORS: Final = ("transfer_vector", "pattern_transfer_vector")


@dataclass(frozen=True)
class SoundWay:
    """What turns velocity and loads into pressure.

    Attributes
    ----------
    key : hash of what it is made of
    content : hash of the transfer vectors
    receivers : number of them
    microphones : pressure per velocity of the rigid motions and, where a source drives it, of the
        shell's modes
    highest_hz : of the transfer vectors; higher lines are silent
    shell : elastic modes of the shell; none where no source drives it
    """

    key: str
    content: str
    receivers: int
    microphones: Observers
    highest_hz: float
    shell: ShellPath | None

    def per_velocity(self, frequency_hz: Array) -> ComplexArray:
        """Pressure per velocity of the rigid motions, shape (receiver, 6, line), Pa s/m."""
        return self.microphones.rigid(np.minimum(frequency_hz, self.highest_hz))

    def besides_rigid(
        self, machine: Machine, lines: Lines, loads: Mapping[str, Loads]
    ) -> tuple[ComplexArray, Noise]:
        """Pressure of what bends the shell, (receiver, line), and random loads."""
        shape = (self.receivers, lines.frequency_hz.size)
        other: ComplexArray = np.zeros(shape, dtype=complex)
        shell = None if self.shell is None else bending_shell(machine, self.shell)
        path = LoadPath(on_mounts(machine), shell)
        for load in lines.loads.values():
            other = other + path.observed(self.microphones, in_shell(load), lines.frequency_hz)
        noise = [
            (part.frequency_hz, path.noise_power(self.microphones, part))
            for one in loads.values()
            for part in one.noise
        ]
        return other, noise

    def weighted(self, noise: Sequence[tuple[Array, Array]]) -> ComplexArray:
        """A-weighted mean square of random loads, shape (receiver,), Pa²."""
        total = np.zeros(self.receivers, dtype=complex)
        for frequency, power in noise:
            total += power @ power_of_level(WEIGHTING["A"](frequency))
        return total


@dataclass
class Ways:
    """Ways of the designs, each made once for all designs that share it.

    Attributes
    ----------
    radiation : gives the transfer vectors
    """

    radiation: Radiation
    _known: dict[str, SoundWay] = field(default_factory=dict, repr=False)

    def __call__(self, study: Study) -> SoundWay:
        """The way of a study."""
        key = sha256(canonical_json(_material(study)).encode())
        if key not in self._known:
            self._known[key] = self._made(study, key)
        return self._known[key]

    def of(self, key: str) -> SoundWay:
        """A way that was made before."""
        return self._known[key]

    def _made(self, study: Study, key: str) -> SoundWay:
        path = shell_path(study)
        motions = () if path is None else path.modes
        radiated, _ = self.radiation(study, no_progress, motions)
        vectors = radiated["transfer_vector"]
        return SoundWay(
            key,
            sha256(b"".join(v.values.tobytes() for n, v in radiated.items() if n in _VECTORS)),
            vectors.sizes["receiver"],
            Observers(
                pressure_per_velocity(vectors),
                None if path is None else pressure_per_shell_velocity(radiated),
            ),
            float(vectors["frequency"].max()),
            path,
        )


def _material(study: Study) -> dict[str, object]:
    """What the way consists of, as JSON values; tables of a rigid machine that it ignores not."""
    settings = study.parameters()
    material = {name: settings[name] for name in ("receivers", "radiation", "shell_modes")}
    machine = settings["machine"]
    kept = ("shell",)
    if study.drives_shell:
        kept = tuple(
            name
            for name in machine
            if name
            not in {
                "mounts",
                "feet",
                "mount_stiffness",
                "floor",
                "floor_mobility",
                "overall_noise",
                "remainder",
            }
        )
    return {**material, **{name: machine[name] for name in kept}}
