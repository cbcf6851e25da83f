"""The device that k-Wave runs on: one that CuPy finds, or this computer's processor."""

import functools
import importlib
import warnings
from typing import Any, Final

import numpy as np
import psutil

_PROCESSOR: Final = "compiled step on the processor"
_LONGEST_REASON: Final = 120


def array_namespace() -> Any:
    """CuPy, where it is installed and finds a device, else NumPy."""
    return _namespace()[0]


def engine_name() -> str:
    """Name the engine that advances k-Wave's equations, in words."""
    cupy = array_namespace()
    if cupy is np:
        return _PROCESSOR
    name = cupy.cuda.runtime.getDeviceProperties(0)["name"].decode()
    return f"k-Wave's own step, CuPy {cupy.__version__} on {name}"


def available_bytes() -> float:
    """Memory that is left where k-Wave runs."""
    cupy = array_namespace()
    if cupy is np:
        return float(psutil.virtual_memory().available)
    return float(cupy.cuda.runtime.memGetInfo()[0])


def device_trouble() -> str:
    """Say on one line why an installed CuPy does not work; empty where it works or is absent."""
    return _namespace()[1]


def warn_of_device() -> None:
    """Warn where CuPy is installed and does not serve."""
    trouble = device_trouble()
    if trouble:
        warnings.warn(f"k-Wave runs on the processor: {trouble}", stacklevel=2)


@functools.cache
def _namespace() -> tuple[Any, str]:
    """CuPy or NumPy, and why it is not CuPy."""
    try:
        cupy: Any = importlib.import_module("cupy")
        if cupy.cuda.runtime.getDeviceCount() > 0:
            return cupy, ""
        return np, "CuPy finds no device"
    except ModuleNotFoundError as error:
        return np, "" if error.name == "cupy" else _broken(error)
    except Exception as error:  # no driver, a library that does not load: each has its exception
        return np, _broken(error)


def _broken(error: Exception) -> str:
    reason = " ".join(str(error).split()) or type(error).__name__
    return f"CuPy does not work: {reason[:_LONGEST_REASON]}"
