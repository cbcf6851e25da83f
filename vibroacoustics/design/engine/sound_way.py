"""The way from motion and loads to the microphones, made by the pipeline's stages."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Final

import numpy as np

from ...base.arrays import Array, ComplexArray
from ...base.hashing import canonical_json, sha256
from ...base.progress import no_progress
from ...levels.by_source import GAIN_BANDS, a_weight_by_band, membership
from ...machine.machine import Machine
from ...machine.source import Shared
from ...mechanics.added import InsertionLoss
from ...mechanics.loads import Lines, Loads, in_shell
from ...radiation.given import Radiation
from ...radiation.pressure import pressure_per_shell_velocity
from ...radiation.transfer_vectors import pressure_per_velocity
from ...stages.shell import shell_path
from ...study.study import Study
from ...transfer.observers import Observers
from ...transfer.received import Transmission

_VECTORS: Final = ("transfer_vector", "pattern_transfer_vector")


@dataclass(frozen=True)
class SoundWay:
    """What turns velocity and loads into pressure.

    Attributes
    ----------
    key : hash of what it is made of
    content : hash of the transfer vectors
    receivers : number of them
    transmission : microphones, and the elastic shell where a source drives it
    highest_hz : of the transfer vectors; higher lines are silent
    """

    key: str
    content: str
    receivers: int
    transmission: Transmission
    highest_hz: float

    def per_velocity(self, frequency_hz: Array) -> ComplexArray:
        """Pressure per velocity of the rigid motions, shape (receiver, 6, line), Pa s/m."""
        return self.transmission.microphones.rigid(np.minimum(frequency_hz, self.highest_hz))

    def besides_rigid(
        self,
        machine: Machine,
        lines: Lines,
        loads: Mapping[str, Loads],
        loss: InsertionLoss,
        shared: Shared,
    ) -> tuple[ComplexArray, Array, Array]:
        """Compute the sound of each source that does not come of the rigid motions.

        Returns
        -------
        pressure of what bends the shell, shape (source, receiver, line), Pa, and mean squares of
        random loads, A-weighted and unweighted, shape (source, receiver, gain band), Pa²
        """
        path = self.transmission.path(shared, machine, loads)
        microphones, hertz = self.transmission.microphones, lines.frequency_hz
        other = np.zeros((len(loads), self.receivers, hertz.size), dtype=complex)
        noise = np.zeros((len(loads), self.receivers, len(GAIN_BANDS)))
        thirds = np.zeros_like(noise)
        for number, (source, load) in enumerate(loads.items()):
            other[number] += path.observed(microphones, in_shell(lines.loads[source]), hertz)
            for part in load.noise:
                power = path.noise_power(microphones, part)
                power = power * loss.power_factor(part.frequency_hz)
                noise[number] += power @ a_weight_by_band(part.frequency_hz)
                thirds[number] += power @ membership(part.frequency_hz, GAIN_BANDS)
        return other, noise, thirds


@dataclass
class Ways:
    """Ways of the designs, each made once for all designs that share it.

    Attributes
    ----------
    radiation : gives the transfer vectors
    criteria : values of criteria by design, which all samples of the machine share
    """

    radiation: Radiation
    criteria: Shared = field(default_factory=Shared, repr=False)
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
        modes = None if path is None else pressure_per_shell_velocity(radiated)
        return SoundWay(
            key,
            sha256(b"".join(v.values.tobytes() for n, v in radiated.items() if n in _VECTORS)),
            vectors.sizes["receiver"],
            Transmission(study, Observers(pressure_per_velocity(vectors), modes), path),
            float(vectors["frequency"].max()),
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
