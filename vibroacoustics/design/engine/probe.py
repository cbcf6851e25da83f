"""One design before anything moves: forces of all sources and the body on its mounts."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from ...base.arrays import Array, ComplexArray, IndexArray
from ...base.progress import no_progress
from ...machine.cases import Cases
from ...machine.source import Case, Shared
from ...mechanics.added import InsertionLoss
from ...mechanics.loads import Lines, Loads, PortLoads, lines_of, summed
from ...mechanics.ports import BodyPort
from ...sources.cases import cases_of, loaded_cases, wrench_lines
from ...study.sampling import Sample
from ...study.study import Study
from ...transfer.machine import MachineOnMounts, on_mounts
from ...uncertainty.sampled_cases import sampled_cases
from .sound_way import SoundWay

Parts = Mapping[str, ComplexArray]
NO_LOSS: Final = InsertionLoss(np.zeros(0), np.zeros(0))


@dataclass(frozen=True)
class Probe:
    """What a design does at each speed, before its motion is solved.

    Attributes
    ----------
    frequency_hz : of the lines above 0 Hz, by speed, each of shape (line,)
    order : of the lines, 0 for tones that are none, likewise
    by_speed : arrays by name, one mapping a speed, of the shapes
        wrench (order, motion): load of the moving parts on the bodies
        load (line, source, motion): on the bodies, the one on the feet first
        other (line, source, receiver): pressure that does not come of the rigid motion, Pa
        noise (source, receiver, gain band): A-weighted mean square of random loads, Pa²
        thirds (source, receiver, gain band): unweighted mean square of random loads, Pa²
        factor (line,): what the option's insertion loss leaves of the pressure
        and one of shape () for each reported figure
        and, where stiffness changes over frequency or loss is viscous, what is added to it:
        added (line, motion, motion), foot_added (line, foot, 3, motion)
    body : arrays by name, of the shapes
        mass, stiffness (motion, motion): complex with the structural loss
        foot (foot, 3, motion): force into each foot per motion
        (a nominal machine has one source: all together)
    way : hash of what the way from motion to microphones consists of
    """

    frequency_hz: tuple[Array, ...]
    order: tuple[IndexArray, ...]
    by_speed: tuple[Parts, ...]
    body: Parts
    way: str

    def groups(self) -> tuple[Parts, ...]:
        """Arrays by name of each speed, last those of the body."""
        return (*self.by_speed, self.body)


def probe(
    study: Study,
    option: str,
    way_of: Callable[[Study], SoundWay],
    sample: Sample | None = None,
    shared: Shared | None = None,
) -> Probe:
    """Forces and body of a study with one of its options.

    Parameters
    ----------
    study : with the values of a design, its options `none` and the one asked for
    option : its name
    way_of : gives the way from motion to microphones
    sample : values by table and field; none for the nominal machine and all sources together
    shared : with other designs of the same sample

    Raises
    ------
    ParameterError, SolverError
        The design cannot be built, or not run.
    """
    shared = shared or Shared()
    cases = _cases(study, option, sample, shared)
    way = way_of(study)
    frequencies, orders, parts = [], [], []
    for speed in study.operation.speed_rpm:
        key = speed, option
        case, loads, wrenches = cases.cases[key], cases.loads[key], cases.wrenches[key]
        orders_held = study.highest_order(speed)
        highest = max(orders_held, case.maximum_order) if study.drives_shell else orders_held
        lines = lines_of(loads, case.shaft_frequency_hz, highest, wrenches)
        frequencies.append(lines.frequency_hz[1:])
        number = np.arange(1, lines.frequency_hz.size)
        orders.append(np.where(number <= highest, number, 0))
        part = _of_case(study, option, case, loads, lines, wrenches, way, shared)
        parts.append(part if sample is not None else _together(part))
    body = on_mounts(case.machine)
    added = [_over_frequency(body, frequency) for frequency in frequencies]
    by_speed = tuple({**part, **more} for part, more in zip(parts, added, strict=True))
    return Probe(tuple(frequencies), tuple(orders), by_speed, body_matrices(body), way.key)


def _cases(study: Study, option: str, sample: Sample | None, shared: Shared) -> Cases:
    """Cases of an option with their loads and the lines of their wrenches."""
    cases = {
        key: replace(case, shared=shared) for key, case in cases_of(study, no_progress).items()
    }
    if sample is None or study.operation.supply_frequency_hz is None:
        cases, loads = loaded_cases(study, cases)
    of_option = {key: case for key, case in cases.items() if key[1] == option}
    if sample is not None:
        return sampled_cases(Cases(of_option, {}, {}), study, sample, shared)
    wrenches = {
        key: wrench_lines(case, loads[key], study.highest_order(case.speed_rpm))
        for key, case in of_option.items()
    }
    return Cases(of_option, loads, wrenches)


def _of_case(
    study: Study,
    option: str,
    case: Case,
    loads: Mapping[str, Loads],
    lines: Lines,
    wrenches: Mapping[str, PortLoads],
    way: SoundWay,
    shared: Shared,
) -> dict[str, ComplexArray]:
    body = on_mounts(case.machine)
    loss = study.options[option].insertion_loss() or NO_LOSS
    other, noise, thirds = way.besides_rigid(case.machine, lines, loads, loss, shared)
    figures = {**case.revolution.figures, **case.added.figures}
    for load in loads.values():
        figures |= load.figures
    on_body = [_loaded(body, load, lines.frequency_hz.size) for load in lines.loads.values()]
    orders = study.highest_order(case.speed_rpm) + 1
    return {
        "wrench": _loaded(body, summed(wrenches.values()), orders)[1:],
        "load": np.stack(on_body, axis=1)[1:],
        "other": np.moveaxis(other, -1, 0)[1:],
        "noise": noise.astype(complex),
        "thirds": thirds.astype(complex),
        "factor": loss.amplitude_factor(lines.frequency_hz)[1:].astype(complex),
        **{name: np.asarray(complex(value)) for name, value in figures.items()},
    }


def _together(part: Parts) -> Parts:
    """All sources as one."""
    total = {name: part[name].sum(axis=1, keepdims=True) for name in ("load", "other")}
    total |= {name: part[name].sum(axis=0, keepdims=True) for name in ("noise", "thirds")}
    return {**part, **total}


def _loaded(body: MachineOnMounts, loads: PortLoads, lines: int) -> ComplexArray:
    """Loads on the bodies, about the centre of mass of each, shape (line, motion)."""
    on_bodies = {port: load for port, load in loads.items() if isinstance(port, BodyPort)}
    load = np.zeros((lines, len(body.isolation.bodies), 6), dtype=complex)
    for port, amplitudes in on_bodies.items():
        load[:, body.row(port)] += amplitudes.T
    return load.reshape(lines, -1)


def body_matrices(body: MachineOnMounts) -> dict[str, ComplexArray]:
    """Mass, stiffness and what the feet pass on; see `Probe.body`."""
    isolation, feet = body.isolation, len(body.stand.names)
    mounts = zip(isolation.bushings[:feet], isolation.bushing_motion, strict=False)
    foot = [
        (1.0 + 1j * mount.loss_factor_ratio) * (mount.in_frame(mount.stiffness) @ motion)[:3]
        for mount, motion in mounts
    ]
    stiffness = isolation.stiffness_matrix + 1j * isolation.structural_damping_matrix
    mass = isolation.mass_matrix.astype(complex)
    return {"mass": mass, "stiffness": stiffness, "foot": np.array(foot)}


def _over_frequency(body: MachineOnMounts, frequency_hz: Array) -> dict[str, ComplexArray]:
    """Stiffness that is added at the lines, with jωC; empty where it is constant."""
    isolation, feet = body.isolation, len(body.stand.names)
    size = 6 * len(isolation.bodies)
    viscous = isolation.damping_matrix
    if all(one.over_frequency is None for one in isolation.bushings) and not viscous.any():
        return {}
    added = 2j * np.pi * frequency_hz[:, None, None] * viscous
    foot = np.zeros((frequency_hz.size, feet, 3, size), dtype=complex)
    for number, mount in enumerate(isolation.bushings):
        if mount.over_frequency is not None:
            motion = isolation.bushing_motion[number, :3]
            per_motion = mount.added_stiffness(frequency_hz)[:, :, None] * motion
            added += motion.T @ per_motion
            if number < feet:
                foot[:, number] = per_motion
    return {"added": added, "foot_added": foot}
