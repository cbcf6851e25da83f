"""One stop of the machine over time: forces, feet, sound, through the elastic shell."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy import fft

from .. import levels
from ..base.arrays import Array, ComplexArray
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.errors import ParameterError
from ..machine.frame import BEARING_HOUSING, FIXED_SCROLL, ORBITING_SCROLL
from ..machine.machine import Machine
from ..machine.stopping import TurningBack
from ..mechanics.loads import summed
from ..mechanics.ports import Port
from ..sources.gas import gas_on_parts
from ..transfer import MachineOnMounts
from ..transfer.bending import BendingShell, pressure_over_time
from ..transfer.observers import Observers
from ..transfer.transient import LOAD_SAMPLES, Transient, transient
from .coasting import VALVE, RunDown

FADE_OUT_S: Final = 0.2
"""Time in which what stays after the stop is faded out: no mode of a shell is as slow."""
RING_OUT_S: Final = 0.3
"""Then, until the shell is still."""


@dataclass(frozen=True)
class StopThroughShell:
    """Response of the shell to the stop of one machine.

    Attributes
    ----------
    machine : gas, brake
    shell : elastic, with the machine's values
    microphones : with its modes
    speed_rpm : before switch-off
    """

    machine: Machine
    shell: BendingShell
    microphones: Observers
    speed_rpm: float

    def pressure(
        self, run: RunDown, first: int, fade: Array, samples: int, rate_hz: float
    ) -> Array:
        """Pressure over the first samples of the result, shape (receiver, samples), Pa.

        Parameters
        ----------
        run : run of the machine
        first : sample of the run with which the result begins
        fade : shape (load samples,): factor of the load, from that sample to the run's end
        samples : number of samples of the result
        rate_hz : sample rate of the result
        """
        loads = {port: fade * load for port, load in self.loads(run, first).items()}
        out = round(LOAD_SAMPLES * FADE_OUT_S * rate_hz)
        falling = 0.5 + 0.5 * np.cos(np.linspace(0.0, np.pi, out))
        total = fft.next_fast_len(samples + round((FADE_OUT_S + RING_OUT_S) * rate_hz), real=True)
        standing = LOAD_SAMPLES * samples - fade.size
        held = np.concatenate([np.ones(standing), falling])

        def event(load: Array) -> Array:
            history = np.zeros((len(load), LOAD_SAMPLES * total))
            history[:, : fade.size] = load
            history[:, fade.size :][:, : held.size] = load[:, -1:] * held
            return history

        events = {port: event(load) for port, load in loads.items()}
        rate = LOAD_SAMPLES * rate_hz
        return pressure_over_time(self.shell, self.microphones, events, rate)[:, :samples]

    def loads(self, run: RunDown, first: int) -> dict[Port, Array]:
        """Return the loads on the parts from a sample on, shape (component, times), N and N m."""
        angle = (run.crank_angle_rad + run.shift.angle)[first:]
        of_gas = gas_on_parts(self.machine, self.speed_rpm, angle)
        loads = {port: run.gas_share[first:] * load for port, load in of_gas.items()}
        if run.brake_force_n.any():
            height = _height_of_brake(self.machine)
            table = self.machine.table(TurningBack)
            brake = brake_on_parts(table, run.brake_force_n[first:], angle, height)
            loads = summed([loads, brake])
        if VALVE in run.sources:
            loads[FIXED_SCROLL][2] += run.force_n[run.sources.index(VALVE), 2, first:]
        return loads


def brake_on_parts(
    table: TurningBack, force_n: Array, angle: Array, height_m: float
) -> dict[Port, Array]:
    """The jam as a pair between the wall of the bearing housing and the crank pin.

    The shaft that turns back drags the wall with it by F, and the brake is wedged outwards with
    F/µ. Forces sum to zero; the moment about z, -F r, is the one that stops the rotor.

    Parameters
    ----------
    table : brake and wall
    force_n : F around the shaft, shape (times,)
    angle : angle of crank pin and brake, shape (times,), rad
    height_m : height of the brake

    Returns
    -------
    by part, shape (component, times), N and N m
    """
    outwards = force_n / table.friction_ratio
    x = outwards * np.cos(angle) + force_n * np.sin(angle)
    y = outwards * np.sin(angle) - force_n * np.cos(angle)
    still = np.zeros_like(x)
    pair = np.stack([x, y, still, -height_m * y, height_m * x, still])
    on_wall = pair.copy()
    on_wall[5] = -table.wall_radius_m * force_n
    return {BEARING_HOUSING: on_wall, ORBITING_SCROLL: -pair}


def _height_of_brake(machine: Machine) -> float:
    parts = machine.moving_parts(np.zeros(1))
    return float(next(part for part in parts if part.source == "brake").position_m[2, 0])


FADE_S: Final = 1.0
"""Time in which the steady load is faded in, so slowly that the mounts do not ring."""
STEADY_S: Final = 1.5
"""Twelve Fast time constants: the level is settled within 3e-5 dB."""
REST_S: Final = (8.0, 16.0, 32.0, 64.0)
"""Time after the stop, until the motion on the mounts has decayed; tried in this order."""
RESIDUE: Final = 1e-4
"""Share of the largest force into a foot, in the last second: the vibration has decayed."""


@dataclass(frozen=True)
class Clock:
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


@dataclass(frozen=True)
class StoppingEvent:
    """One stop over the times shown.

    Attributes
    ----------
    shaft_speed : shape (times,), rad/s
    force, moment : on the housing, shape (3, times), N and N m
    foot_force : magnitude, shape (foot, times), N
    pressure : shape (receiver, times), Pa
    fast_level : A-weighted, shape (receiver, times), dB
    """

    shaft_speed: Array
    force: Array
    moment: Array
    foot_force: Array
    pressure: Array
    fast_level: Array


def stopping_event(
    run: RunDown,
    clock: Clock,
    body: MachineOnMounts,
    pressure_per_velocity: Callable[[Array], ComplexArray],
    shell: StopThroughShell | None = None,
) -> StoppingEvent:
    """Forces of a run-down and what they do to feet and microphones.

    Parameters
    ----------
    run : with steady running for the clock's lead at least, LOAD_SAMPLES per sample of the clock
    clock : times of the result
    body : the machine on its mounts
    pressure_per_velocity : function of frequencies to shape (receiver, dof, frequency)
    shell : that bends too; none for a rigid one
    """
    first = np.count_nonzero(run.time_s < 0.0) - LOAD_SAMPLES * clock.lead
    history = np.concatenate([run.force_n.sum(axis=0), run.moment_n_m.sum(axis=0)])[:, first:]
    speed = run.speed_rad_per_s[first:]
    response = _response(history, clock, body, pressure_per_velocity)
    if shell is not None:
        fade = _fade(history.shape[-1], clock.rate_hz)
        through = shell.pressure(run, first, fade, clock.shown.stop, clock.rate_hz)
        response.pressure_pa[:, : through.shape[-1]] += through
    weighted = levels.weighted_signal(response.pressure_pa, clock.rate_hz, "A")
    fast = levels.time_weighted_mean_square(weighted, clock.rate_hz, levels.FAST_TIME_CONSTANT_S)
    shown = clock.shown
    padding = LOAD_SAMPLES * shown.stop - speed.size
    shaft_speed, force, moment = np.split(
        np.pad(np.vstack([speed, history]), ((0, 0), (0, padding)))[:, ::LOAD_SAMPLES][:, shown],
        [1, 4],
    )
    return StoppingEvent(
        shaft_speed[0],
        force,
        moment,
        np.linalg.norm(response.foot_force_n[..., shown], axis=1),
        response.pressure_pa[:, shown],
        levels.mean_square_level(fast[:, shown], REFERENCE_PRESSURE_PA),
    )


def _fade(samples: int, rate_hz: float) -> Array:
    """Fade of a load from its first sample to its last."""
    fade = np.ones(samples)
    rising = np.linspace(0.0, np.pi, round(FADE_S * LOAD_SAMPLES * rate_hz))
    fade[: rising.size] = 0.5 - 0.5 * np.cos(rising)
    return fade


def _response(
    history: Array,
    clock: Clock,
    body: MachineOnMounts,
    pressure_per_velocity: Callable[[Array], ComplexArray],
) -> Transient:
    """Response to a load that is faded in and followed by rest until the motion on the mounts has
    decayed."""
    rate = LOAD_SAMPLES * clock.rate_hz
    fade = _fade(history.shape[-1], clock.rate_hz)
    for rest_s in REST_S:
        samples = fft.next_fast_len(clock.shown.stop + round(rest_s * clock.rate_hz), real=True)
        load = np.zeros((6, LOAD_SAMPLES * samples))
        load[:, : fade.size] = fade * history
        response = transient(body, load, rate, pressure_per_velocity)
        size = np.abs(response.foot_force_n)
        if np.max(size[..., -round(clock.rate_hz) :]) < RESIDUE * np.max(size):
            return response
    raise ParameterError(
        f"machine: mounts.loss_factor_ratio: too small, the machine still rings on its mounts "
        f"{REST_S[-1]:g} s after a stop"
    )
