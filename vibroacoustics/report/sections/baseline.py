"""The measured baseline: what options make of it, and its limits."""

from pathlib import PurePath
from typing import Any, Final

import numpy as np
import xarray as xr

from ...base import rounding
from ...base.decibel import power_of_level
from ...base.registry import register
from ...base.units import shaft_frequency_hz
from ...base.vocabulary import REFERENCE_OPTION
from ...base.weighting import a_weighting
from ...results.bands import percent
from ...results.estimates import prior_ensemble
from ...results.stored_study import balancers, parameters, speeds
from ..blocks import Block, Bullets, Pictures, Text
from ..figures.sources import baseline_third_octaves
from ..shown_speeds import chosen_speeds, few_speeds
from ..tables import Table
from . import Section

_TOLERANCE: Final = 0.02
"""Share by which a speed may lie outside those that were measured."""


def baseline_of(results: xr.Dataset) -> dict[str, Any]:
    """Parameters of the measured baseline; none where there is none."""
    return (parameters(results).get("measured") or {}).get("baseline") or {}


def microphones(results: xr.Dataset) -> list[str]:
    """Those with a baseline, each once."""
    baseline = baseline_of(results)
    every = [*baseline.get("third_octaves", ()), *baseline.get("orders", ())]
    return list(dict.fromkeys(row["microphone"] for row in every))


def summary(results: xr.Dataset) -> str:
    """Say where the baseline comes from and what is done with it."""
    files = ", ".join(PurePath(name).name for name in baseline_of(results)["file"])
    return (
        f"The sound of the machine without a balancer was measured at "
        f"{', '.join(microphones(results))} ({files}). There total level, orders and "
        "their changes are those measured, less what is modelled without a balancer, plus what is "
        "modelled with the option, band by band and order by order; they take the place of the "
        "published level."
    )


def limits(results: xr.Dataset) -> tuple[str, ...]:
    """Say what the measurement covers, and its limits."""
    sentences = [_of_bands(results), _of_orders(results), _of_speeds(results)]
    sentences += [_of_model(results), _of_others(results), _of_samples(results)]
    return tuple(filter(None, sentences))


def _of_bands(results: xr.Dataset) -> str:
    rows = baseline_of(results).get("third_octaves", ())
    if not rows:
        return (
            "Third octaves were not measured: beside the orders, the unmodelled noise of the "
            "published level counts."
        )
    covered = {row["microphone"]: (min(row["band_hz"]), max(row["band_hz"])) for row in rows}
    ranges = [f"{low:g} to {high:g} Hz at {name}" for name, (low, high) in covered.items()]
    share = not_measured(results)
    size = f", up to {percent(share)} of the energy of the total level" if share > 0.005 else ""
    return (
        f"Third octaves: {', '.join(ranges)}; in other bands the unmodelled noise of the published "
        f"level counts{size}."
    )


def not_measured(results: xr.Dataset) -> float:
    """Largest share of A-weighted energy without an option outside the measured bands."""
    bands = results["baseline_band_level"].sel(option=REFERENCE_OPTION)
    weight = xr.DataArray(a_weighting(bands["baseline_band"].values), dims="baseline_band")
    measured = power_of_level(bands + weight).sum("baseline_band")
    total = power_of_level(results["level_total"].sel(option=REFERENCE_OPTION))
    share = (1.0 - measured / total).where(bands.notnull().any("baseline_band"))
    return float(share.max())


def _of_orders(results: xr.Dataset) -> str:
    if "baseline_order_phase" not in results:
        return "Orders were not measured apart: a tone counts as energy of its band, without phase."
    phase = results["baseline_order_phase"].values
    count, by_phase = int(np.isfinite(phase).sum()), int(np.nansum(phase))
    orders = ", ".join(f"{order:g}" for order in results["baseline_order"].values[:20])
    first = f"Orders {orders} were measured"
    if by_phase == count:
        return f"{first}, all with a phase that counts: they change as complex peaks."
    if baseline_of(results).get("tacho_angle_rad") is None:
        return (
            f"{first}. The crank angle of the tacho's pulse is not given (tacho_angle_deg): they "
            "change as energies, and whether an option's tone adds to the rest or takes off it is "
            "not known."
        )
    return (
        f"{first}; {by_phase} of {count} values (order, speed, microphone) have a phase that "
        "counts and change as complex peaks, the others as energies."
    )


def _of_speeds(results: xr.Dataset) -> str:
    """Speeds of the study that were measured, lie between, or outside."""
    sentences = []
    for name in microphones(results):
        position_at = {f"{speed:g}": _position(results, name, speed) for speed in speeds(results)}
        between = [speed for speed, position in position_at.items() if position == "between"]
        outside = [speed for speed, position in position_at.items() if position == "outside"]
        if between:
            sentences.append(
                f"At {name} levels at {', '.join(between)} rpm are interpolated between measured "
                "speeds, linearly in level and phase; a resonance between them is missed."
            )
        if outside:
            sentences.append(
                f"At {name} nothing was measured at {', '.join(outside)} rpm: there the "
                "unmodelled noise of the published level counts. Do not compare these levels with "
                "those at other speeds."
            )
    return " ".join(sentences)


