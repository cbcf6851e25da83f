"""Packed values of netCDF and HDF5: scale, offset, values that are missing or out of range.

Conventions of netCDF (Unidata, "Best practices") and CF-1.11, 8.1: value = stored · scale_factor +
add_offset; fill values and the valid range (2.5.1) are compared as they are stored.
"""

from collections.abc import Mapping
from typing import Any, Final

import numpy as np

from .recorded import Samples

PACKING_NAMES: Final = (
    "scale_factor", "add_offset", "_FillValue", "missing_value", "_Unsigned", "valid_min",
    "valid_max", "valid_range",
)  # fmt: skip
"""Attributes that say how values are stored."""
_DEFAULT_FILL: Final = 9.969209968386869e36
"""Values that the netCDF library writes for missing numbers, as float or double."""


def unsigned(stored: Samples, attributes: Mapping[str, Any]) -> Samples:
    """Stored values as the unsigned whole numbers that `_Unsigned` says they are."""
    text = attributes.get("_Unsigned", b"")
    text = text.encode() if isinstance(text, str) else bytes(text)
    if text.lower() != b"true" or stored.dtype.kind != "i":
        return stored
    return stored.view(f"{stored.dtype.byteorder}u{stored.dtype.itemsize}")


def unpacked(stored: Samples, attributes: Mapping[str, Any]) -> Samples:
    """Values that the stored numbers stand for; the stored ones where nothing is packed."""
    if not is_packed(attributes):
        return stored
    scale = float(np.asarray(attributes.get("scale_factor", 1.0)).item())
    offset = float(np.asarray(attributes.get("add_offset", 0.0)).item())
    return np.asarray(stored * np.float64(scale) + offset)


def is_packed(attributes: Mapping[str, Any]) -> bool:
    """Whether stored numbers are no values yet."""
    return "scale_factor" in attributes or "add_offset" in attributes


def missing(stored: Samples, attributes: Mapping[str, Any]) -> tuple[Samples, str] | None:
    """Return which of the stored numbers are missing, and why; None without any."""
    fills = [
        float(fill)
        for name in ("_FillValue", "missing_value")
        for fill in _numbers(attributes, name)
    ]
    for fill in [*fills, _DEFAULT_FILL]:
        where = stored == np.asarray(fill).astype(stored.dtype if np.isfinite(fill) else float)
        if fill == _DEFAULT_FILL and stored.dtype.kind != "f":
            continue
        if where.any():
            return where, f"fill value {fill:g}"
    low, high = _valid_range(attributes)
    where = (stored < low) | (stored > high)
    return (where, f"outside the valid range {low:g} to {high:g}") if where.any() else None


def _valid_range(attributes: Mapping[str, Any]) -> tuple[float, float]:
    """Least and greatest stored number that is valid."""
    limits = _numbers(attributes, "valid_range")
    if len(limits) == 2:
        return float(limits[0]), float(limits[1])
    low, high = _numbers(attributes, "valid_min"), _numbers(attributes, "valid_max")
    return float(low[0]) if len(low) else -np.inf, float(high[0]) if len(high) else np.inf


def _numbers(attributes: Mapping[str, Any], name: str) -> Samples:
    values = np.ravel(np.asarray(attributes.get(name, ())))
    return values if values.dtype.kind in "iuf" else np.empty(0)
