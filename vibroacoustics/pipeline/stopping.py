"""Switching off: run-down of the bare machine, forces, sound and feet against steady running."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import xarray as xr
from scipy import fft

from .. import levels
from ..constants import REFERENCE_PRESSURE_PA
from ..errors import ParameterError
from ..mechanisms.oldham_scroll import scroll_parts
from ..mechanisms.run_down.coasting import RunDown, run_down
from ..mechanisms.scroll_gas.cycle import scroll_gas_cycle
from ..moving_parts import MovingPart
from ..orders import angular_resample, from_angle, order_map
from ..parameters.inside import Inside
from ..parameters.oldham_scroll import OldhamScroll
from ..parameters.run_down import Stopping
from ..parameters.study import Study
from ..rotation import Array, uniform_crank_angle
from ..schema import AXES, check, stamp
from ..transfer import RigidBodyOnMounts, SuspendedBlock
from ..units import shaft_frequency_hz
from .inner_sound import rigid_pressures
from .inner_sources import GAS_SAMPLES, Complex
from .transient import LOAD_SAMPLES, RESULT_SAMPLES, transient

SHIFTED: Final = ("orbiting_scroll", "brake", "oldham")
"""The set that the brake lets turn against pin and counterweights (thesis 6.4)."""
PHASES: Final = ("steady", "stopping")
REVOLUTIONS_BEFORE: Final = 5
"""Shown before switch-off, of the slowest speed. The first half stands for steady running; in the
second the forerunner of `transient` grows."""
SHOWN_AFTER_S: Final = 0.4
"""Shown after the last stop: three Fast time constants, two periods of the softest rocking."""
FADE_S: Final = 1.0
"""In which the steady load is faded in, so slowly that the mounts do not ring."""
STEADY_S: Final = 1.5
"""Twelve Fast time constants: the level is settled within 3e-5 dB."""
RESIDUE: Final = 1e-4
"""To which the mounts' ringing must have died out where the event repeats."""
LONGEST_RING_S: Final = 60.0
MAP_REVOLUTIONS: Final = 8
"""In a block of the order map: orders 0.19 apart are told from each other."""
MAP_ORDER: Final = 4
MAP_SAMPLES: Final = 32
"""Samples of the run-down per revolution at full speed, for the order map."""


def stopping_sound(
    study: Study,
    inside: Inside,
    machine: OldhamScroll,
    body: RigidBodyOnMounts | SuspendedBlock,
    results: xr.Dataset,
) -> xr.Dataset:
    """Run-down from each speed, without a balancer; force, moment, feet, sound, order map.

    Parameters
    ----------
    study : its speeds
    inside : gas and stopping
    machine : moving parts
    body : the machine on its mounts
    results : with the transfer vectors of the rigid motions
    """
    speeds = study.operation.speed_rpm
    stops = _Stops(inside, scroll_parts(machine, uniform_crank_angle(_SAMPLES)))
    highest_hz = float(results["frequency"].values[-1])
    rate = RESULT_SAMPLES * highest_hz
    before = REVOLUTIONS_BEFORE / shaft_frequency_hz(min(speeds))
    lead = FADE_S + STEADY_S + before
    runs = [stops.run_down(speed, LOAD_SAMPLES * rate, lead) for speed in speeds]
    after = max(run.stop_time_s for run in runs) + SHOWN_AFTER_S
    clock = _Clock(rate, round(before * rate), round(after * rate), round(lead * rate))
    ring = clock.ring_samples(body, machine)
    events = [
        _event(run, clock, body, ring, lambda hz: rigid_pressures(results, hz)) for run in runs
    ]
    return _labelled(speeds, results, runs, clock, events).merge(_map(stops, max(speeds)))


_SAMPLES: Final = 256
"""Of the moving parts' paths, which are circles and a line."""


@dataclass(frozen=True)
class _Stops:
    """Run-downs of one machine."""

    inside: Inside
    parts: Sequence[MovingPart]

    def run_down(
        self, speed_rpm: float, rate_hz: float, lead_s: float, stopping: Stopping | None = None
    ) -> RunDown:
        """From a speed, with at least `lead_s` of steady running before."""
        gas = scroll_gas_cycle(
            self.inside.wraps, self.inside.gas, uniform_crank_angle(GAS_SAMPLES)
        ).torque_n_m
        hertz = shaft_frequency_hz(speed_rpm)
        return run_down(
            stopping or self.inside.stopping,
            self.parts,
            SHIFTED,
            gas,
            2.0 * np.pi * hertz,
            rate_hz,
            int(np.ceil(lead_s * hertz)) + 1 if lead_s else 0,
        )


