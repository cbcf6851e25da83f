"""Reported figures of what tones do to the feet."""

from collections.abc import Mapping
from dataclasses import replace

from ..machine.machine import Machine
from ..mechanics.loads import Loads
from .machine import largest_foot_force_n, on_mounts


def with_foot_figures(machine: Machine, loads: Mapping[str, Loads]) -> dict[str, Loads]:
    """Loads by source with the figures of the largest foot force of their tones.

    Parameters
    ----------
    machine : on whose mounts they act
    loads : by source
    """
    body = on_mounts(machine)

    def figures(load: Loads) -> dict[str, float]:
        return {
            tone.figure: largest_foot_force_n(body, tone)
            for tone in load.tones
            if tone.figure is not None
        }

    return {
        name: replace(load, figures={**load.figures, **figures(load)})
        for name, load in loads.items()
    }
