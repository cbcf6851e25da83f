"""Where the inputs come from, what is not modelled, and the errors of the source."""

from typing import Any, Final

import xarray as xr

from . import rounding
from .study import catalogue_receiver, parameters
from .tables import Table

ASSUMED: Final = "assumed"

NOT_MODELLED: Final = (
    "The shell is rigid. Its elastic modes and the gas, contact and bearing forces that drive them "
    "are not modelled; these forces are internal and do not shake the "
    "rigid machine, but they make most of its sound.",
    "Gas pulsation in the suction and discharge pipes is not modelled.",
    "Structure-borne sound is not modelled: the forces into the feet are reported, the floor, "
    "panel and pipes that they would excite are not. A change of the foot force may be heard "
    "there before it is heard through the air.",
    "The floor is rigid for the mounts and hard for the sound; there are no other walls. Sound "
    "that the floor returns to the machine is not scattered by its shell a second time.",
    "The shaft turns at constant speed; torque ripple, twice-line torque of the motor and key "
    "slap are not modelled.",
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
    noise = parameters(results)["machine"]["published_noise"]
    return (
        f"The catalogue gives {noise['level_dba']:g} dB(A) at {noise['distance_m']:g} m and "
        f"{noise['speed_rpm']:g} rpm. What the model leaves of it at {catalogue_receiver(results)} "
        f"without a balancer, {rounding.fixed(results['level_remainder'].item(), 3)} dB(A), is "
        "added as energy to the modelled level at every speed, option and microphone. That it "
        "stays constant is an assumption, not a result."
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
