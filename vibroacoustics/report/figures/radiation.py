"""From the motion of the housing to the sound at the microphones."""

from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...base import rounding
from ...results.estimates import has_samples
from ...results.stored_study import catalogue_receiver, options, speeds
from ..charts.needs import needs
from ..comparison import comparison
from ..kwave_words import computed_by_kwave, kwave_to_hz
from ..shown_speeds import few_speeds
from ..titles import chosen
from .first_order import first_order_marks, mark_first_order
from .panels import each_panel, in_rpm, lines, named_rows, one_panel
from .style import COLOURS, Picture, file_name, frequency_ticks, png, wrap

NEGLIGIBLE: Final = 1e-4
"""Motions are not drawn whose largest transfer is below this share of the largest of their kind:
what symmetry forbids comes out of the grid at some 1e-5."""

_KINDS: Final = (("translations", "t", "Pa per m/s"), ("rotations", "r", "Pa per rad/s"))


def transfer_figures(results: xr.Dataset) -> list[Picture]:
    """Transfer vectors at the catalogue's microphone; where k-Wave ran, its check at all."""
    pictures = [_transfer(results, catalogue_receiver(results))]
    return [*pictures, _difference(results)] if kwave_to_hz(results) else pictures


@needs("level_total", "level_modelled", "order_level")
def levels(results: xr.Dataset, receiver: str | None = None) -> Figure:
    """A-weighted levels of the 1x line, of all that is modelled and of the whole machine, dB(A).

    A row an option, a panel a speed (six at most).

    Parameters
    ----------
    results : of `run`; needs `level_total`, `level_modelled` (speed, option, receiver, …) and
        `order_level`, dB
    receiver : one of the results' microphones; default: that of the catalogue's noise

    Raises
    ------
    ParameterError
        The results hold none, or there is no such receiver.

    Examples
    --------
    >>> results = va.open_results("results.nc")
    >>> va.plot.levels(results).savefig("levels.png")
    """
    at = chosen(results, "receiver", receiver or catalogue_receiver(results))
    compared = comparison(results).sel(receiver=at)
    names, shown_speeds = options(results), speeds(few_speeds(results))
    what = _modelled(results)
    kinds = {
        "level_1x_dba": ("1× line", "o", 6, COLOURS[3]),
        "level_modelled_dba": (f"all modelled {what}", "|", 13, COLOURS[1]),
        "level_total_dba": ("total", "s", 6, COLOURS[0]),
    }

    def paint(axes: Axes, speed: float) -> None:
        for column, (label, marker, size, colour) in kinds.items():
            values = compared[column].sel(speed=speed).values
            shown = np.where(values >= rounding.LEVEL_FLOOR_DB, values, np.nan)
            (dots,) = axes.plot(shown, range(len(names)), marker, color=colour, label=label)
            dots.set(markersize=size, markeredgewidth=1.6)
        named_rows(axes, names)

    return each_panel(
        shown_speeds, 0.7 + 0.26 * len(names), paint, "A-weighted level, dB(A) re 20 µPa",
        title=in_rpm, columns=3, rows=1, sharex=True,
    )  # fmt: skip


def level_figures(results: xr.Dataset) -> list[Picture]:
    """Where line, modelled level and total lie, for every option and speed."""
    receiver = catalogue_receiver(results)
    compared = comparison(results).sel(receiver=receiver)
    what = _modelled(results)
    total = compared["level_total_dba"]
    return [
        Picture(
            "levels",
            f"A-weighted levels at {receiver} for every option and speed: 1× line, all modelled "
            f"{what}, and the total near {float(total.mean()):.1f} dB(A).",
            f"A-weighted levels at {receiver}. The total stays where it is because the modelled "
            "orders lie far below it."
            if float(compared["level_modelled_dba"].max()) < float(total.min()) - 10.0
            else f"A-weighted levels at {receiver}: 1× line, all modelled {what} and the total"
            f"{', medians' if has_samples(results) else ''}.",
            png(levels(results)),
        )
    ]


def _modelled(results: xr.Dataset) -> str:
    return "sources" if has_samples(results) else "orders"


