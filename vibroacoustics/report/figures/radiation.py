"""Charts of the mounts, and of the radiation from the housing to the microphones."""

from typing import Final

import numpy as np
import xarray as xr

from ...base import rounding
from ...results.estimates import has_samples
from ...results.stored_study import catalogue_receiver, first_order_hz, options, speeds
from ...results.titles import chosen
from ..charts.axes import option_panel
from ..charts.layout import COLOURS, wrapped
from ..charts.marks import Axis, Chart, Line, Panel, Points, Segments, Span, frequency_axis, lines
from ..charts.needs import needs
from ..file_names import file_name
from ..kwave_words import computed_by_kwave, kwave_to_hz
from ..sections.comparison import comparison
from ..shown_speeds import few_speeds, many_speeds


def first_order_mark(
    results: xr.Dataset, label: str = "", colour: str = "#888888"
) -> Span | Segments:
    """Return a dotted line at every speed; where there are many, a band over their range."""
    frequencies = first_order_hz(results)
    if many_speeds(results):
        return Span(float(frequencies.min()), float(frequencies.max()), label, "#888888")
    ends = np.full(len(frequencies), np.nan)
    return Segments(frequencies, ends, frequencies, ends, label, colour, ":")


@needs("mount_transmissibility")
def mount_transmissibility(results: xr.Dataset) -> Chart:
    """Sum of the foot forces per force over frequency, with 1x marked at every speed.

    Parameters
    ----------
    results : results of `run`; needs `mount_transmissibility` (axis, mount_frequency), 1
    """
    nominal, attaching, curves = abs(results["mount_transmissibility"]), [], []
    if "option_mount_transmissibility" in results:
        attaching = list(abs(results["option_mount_transmissibility"]).dropna("option"))
    frequency = nominal["mount_frequency"].values
    looks = zip(nominal, ["-", "--", "-."], (COLOURS[3], COLOURS[2], COLOURS[5]), strict=True)
    for curve, dash, colour in looks:
        axis = curve["axis"].item()
        curves.append(Line(frequency, curve, f"along {axis}", colour=colour, dash=dash))
        for option in attaching:
            label = f"along {axis}, {option['option'].item()}"
            along = option.sel(axis=axis)
            curves.append(Line(frequency, along, label, None, colour, dash, width=0.7))
    first = first_order_mark(results, "1× at the speeds of the study", "#000000")
    unity = Segments([frequency[0]], [1.0], [frequency[-1]], [1.0], colour="#888888", width=0.8)
    x, y = (
        frequency_axis("Frequency, Hz", frequency),
        Axis("Sum of foot forces per force, 1", "log"),
    )
    panel = Panel(x, y, (*curves, first, unity), height=3.0)
    return Chart(
        "mount_transmissibility",
        "Transmissibility of the mounts along x, y and z against frequency, above 1 around the "
        "natural frequencies and falling above them.",
        "Sum of the foot forces per force at the centre of mass, along the same axis. Below 1 the "
        f"mounts isolate. 1× is at {_first_order(results)}.",
        (panel,),
    )


def _first_order(results: xr.Dataset) -> str:
    """Frequencies of 1×: the first two, or the range of many."""
    shaft = first_order_hz(results)
    if many_speeds(results):
        return f"{rounding.span(shaft, rounding.fixed)} Hz"
    marks = " and ".join(f"{frequency:.1f} Hz" for frequency in shaft[:2])
    return marks if len(shaft) <= 2 else f"{marks} and further speeds"


NEGLIGIBLE: Final = 1e-4
"""Motions are not drawn whose largest transfer is below this share of the largest of their kind:
what symmetry forbids comes out of the grid at some 1e-5."""


