"""Section on switching off, compared with steady running."""

from typing import Final

import numpy as np
import xarray as xr

from ...base import rounding
from ...base.arrays import Array
from ...base.registry import register
from ...base.vocabulary import REFERENCE_OPTION
from ...results.stored_study import parameters, speeds
from ..blocks import Block, Pictures, Text
from ..figures.stopping import force_and_moments, stopping, stopping_order_map
from ..shown_speeds import chosen_speeds, few_speeds
from ..tables import DataTable, Table, long_table
from . import Section, hold
from .sources.words import LINE_FIGURE


def sentences(results: xr.Dataset) -> tuple[str, ...]:
    """Forces and levels of the stop, its order map, and neglected effects."""
    return (_finding(results), *_turned_back(results), _map_sentence(results), _limits(results))


def _greatest(over_time: xr.DataArray) -> tuple[Array, Array]:
    """Greatest values before switch-off and from then on, shape (speed,)."""
    time = over_time["stopping_time"]
    parts = (over_time.where(during).max("stopping_time") for during in (time < 0.0, time >= 0.0))
    before, after = (np.asarray(part.values) for part in parts)
    return before, after


_PHASES: Final = ("steady", "stopping")


def _finding(results: xr.Dataset) -> str:
    steady, stopping = results["stopping_foot_force"].sel(stopping_phase=list(_PHASES)).values
    speed = int(np.argmax(stopping))
    whose = "One weighted sample: switched" if "representative_value" in results else "Switched"
    return (
        f"{whose} off at {speeds(results)[speed]:g} rpm the shaft comes to rest in "
        f"{rounding.significant(results['stopping_duration'].values[speed])} s, after "
        f"{rounding.fixed(results['stopping_revolutions'].values[speed])} revolutions. The largest "
        f"force into a foot is {rounding.significant(stopping[speed])} N. In steady running "
        f"without torque ripple it is {rounding.significant(steady[speed])} N. The motor's torque "
        "at twice the line frequency makes "
        f"{rounding.significant(_line_foot_force_n(results, speed))} N. "
    ) + _loudest(results.isel(speed=speed))


def _loudest(results: xr.Dataset) -> str:
    """Sentence on the loudest stop at one speed."""
    level = results["stopping_fast_maximum_level"].sel(stopping_phase=list(_PHASES))
    rise = np.subtract(*level.values[::-1])
    most, loudest = int(np.argmax(rise)), int(np.argmax(level.values[1]))
    names = level["receiver"].values
    return (
        f"The greatest Fast level rises by up to {rounding.fixed(float(rise[most]))} dB (at "
        f"{names[most]}); at most it is {rounding.level(float(level.values[1, loudest]))} dB(A) "
        f"(at {names[loudest]})."
    )


def _line_foot_force_n(results: xr.Dataset, speed: int) -> float:
    if LINE_FIGURE not in results["figure"].values:
        return float("nan")
    figures = results["reported_figure"].sel(option=REFERENCE_OPTION).isel(speed=speed)
    return float(figures.sel(figure=LINE_FIGURE))


def _map_sentence(results: xr.Dataset) -> str:
    turned = rounding.span(results["stopping_revolutions"].values, rounding.fixed)
    words = (
        ". The order map is that of a stop from the highest speed without gas load."
        if "stopping_order_map" in results
        else ", too few for an order map even without gas load."
    )
    return f"The shaft turns {turned} times while it stops{words}"


def _limits(results: xr.Dataset) -> str:
    stop = parameters(results)["machine"]["stopping"]
    left_out = _TURNED_BACK if "stopping_brake_force" in results else _NOT_TURNED_BACK
    return (
        f"Assumed: the orbiting set turns by {rounding.fixed(np.degrees(stop['shift_rad']))}° "
        f"against its counterweights within {rounding.significant(1e3 * stop['shift_duration_s'])} "
        f"ms. The gas keeps {rounding.fixed(100.0 * stop['gas_share_ratio'], 0)} % of its torque "
        f"until the shaft is at rest; the motor's torque ends at once. {left_out}"
    )


def _turned_back(results: xr.Dataset) -> tuple[str, ...]:
    """Say what follows the first rest, where it is computed."""
    if "stopping_brake_force" not in results:
        return ()
    angle = np.degrees(results["stopping_turned_back_angle"].values)
    force = results["stopping_brake_force"].values
    jam = (
        f"the brake jams with up to {rounding.significant(float(force.max()))} N around the shaft"
        if force.any()
        else "the brake does not jam"
    )
    span = rounding.span(angle, rounding.fixed)
    return (f"Trapped gas turns the shaft back by {span}°; {jam}.",)


_NOT_TURNED_BACK: Final = (
    "Sound is that of the rigid housing. Neglected: the impact at the end of the turn, gas that "
    "turns the shaft back, valves, the elastic shell."
)
_TURNED_BACK: Final = (
    "Sound is that of the housing and, where a source drives it, of the shell under gas, brake and "
    "valve. Neglected: the impact at the end of the turn, keys and motor in the shell."
)


def forces_table(results: xr.Dataset) -> Table:
    """Largest forces before and after switch-off, a row per speed."""
    foot = results["stopping_foot_force"].sel(stopping_phase=list(_PHASES)).values
    pairs = [*(_greatest(values) for values in force_and_moments(results)), (foot[0], foot[1])]
    rows = tuple(
        (
            f"{speed:g} rpm",
            rounding.significant(results["stopping_duration"].values[number]),
            rounding.fixed(results["stopping_revolutions"].values[number]),
            *(rounding.significant(part[number]) for pair in pairs for part in pair),
        )
        for number, speed in enumerate(speeds(results))
    )
    what = ("Force, N", "Tilting moment, N m", "Roll moment, N m", "Force into a foot, N")
    head = [f"{name}, {phase}" for name in what for phase in _PHASES]
    caption = "Largest values over time in steady running and while the machine stops"
    return Table(caption, ("Speed", "Time to rest, s", "Revolutions", *head), rows)


def stopping_data(results: xr.Dataset) -> dict[str, DataTable]:
    """Return durations, largest foot forces and greatest levels of the stop."""
    names = ("stopping_duration", "stopping_revolutions", "stopping_turned_back_angle",
             "stopping_brake_force", "stopping_foot_force", "stopping_fast_maximum_level",
             "stopping_peak_level")  # fmt: skip
    return {"stopping.csv": long_table(results, names)}


def _blocks(results: xr.Dataset) -> list[Block]:
    shown = few_speeds(results)
    maps = [stopping_order_map(shown)] if "stopping_order_map" in shown else []
    return [
        *(Text(sentence) for sentence in sentences(results)),
        *chosen_speeds(results, "results.nc"),
        forces_table(shown),
        Text("Levels at all microphones are in stopping.csv.", "note"),
        Pictures((stopping(shown), *maps)),
    ]


_applies = hold("stopping_force")
register(Section("stopping", "Stopping", _blocks, _applies, 80.0, tables=stopping_data))
