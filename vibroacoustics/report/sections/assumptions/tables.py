"""Where the inputs come from, what is not modelled, and the errors of the source."""

from typing import Any, Final

import xarray as xr

from ....base import rounding
from ....base.decibel import level_of_power, power_of_level
from ....results.estimates import has_samples
from ....results.stored_study import (
    catalogue_receiver,
    operating_points,
    overall_noise,
    parameters,
    quoted_dba,
    words,
)
from ...bands import INTERVAL, band
from ...remainder import growth_sentence
from ...tables import Table

ASSUMED: Final = "assumed"

LOUD_LINE_BELOW_TOTAL_DB: Final = 11.0
"""A pessimistic structure-borne 1x line: 45 of 56 dB(A)."""

RIGID_SHELL: Final = (
    "The shell is rigid. Its elastic modes and the gas, contact and bearing forces that drive them "
    "are not modelled; these forces are internal and do not shake the "
    "rigid machine, but they make most of its sound.",
)

ELASTIC_SHELL: Final = (
    "Gas forces, Oldham keys and motor torque drive the modes of an elastic shell, which is empty: "
    "oil and gas inside are not in its modes, but for a range of their frequencies and mobility. "
    "The parts inside are rigid and touch the shell at welds only; they load it through the "
    "machine's frame where its file has one. Feet, tubes and terminal box are left out.",
    "Contact of the wraps' flanks and tips, noise of the bearings, magnetic forces of the motor "
    "other than its torque, jets of the gas, and sound in the gas of the shell where the machine's "
    "file has no table of it are not modelled; they are {rest}.",
)
"""Instead of RIGID_SHELL where sources drive the shell."""

RIGID_FLOOR: Final = "rigid for the mounts and hard"
YIELDING_FLOOR: Final = (
    "not rigid: the floor under the feet gives way each for itself, without sound of its own; "
    "natural frequencies are those on a rigid one. It is hard"
)
NOT_MODELLED: Final = (
    "Gas pulsation in the suction and discharge pipes is not modelled.",
    "Structure-borne sound is not modelled: the forces into the feet are reported, the floor, "
    "panel and pipes that they would excite are not. A change of the foot force may be heard "
    "there before it is heard through the air.",
    "The floor is {floor} for the sound; there are no other walls. The "
    "scattering of sound between shell and floor is included.",
    "Levels hold at the study's microphones; a rocking machine sounds louder in other directions.",
    "The weight of moving parts times their sideways shift is left out of the moment: some mN m.",
)


def not_modelled(results: xr.Dataset) -> tuple[str, ...]:
    """What the results leave out, one sentence or two each."""
    of_shell = ELASTIC_SHELL if words(results)["shell_bends"] else RIGID_SHELL
    rest = "in no level" if overall_noise(results) is None else "part of the remainder"
    machine = parameters(results)["machine"]
    gives_way = machine.get("floor") or machine.get("floor_mobility")
    everywhere = tuple(
        text.format(floor=YIELDING_FLOOR if gives_way else RIGID_FLOOR, rest=rest)
        for text in (*of_shell, *NOT_MODELLED)
    )
    return (*everywhere, *_mounts_held(machine), *words(results)["leaves_out"])


def _mounts_held(machine: dict[str, Any]) -> tuple[str, ...]:
    """Where the stiffness of mounts from files ends."""
    feet = (machine.get("feet") or {}).values()
    tables = [machine.get("mount_stiffness"), *(foot and foot["stiffness"] for foot in feet)]
    known = [table["frequency_hz"] for table in tables if table]
    if not known:
        return ()
    lowest, highest = max(each[0] for each in known), min(each[-1] for each in known)
    return (
        f"Stiffness and loss of the mounts are known from {lowest:g} to {highest:g} Hz; they are "
        "held below and above.",
    )


def records_table(results: xr.Dataset) -> Table:
    """Every recorded value, the assumed ones first."""
    records = parameters(results)["records"]
    ordered = sorted(records, key=lambda record: not _is_assumed(record))
    head = ("Value of", "Value", "Unit", "Range", "Source", "File")
    rows = tuple(_record_row(record) for record in ordered)
    return Table("Inputs with their sources", head, rows, frozenset({0, 2, 4, 5}))


def assumed_count(results: xr.Dataset) -> tuple[int, int]:
    """Number of assumed values, and of all recorded values."""
    records = parameters(results)["records"]
    return sum(_is_assumed(record) for record in records), len(records)


def errata_table(results: xr.Dataset) -> Table | None:
    """Errors in the source document; None if none are listed."""
    errata = parameters(results)["machine"]["errata"]
    rows = tuple((entry["item"], entry["printed"], entry["finding"]) for entry in errata)
    head = ("Item", "As printed", "Finding")
    return Table("Errata of the source", head, rows, frozenset({0, 1, 2})) if rows else None


def remainder_sentence(results: xr.Dataset) -> str:
    """How the part of the level that the model does not explain is fixed."""
    noise = overall_noise(results)
    if noise is None:
        return growth_sentence(results)
    assumed = any(
        record["field"].endswith("overall_noise.level_dba") and _is_assumed(record)
        for record in parameters(results)["records"]
    )
    who = "The catalogue gives" if not assumed else "The level of the whole machine is assumed:"
    if has_samples(results):
        rest = band(results, "level_unmodelled")
        left = f"{rest.ends(rounding.fixed)} dB(A) ({INTERVAL})"
    else:
        left = f"{rounding.fixed(results['level_unmodelled'].item())} dB(A)"
    return (
        f"{who} {noise['level_dba']:g} dB(A) at {noise['distance_m']:g} m and "
        f"{noise['speed_rpm']:g} rpm{_point_words(results)}. What the model leaves of "
        f"it at {catalogue_receiver(results)} "
        f"without a balancer, {left}, is "
        "added as energy to the modelled level at every option and microphone; an option with an "
        f"insertion loss takes it off each third octave. {growth_sentence(results)}"
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
        f"Each sample deviates from the model by {path} common to all sources, {source} of each "
        f"source, {band_db} of each third octave of a source (correlation exp(−octaves)) and "
        f"{added} of what an option adds to a source (standard deviations). A deviation is the "
        "same for all options, speeds and microphones. The four figures are judgement: chosen "
        "among some 25 settings so that intervals hold the truth of machines that the model does "
        "not describe."
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
    """What removing a line would buy, were it far louder through the feet than through the air."""
    total = quoted_dba(results)
    gain = level_of_power(1.0 - power_of_level(-LOUD_LINE_BELOW_TOTAL_DB))
    return (
        f"To see what such sound could change: a 1× line of {total - LOUD_LINE_BELOW_TOTAL_DB:g} "
        f"dB(A), far above the airborne one, removed altogether, would lower {total:g} dB(A) by "
        f"{rounding.fixed(abs(gain), 2)} dB."
    )


def _is_assumed(record: dict[str, Any]) -> bool:
    return str(record["source"]).startswith(ASSUMED)


def _record_row(record: dict[str, Any]) -> tuple[str, ...]:
    return (
        record["field"],
        record["value"].replace("-", "−"),
        record["unit"] or "1",
        _range(record),
        record["source"],
        record["file"],
    )


def _range(record: dict[str, Any]) -> str:
    if record["lowest"] is None:
        return rounding.NOTHING
    return f"{record['lowest']:g} to {record['highest']:g}".replace("-", "−")
