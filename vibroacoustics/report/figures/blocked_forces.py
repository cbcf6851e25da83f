"""Blocked forces with their bands, and their on-board validation."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..charts.needs import needs
from .panels import band, each_panel
from .style import COLOURS, Picture, png, shortened

_FROM = "`blocked_forces`, command `blocked-forces`"
_RANGE_DB = 80.0


@needs("blocked_force", "blocked_force_low", from_=_FROM)
def blocked_force(blocked: xr.Dataset) -> Figure:
    """Amplitude of each blocked force with its 90 % band: a panel a point.

    Parameters
    ----------
    blocked : of `blocked_forces`; needs `blocked_force`, `blocked_force_low`,
        `blocked_force_high` (force_point, frequency), N

    Raises
    ------
    ParameterError
        The dataset holds none.

    Examples
    --------
    >>> blocked = va.open_results("blocked_forces.nc")
    >>> va.plot.blocked_force(blocked).savefig("blocked_forces.png")
    """
    points = [str(name) for name in blocked["force_point"].values]
    frequency = blocked["frequency"].values

    def paint(axes: Axes, point: str) -> None:
        at = blocked.sel(force_point=point)
        amplitude = np.abs(at["blocked_force"].values)
        least = 0.1 * max(amplitude.min(), 1e-9)
        low, high = np.maximum(at["blocked_force_low"], least), at["blocked_force_high"]
        band(axes, frequency, low, high)
        axes.semilogy(frequency, amplitude, color=COLOURS[1], label="blocked force")

    return each_panel(points, 2.0, paint, "Frequency, Hz", "Force, N", shortened, 2, 1)


@needs("validation_measured", "validation_predicted", from_=_FROM)
def blocked_validation(blocked: xr.Dataset) -> Figure:
    """Levels by the blocked forces beside those measured, where no force is inverted from.

    Parameters
    ----------
    blocked : of `blocked_forces`; needs `validation_measured`, `validation_predicted`,
        `validation_predicted_low`, `validation_predicted_high` (validation_point, frequency), dB

    Raises
    ------
    ParameterError
        The dataset holds none.

    Examples
    --------
    >>> blocked = va.open_results("blocked_forces.nc")
    >>> va.plot.blocked_validation(blocked).savefig("validation.png")
    """
    points = [str(name) for name in blocked["validation_point"].values]
    frequency = blocked["frequency"].values

    def paint(axes: Axes, point: str) -> None:
        at = blocked.sel(validation_point=point)
        measured, predicted = at["validation_measured"], at["validation_predicted"]
        top = float(measured.max()) + 5.0
        low = np.maximum(at["validation_predicted_low"], top - _RANGE_DB)
        band(axes, frequency, low, at["validation_predicted_high"])
        axes.plot(frequency, measured, color=COLOURS[0], label="measured")
        axes.plot(frequency, predicted, "--", color=COLOURS[1], label="by the blocked forces")
        axes.set_ylim(max(top - _RANGE_DB, float(measured.min()) - 5.0), top)
        is_sound = at["validation_quantity"].item() == "sound pressure"
        axes.set_ylabel(f"Level, dB re {'20 µPa' if is_sound else '1 µm/s²'}")

    return each_panel(points, 2.2, paint, "Frequency, Hz", title=shortened, columns=3, rows=1)


def blocked_figures(blocked: xr.Dataset) -> list[Picture]:
    """The forces and their validation."""
    return [
        Picture(
            "blocked_forces",
            "Blocked forces with their 90 % bands.",
            "Amplitudes of the blocked forces with their 90 % bands.",
            png(blocked_force(blocked)),
        ),
        Picture(
            "validation",
            "Levels by the blocked forces and as measured.",
            "Levels where no force is inverted from: by the blocked forces and as measured.",
            png(blocked_validation(blocked)),
        ),
    ]
