"""Results beside published values of the machine: level and forces of moving parts."""

from collections.abc import Iterable, Iterator
from dataclasses import fields
from typing import Any, Final

import numpy as np
import xarray as xr

from ..base.ellipse import semi_major_axis
from ..base.vocabulary import COORDINATES, REFERENCE_OPTION, VARIABLES, stamped
from ..results.estimates import nominal, prior_ensemble
from ..results.grid_error import grid_error_db
from ..results.stored_study import (
    at_catalogue,
    catalogue_receiver,
    has_sources,
    level_bias_db,
    operating_points,
    overall_noise,
    parameters,
)
from ..results.validation import Validation

_OF_A_RANGE: Final = 1.0 / np.sqrt(12.0)
"""Standard uncertainty of what lies evenly in a range, over its width (JCGM 100:2008, 4.3.7)."""
_DEVIATION_DB: Final = 2.0
"""Standard deviation of a published level without one."""


def validation_variables(results: xr.Dataset) -> xr.Dataset:
    """Label all that is published of what results hold, with uncertainties; empty without any.

    Parameters
    ----------
    results : variables of a run, with the parameters of its study
    """
    evidence = parameters(results).get("evidence") or {}
    every = [*_catalogue_level(results), *_forces(results, evidence.get("forces", ()))]
    if not every:
        return xr.Dataset()
    names = [part.name for part in fields(Validation)]
    columns = {f"evidence_{name}": [getattr(each, name) for each in every] for name in names}
    numbers = {name: values for name, values in columns.items() if name in VARIABLES}
    texts = {name: ("evidence", text) for name, text in columns.items() if name in COORDINATES}
    labelled = stamped(numbers, {"evidence": np.arange(1.0, 1.0 + len(every))})
    return labelled.assign_coords(texts)


def _catalogue_level(results: xr.Dataset) -> Iterator[Validation]:
    """Level of all that is modelled beside that of the machine; neglected sources are in E."""
    noise, receiver = overall_noise(results), catalogue_receiver(results)
    if noise is None:
        return
    ensemble = prior_ensemble(results)
    sampled = np.zeros(0) if ensemble is None else ensemble.level_dba
    sampled = sampled[np.isfinite(sampled)]
    speed = noise["speed_rpm"]
    if speed in results["speed"].values and not _is_elsewhere(results):
        here = at_catalogue(results, speed=speed, weighting="A")
        simulated = float(nominal(results, "level_modelled").sel(here))
    elif sampled.size:
        simulated = float(np.median(sampled))
    else:
        return
    what = "all modelled sources" if has_sources(results) else "moving parts"
    bias, spread = level_bias_db(results)
    yield Validation(
        f"Level at {receiver}, {speed:g} rpm: {what}, nominal values, beside the machine",
        "dB(A)",
        simulated,
        noise["level_dba"] - bias,
        grid_error_db(results, receiver),
        float(np.std(sampled)) if sampled.size else 0.0,
        float(np.hypot(noise.get("deviation_db", _DEVIATION_DB), spread)),
        _source(results, "overall_noise.level_dba"),
    )


def _is_elsewhere(results: xr.Dataset) -> bool:
    """Return whether the level is published at another operating point."""
    runs_at, point = operating_points(results)
    return point != runs_at


def _forces(results: xr.Dataset, rows: Iterable[dict[str, Any]]) -> Iterator[Validation]:
    """Forces of moving parts at 1x, where the results have part and speed."""
    for row in rows if "force_order" in results else ():
        is_computed = row["part"] in results["source"].values
        if not is_computed or row["speed_rpm"] not in results["speed"].values:
            continue
        phasors = results["force_order"].sel(
            source=row["part"], speed=row["speed_rpm"], option=REFERENCE_OPTION, order=1
        )
        force = float(semi_major_axis(phasors.values, 0))
        inputs = [_relative_range(results, field) for field in row["proportional_to"].split()]
        yield Validation(
            f"Force of the part {row['part'].replace('_', ' ')} at 1×, {row['speed_rpm']:g} rpm",
            "N",
            force,
            row["force_1x_n"],
            0.0,
            force * float(np.linalg.norm(inputs)),
            row["deviation_n"],
            row["source"],
        )


def _relative_range(results: xr.Dataset, field: str) -> float:
    """Relative standard uncertainty of a value of the machine from its range; 0 without one."""
    for record in parameters(results)["records"]:
        if _is_of(record, field) and None not in (record["lowest"], record["highest"]):
            width = (record["highest"] - record["lowest"]) * _OF_A_RANGE
            return float(width / abs(_number(record["value"])))
    return 0.0


def _number(text: str) -> float:
    """A recorded value; not a number where it is none."""
    try:
        return float(text) or np.nan
    except ValueError:
        return np.nan


def _source(results: xr.Dataset, field: str) -> str:
    for record in parameters(results)["records"]:
        if _is_of(record, field):
            return str(record["source"])
    return ""


def _is_of(record: dict[str, Any], field: str) -> bool:
    """Whether a record is of a value, whatever the unit that its file gives it in."""
    return bool(record["field"] == field or record["field"].startswith(f"{field}_"))
