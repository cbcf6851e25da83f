"""Sound of a stop through the elastic shell: gas, the brake's jam, the valve's impact."""

from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy import fft

from ..base.arrays import Array
from ..machine.frame import BEARING_HOUSING, FIXED_SCROLL, ORBITING_SCROLL
from ..machine.machine import Machine
from ..machine.stopping import TurningBack
from ..mechanics.loads import summed
from ..mechanics.ports import Port
from ..sources.gas import gas_on_parts
from ..transfer.bending import BendingShell, pressure_over_time
from ..transfer.observers import Observers
from ..transfer.transient import LOAD_SAMPLES
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