def _position(results: xr.Dataset, name: str, speed: float) -> str:
    """Third octaves or orders: `outside` of the measured speeds, else `between`, or `measured`."""
    between = False
    for kind in ("third_octaves", "orders"):
        rows = baseline_of(results).get(kind, ())
        rpm = [each["speed_rpm"] for each in rows if each["microphone"] == name]
        if not rpm or min(abs(each / speed - 1.0) for each in rpm) <= _TOLERANCE / 4.0:
            continue
        if not min(rpm) * (1.0 - _TOLERANCE) <= speed <= max(rpm) * (1.0 + _TOLERANCE):
            return "outside"
        between |= min(rpm) < speed < max(rpm)
    return "between" if between else "measured"


def _of_model(results: xr.Dataset) -> str:
    """Say where the model is louder than the measurement."""
    louder = (results["baseline_share"] > 1.0).any(["speed", "receiver"])
    bands = [f"{band:g}" for band in results["baseline_band"].values[louder.values]]
    texts = []
    if bands:
        texts.append(f"the third octaves at {', '.join(bands)} Hz")
    if "baseline_order_share" in results:
        is_louder = (
            results["baseline_order_share"].where(results["baseline_order_phase"] == 0.0) > 1.0
        )
        louder_orders = results["baseline_order"].values[
            is_louder.any(["speed", "receiver"]).values
        ]
        if louder_orders.size:
            texts.append(f"the orders {', '.join(f'{order:g}' for order in louder_orders)}")
    if not texts:
        return ""
    return (
        f"Somewhere the model is louder than what was measured, in {' and '.join(texts)}: there "
        "the model's level stands, and its change is not to be trusted."
    )


def _of_others(results: xr.Dataset) -> str:
    names = map(str, results["receiver"].values)
    others = [name for name in names if name not in microphones(results)]
    if not others:
        return ""
    return f"At {', '.join(others)} nothing was measured: there the published level counts."


def _of_samples(results: xr.Dataset) -> str:
    if prior_ensemble(results) is None:
        return ""
    tolerance = baseline_of(results).get("tolerance_db", 0.0)
    return (
        f"Samples are weighted by the measurement, of ± {tolerance:g} dB: by the A-weighted "
        "level in the measured bands and orders at the lowest, a middle and the highest speed at "
        "each microphone, together as one measurement."
    )


MOST_ORDERS: Final = 10
"""Most orders in a table, the loudest ones."""


def order_tables(results: xr.Dataset) -> list[Table]:
    """The loudest orders at the first microphone where any were measured, with every option."""
    if "baseline_order_level" not in results:
        return []
    is_measured = (
        results["baseline_order_level"].notnull().any(["speed", "option", "baseline_order"])
    )
    name = str(results["receiver"].values[is_measured.values][0])
    here = few_speeds(results).sel(receiver=name)
    measured = here["baseline_order_level"].notnull().any(["option", "baseline_order"])
    return [
        _order_table(here.sel(speed=speed), name, speed)
        for speed, has_values in zip(speeds(here), measured.values.tolist(), strict=True)
        if has_values
    ]


def _order_table(here: xr.Dataset, name: str, speed: float) -> Table:
    here = here.isel(baseline_order=here["baseline_order_phase"].notnull().values)
    level = here["baseline_order_level"]
    measured = level.sel(option=REFERENCE_OPTION).values
    loudest = np.sort(np.argsort(-np.nan_to_num(measured, nan=-np.inf))[:MOST_ORDERS])
    changed = balancers(here)
    rows = tuple(
        (
            f"{order:g}",
            f"{order * shaft_frequency_hz(speed):.1f}",
            "yes" if here["baseline_order_phase"].values[index] > 0.0 else "no",
            rounding.level(float(measured[index])),
            rounding.fixed(100.0 * float(here["baseline_order_share"].values[index]), 0),
            *(rounding.level(float(level.sel(option=option).values[index])) for option in changed),
        )
        for index, order in zip(loudest, here["baseline_order"].values[loudest], strict=True)
    )
    head = ("Order", "Hz", "phase", "measured", "modelled, % of energy", *changed)
    caption = f"Measured orders at {name}, {speed:g} rpm, and with each option, dB re 20 µPa"
    return Table(caption, head, rows, frozenset({2}))


def _blocks(results: xr.Dataset) -> list[Block]:
    has_bands = results["baseline_band_level"].notnull().any()
    return [
        Text(summary(results)),
        Bullets(limits(results)),
        *chosen_speeds(results, "results.nc"),
        *order_tables(results),
        *([Pictures((baseline_third_octaves(results),))] if has_bands else []),
    ]


def _applies(results: xr.Dataset) -> bool:
    return "baseline_share" in results and bool(baseline_of(results))


register(Section("baseline", "Measured baseline", _blocks, _applies, 25.0))
