"""One stop of the machine over time: forces, feet, sound."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy import fft

from .. import levels
from ..base.arrays import Array, ComplexArray
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.errors import ParameterError
from ..transfer import MachineOnMounts
from ..transfer.transient import LOAD_SAMPLES, Transient, transient
from .coasting import RunDown
from .through_shell import StopThroughShell

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

    Raises
    ------
    ParameterError
        The mounts have next to no loss and do not ring out.
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
