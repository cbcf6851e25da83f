"""Feet and sound of a rigid machine under loads that do not repeat."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy import fft

from ..base.arrays import Array, ComplexArray
from .machine import MachineOnMounts

LOAD_SAMPLES: Final = 2
"""Samples of the load per sample of the result: a jump of the load aliases less."""
RESULT_SAMPLES: Final = 4
"""Samples of the result per period of the highest frequency: a peak is met within 30 % there,
within 0.3 % at a tenth of it, where a stop sounds."""


@dataclass(frozen=True)
class Transient:
    """Response to a load, from its first sample on.

    Attributes
    ----------
    foot_force_n : shape (foot, axis, times)
    pressure_pa : shape (receiver, times)
    """

    foot_force_n: Array
    pressure_pa: Array


def transient(
    body: MachineOnMounts,
    load: Array,
    load_rate_hz: float,
    pressure_per_velocity: Callable[[Array], ComplexArray],
) -> Transient:
    """Response to a load over time by Fourier transform of the event.

    The event counts as one period: it has to end with rest that lasts until the mounts' ringing
    has died out. Their structural loss (the same at every frequency above zero) has no causal
    counterpart in time (Crandall 1970, J. Sound Vib. 11:3): a kick of the load has a forerunner of
    about the loss factor times its size. Sound above the highest frequency is omitted.

    Parameters
    ----------
    body : on its mounts
    load : force and moment about the centre of mass, shape (6, times), N and N m; the number of
        times is a multiple of LOAD_SAMPLES
    load_rate_hz : LOAD_SAMPLES times that of the result; RESULT_SAMPLES times the highest
        frequency are the result's
    pressure_per_velocity : function of frequencies up to the highest to shape (receiver, dof,
        frequency)
    """
    times = load.shape[-1]
    highest_hz = load_rate_hz / (LOAD_SAMPLES * RESULT_SAMPLES)
    frequency = fft.rfftfreq(times, 1.0 / load_rate_hz)
    frequency = frequency[frequency <= highest_hz]
    spectrum = fft.rfft(load)[:, : frequency.size].T

    def over_time(lines: ComplexArray) -> Array:
        return np.asarray(fft.irfft(lines, times // LOAD_SAMPLES) / LOAD_SAMPLES)

    response = body.response(spectrum, frequency)
    pressure = np.einsum("rdf,fd->rf", pressure_per_velocity(frequency), response.velocity)
    foot_force = np.moveaxis(response.foot_force, 0, -1)
    return Transient(over_time(foot_force), over_time(pressure))