@needs("transfer_vector")
def transfer(results: xr.Dataset, receiver: str | None = None) -> Figure:
    """Sound pressure per velocity of the housing over frequency, Pa per m/s and per rad/s.

    Black dots: the closed form of the image sources, where k-Wave ran.

    Parameters
    ----------
    results : of `run`; needs `transfer_vector` (receiver, dof, frequency), Pa s/m
    receiver : one of the results' microphones; default: that of the catalogue's noise

    Raises
    ------
    ParameterError
        The results hold none, or there is no such receiver.

    Examples
    --------
    >>> results = va.open_results("results.nc")
    >>> va.plot.transfer(results).savefig("transfer.png")
    """
    receiver = chosen(results, "receiver", receiver or catalogue_receiver(results))
    simulated = abs(results["transfer_vector"].sel(receiver=receiver))
    compared = receiver in kwave_to_hz(results)
    closed = (
        abs(results["transfer_vector_closed_form"].sel(receiver=receiver)) if compared else None
    )

    def paint(axes: Axes, kind: tuple[str, str, str]) -> None:
        _, letter, unit = kind
        _transfer_panel(axes, simulated, closed, letter)
        axes.set_ylabel(unit)
        mark_first_order(axes, results, "#888888")

    return each_panel(
        _KINDS, 2.5, paint, "Frequency, Hz", title=lambda kind: kind[0].capitalize(), sharex=True
    )


def _transfer(results: xr.Dataset, receiver: str) -> Picture:
    compared = receiver in kwave_to_hz(results)
    greens = (
        ": coloured lines with k-Wave's Green's function, black dots with the closed form"
        if compared
        else ", with the closed-form Green's function"
    )
    return Picture(
        f"transfer_{file_name(receiver)}",
        f"Sound pressure at {receiver} per velocity of the housing against frequency, for "
        f"translations and rotations{'; k-Wave and closed form' if compared else ''}.",
        f"Sound pressure at {receiver} per velocity of the housing{greens}. "
        "tx, ty, tz: motion along x, y, z; "
        "rx, ry, rz: rotation about them; motions that do not radiate there are left out. "
        f"{first_order_marks(results)}: 1× at the speeds of the study. Other microphones: in "
        "results.nc.",
        png(transfer(results)),
    )


def _transfer_panel(
    axes: Axes, simulated: xr.DataArray, closed: xr.DataArray | None, letter: str
) -> None:
    dofs = [dof for dof in map(str, simulated["dof"].values) if dof.startswith(letter)]
    largest = simulated.sel(dof=dofs).max("frequency")
    radiating = [dof for dof in dofs if largest.sel(dof=dof) > NEGLIGIBLE * largest.max()]
    colours = dict(zip(dofs, (COLOURS[3], COLOURS[1], COLOURS[5]), strict=True))
    for dof, dash in zip(radiating, ("-", "--", "-."), strict=False):
        curve = simulated.sel(dof=dof)
        axes.loglog(curve["frequency"], curve, dash, color=colours[dof], label=dof)
        if closed is not None:
            axes.loglog(curve["frequency"], closed.sel(dof=dof), ":", color="black", linewidth=1.1)
    if radiating:
        axes.legend(loc="lower right", frameon=False, ncols=3)
    frequency_ticks(axes, simulated["frequency"].values)


@needs("green_difference", from_="`run` of a study whose room k-Wave computes")
def green_difference(results: xr.Dataset) -> Figure:
    """k-Wave's Green's function against the closed form over frequency, dB.

    Parameters
    ----------
    results : of `run`; needs `green_difference` (receiver, frequency), dB

    Raises
    ------
    ParameterError
        The results hold none.

    Examples
    --------
    >>> results = va.open_results("results.nc")
    >>> va.plot.green_difference(results).savefig("green_difference.png")
    """
    gap = computed_by_kwave(results)
    names = [wrap(str(name), 24) for name in gap["receiver"].values]

    def paint(axes: Axes) -> None:
        lines(axes, gap["frequency"], names, gap)
        axes.axhline(0.0, color="#888888", linewidth=0.8)

    y, rows = "k-Wave − closed form, dB", (len(names) + 1) // 2
    return one_panel(2.4, paint, "Frequency, Hz", y, columns=2, rows=rows)


def _difference(results: xr.Dataset) -> Picture:
    gap = results["green_difference"]
    return Picture(
        "green_difference",
        "Difference between k-Wave's Green's function and the closed form against frequency, at "
        f"its microphones; at most {float(abs(gap).max()):.2f} dB.",
        "k-Wave's Green's function against the closed form, level difference at its microphones.",
        png(green_difference(results)),
    )
