"""Words that fit one kind of machine only."""

from typing import Final

import xarray as xr

from .study import parameters

_AXES: Final = {
    "oldham-scroll": "the Oldham stroke (x), across (y) and along the shaft (z)",
    "reciprocating": "across the cylinder (x), along the shaft (y) and along the cylinder (z)",
}

_ORDERS: Final = {
    "oldham-scroll": "The stroke of the ring is a pure cosine of the crank angle, so order 2 of "
    "the ring alone is zero; higher orders come from what an option adds.",
    "reciprocating": "The tilt of the connecting rod makes the even orders, the swing of the "
    "shaft's speed under the gas load the others. Orders are multiples of the mean shaft "
    "frequency in time.",
}


def axes_words(results: xr.Dataset) -> str:
    """What x, y and z are on this machine."""
    return _AXES.get(_kind(results), "x, y and z")


def order_words(results: xr.Dataset) -> str:
    """Where the orders of the force come from."""
    return _ORDERS.get(_kind(results), "Orders are multiples of the mean shaft frequency in time.")


def _kind(results: xr.Dataset) -> str:
    return str(parameters(results)["machine"]["kind"])
