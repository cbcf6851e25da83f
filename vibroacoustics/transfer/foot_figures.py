"""Forces of the feet on the floor by the loads of sources, and the figures that tones report."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..machine.machine import Machine
from ..machine.source import Case
from ..mechanics.loads import Loads, PortLoads, Tone, lines_of, summed
from .load_path import LoadPath
from .machine import MachineOnMounts, on_mounts
from .observers import feet


def foot_force(body: MachineOnMounts, loads: PortLoads, frequency_hz: Array) -> ComplexArray:
    """Force of each foot on the floor, complex peaks, shape (line, foot, axis), N.

    Parameters
    ----------
    body : on the feet
    loads : by port, shape (component, line)
    frequency_hz : shape (line,)
    """
    force = np.zeros((3 * len(body.stand.names), frequency_hz.size), dtype=complex)
    force += LoadPath(body).observed(feet(body), loads, frequency_hz)
    return np.asarray(force.T.reshape(frequency_hz.size, -1, 3))


def with_foot_figures(machine: Machine, loads: Mapping[str, Loads]) -> dict[str, Loads]:
    """Loads by source with the figures of the largest foot force of their tones."""
    body = on_mounts(machine)

    def largest_n(tone: Tone) -> float:
        by_port = {port: load[:, None] for port, load in tone.loads.items()}
        force = foot_force(body, by_port, np.array([tone.frequency_hz]))
        return float(np.max(np.linalg.norm(np.abs(force), axis=-1)))

    def figures(load: Loads) -> dict[str, float]:
        return {tone.figure: largest_n(tone) for tone in load.tones if tone.figure is not None}

    return {
        name: replace(load, figures={**load.figures, **figures(load)})
        for name, load in loads.items()
    }


def force_at_lines(
    case: Case,
    loads: Mapping[str, Loads],
    wrenches: Mapping[str, PortLoads],
    names: list[str],
) -> ComplexArray:
    """Force of each foot on the floor at the lines, all sources, shape (line, foot, axis), N."""
    orders = sum(name.startswith("order ") for name in names)
    lines = lines_of(loads, case.shaft_frequency_hz, orders - 1, wrenches)
    foot_n = foot_force(on_mounts(case.machine), summed(lines.loads.values()), lines.frequency_hz)
    force = np.zeros((len(names), *foot_n.shape[1:]), dtype=complex)
    force[[names.index(name) for name in lines.names]] = foot_n
    return force
