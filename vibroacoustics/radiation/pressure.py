"""Sound pressure of a moving housing: velocity at the lines times transfer vectors."""

import xarray as xr

from .interpolation import Interpolant
from .transfer_vectors import interpolate_transfer_vector, pressure_per_velocity


def pressure_per_shell_velocity(radiated: xr.Dataset) -> Interpolant:
    """`pressure_per_velocity` of the elastic modes of the shell."""
    return pressure_per_velocity(radiated["pattern_transfer_vector"].rename(pattern="dof"))


def wrench_pressure(results: xr.Dataset, name: str) -> xr.DataArray:
    """Pressure of every wrench at every order, Pa."""
    return _at_orders(results["velocity_order"], results[name], results["order_frequency"])


def pressure_on_surface(velocity: xr.DataArray, results: xr.Dataset) -> xr.DataArray:
    """Pressure at the positions of the measurement surface, here called receivers, Pa.

    Parameters
    ----------
    velocity : velocity of the housing at the orders, with the dimension dof
    results : with `surface_transfer_vector` and `order_frequency`
    """
    vectors = results["surface_transfer_vector"]
    vectors = vectors.rename(position="receiver", position_distance="distance")
    return _at_orders(velocity, vectors, results["order_frequency"])


def pressure_on_map(velocity: xr.DataArray, results: xr.Dataset) -> xr.DataArray:
    """Pressure of the first order on the map, Pa.

    Parameters
    ----------
    velocity : velocity of the housing at the orders, with the dimension dof
    results : with `map_transfer_vector`, whose frequencies are those of the first order
    """
    first = velocity.sel(order=1, drop=True)
    by_speed = results["map_transfer_vector"].rename(line_frequency="speed")
    pressure: xr.DataArray = xr.dot(first, by_speed.assign_coords(speed=first["speed"]), dim="dof")
    return pressure


def _at_orders(
    velocity: xr.DataArray, vectors: xr.DataArray, order_frequency: xr.DataArray
) -> xr.DataArray:
    """Orders beyond the table are silent: its highest frequency stands for theirs."""
    frequency = order_frequency.clip(max=vectors["frequency"].max().item())
    at_orders = interpolate_transfer_vector(vectors, frequency)
    pressure: xr.DataArray = xr.dot(velocity, at_orders, dim="dof")
    return pressure
