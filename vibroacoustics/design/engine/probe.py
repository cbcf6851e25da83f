"""One design before anything moves: loads of all sources and the body on its mounts."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from ...base.arrays import Array, ComplexArray
from ...base.errors import ParameterError
from ...base.progress import no_progress
from ...machine.cases import Cases
from ...machine.machine import Machine
from ...machine.source import Shared
from ...mechanics.added import InsertionLoss
from ...mechanics.loads import Lines, Loads, PortLoads, in_shell, lines_of, summed
from ...mechanics.ports import BodyPort, Port
from ...sources.cases import cases_of, loaded_cases, wrench_lines
from ...study.samples import with_sample
from ...study.sampling import Sample
from ...study.study import Study
from ...transfer.machine import MachineOnMounts, on_mounts
from ...uncertainty.sampled_cases import sampled_cases, sampled_machine
from .layout import Layout, RandomLoad

Parts = Mapping[str, ComplexArray]
NO_LOSS: Final = InsertionLoss(np.zeros(0), np.zeros(0))


@dataclass(frozen=True)
class LoadsOfDesign:
    """Loads of all sources of a design.

    Attributes
    ----------
    layout : ports, lines and random loads by speed
    by_speed : arrays by name, one mapping a speed; see `Probe`
    """

    layout: tuple[Layout, ...]
    by_speed: tuple[Parts, ...]

    @property
    def nbytes(self) -> int:
        """Bytes of its arrays."""
        return _bytes_of(self.by_speed)


@dataclass(frozen=True)
class Stand:
    """Body of a design on its mounts.

    Attributes
    ----------
    by_speed : stiffness added to the body at the lines, by speed; see `Probe`
    body : matrices of the body; see `Probe`
    """

    by_speed: tuple[Parts, ...]
    body: Parts

    @property
    def nbytes(self) -> int:
        """Bytes of its arrays."""
        return _bytes_of((*self.by_speed, self.body))


def _bytes_of(groups: Iterable[Parts]) -> int:
    return sum(np.asarray(array).nbytes for parts in groups for array in parts.values())


@dataclass(frozen=True)
class Probe:
    """Loads and body of a design at each speed, before its motion is solved.

    Attributes
    ----------
    layout : lines, ports and random loads by speed
    by_speed : arrays by name, one mapping a speed, of the shapes
        wrench (order, motion): load of the moving parts on the bodies
        load (line, source, motion): on the bodies, the one on the feet first
        shell (line, source, component): on the ports in the shell
        random (value,): densities of random loads behind the insertion loss, one after another,
        each of shape (line, force, force)
        factor (line,): what the option's insertion loss leaves of the pressure
        and one of shape () for each reported figure
        and, where stiffness changes over frequency or loss is viscous, what is added to it:
        added (line, motion, motion), foot_added (line, foot, 3, motion)
    body : arrays by name, of the shapes
        mass, stiffness (motion, motion): complex with the structural loss
        foot (foot, 3, motion): force into each foot per motion
        (a nominal machine has one source: all together)
    """

    layout: tuple[Layout, ...]
    by_speed: tuple[Parts, ...]
    body: Parts

    @classmethod
    def of(cls, loads: LoadsOfDesign, stand: Stand) -> "Probe":
        """Join the loads of a design and its body."""
        pairs = zip(loads.by_speed, stand.by_speed, strict=True)
        return cls(loads.layout, tuple({**part, **added} for part, added in pairs), stand.body)

    def groups(self) -> tuple[Parts, ...]:
        """Arrays by name of each speed, last those of the body."""
        return (*self.by_speed, self.body)


def probe(study: Study, option: str) -> Probe:
    """Compute the loads and the body of the nominal machine of a study with one of its options.

    Parameters
    ----------
    study : study with its options `none` and the requested one
    option : name of the requested option
    """
    loads = loads_of_design(study, option, None, Shared())
    return Probe.of(loads, stand_of_design(study, option, None, loads.layout))


def loads_of_design(
    study: Study, option: str, sample: Sample | None, shared: Shared
) -> LoadsOfDesign:
    """Compute the loads of a study with one of its options.

    Parameters
    ----------
    study : study with the values of a design, its options `none` and the requested one
    option : name of the requested option
    sample : sampled values by table and field; none for the nominal machine and all sources
        together
    shared : results shared with other designs of the same sample
    """
    cases = _cases(study, option, sample, shared)
    speeds, together = study.operation.speed_rpm, sample is None
    each = [_of_case(study, option, cases, speed, together) for speed in speeds]
    layouts, parts = zip(*each, strict=True)
    return LoadsOfDesign(layouts, parts)


def stand_of_design(
    study: Study, option: str, sample: Sample | None, layout: tuple[Layout, ...]
) -> Stand:
    """Compute the matrices of the body of a study with one of its options.

    Parameters
    ----------
    study, option, sample : see `loads_of_design`
    layout : layout of the loads, by speed
    """
    body = on_mounts(machine_of_design(study, option, sample, with_bodies=True))
    added = tuple(_over_frequency(body, speed.hertz) for speed in layout)
    return Stand(added, body_matrices(body))


def machine_of_design(
    study: Study, option: str, sample: Sample | None, with_bodies: bool
) -> Machine:
    """Return the machine of a study as one of its options leaves it.

    Parameters
    ----------
    study, option, sample : see `loads_of_design`
    with_bodies : whether it carries the bodies that the option attaches
    """
    chosen = study.options[option]
    changed, values = chosen.applied_to(study.machine), {} if sample is None else sample
    if with_bodies:
        return sampled_machine(changed, study.machine, chosen, values)
    return with_sample(changed, study.machine, values)


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
    study: Study, option: str, cases: Cases, speed_rpm: float, together: bool
) -> tuple[Layout, dict[str, ComplexArray]]:
    """Loads of one speed; all sources as one where they are wanted together."""
    key = speed_rpm, option
    case, loads, wrenches = cases.cases[key], cases.loads[key], cases.wrenches[key]
    held = study.highest_order(speed_rpm)
    highest = max(held, case.maximum_order) if study.drives_shell else held
    lines = lines_of(loads, case.shaft_frequency_hz, highest, wrenches)
    loss = study.options[option].insertion_loss() or NO_LOSS
    layout, random = _layout(lines, loads, highest, loss, together)
    figures = {**case.revolution.figures, **case.added.figures}
    for load in loads.values():
        figures |= load.figures
    names, size = case.machine.body_names, lines.frequency_hz.size
    on_body = np.stack([_on_bodies(names, load, size) for load in lines.loads.values()], axis=1)
    on_shell = np.stack([_on_shell(layout, load, size) for load in lines.loads.values()], axis=1)
    if together:
        on_body, on_shell = (part.sum(axis=1, keepdims=True) for part in (on_body, on_shell))
    return layout, {
        "wrench": _on_bodies(names, summed(wrenches.values()), held + 1)[1:],
        "load": on_body[1:],
        "shell": on_shell[1:],
        "random": random,
        "factor": loss.amplitude_factor(lines.frequency_hz)[1:].astype(complex),
        **{name: np.asarray(complex(value)) for name, value in figures.items()},
    }


def _layout(
    lines: Lines, loads: Mapping[str, Loads], highest: int, loss: InsertionLoss, together: bool
) -> tuple[Layout, ComplexArray]:
    """Return the layout of loads, and the densities of random loads, shape (value,)."""
    ports: dict[Port, None] = {}
    for on_ports in lines.loads.values():
        ports |= dict.fromkeys(in_shell(on_ports))
    random, densities = [], [np.zeros(0, dtype=complex)]
    for number, load in enumerate(loads.values()):
        for part in load.noise:
            random.append(RandomLoad.of(0 if together else number, part))
            density = part.density * loss.power_factor(part.frequency_hz)
            densities.append(np.moveaxis(density, -1, 0).ravel())
    line = np.arange(1, lines.frequency_hz.size)
    order = np.where(line <= highest, line, 0)
    hertz = tuple(lines.frequency_hz[1:].tolist())
    layout = Layout(hertz, tuple(order.tolist()), tuple(ports), tuple(random))
    return layout, np.concatenate(densities)


def _on_bodies(names: tuple[str, ...], loads: PortLoads, lines: int) -> ComplexArray:
    """Loads on the bodies, about the centre of mass of each, shape (line, motion)."""
    load = np.zeros((lines, len(names), 6), dtype=complex)
    for port, amplitudes in loads.items():
        if not isinstance(port, BodyPort):
            continue
        if port.name not in names:
            raise ParameterError(f"port {port.name}: the machine has none")
        load[:, names.index(port.name)] += amplitudes.T
    return load.reshape(lines, -1)


def _on_shell(layout: Layout, loads: PortLoads, lines: int) -> ComplexArray:
    """Loads on the ports in the shell, shape (line, component)."""
    rows = layout.components
    load = np.zeros((lines, sum(len(port.components) for port in rows)), dtype=complex)
    for port, amplitudes in in_shell(loads).items():
        load[:, rows[port]] += amplitudes.T
    return load


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
    if all(mount.over_frequency is None for mount in isolation.bushings) and not viscous.any():
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
