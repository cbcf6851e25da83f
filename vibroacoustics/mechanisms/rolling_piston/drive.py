"""The motor's torque within a turn: as it falls with the speed, or as the inverter sets it."""

import numpy as np

from ...base.arrays import Array
from ...base.errors import ParameterError
from ...orders.spectrum import order_spectrum
from .parameters import Drive


def control_torque_n_m(drive: Drive, load_n_m: Array) -> Array:
    """Alternating torque with which an inverter follows the load's first orders, N m.

    Orders 1 to n of the load; all smaller by one factor where mean and control together would take
    more current than the drive has. Zero without a control.

    Parameters
    ----------
    drive : with its control
    load_n_m : torque against the rotation over uniform crank angles, shape (samples,)

    Raises
    ------
    ParameterError
        The current does not carry the mean load.
    """
    control = drive.control
    if control is None:
        return np.zeros_like(load_n_m)
    spectrum = np.fft.rfft(load_n_m)
    spectrum[0] = 0.0
    spectrum[control.highest_order + 1 :] = 0.0
    wave = np.asarray(np.fft.irfft(spectrum, n=load_n_m.size))
    if control.current_limit_a is None:
        return wave
    room = drive.torque_per_current_nm_per_a * control.current_limit_a - float(np.mean(load_n_m))
    if room < 0.0:
        needed = float(np.mean(load_n_m)) / drive.torque_per_current_nm_per_a
        raise ParameterError(
            f"current_limit_a = {control.current_limit_a:g} A: must be at least {needed:.4g} A, "
            "the current of the mean load"
        )
    return np.asarray(wave * min(1.0, room / max(float(np.max(wave)), np.finfo(float).tiny)))


def torque_orders_n_m(torque_n_m: Array, highest: int) -> Array:
    """Amplitudes of the orders 1 to `highest` over the crank angle, shape (highest,), N m.

    Parameters
    ----------
    torque_n_m : over uniform crank angles, shape (samples,)
    highest : order
    """
    return np.abs(order_spectrum(torque_n_m, highest)[1:])
