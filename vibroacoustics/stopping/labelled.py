"""Switching off: run-down of the bare machine, forces, sound and feet against steady running."""

from collections.abc import Sequence
from typing import Any, Final

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import mean_square_level
from ..base.units import shaft_frequency_hz
from ..base.vocabulary import AXES, stamped
from ..machine.machine import Machine
from ..radiation.pressure import pressure_per_shell_velocity
from ..radiation.transfer_vectors import pressure_per_velocity
from ..study.study import Study
from ..transfer import MachineOnMounts
from ..transfer.bending import bending_shell
from ..transfer.observers import Observers
from ..transfer.path import ShellPath
from ..transfer.transient import LOAD_SAMPLES, RESULT_SAMPLES
from .coasting import RunDown
from .event import FADE_S, STEADY_S, Clock, StoppingEvent, stopping_event
from .orders import stopping_order_map
from .stops import Stops
from .through_shell import StopThroughShell

PHASES: Final = ("steady", "stopping")
REVOLUTIONS_BEFORE: Final = 5
"""Shown before switch-off, of the slowest speed. The first half stands for steady running; in the
second the forerunner of `transient` grows."""
SHOWN_AFTER_S: Final = 0.4
"""Shown after the last stop: three Fast time constants, two periods of the softest rocking."""


def stopping_variables(
    study: Study,
    machine: Machine,
    body: MachineOnMounts,
    results: xr.Dataset,
    path: ShellPath | None = None,
) -> xr.Dataset:
    """Run-down from each speed, without a balancer; force, moment, feet, sound, order map.

    Parameters
    ----------
    study : its speeds
    machine : moving parts, gas and stopping
    body : the machine on its mounts
    results : with the transfer vectors of the rigid motions, and of the shell's where it bends
    path : elastic shell; stops that turn back sound through it
    """
    speeds, turns_back = study.operation.speed_rpm, study.operation.turning_back
    stops = Stops.of(machine, turns_back)
    rate_hz = RESULT_SAMPLES * float(results["frequency"].values[-1])
    before_s = REVOLUTIONS_BEFORE / shaft_frequency_hz(min(speeds))
    lead_s = FADE_S + STEADY_S + before_s
    runs = [
        # One revolution more than the lead has, and one for the rounding to a sample.
        stops.run_down(speed, LOAD_SAMPLES * rate_hz, int(lead_s * shaft_frequency_hz(speed)) + 2)
        for speed in speeds
    ]
    clock = _clock(runs, rate_hz, before_s, lead_s)
    vectors = pressure_per_velocity(results["transfer_vector"])
    bending, microphones = None, Observers(vectors)
    if turns_back and path is not None:
        bending = bending_shell(machine, path)
        microphones = Observers(vectors, pressure_per_shell_velocity(results))
    events = [
        stopping_event(
            run,
            clock,
            body,
            vectors,
            None if bending is None else StopThroughShell(machine, bending, microphones, speed),
        )
        for speed, run in zip(speeds, runs, strict=True)
    ]
    axes = {
        "speed": list(speeds),
        "stopping_time": clock.time_s,
        "axis": list(AXES),
        "receiver": results["receiver"].values,
        "stopping_phase": list(PHASES),
    }
    histories, phases = _histories(events), _phases(events, clock.time_s)
    labelled = stamped({**_of_runs(runs), **histories, **phases}, axes)
    if turns_back:
        labelled = labelled.merge(stamped(_of_turning_back(runs), axes))
    return labelled.merge(stopping_order_map(stops, max(speeds)))


def _clock(runs: Sequence[RunDown], rate_hz: float, before_s: float, lead_s: float) -> Clock:
    """Times that show all stops."""
    after_s = max(run.stop_time_s for run in runs) + SHOWN_AFTER_S
    return Clock(
        rate_hz, round(before_s * rate_hz), round(after_s * rate_hz), round(lead_s * rate_hz)
    )


def _of_runs(runs: Sequence[RunDown]) -> dict[str, Any]:
    """Time and revolutions that each stop takes."""
    return {
        "stopping_duration": [run.stop_time_s for run in runs],
        "stopping_revolutions": [run.crank_angle_rad.max() / (2.0 * np.pi) for run in runs],
    }


def _of_turning_back(runs: Sequence[RunDown]) -> dict[str, Any]:
    """Angle that the shaft turns back, and the largest force of the brake around it."""
    return {
        "stopping_turned_back_angle": [run.turned_back_rad for run in runs],
        "stopping_brake_force": [run.brake_force_n.max() for run in runs],
    }


def _histories(events: Sequence[StoppingEvent]) -> dict[str, Array]:
    """Time histories that are kept."""
    names = ("shaft_speed", "force", "moment", "pressure", "fast_level")
    return {f"stopping_{name}": _of_events(events, name) for name in names}


def _phases(events: Sequence[StoppingEvent], time_s: Array) -> dict[str, Array]:
    """Greatest values in steady running and in the stop."""
    phases = (time_s < 0.5 * time_s[0], time_s >= 0.0)

    def greatest(values: Array) -> Array:
        """Return the greatest value over the times of each phase, shape (phase, ...)."""
        return np.stack([values[..., times].max(axis=-1) for times in phases])

    square = greatest(_of_events(events, "pressure") ** 2)
    return {
        "stopping_fast_maximum_level": greatest(_of_events(events, "fast_level")),
        "stopping_peak_level": mean_square_level(square, REFERENCE_PRESSURE_PA),
        "stopping_foot_force": greatest(_of_events(events, "foot_force")).max(axis=-1),
    }


def _of_events(events: Sequence[StoppingEvent], part: str) -> Array:
    return np.stack([getattr(event, part) for event in events])
