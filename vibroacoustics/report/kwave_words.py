"""What k-Wave computed, and how far the closed form of the image sources is from it, in words."""

from typing import Final

import numpy as np
import xarray as xr

from ..base import rounding
from ..base.arrays import Array
from ..base.decibel import level_of_amplitude

_LOUD: Final = 0.1
"""Share of the loudest microphone's pressure above which a difference of levels counts."""
_STRONG: Final = 1e-3
"""Of the strongest translation or rotation."""


def kwave_sentence(results: xr.Dataset) -> str:
    """Where k-Wave computed the room, and the difference of the two methods there."""
    by_kwave = computed_by_kwave(results) if "green_difference" in results else None
    if by_kwave is None or not by_kwave.size:
        return "The Green's functions are the closed form of image sources; k-Wave did not run."
    gap = abs(by_kwave)
    worst = gap.where(gap == gap.max(), drop=True).isel(receiver=0, frequency=0)
    frequency = by_kwave["frequency"].values
    words = (
        f"k-Wave computed the room at {', '.join(map(str, by_kwave['receiver'].values))} from "
        f"{frequency[0]:g} to {frequency[-1]:g} Hz, the closed form of image sources the rest. "
        f"k-Wave's Green's function differs from the closed form by at most "
        f"{rounding.fixed(float(gap.max()), 2)} dB (at {worst['receiver'].item()}, "
        f"{worst['frequency'].item():g} Hz)"
    )
    differences = method_difference_db(results)
    if differences is None:
        return f"{words}."
    largest = float(np.abs(differences).max())
    words += f", the pressure per velocity by at most {rounding.fixed(largest, 3)} dB"
    if frequency[-1] < results["frequency"].values[-1]:
        seam = float(np.abs(differences[:, :, -1]).max())
        words += f", {rounding.fixed(seam, 3)} dB at the seam of {frequency[-1]:g} Hz"
    return f"{words}."


def computed_by_kwave(results: xr.Dataset) -> xr.DataArray:
    """`green_difference` at the microphones and frequencies that k-Wave computed."""
    gap = results["green_difference"].transpose("receiver", "frequency")
    return gap.dropna("receiver", how="all").dropna("frequency", how="all")


def kwave_to_hz(results: xr.Dataset) -> dict[str, float]:
    """Highest frequency that k-Wave computed, of each microphone where it did."""
    if "green_difference" not in results:
        return {}
    by_kwave = computed_by_kwave(results)
    return {
        str(name): float(by_kwave["frequency"].values[np.isfinite(gap)].max())
        for name, gap in zip(by_kwave["receiver"].values, by_kwave.values, strict=True)
    }


def method_difference_db(results: xr.Dataset) -> Array | None:
    """Level of k-Wave's pressure per velocity over that of the closed form, where both are loud.

    (receiver, dof, frequency) of k-Wave; 0 where they are not loud. None without the closed form.
    """
    if "transfer_vector_closed_form" not in results:
        return None
    size, closed = (
        np.abs(results[name].transpose("receiver", "dof", "frequency").values)
        for name in ("transfer_vector", "transfer_vector_closed_form")
    )
    loud = (size > _LOUD * size.max(axis=0)) & (closed > 0.0)
    kinds = np.array([str(dof)[0] for dof in results["dof"].values])
    for kind in ("t", "r"):
        of_kind = size[:, kinds == kind]
        loud[:, kinds == kind] &= of_kind > _STRONG * of_kind.max(axis=1, keepdims=True)
    gap = np.where(loud, level_of_amplitude(size / np.where(loud, closed, 1.0) + ~loud), 0.0)
    by_kwave = computed_by_kwave(results)
    rows = np.isin(results["receiver"].values, by_kwave["receiver"].values)
    columns = np.isin(results["frequency"].values, by_kwave["frequency"].values)
    return np.asarray(gap[rows][:, :, columns])
