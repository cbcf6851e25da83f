"""Sentences on k-Wave: the room it computed, and the difference from image sources."""

from typing import Final

import numpy as np
import xarray as xr

from ..base import rounding
from ..base.arrays import Array
from ..base.decibel import level_of_amplitude

_LOUD: Final = 0.1
"""Share of the loudest microphone's pressure above which a difference of levels counts."""
_STRONG: Final = 1e-3
"""Share of the strongest translation or rotation."""


def kwave_sentence(results: xr.Dataset) -> str:
    """Say where k-Wave computed the room, and how both methods differ there."""
    by_kwave = computed_by_kwave(results)
    if not by_kwave.size:
        reasons = sorted({reason for _, reason in receiver_methods(results).values()} - {""})
        return f"k-Wave did not run: {'; '.join(reasons) or 'the results name no reason'}."
    gap = abs(by_kwave)
    worst = gap.where(gap == gap.max(), drop=True).isel(receiver=0, frequency=0)
    frequency = by_kwave["frequency"].values
    words = (
        f"k-Wave computed the room at {', '.join(map(str, by_kwave['receiver'].values))} from "
        f"{frequency[0]:g} to {frequency[-1]:g} Hz; other Green's functions are closed form. "
        "Its Green's functions differ from the closed form by at most "
        f"{rounding.fixed(float(gap.max()), 2)} dB (at "
        f"{worst['receiver'].item()}, {worst['frequency'].item():g} Hz)"
    )
    differences = method_difference_db(results)
    if differences is None:
        return f"{words}."
    largest = float(np.abs(differences).max())
    words += f", the pressure per velocity by at most {rounding.fixed(largest, 3)} dB"
    if frequency[-1] < results["frequency"].values[-1]:
        crossover_db = float(np.abs(differences[:, :, -1]).max())
        words += f", {rounding.fixed(crossover_db, 3)} dB at the limit of {frequency[-1]:g} Hz"
    return f"{words}."


def kwave_line(results: xr.Dataset) -> str:
    """Microphones of k-Wave and its largest difference from the closed form, in one short line."""
    to_hz = kwave_to_hz(results)
    if not to_hz:
        return kwave_sentence(results)
    where = ", ".join(f"{name} to {highest:g} Hz" for name, highest in to_hz.items())
    difference = rounding.fixed(kwave_difference_db(results) or 0.0, 3)
    return f"k-Wave at {where}: pressure within {difference} dB of the closed form."


def kwave_difference_db(results: xr.Dataset) -> float | None:
    """Largest level difference of pressure per velocity, k-Wave against closed form, dB.

    That of the Green's functions where the pressures of the closed form are not in the results;
    None where k-Wave did not run.
    """
    by_kwave = computed_by_kwave(results)
    if not by_kwave.size:
        return None
    differences = method_difference_db(results)
    return float(np.nanmax(np.abs(by_kwave.values if differences is None else differences)))


def receiver_methods(results: xr.Dataset) -> dict[str, tuple[str, str]]:
    """Method and reason why it is not k-Wave of each microphone; empty in older results."""
    if "radiation_method" not in results.coords:
        return {}
    names = ("receiver", "radiation_method", "radiation_method_reason")
    columns = (map(str, results[name].values) for name in names)
    return {name: (method, reason) for name, method, reason in zip(*columns, strict=True)}


def computed_by_kwave(results: xr.Dataset) -> xr.DataArray:
    """`green_difference` at the microphones and frequencies that k-Wave computed; else empty."""
    if "green_difference" not in results:
        return xr.DataArray(np.empty((0, 0)), coords=[("receiver", []), ("frequency", [])])
    gap = results["green_difference"].transpose("receiver", "frequency")
    return gap.dropna("receiver", how="all").dropna("frequency", how="all")


def kwave_to_hz(results: xr.Dataset) -> dict[str, float]:
    """Highest frequency that k-Wave computed, of each microphone where it did."""
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
