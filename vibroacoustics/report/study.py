"""What the report reads from the attributes of a results dataset."""

import json
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ..schema import REFERENCE_OPTION
from ..units import shaft_frequency_hz


def parameters(results: xr.Dataset) -> dict[str, Any]:
    """All parameters of the study, as `Study.parameters` gave them."""
    return dict(json.loads(results.attrs["parameters"]))


def words(results: xr.Dataset) -> dict[str, Any]:
    """What machine and options say of themselves, as the run kept it."""
    return dict(json.loads(results.attrs["words"]))


def catalogue_receiver(results: xr.Dataset) -> str:
    """Name of the microphone at which the machine's noise is published."""
    return str(parameters(results)["catalogue_receiver"])


def speeds(results: xr.Dataset) -> list[float]:
    """Shaft speeds in rpm."""
    return [float(speed) for speed in results["speed"].values]


def options(results: xr.Dataset) -> list[str]:
    """Names of all options, the reference among them."""
    return [str(option) for option in results["option"].values]


def balancers(results: xr.Dataset) -> list[str]:
    """Names of the options that are told against the reference."""
    return [option for option in options(results) if option != REFERENCE_OPTION]


def other_receivers(results: xr.Dataset) -> list[str]:
    """Microphones apart from the catalogue's."""
    names = [str(receiver) for receiver in results["receiver"].values]
    return [name for name in names if name != catalogue_receiver(results)]


def overall_noise(results: xr.Dataset) -> dict[str, float]:
    """Published level of the whole machine with its speed and distance."""
    return dict(parameters(results)["machine"]["overall_noise"])


def has_inner_sources(results: xr.Dataset) -> bool:
    """Whether gas, keys and motor drive an elastic shell."""
    return "source_level" in results


def first_order_hz(results: xr.Dataset) -> NDArray[np.float64]:
    """Frequency of the 1x line at each speed, Hz."""
    return np.array([shaft_frequency_hz(speed) for speed in speeds(results)])
