"""Switching off: run-down of the bare machine, forces, sound and feet against steady running."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np
import xarray as xr

from .. import levels
from ..base.arrays import Array
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.errors import ParameterError
from ..base.units import shaft_frequency_hz
from ..base.vocabulary import AXES, check, stamp
from ..machine.machine import Machine
from ..machine.source import Shared
from ..machine.stopping import Stopping
from ..mechanics.moving_parts import MovingPart
from ..mechanics.rotation import uniform_crank_angle
from ..orders import angular_resample, from_angle, order_map
from ..sources.gas import gas_cycle
from ..stopping.coasting import RunDown, run_down
from ..stopping.event import (
    FADE_S,
    STEADY_S,
    Clock,
    StoppingEvent,
    stopping_event,
)
from ..study.study import Study
from ..transfer import RigidBodyOnMounts, SuspendedBlock
from ..transfer.transient import LOAD_SAMPLES, RESULT_SAMPLES
from .sound import pressure_per_velocity

SHIFTED: Final = ("orbiting_scroll", "brake", "oldham")
"""The set that the brake lets turn against pin and counterweights (thesis 6.4)."""
PATH_SAMPLES: Final = 256
"""Of the moving parts' paths, which are circles and a line."""
PHASES: Final = ("steady", "stopping")
REVOLUTIONS_BEFORE: Final = 5
"""Shown before switch-off, of the slowest speed. The first half stands for steady running; in the
second the forerunner of `transient` grows."""
SHOWN_AFTER_S: Final = 0.4
"""Shown after the last stop: three Fast time constants, two periods of the softest rocking."""
MAP_REVOLUTIONS: Final = 8
"""In a block of the order map: orders 0.19 apart are told from each other."""
KERNEL_REVOLUTIONS: Final = 2
"""Lost to the resampling's kernel, which spans 1.6 for the orders below."""
MAP_ORDER: Final = 4
MAP_SAMPLES: Final = 32
"""Samples of the run-down per revolution at full speed, for the order map."""


def stopping_sound(
    study: Study,
    machine: Machine,
    body: RigidBodyOnMounts | SuspendedBlock,
    results: xr.Dataset,
) -> xr.Dataset:
    """Run-down from each speed, without a balancer; force, moment, feet, sound, order map.

    Parameters
    ----------
    study : its speeds
    machine : moving parts, gas and stopping
    body : the machine on its mounts
    results : with the transfer vectors of the rigid motions
    """
    speeds = study.operation.speed_rpm
    stops = _Stops.of(machine)
    rate = RESULT_SAMPLES * float(results["frequency"].values[-1])
    before = REVOLUTIONS_BEFORE / shaft_frequency_hz(min(speeds))
    lead = FADE_S + STEADY_S + before
    runs = [
        # One revolution more than the lead has, and one for the rounding to whole samples.
        stops.run_down(speed, LOAD_SAMPLES * rate, int(lead * shaft_frequency_hz(speed)) + 2)
        for speed in speeds
    ]
    after = max(run.stop_time_s for run in runs) + SHOWN_AFTER_S
    clock = Clock(rate, round(before * rate), round(after * rate), round(lead * rate))
    vectors = pressure_per_velocity(results["transfer_vector"])
    events = [stopping_event(run, clock, body, vectors) for run in runs]
    return _labelled(speeds, results, runs, clock, events).merge(_map(stops, max(speeds)))


@dataclass(frozen=True)
class _Stops:
    """Run-downs of one machine."""

    stopping: Stopping
    parts: Sequence[MovingPart]
    gas_torque_n_m: Array

    @classmethod
    def of(cls, machine: Machine) -> "_Stops":
        gas = gas_cycle(machine, Shared())
        parts = machine.moving_parts(uniform_crank_angle(PATH_SAMPLES))
        return cls(machine.table(Stopping), parts, gas.torque_n_m)

    def run_down(self, speed_rpm: float, rate_hz: float, steady_revolutions: int) -> RunDown:
        return run_down(
            self.stopping,
            self.parts,
            SHIFTED,
            self.gas_torque_n_m,
            2.0 * np.pi * shaft_frequency_hz(speed_rpm),
            rate_hz,
            steady_revolutions,
        )


