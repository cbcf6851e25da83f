"""Levels of sources and orders in a run-up between the speeds of a study."""

import xarray as xr

from ...base.vocabulary import REFERENCE_OPTION
from ...results.stored_study import catalogue_receiver
from ...results.titles import chosen
from ..charts.marks import Axis, Chart, Image, Line, Panel
from ..charts.needs import needs
from .stacked import DEPTH_DB, part_colours


@needs("run_up_level", "run_up_source_level", from_="`run` of a study with few speeds")
def run_up_levels(results: xr.Dataset, receiver: str | None = None) -> Chart:
    """A-weighted levels of machine, sources and unmodelled noise over speed in a run-up.

    Parameters
    ----------
    results : of `run`; needs `run_up_level` (run_up_speed, receiver), dB, and its parts
    receiver : one of the results' microphones; default: that of the catalogue's noise
    """
    mic = chosen(results, "receiver", receiver or catalogue_receiver(results))
    total = results["run_up_level"].sel(receiver=mic)
    speed, top = total["run_up_speed"].values, float(total.max())
    levels = results["run_up_source_level"].sel(receiver=mic)
    curves = {str(part): levels.sel(sound_source=part) for part in levels["sound_source"].values}
    curves["unmodelled"] = results["run_up_unmodelled_level"]
    shown = {part: level for part, level in curves.items() if level.max() > top - DEPTH_DB}
    parts = tuple(
        Line(speed, shown[part], words, colour=colour)
        for part, (words, colour) in zip(shown, part_colours(results, list(shown)), strict=True)
    )
    machine = Line(speed, total, "machine", colour="#000000", dash="-", width=2.4)
    y = Axis("Level, dB(A)", limits=(top - DEPTH_DB, top + 3.0))
    return Chart(
        "run_up_levels",
        f"A-weighted levels of the machine and its sources at {mic} over speed.",
        f"A-weighted levels at {mic} in a run-up, option {REFERENCE_OPTION}, of the representative "
        f"sample. Sources more than {DEPTH_DB:g} dB below the machine are not drawn.",
        (Panel(Axis("Speed, rpm"), y, (*parts, machine), height=3.0),),
    )


@needs("run_up_order_level", from_="`run` of a study with few speeds")
def run_up_orders(results: xr.Dataset, receiver: str | None = None) -> Chart:
    """A-weighted level of each order of all sources together over speed in a run-up, as colours.

    Parameters
    ----------
    results : of `run`; needs `run_up_order_level` (run_up_speed, receiver, run_up_order), dB
    receiver : one of the results' microphones; default: that of the catalogue's noise
    """
    mic = chosen(results, "receiver", receiver or catalogue_receiver(results))
    level = results["run_up_order_level"].sel(receiver=mic)
    level = level.transpose("run_up_speed", "run_up_order")
    scale = (float(level.max()) - DEPTH_DB, float(level.max()))
    image = Image(level["run_up_order"], level["run_up_speed"], level, scale, "dB(A)")
    return Chart(
        "run_up_orders",
        f"A-weighted level of each order at {mic} over speed.",
        f"A-weighted level of each order of all sources at {mic} in a run-up, option "
        f"{REFERENCE_OPTION}, of the representative sample; {DEPTH_DB:g} dB shown.",
        (Panel(Axis("Shaft order", integer=True), Axis("Speed, rpm"), (image,), height=3.0),),
    )
