"""Vibration of the feet of a predicted run: velocity, RMS, and displacement, peak to peak."""

import numpy as np
import xarray as xr

from ..base.vocabulary import stamp
from ..mechanics.severity import displacement_range, velocity_rms


def foot_vibration(results: xr.Dataset) -> xr.Dataset:
    """Return `foot_velocity` and `foot_displacement` (speed, option, foot, axis).

    Parameters
    ----------
    results : with `velocity_order` (speed, option, source, dof, order) and its coordinates
    """
    motion = results["velocity_order"].sum("source").transpose("speed", "option", "order", "dof")
    turned = np.cross(motion.values[..., None, 3:], results["foot_position"].values)
    velocity = np.moveaxis(motion.values[..., None, :3] + turned, 2, -1)
    frequency_hz = results["order_frequency"].transpose("speed", "order").values
    frequency_hz = frequency_hz[:, None, None, None]
    coords = {name: results[name] for name in ("speed", "option", "foot", "axis")}
    values = {
        "foot_velocity": velocity_rms(velocity, frequency_hz),
        "foot_displacement": displacement_range(velocity, frequency_hz),
    }
    return xr.Dataset({name: stamp(name, value, coords) for name, value in values.items()})
