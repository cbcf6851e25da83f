"""Switching off: run-down of the bare machine, forces, sound and feet against steady running."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, Final

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import mean_square_level
from ..base.errors import ParameterError
from ..base.units import shaft_frequency_hz
from ..base.vocabulary import AXES, check, stamp, stamped
from ..machine.machine import Machine
from ..orders import OrderMap, angular_resample, from_angle, order_map
from ..radiation.pressure import pressure_per_shell_velocity
from ..radiation.transfer_vectors import pressure_per_velocity
from ..study.study import Study
from ..transfer import MachineOnMounts
from ..transfer.bending import bending_shell
from ..transfer.observers import Observers
from ..transfer.path import ShellPath
from ..transfer.transient import LOAD_SAMPLES, RESULT_SAMPLES
from .coasting import RunDown
from .event import FADE_S, STEADY_S, Clock, StoppingEvent, StopThroughShell, stopping_event
from .stops import Stops

MAP_REVOLUTIONS: Final = 8
"""Revolutions in a block of the order map: orders 0.19 apart are separated."""
KERNEL_REVOLUTIONS: Final = 2
"""Lost to the resampling's kernel, which spans 1.6 for the orders below."""
MAP_ORDER: Final = 4
MAP_SAMPLES: Final = 32
"""Samples of the run-down per revolution at full speed, for the order map."""


def stopping_order_map(stops: Stops, speed_rpm: float) -> xr.Dataset:
    """Order map of a stop without gas load; empty where it lasts too few revolutions or too long.

    A stop from the highest speed runs through all others. Under load it is over within a few
    revolutions, too few to separate orders.

    Parameters
    ----------
    stops : stops of the machine
    speed_rpm : before switch-off
    """
    no_gas = stops.stopping.model_copy(update={"gas_share_ratio": 0.0})
    rate_hz = MAP_SAMPLES * shaft_frequency_hz(speed_rpm)
    if no_gas.friction_torque_n_m == 0.0:  # it would never stop
        return xr.Dataset()
    try:
        run = replace(stops, stopping=no_gas, after=None).run_down(speed_rpm, rate_hz, 0)
    except ParameterError:  # friction alone takes too long
        return xr.Dataset()
    if run.crank_angle_rad[-1] < 2.0 * np.pi * (MAP_REVOLUTIONS + KERNEL_REVOLUTIONS):
        return xr.Dataset()
    return _labelled(_spectra(run, rate_hz))


def _spectra(run: RunDown, rate_hz: float) -> OrderMap:
    motion = from_angle(run.time_s, run.crank_angle_rad)
    signal = angular_resample(run.force_n.sum(axis=0), rate_hz, motion, MAP_ORDER)
    return order_map(signal, 1.5 / MAP_REVOLUTIONS, overlap_ratio=0.75)


def _labelled(spectra: OrderMap) -> xr.Dataset:
    coords = {
        "axis": list(AXES),
        "stopping_block": np.arange(spectra.time_s.size),
        "map_order": spectra.order,
        "stopping_block_time": ("stopping_block", spectra.time_s),
        "stopping_block_speed": ("stopping_block", 60.0 * spectra.shaft_frequency_hz),
    }
    labelled = stamp("stopping_order_map", np.abs(spectra.amplitude), coords)
    return check(xr.Dataset({"stopping_order_map": labelled}))


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
