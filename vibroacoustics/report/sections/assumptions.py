"""Sources of the inputs, and neglected effects."""

from typing import Any, Final

import xarray as xr

from ...base import rounding
from ...base.decibel import level_of_power, power_of_level
from ...base.registry import register
from ...results.bands import INTERVAL, band
from ...results.estimates import has_samples
from ...results.stored_study import (
    catalogue_receiver,
    level_bias_db,
    level_kind,
    operating_points,
    overall_noise,
    parameters,
    quoted_dba,
    words,
)
from ..blocks import Block, Bullets, Heading, Text
from ..remainder import growth_sentence
from ..tables import DataTable, Table, columns_of
from . import Section, text
from .unknowns import dotted, in_si

SHOWN: Final = 5
"""Inputs on the page."""

LOUD_LINE_BELOW_TOTAL_DB: Final = 11.0
"""A pessimistic structure-borne 1x line: 45 of 56 dB(A)."""

RIGID_SHELL: Final = (
    "The shell is rigid: its elastic modes and the internal forces that drive them, which make "
    "most of the sound, are not modelled.",
)

ELASTIC_SHELL: Final = (
    "The elastic shell is empty, without feet, tubes and terminal box. The parts inside are rigid "
    "and touch it at welds only.",
    "Contacts of the wraps, bearing noise, magnetic forces other than the torque and jets of the "
    "gas are {unmodelled}.",
)
"""Instead of RIGID_SHELL where sources drive the shell."""

RIGID_FLOOR: Final = "rigid for the mounts and hard"
COMPLIANT_FLOOR: Final = (
    "compliant under each foot by itself and silent; natural frequencies are those on a rigid "
    "floor. It is hard"
)
NOT_MODELLED: Final = (
    "Gas pulsation in the suction and discharge pipes is not modelled.",
    "Structure-borne sound of floor, panels and pipes is not modelled; forces into the feet are "
    "reported.",
    "The floor is {floor} for the sound; there are no other walls.",
    "Levels are those at the study's microphones; a rocking machine is louder elsewhere.",
)


def not_modelled(results: xr.Dataset) -> tuple[str, ...]:
    """Effects that the results neglect, one sentence or two each."""
    of_shell = ELASTIC_SHELL if words(results)["shell_bends"] else RIGID_SHELL
    unmodelled = "in no level" if overall_noise(results) is None else "unmodelled noise"
    machine = parameters(results)["machine"]
    is_compliant = machine.get("floor") or machine.get("floor_mobility")
    everywhere = tuple(
        text.format(floor=COMPLIANT_FLOOR if is_compliant else RIGID_FLOOR, unmodelled=unmodelled)
        for text in (*of_shell, *NOT_MODELLED)
    )
    return (*everywhere, *_mounts_held(machine), *words(results)["leaves_out"])


def _mounts_held(machine: dict[str, Any]) -> tuple[str, ...]:
    """Ends of the stiffness of mounts from files."""
    feet = (machine.get("feet") or {}).values()
    tables = [machine.get("mount_stiffness"), *(foot and foot["stiffness"] for foot in feet)]
    frequencies = [table["frequency_hz"] for table in tables if table]
    if not frequencies:
        return ()
    lowest, highest = max(each[0] for each in frequencies), min(each[-1] for each in frequencies)
    return (
        f"Stiffness and loss of the mounts are known from {lowest:g} to {highest:g} Hz, and "
        "constant below and above.",
    )


def inputs_data(results: xr.Dataset) -> dict[str, DataTable]:
    """Every recorded value with its range, the range in SI, and why a range is not sampled."""
    held = {dotted(item): item for item in parameters(results).get("held_ranges", ())}
    sampled = {dotted(item): item for item in parameters(results).get("ranges", ())}
    rows = []
    for record in parameters(results)["records"]:
        name = in_si(record["field"])
        item = sampled.get(name) or held.get(name) or {}
        use = item.get("reason", "sampled") if item else ""
        ends = [of.get(end) for of in (record, item) for end in ("lowest", "highest")]
        cells = ["" if end is None else end for end in ends]
        named = (record["field"], record["value"], record["unit"] or "1")
        origin = "example" if record.get("example") else ""
        rows.append((*named, *cells, use, origin, record["source"], record["file"]))
    head = ("field", "value", "unit", "lowest", "highest", "lowest_si", "highest_si", "use",
            "origin", "source", "file")  # fmt: skip
    return {"inputs.csv": columns_of(head, rows)}