def _labelled(
    speeds: Sequence[float],
    results: xr.Dataset,
    runs: Sequence[RunDown],
    clock: Clock,
    events: Sequence[StoppingEvent],
) -> xr.Dataset:
    time = clock.time_s
    by_speed = {"speed": list(speeds)}
    over_time = {**by_speed, "stopping_time": time}
    receiver = {"receiver": results["receiver"].values}
    phase = {"stopping_phase": list(PHASES)}

    def gathered(part: str) -> Array:
        return np.stack([getattr(event, part) for event in events])

    def greatest(values: Array) -> Array:
        """Over the times of each phase, shape (phase, ...)."""
        phases = (time < 0.5 * time[0], time >= 0.0)
        return np.stack([values[..., own].max(axis=-1) for own in phases])

    pressure, fast = gathered("pressure"), gathered("fast_level")
    peak = levels.mean_square_level(greatest(pressure**2), REFERENCE_PRESSURE_PA)
    turned = [run.crank_angle_rad[-1] / (2.0 * np.pi) for run in runs]
    arrays: dict[str, tuple[Any, dict[str, Any]]] = {
        "stopping_duration": ([run.stop_time_s for run in runs], by_speed),
        "stopping_revolutions": (turned, by_speed),
        "stopping_shaft_speed": (gathered("shaft_speed"), over_time),
        "stopping_force": (gathered("force"), {**over_time, "axis": list(AXES)}),
        "stopping_moment": (gathered("moment"), {**over_time, "axis": list(AXES)}),
        "stopping_pressure": (pressure, {**over_time, **receiver}),
        "stopping_fast_level": (fast, {**over_time, **receiver}),
        "stopping_fast_maximum_level": (greatest(fast), {**phase, **by_speed, **receiver}),
        "stopping_peak_level": (peak, {**phase, **by_speed, **receiver}),
        "stopping_foot_force": (
            greatest(gathered("foot_force")).max(axis=-1),
            {**phase, **by_speed},
        ),
    }
    return check(
        xr.Dataset({name: stamp(name, values, at) for name, (values, at) in arrays.items()})
    )


def _map(stops: _Stops, speed_rpm: float) -> xr.Dataset:
    """Order map of a stop without gas load; empty where it lasts too few revolutions or too long.

    A stop from the highest speed runs through all others. Under load it is over within a few
    revolutions, too few to tell orders from each other.
    """
    no_gas = stops.stopping.model_copy(update={"gas_share_ratio": 0.0})
    rate = MAP_SAMPLES * shaft_frequency_hz(speed_rpm)
    if no_gas.friction_torque_n_m == 0.0:  # it would never stop
        return xr.Dataset()
    try:
        run = replace(stops, stopping=no_gas).run_down(speed_rpm, rate, 0)
    except ParameterError:  # friction alone takes too long
        return xr.Dataset()
    if run.crank_angle_rad[-1] < 2.0 * np.pi * (MAP_REVOLUTIONS + KERNEL_REVOLUTIONS):
        return xr.Dataset()
    motion = from_angle(run.time_s, run.crank_angle_rad)
    signal = angular_resample(run.force_n.sum(axis=0), rate, motion, MAP_ORDER)
    spectra = order_map(signal, 1.5 / MAP_REVOLUTIONS, overlap_ratio=0.75)
    coords = {
        "axis": list(AXES),
        "stopping_block": np.arange(spectra.time_s.size),
        "map_order": spectra.order,
        "stopping_block_time": ("stopping_block", spectra.time_s),
        "stopping_block_speed": ("stopping_block", 60.0 * spectra.shaft_frequency_hz),
    }
    return check(
        xr.Dataset(
            {"stopping_order_map": stamp("stopping_order_map", np.abs(spectra.amplitude), coords)}
        )
    )