@needs("level_total", "level_modelled", "order_level")
def levels(results: xr.Dataset, receiver: str | None = None) -> Chart:
    """A-weighted levels of the 1x line, of all that is modelled and of the machine, dB(A).

    A row an option, a panel a speed (six at most).

    Parameters
    ----------
    results : results of `run`; needs `level_total`, `level_modelled` (speed, option, receiver, …)
        and `order_level`, dB
    receiver : one of the results' microphones; default: that of the catalogue's noise
    """
    mic = chosen(results, "receiver", receiver or catalogue_receiver(results))
    compared, names = comparison(results).sel(receiver=mic), options(results)
    what = "sources" if has_samples(results) else "orders"
    kinds = {
        "level_1x_dba": ("1× line", None, COLOURS[3], "o"),
        "level_modelled_dba": (f"all modelled {what}", None, COLOURS[1], "D"),
        "level_total_dba": ("total", None, COLOURS[0], "s"),
    }
    shown = compared[list(kinds)].where(compared[list(kinds)] >= rounding.LEVEL_FLOOR_DB)
    x, rows = Axis("A-weighted level, dB(A) re 20 µPa"), np.arange(len(names))
    panels = tuple(
        option_panel(
            x,
            names,
            (Points(shown[name].sel(speed=speed), rows, *looks) for name, looks in kinds.items()),
            f"{speed:g} rpm",
        )
        for speed in speeds(few_speeds(results))
    )
    total = compared["level_total_dba"]
    is_far = float(compared["level_modelled_dba"].max()) < float(total.min()) - 10.0
    caption = f"1× line, all modelled {what} and total{', medians' * has_samples(results)}."
    if is_far:
        caption = "The total does not change because the modelled orders are far below it."
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
    results : results of `run`; needs `transfer_vector` (receiver, dof, frequency), Pa s/m
    receiver : one of the results' microphones; default: that of the catalogue's noise
    """
    mic = chosen(results, "receiver", receiver or catalogue_receiver(results))
    field = abs(results["transfer_vector"].sel(receiver=mic))
    marked = "Grey band" if many_speeds(results) else "Vertical dotted lines"
    is_compared = mic in kwave_to_hz(results)
    closed = abs(results["transfer_vector_closed_form"].sel(receiver=mic)) if is_compared else None
    first, x = first_order_mark(results), frequency_axis("Frequency, Hz", field["frequency"])
    panels = tuple(
        Panel(
            x, Axis(unit, "log"), (*_transfers(field, closed, title[0].lower()), first), title, 2.5
        )
        for title, unit in (("Translations", "Pa per m/s"), ("Rotations", "Pa per rad/s"))
    )
    greens = ", closed-form Green's function"
    if is_compared:
        greens = ": k-Wave's Green's function coloured, closed form dotted"
    return Chart(
        f"transfer_{file_name(mic)}",
        f"Sound pressure at {mic} per velocity of the housing against frequency, for translations "
        f"and rotations{'; k-Wave and closed form' if is_compared else ''}.",
        f"Sound pressure at {mic} per velocity of the housing{greens}. Motions: tx, ty, tz along "
        "x, y, z; rx, ry, rz about them. Motions that do not radiate are omitted. "
        f"{marked}: 1× at the speeds of the study. Other microphones: in "
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
            x = field["frequency"]
            marks.append(Line(x, field.sel(dof=dof), dof, colour=colour, dash=dash))
            if closed is not None:
                exact = closed.sel(dof=dof)
                marks.append(Line(x, exact, "closed form", None, "#000000", ":", width=1.1))
    return marks


@needs("green_difference", from_="`run` of a study whose room k-Wave computes")
def green_difference(results: xr.Dataset) -> Chart:
    """k-Wave's Green's function against the closed form over frequency, dB.

    Parameters
    ----------
    results : results of `run`; needs `green_difference` (receiver, frequency), dB
    """
    gap = computed_by_kwave(results)
    names = [wrapped(str(name), 24) for name in gap["receiver"].values]
    ends = gap["frequency"].values[[0, -1]]
    zero = Segments(ends[:1], [0.0], ends[1:], [0.0], colour="#888888", width=0.8)
    curves = lines(gap["frequency"], zip(names, gap.values, strict=True))
    x, y = Axis("Frequency, Hz"), Axis("k-Wave − closed form, dB")
    return Chart(
        "green_difference",
        "Difference between k-Wave's Green's function and the closed form against frequency, at "
        f"its microphones; at most {float(abs(results['green_difference']).max()):.2f} dB.",
        "k-Wave's Green's function against the closed form, level difference at its microphones.",
        (Panel(x, y, (*curves, zero)),),
    )
