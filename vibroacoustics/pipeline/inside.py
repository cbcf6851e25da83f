"""Inner sources of a study: their sound at the receivers, with a band for what is not known."""

from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from typing import Final

import numpy as np
import xarray as xr

from .. import levels
from ..mechanics.added import Added, InsertionLoss
from ..mechanics.capabilities import OldhamRing
from ..mechanics.rotation import Array
from ..parameters.inside import Inside, InsideSettings
from ..parameters.machine import Machine
from ..parameters.study import Study
from ..radiation.machine_side import processors
from ..transfer import RigidBodyOnMounts
from .inner_draws import latin_hypercube
from .inner_keys import KEY_COMPONENTS, Complex, Operating
from .inner_levels import Heard, labelled_levels
from .inner_sound import (
    ShellPath,
    SourceSound,
    mode_pressures,
    pressure_per_load,
    rigid_pressures,
    source_sound,
    whole_octave_thirds,
)
from .inner_sources import InnerLoads, InnerSources
from .progress import Progress

MOVING_PARTS: Final = "moving_parts"


@dataclass(frozen=True)
class _Case:
    """What a draw needs of one speed and option, whatever the draw.

    Attributes
    ----------
    operating : the speed
    machine : as the option leaves it
    added : by the option
    insertion_loss : of the option
    moving_parts_pa : sound of the rigid machine's orders, shape (receiver, order)
    """

    operating: Operating
    machine: Machine
    added: Added
    insertion_loss: InsertionLoss | None
    moving_parts_pa: Complex


def inside_sound(
    study: Study,
    settings: InsideSettings,
    added: Mapping[tuple[float, str], Added],
    results: xr.Dataset,
    path: ShellPath,
    progress: Progress,
) -> xr.Dataset:
    """Sound of every source at every receiver, as assumed and as a band over the ranges.

    Parameters
    ----------
    study : speeds, options, overall level
    settings : of its inner sources
    added : by each option at each speed
    results : of the stages before, with the transfer vectors of the shell's modes
    path : the elastic shell
    progress : told of the advance
    """
    cases = _cases(study, results, settings, added)
    draws = [settings.inside, *latin_hypercube(settings)]
    bands = whole_octave_thirds(path.maximum_frequency_hz)
    heard: list[Heard] = []
    with ThreadPoolExecutor(processors()) as pool:  # the keys run without the interpreter's lock
        for found in pool.map(lambda inside: _Listener(results, path, bands, inside)(cases), draws):
            heard.append(found)
            progress("inner sources", len(heard), len(draws))
    return labelled_levels(study, results, heard, bands)


def _cases(
    study: Study,
    results: xr.Dataset,
    settings: InsideSettings,
    added: Mapping[tuple[float, str], Added],
) -> dict[tuple[float, str], _Case]:
    pressure = results["pressure_order"].sum("source")
    cases = {}
    for speed, line in zip(study.operation.speed_rpm, settings.line_frequency_hz, strict=True):
        operating = Operating(
            speed, line, study.radiation.maximum_frequency_hz, settings.key_revolutions
        )
        for name, option in study.options.items():
            at = {"speed": speed, "option": name}
            cases[speed, name] = _Case(
                operating,
                option.applied_to(study.machine),
                added[speed, name],
                option.insertion_loss(),
                pressure.sel(at).transpose("receiver", "order").values,
            )
    return cases


@dataclass(frozen=True)
class _Listener:
    """The way from the loads to the receivers with one set of values.

    Attributes
    ----------
    results : transfer vectors
    path : the elastic shell
    bands : third octaves
    inside : the values
    """

    results: xr.Dataset
    path: ShellPath
    bands: tuple[levels.Band, ...]
    inside: Inside
    _known: dict[bytes, Complex] = field(default_factory=dict, repr=False)

    def __call__(self, cases: Mapping[tuple[float, str], _Case]) -> Heard:
        """Sound and figures of every case."""
        sources = InnerSources(self.inside)
        found = {}
        for key, case in cases.items():
            loads = sources.loads(case.machine.require(OldhamRing), case.added, case.operating)
            body = _body(case.machine)
            sound = self._hears(case, loads, body)
            found[key] = sound, {**loads.facts, **_feet(body, loads)}
        return found

    def _hears(self, case: _Case, loads: InnerLoads, body: RigidBodyOnMounts) -> SourceSound:
        """Sound of all sources, the moving parts of the rigid machine among them."""
        frequency = loads.frequency_hz
        per_load = self._per_load(frequency)
        roll = rigid_pressures(self.results, frequency)[:, -1]  # about z
        per_moment = roll * _roll_velocity(body, frequency)
        factor = _left(case.insertion_loss, frequency)
        receivers, orders = case.moving_parts_pa.shape
        moving = np.zeros((receivers, frequency.size), dtype=complex)
        held = min(orders, case.operating.maximum_order + 1)  # silent beyond; other lines follow
        moving[:, :held] = case.moving_parts_pa[:, :held]
        pressure: dict[str, Complex] = {MOVING_PARTS: moving}
        for source, lines in loads.lines.items():
            elastic = np.einsum("rjcf,jcf->rf", per_load, lines.load, optimize=True)
            pressure[source] = factor * (elastic + per_moment * lines.roll_moment_n_m)
        noise = {
            source: [
                _left(case.insertion_loss, part.frequency_hz)
                * self._per_load(part.frequency_hz)[:, part.joint][:, KEY_COMPONENTS]
                for part in parts
            ]
            for source, parts in loads.noise.items()
        }
        return source_sound(loads, pressure, noise, self.bands)

    def _per_load(self, frequency_hz: Array) -> Complex:
        """Pressure per load on the joints, kept, as options share the frequencies."""
        key = frequency_hz.tobytes()
        if key not in self._known:
            inside = self.inside
            gain = 10.0 ** (inside.doubt.mobility_change_db / 20.0)
            self._known[key] = gain * pressure_per_load(
                self.path,
                mode_pressures(self.results, frequency_hz),
                frequency_hz,
                inside.shell.loss_factor_ratio,
                inside.doubt.frequency_factor_ratio,
            )
        return self._known[key]


def _left(loss: InsertionLoss | None, frequency_hz: Array) -> Array:
    """What is left of the pressure at each frequency."""
    return np.ones(frequency_hz.shape) if loss is None else loss.amplitude_factor(frequency_hz)


def _body(machine: Machine) -> RigidBodyOnMounts:
    return RigidBodyOnMounts(
        machine.housing, machine.mounts, -machine.shell.centre_of_mass_height_m
    )


def _roll_velocity(body: RigidBodyOnMounts, frequency_hz: Array) -> Complex:
    """Velocity about z per moment about z, shape (frequency,)."""
    return body.velocity(_moment_about_z(frequency_hz.size), frequency_hz)[:, -1]


def _moment_about_z(count: int) -> Complex:
    load = np.zeros((count, 6), dtype=complex)
    load[:, -1] = 1.0
    return load


def _feet(body: RigidBodyOnMounts, loads: InnerLoads) -> dict[str, float]:
    """Largest force into a foot by the motor's torque at twice the line frequency."""
    line = loads.line_name.index("2 x line")
    load = loads.lines["motor"].roll_moment_n_m[line] * _moment_about_z(1)
    force = body.foot_force(load, loads.frequency_hz[[line]])
    return {"foot_force_2x_line_n": float(np.max(np.linalg.norm(np.abs(force), axis=-1)))}
