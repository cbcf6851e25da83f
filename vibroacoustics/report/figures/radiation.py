"""From the motion of the housing to the sound at the microphones."""

from typing import Final

import numpy as np
import xarray as xr

from ...base import rounding
from ...results.estimates import has_samples
from ...results.stored_study import catalogue_receiver, options, speeds
from ...results.titles import chosen
from ..charts.layout import COLOURS, wrapped
from ..charts.marks import (
    Axis,
    Chart,
    Line,
    Panel,
    Points,
    Segments,
    frequency_axis,
    lines,
    named_axis,
)
from ..charts.needs import needs
from ..file_names import file_name
from ..kwave_words import computed_by_kwave, kwave_to_hz
from ..sections.comparison.tables import comparison
from ..shown_speeds import few_speeds
from .first_order import first_order_mark, first_order_words

NEGLIGIBLE: Final = 1e-4
"""Motions are not drawn whose largest transfer is below this share of the largest of their kind:
what symmetry forbids comes out of the grid at some 1e-5."""


@needs("level_total", "level_modelled", "order_level")
def levels(results: xr.Dataset, receiver: str | None = None) -> Chart:
    """A-weighted levels of the 1x line, of all that is modelled and of the machine, dB(A).

    A row an option, a panel a speed (six at most).

    Parameters
    ----------
    results : of `run`; needs `level_total`, `level_modelled` (speed, option, receiver, …) and
        `order_level`, dB
    receiver : one of the results' microphones; default: that of the catalogue's noise
    """
    mic = chosen(results, "receiver", receiver or catalogue_receiver(results))
    compared, names = comparison(results).sel(receiver=mic), options(results)
    what = "sources" if has_samples(results) else "orders"
    kinds = {
        "level_1x_dba": ("1× line", "o", COLOURS[3]),
        "level_modelled_dba": (f"all modelled {what}", "D", COLOURS[1]),
        "level_total_dba": ("total", "s", COLOURS[0]),
    }
    shown = {
        name: compared[name].where(compared[name] >= rounding.LEVEL_FLOOR_DB) for name in kinds
    }
    panels = tuple(
        Panel(
            Axis("A-weighted level, dB(A) re 20 µPa"),
            named_axis(names, wrapped),
            tuple(
                Points(
                    shown[name].sel(speed=speed), np.arange(len(names)), label, None, colour, mark
                )
                for name, (label, mark, colour) in kinds.items()
            ),
            f"{speed:g} rpm",
            0.8 + 0.26 * len(names),
        )
        for speed in speeds(few_speeds(results))
    )
    total = compared["level_total_dba"]
    is_far = float(compared["level_modelled_dba"].max()) < float(total.min()) - 10.0
    caption = (
        "The total does not change because the modelled orders are far below it."
        if is_far
        else f"1× line, all modelled {what} and total{', medians' if has_samples(results) else ''}."
    )
    return Chart(
        "levels",
        f"A-weighted levels at {mic} for every option and speed: 1× line, all modelled {what}, and "
        f"the total near {float(total.mean()):.1f} dB(A).",
        f"A-weighted levels at {mic}. {caption}",
        panels,
    )


@needs("transfer_vector")
def transfer(results: xr.Dataset, receiver: str | None = None) -> Chart:
    """Sound pressure per velocity of the housing over frequency, Pa per m/s and per rad/s.

    Black dots: the closed form of the image sources, where k-Wave ran.

    Parameters
    ----------
    results : of `run`; needs `transfer_vector` (receiver, dof, frequency), Pa s/m
    receiver : one of the results' microphones; default: that of the catalogue's noise
    """
    mic = chosen(results, "receiver", receiver or catalogue_receiver(results))
    field = abs(results["transfer_vector"].sel(receiver=mic))
    is_compared = mic in kwave_to_hz(results)
    closed = abs(results["transfer_vector_closed_form"].sel(receiver=mic)) if is_compared else None
    first, x = first_order_mark(results), frequency_axis("Frequency, Hz", field["frequency"])
    panels = tuple(
        Panel(x, Axis(unit, "log"), (*_transfers(field, closed, letter), first), title, 2.5)
        for title, letter, unit in (
            ("Translations", "t", "Pa per m/s"),
            ("Rotations", "r", "Pa per rad/s"),
        )
    )
    greens = (
        ": coloured lines with k-Wave's Green's function, dotted ones with the closed form"
        if is_compared
        else ", with the closed-form Green's function"
    )
    return Chart(
        f"transfer_{file_name(mic)}",
        f"Sound pressure at {mic} per velocity of the housing against frequency, for translations "
        f"and rotations{'; k-Wave and closed form' if is_compared else ''}.",
        f"Sound pressure at {mic} per velocity of the housing{greens}. tx, ty, tz: motion along x, "
        "y, z; rx, ry, rz: rotation about them; motions that do not radiate are omitted. "
        f"{first_order_words(results)}: 1× at the speeds of the study. Other microphones: in "
        "results.nc.",
        panels,
    )


def _transfers(field: xr.DataArray, closed: xr.DataArray | None, letter: str) -> list[Line]:
    """Lines of the motions of a kind that radiate, and their closed form."""
    dofs = [dof for dof in map(str, field["dof"].values) if dof.startswith(letter)]
    largest = field.sel(dof=dofs).max("frequency")
    looks = zip(dofs, ["-", "--", "-."], (COLOURS[3], COLOURS[1], COLOURS[5]), strict=False)
    marks = []
    for dof, dash, colour in looks:
        if largest.sel(dof=dof) > NEGLIGIBLE * largest.max():
            curve = field.sel(dof=dof)
            marks.append(Line(curve["frequency"], curve, dof, colour=colour, dash=dash))
            if closed is not None:
                exact = closed.sel(dof=dof)
                label = "closed form"
                marks.append(
                    Line(curve["frequency"], exact, label, colour="#000000", dash=":", width=1.1)
                )
    return marks


@needs("green_difference", from_="`run` of a study whose room k-Wave computes")
def green_difference(results: xr.Dataset) -> Chart:
    """k-Wave's Green's function against the closed form over frequency, dB.

    Parameters
    ----------
    results : of `run`; needs `green_difference` (receiver, frequency), dB
    """
    gap = computed_by_kwave(results)
    names = [wrapped(str(name), 24) for name in gap["receiver"].values]
    ends = gap["frequency"].values[[0, -1]]
    zero = Segments(ends[:1], [0.0], ends[1:], [0.0], colour="#888888", width=0.8)
    curves = lines(gap["frequency"], zip(names, gap.values, strict=True))
    y = Axis("k-Wave − closed form, dB")
    return Chart(
        "green_difference",
        "Difference between k-Wave's Green's function and the closed form against frequency, at "
        f"its microphones; at most {float(abs(results['green_difference']).max()):.2f} dB.",
        "k-Wave's Green's function against the closed form, level difference at its microphones.",
        (Panel(Axis("Frequency, Hz"), y, (*curves, zero)),),
    )
