"""The loads of one case, path by path, to sound at the receivers; nothing is summed."""

from collections.abc import Iterator, Mapping
from typing import Final

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..base.vocabulary import RIGID_BODY_DOFS
from ..mechanics.contributions import Contributions, NoiseContribution, PathName
from ..mechanics.loads import PARTS, YOKE_ORDERS, Lines, Loads, Noise
from .force_sound import of_body
from .machine import MachineOnMounts
from .radiating_motions import by_motion, motion_names
from .sound_path import BendingShell, SoundPath

HOUSING: Final = "housing"
YOKE: Final = "stator_yoke"
PART_DIRECTIONS: Final = ("fx", "fy", "fz", "mx", "my", "mz")
FLOW: Final = "flow"
Paths = dict[PathName, ComplexArray]
"""Pressure at the lines by path, (receiver, line)."""


def contributions(
    path: SoundPath,
    body: MachineOnMounts,
    lines: Lines,
    loads: Mapping[str, Loads],
    of_wrenches: Mapping[str, ComplexArray],
) -> Contributions:
    """Sound of one case by path; the sum over the paths is `SoundPath.pressure` and the wrenches'.

    Parameters
    ----------
    path : from loads to the receivers
    body : on whose mounts the rigid loads act
    lines : of all sources
    loads : by source; of them the noise
    of_wrenches : pressure of the wrenches over crank angle by source, at orders from zero and by
        the housing's motion, shape (receiver, 6, order), Pa
    """
    pressure: Paths = {}
    for source in loads:
        by_path = _of_housing(path, body, lines, source, of_wrenches.get(source))
        by_path |= {} if path.shell is None else _through_shell(path.shell, lines, source)
        pressure |= {name: values for name, values in by_path.items() if values.any()}
    if path.shell is not None:
        for source, name in _noisy(loads):  # a path that only noise takes
            pressure.setdefault(PathName(source, *name), _silence(pressure, lines))
    names = tuple(pressure)
    noise = [
        _of_noise(path.shell, part, names, source)
        for source, load in loads.items()
        for part in load.noise
        if path.shell is not None and part.density.any()
    ]
    stacked = np.array([pressure[name] for name in names])
    motions, radiated = _by_motion(path, lines, names, stacked)
    return Contributions(names, lines.frequency_hz, stacked, tuple(noise), motions, radiated)


def _by_motion(
    path: SoundPath, lines: Lines, names: tuple[PathName, ...], pressure: ComplexArray
) -> tuple[tuple[str, ...], ComplexArray]:
    """Names of the housing's motions and the shell's modes, and the pressure of each."""
    rows = [[name[1:] == (HOUSING, motion) for name in names] for motion in RIGID_BODY_DOFS]
    rigid = np.array([pressure[row].sum(axis=0) for row in rows])
    if path.shell is None:
        return RIGID_BODY_DOFS, rigid
    of_shell = by_motion(path.shell, lines)
    modes, as_body = of_shell[:-6], of_shell[-6:]
    return (*RIGID_BODY_DOFS, *motion_names(path.shell)), np.concatenate([rigid + as_body, modes])


def _silence(pressure: Paths, lines: Lines) -> ComplexArray:
    """No line, at as many receivers as the others have."""
    receivers = len(next(iter(pressure.values()))) if pressure else 1
    return np.zeros((receivers, lines.frequency_hz.size), dtype=complex)


def _of_housing(
    path: SoundPath,
    body: MachineOnMounts,
    lines: Lines,
    source: str,
    of_wrench: ComplexArray | None,
) -> Paths:
    """By motion of the housing as a rigid body."""
    frequency = lines.frequency_hz
    on_shell = lines.on_shell.get(source, np.zeros_like(lines.rigid[source]))
    velocity = body.response(lines.rigid[source].T, frequency, on_shell.T).velocity
    by_motion = of_body(path.rigid, body)(frequency) * velocity.T
    if of_wrench is not None:
        held = min(of_wrench.shape[-1], frequency.size)
        by_motion[..., :held] += of_wrench[..., :held]
    return {
        PathName(source, HOUSING, motion): by_motion[:, row]
        for row, motion in enumerate(RIGID_BODY_DOFS)
    }


def _through_shell(shell: BendingShell, lines: Lines, source: str) -> Paths:
    """By load on a part, flow into a space of gas and wave around the yoke."""
    frequency, on_parts = lines.frequency_hz, lines.on_parts[source]
    paths: Paths = {}
    if on_parts.any():
        per_load = shell.per_load(frequency)
        for part, component in zip(*np.nonzero(on_parts.any(axis=-1)), strict=True):
            name = PathName(source, *_port(part, component))
            paths[name] = per_load[:, part, component] * on_parts[part, component]
    for flow in lines.flows.get(source, ()):
        name = PathName(source, flow.into, FLOW)
        paths[name] = paths.get(name, 0.0) + shell.of_gas(flow, frequency)
    if source in lines.on_yoke:
        around = shell.per_yoke_load(frequency) * lines.on_yoke[source]
        for row, order in enumerate(YOKE_ORDERS):
            paths[PathName(source, YOKE, f"wave {order}")] = around[:, row].sum(axis=1)
    return paths


def _noisy(loads: Mapping[str, Loads]) -> Iterator[tuple[str, tuple[str, str]]]:
    """Source, port and direction of all that noise loads."""
    for source, load in loads.items():
        for noise in load.noise:
            if not noise.density.any():  # keys that do not strike
                continue
            for part, component in zip(*np.nonzero(noise.on_parts.any(axis=-1)), strict=True):
                yield source, _port(part, component)


def _of_noise(
    shell: BendingShell, noise: Noise, names: tuple[PathName, ...], source: str
) -> NoiseContribution:
    """Mean squares by path: a* S a of its pressure a per random force, and Re{a* S Σ a}."""
    frequency = noise.frequency_hz
    step = frequency[1] - frequency[0]
    per_load = shell.per_load(frequency)

    def drives(pressure: ComplexArray) -> ComplexArray:
        return np.asarray(np.einsum("ijf,rjf->rif", noise.density, pressure))

    def energy(pressure: ComplexArray, driven: ComplexArray) -> Array:
        return np.asarray(step * (pressure.conj() * driven).sum(axis=1).real)

    ports = list(zip(*np.nonzero(noise.on_parts.any(axis=-1)), strict=True))
    per_force = [per_load[:, p, c, None] * noise.on_parts[p, c][:, None] for p, c in ports]
    together = drives(np.sum(per_force, axis=0))
    return NoiseContribution(
        tuple(names.index(PathName(source, *_port(p, c))) for p, c in ports),
        frequency,
        np.array([energy(pressure, drives(pressure)) for pressure in per_force]),
        np.array([energy(pressure, together) for pressure in per_force]),
    )


def _port(part: int, component: int) -> tuple[str, str]:
    return PARTS[part], PART_DIRECTIONS[component]