def records_table(results: xr.Dataset) -> Table:
    """Recorded values that the level depends on most, or with the widest ranges."""
    shares: dict[str, float] = {}
    if "level_share" in results:  # before any data
        share = results["level_share"].isel(knowledge=0)
        shares = dict(zip(share["uncertain_parameter"].values, share.values.tolist(), strict=True))

    def weight(record: dict[str, Any]) -> tuple[float, float]:
        low, high = (record[end] or 0.0 for end in ("lowest", "highest"))
        width = (high - low) / (max(abs(low), abs(high)) or 1.0)
        return shares.get(in_si(record["field"]), 0.0), width

    ordered = sorted(parameters(results)["records"], key=weight, reverse=True)
    head = ("Value of", "Value", "Unit", "Range", "Source")
    rows = []
    for record in ordered[:SHOWN]:
        low, high, value = record["lowest"], record["highest"], record["value"].replace("-", "−")
        span = rounding.NOTHING if low is None else f"{low:g} to {high:g}".replace("-", "−")
        rows.append((record["field"], value, record["unit"] or "1", span, record["source"]))
    what = "that the level depends on most" if shares else "with the widest ranges"
    return Table(f"Inputs {what}", head, tuple(rows), frozenset({0, 2, 4}))


def unmodelled_sentence(results: xr.Dataset) -> str:
    """Say how the unmodelled noise is determined."""
    noise = overall_noise(results)
    if noise is None:
        return growth_sentence(results)
    kind = level_kind(results)
    bias, spread = level_bias_db(results)
    lower = f" It stands for one {bias:g} ± {spread:g} dB lower." if bias else ""
    unmodelled = f"{rounding.fixed(results['level_unmodelled'].item())} dB(A)"
    if has_samples(results):
        unmodelled = f"{band(results, 'level_unmodelled').ends(rounding.fixed)} dB(A) ({INTERVAL})"
    return (
        f"The {kind} level is {noise['level_dba']:g} dB(A) at {noise['distance_m']:g} m and "
        f"{noise['speed_rpm']:g} rpm{_point_words(results)}.{lower} Unmodelled noise at "
        f"{catalogue_receiver(results)} without a balancer is {unmodelled}. It is added as energy "
        "at every option and microphone, spread as from a source at the machine. "
        f"{growth_sentence(results)}"
    )


def discrepancy_sentence(results: xr.Dataset) -> str:
    """Deviations of the model that no range covers; empty where nothing was sampled."""
    settings = parameters(results).get("uncertainty") or {}
    if not has_samples(results) or "path_deviation_db" not in settings:
        return ""
    path, source, band_db, added = (
        f"{settings[f'{name}_deviation_db']:g} dB" for name in ("path", "source", "band", "added")
    )
    return (
        f"Model deviations: {path} common to all sources, {source} of each source, {band_db} of "
        f"its third octaves, {added} of an option. These standard deviations are assumed, the "
        "same for all options, speeds and microphones."
    )


def _point_words(results: xr.Dataset) -> str:
    """Operating point of the overall noise, and where the machine runs elsewhere."""
    runs_at, point = operating_points(results)
    if point is None:
        return ""
    here = f"the operating point {runs_at}" if runs_at else "the values of its file"
    other = "" if point == runs_at else f"; the machine runs at {here}"
    return f" at the operating point {point}{other}"


def structure_borne_sentence(results: xr.Dataset) -> str:
    """Say what removing a line would buy, were it far louder through the feet than through the
    air."""
    total = quoted_dba(results)
    gain = level_of_power(1.0 - power_of_level(-LOUD_LINE_BELOW_TOTAL_DB))
    return (
        f"A 1× line of {total - LOUD_LINE_BELOW_TOTAL_DB:g} dB(A) through the feet, removed "
        f"altogether, would lower {total:g} dB(A) by {rounding.fixed(abs(gain), 2)} dB."
    )


def _blocks(results: xr.Dataset) -> list[Block]:
    records = parameters(results)["records"]
    assumed = sum(str(record["source"]).startswith("assumed") for record in records)
    discrepancy = text(discrepancy_sentence(results))
    return [
        Heading("What is not modelled"),
        Bullets(tuple(not_modelled(results))),
        *([Text(structure_borne_sentence(results))] if overall_noise(results) else []),
        Heading("Unmodelled noise"),
        Text(unmodelled_sentence(results)),
        *([Heading("Model discrepancy")] if discrepancy else []),
        *discrepancy,
        Heading("Inputs"),
        Text(
            f"{assumed} of {len(records)} recorded values are assumed; all are in inputs.csv. A "
            "range is expected to hold the true value."
        ),
        records_table(results),
    ]


register(Section("assumptions", "Assumptions", _blocks, position=100.0, tables=inputs_data))


def _errata(results: xr.Dataset) -> list[Block]:
    """Errors in the source document."""
    errata = parameters(results)["machine"]["errata"]
    rows = tuple((entry["item"], entry["printed"], entry["finding"]) for entry in errata)
    head = ("Item", "Printed", "Finding")
    return [Table("Errata of the source", head, rows, frozenset({0, 1, 2}))]


def _has_errata(results: xr.Dataset) -> bool:
    return bool(parameters(results)["machine"]["errata"])


register(Section("errata", "Errata of the source", _errata, _has_errata, 110.0))