@dataclass(frozen=True)
class _Clock:
    """Samples of the result: shown before and after switch-off, and led in before."""

    rate_hz: float
    before: int
    after: int
    lead: int

    @property
    def time_s(self) -> Array:
        """Shown, from switch-off."""
        return np.arange(-self.before, self.after) / self.rate_hz

    @property
    def shown(self) -> slice:
        """Among the samples of a response that starts with the lead."""
        return slice(self.lead - self.before, self.lead + self.after)

    def ring_samples(self, body: RigidBodyOnMounts | SuspendedBlock, machine: OldhamScroll) -> int:
        """Until the slowest ringing, exp(-π η f t), has died out.

        Raises
        ------
        ParameterError
            The mounts have next to no loss.
        """
        springs = [machine.mounts]
        if machine.suspension is not None:
            springs.append(machine.suspension.springs)
        loss = min(spring.loss_factor_ratio for spring in springs)
        softest_hz = float(body.natural_modes()[0].min())
        rate = np.pi * loss * softest_hz
        needed = -np.log(RESIDUE)
        if rate * LONGEST_RING_S < needed:
            raise ParameterError(
                f"machine: mounts.loss_factor_ratio = {loss:g}: the mounts ring at "
                f"{softest_hz:.3g} Hz for over {LONGEST_RING_S:g} s after a stop; must be at least "
                f"{needed / (np.pi * softest_hz * LONGEST_RING_S):.2g}"
            )
        return int(np.ceil(needed / rate * self.rate_hz))


@dataclass(frozen=True)
class _Event:
    """One stop over the times shown.

    Attributes
    ----------
    shaft_speed, force, moment : shapes (times,), (3, times), (3, times)
    foot_force : magnitude, shape (foot, times)
    pressure : shape (receiver, times)
    fast_level : A-weighted, shape (receiver, times)
    """

    shaft_speed: Array
    force: Array
    moment: Array
    foot_force: Array
    pressure: Array
    fast_level: Array


def _event(
    run: RunDown,
    clock: _Clock,
    body: RigidBodyOnMounts | SuspendedBlock,
    ring: int,
    pressure_per_velocity: Callable[[Array], Complex],
) -> _Event:
    """Forces of a run-down and what they do, led in and followed by rest."""
    lead = LOAD_SAMPLES * clock.lead
    wrench = np.concatenate([run.force_n.sum(axis=0), run.moment_n_m.sum(axis=0)])
    kept = np.concatenate([run.speed_rad_per_s[None], wrench])[:, _switch_off(run) - lead :]
    length = LOAD_SAMPLES * fft.next_fast_len(clock.lead + clock.after + ring, real=True)
    course = np.zeros((kept.shape[0], length))
    course[:, : kept.shape[1]] = kept
    fade = np.linspace(0.0, np.pi, round(FADE_S * LOAD_SAMPLES * clock.rate_hz))
    load = course[1:].copy()
    load[:, : fade.size] *= 0.5 - 0.5 * np.cos(fade)
    response = transient(body, load, LOAD_SAMPLES * clock.rate_hz, pressure_per_velocity)
    weighted = levels.weighted_signal(response.pressure_pa, clock.rate_hz, "A")
    fast = levels.time_weighted_mean_square(weighted, clock.rate_hz, levels.FAST_TIME_CONSTANT_S)
    shown = clock.shown
    speed, force, moment = np.split(course[:, ::LOAD_SAMPLES][:, shown], [1, 4])
    return _Event(
        speed[0],
        force,
        moment,
        np.linalg.norm(response.foot_force_n[..., shown], axis=1),
        response.pressure_pa[:, shown],
        levels.mean_square_level(fast[:, shown], REFERENCE_PRESSURE_PA),
    )


def _switch_off(run: RunDown) -> int:
    """Sample at time zero."""
    return int(np.argmin(np.abs(run.time_s)))


def _labelled(
    speeds: Sequence[float],
    results: xr.Dataset,
    runs: Sequence[RunDown],
    clock: _Clock,
    events: Sequence[_Event],
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
    """Order map of a stop without gas load; empty where it lasts too few revolutions.

    A stop from the highest speed runs through all others. Under load it is over within a few
    revolutions, too few to tell orders from each other.
    """
    own = stops.inside.stopping
    if own.friction_torque_n_m == 0.0:  # it would never stop
        return xr.Dataset()
    unloaded = own.model_copy(update={"gas_share_ratio": 0.0})
    rate = MAP_SAMPLES * shaft_frequency_hz(speed_rpm)
    run = stops.run_down(speed_rpm, rate, 0.0, unloaded)
    motion = from_angle(run.time_s, run.crank_angle_rad)
    signal = angular_resample(run.force_n.sum(axis=0), rate, motion, MAP_ORDER)
    if signal.time_s.size < MAP_REVOLUTIONS * signal.samples_per_revolution:
        return xr.Dataset()
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
