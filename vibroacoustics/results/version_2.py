"""Results of schema version 2, raised to the present one at reading.

Version 2 had nominal values in the plain variables and samples beside them under other names.
Quantities that were kept by sample get their statistics; others stay nominal.
"""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Final

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import SILENCE_DB, level_of_power, power_of_level
from ..base.errors import SchemaError, StorageError
from ..base.hashing import canonical_json, sha256
from ..base.quantiles import weighted_quantiles
from ..base.vocabulary import HIGH, LOW, MEAN, REFERENCE_OPTION, SUFFIXES, VARIABLES, stamp, stamped
from ..levels.changes import FORCES, JUDGED, changes_of
from ..sound.tone_spectra import nominal_spectra, tone_variables
from ..study.scoring import Measurable
from .estimates import QUANTILES, estimated

VERSION: Final = "2"
RAISED: Final = "raised_from_schema_version"
"""Attribute of raised results."""
_RENAMED: Final = {
    "draw": "sample",
    "draw_weight": "sample_weight",
    "drawn_value": "sampled_value",
    "drawn_parameter": "uncertain_parameter",
    "bank_draw": "prior_sample",
    "bank_weight": "prior_sample_weight",
    "bank_level": "prior_sample_level",
    "bank_value": "prior_sample_value",
    "shell_draw": "shell_sample",
    "shell_level_draw": "shell_level_sample",
    "level_remainder": "level_unmodelled",
    "level_remainder_by_draw": "level_unmodelled_by_sample",
    "remainder_band_level": "unmodelled_band_level",
}
_GONE: Final = (
    "energy_share", "energy_majority", "evidence_effective", "room_level_low", "room_level_middle",
    "room_level_high",
)  # fmt: skip
_GONE_COORDINATES: Final = ("evidence", "energy_part")
_ONCE_ALIKE: Final = tuple(
    f"{name}{end}"
    for name in (
        "unmodelled_band_level", "representative_unmodelled_band_level", "run_up_unmodelled_level"
    )
    for end in ("", *SUFFIXES.values())
)  # fmt: skip
"""Variables of results that had no microphones."""
_SAMPLED: Final = ("level_total", "source_level", "level_unmodelled")


def of_this_version(results: xr.Dataset, path: Path) -> xr.Dataset:
    """Return results as they are, those of a run of version 2 raised.

    Raises
    ------
    StorageError
        A run of version 2 lacks a variable.
    """
    results = _with_receivers(results)
    if results.attrs.get("schema_version") != VERSION or "level_total" not in results:
        return results
    try:
        return raised(results)
    except (KeyError, ValueError, IndexError, SchemaError) as error:
        raise StorageError(f"{path}: cannot be raised from schema version 2: {error}") from None


def _with_receivers(results: xr.Dataset) -> xr.Dataset:
    """Return results whose unmodelled noise, once alike at all microphones, is by microphone."""
    alike = {
        name: results[name].expand_dims(receiver=results["receiver"]).transpose(*dims)
        for name, dims in ((name, VARIABLES[name].dims) for name in _ONCE_ALIKE if name in results)
        if "receiver" not in results[name].dims
    }
    return results.assign(alike) if alike else results


def raised(results: xr.Dataset) -> xr.Dataset:
    """Return results of version 2 with the names and variables of the present version."""
    every = [str(name) for name in results.variables]
    by_sample = {
        name: name.replace("_by_draw", "_by_sample") for name in every if "_by_draw" in name
    }
    renamed = {**by_sample, **_RENAMED}
    present = results.rename({old: new for old, new in renamed.items() if old in results.variables})
    present = _with_receivers(present)
    present = present.drop_vars([*_GONE, *_GONE_COORDINATES], errors="ignore")
    parameters = _parameters(str(results.attrs["parameters"]))
    digest = sha256(parameters.encode())
    present = present.assign_attrs(parameters=parameters, parameters_sha256=digest)
    present = present.assign(_nominal(present))
    if "sample_weight" in present:
        present = estimated(_with_solution(present), _statistics(_with_solution(present)))
    return present.assign_attrs({"schema_version": "3", RAISED: VERSION})


def _parameters(text: str) -> str:
    """Parameters of the study with the present keys."""
    parameters = json.loads(text)
    measurable = parameters["scoring"].get("measurable", {})
    if "draws_ratio" in measurable:
        measurable["samples_ratio"] = measurable.pop("draws_ratio")
    return canonical_json(parameters)


def _measurable(results: xr.Dataset) -> Measurable:
    parameters = json.loads(results.attrs["parameters"])
    return Measurable(**parameters["scoring"].get("measurable", {}))


def _nominal(results: xr.Dataset) -> dict[str, xr.DataArray]:
    """Nominal values of variables that version 2 had not."""
    total, modelled = (
        results["level_total"],
        results["level_modelled"].sel(weighting="A", drop=True),
    )
    energy = power_of_level(total)
    noise = (energy - power_of_level(modelled)).clip(min=0.0)
    largest = results["foot_force_amplitude"].max("foot")
    values = {
        "largest_foot_force": largest,
        "residual_level": xr.apply_ufunc(level_of_power, noise),
    }
    if "source_share" in results:
        values["source_share"] = results["source_share"] * power_of_level(modelled) / energy
        values["unmodelled_share"] = noise / energy
    forces = np.stack([amplitude.values for amplitude in _first_order(results, largest)])
    changes = _changes(results, forces[:, None], total.values[None])
    named = {**{name: _stamped(name, array) for name, array in values.items()}, **changes}
    return named | _bands_and_tones(results) if "noise_band_level" in results else named


def _bands_and_tones(results: xr.Dataset) -> dict[str, xr.DataArray]:
    """Third octaves of all sources, and tones with the nominal values."""
    spectra, _ = nominal_spectra(results.drop_vars("baseline_band_level", errors="ignore"))
    dims = ("speed", "option", "receiver", "noise_band")
    noise = power_of_level(results["noise_band_level"].transpose(*dims).values)
    coords = {dim: results[dim].values for dim in dims}
    lines = spectra.in_bands() / REFERENCE_PRESSURE_PA**2
    bands = stamp("sources_band_level", level_of_power(lines + noise), coords)
    tones = tone_variables(results)
    return {str(bands.name): bands, **{str(name): array for name, array in tones.data_vars.items()}}


def _first_order(results: xr.Dataset, largest: xr.DataArray) -> list[xr.DataArray]:
    amplitudes = (results["force_amplitude"], results["moment_amplitude"], largest)
    return [
        amplitude.sel(order=1, drop=True).transpose("speed", "option") for amplitude in amplitudes
    ]


def _stamped(name: str, values: xr.DataArray) -> xr.DataArray:
    dims = VARIABLES[name].dims
    array = values.transpose(*dims)
    return stamp(name, array.values, {dim: array[dim].values for dim in dims})


def _statistics(results: xr.Dataset) -> xr.Dataset:
    """Medians and intervals of what was kept by sample, and probabilities of change."""
    weight = results["sample_weight"].values[0]
    by_sample = {name: _rows(results, name) for name in _SAMPLED}
    total, modelled = by_sample["level_total"], _rows(results, "level_modelled")
    noise = np.maximum(power_of_level(total) - power_of_level(modelled), 0.0)
    reference = results["option"].values.tolist().index(REFERENCE_OPTION)
    by_sample |= {
        "residual_level": np.maximum(level_of_power(noise), SILENCE_DB),
        "change_total": total - total[:, :, [reference]],
        "change_modelled": modelled - modelled[:, :, [reference]],
    }
    if "source_share" in results:
        by_sample["source_share"] = power_of_level(by_sample["source_level"] - total[:, :, :, None])
        by_sample["unmodelled_share"] = noise / power_of_level(total)
    parts = [_of_variable(name, rows, weight, results) for name, rows in by_sample.items()]
    if "force_1x_by_sample" in results:
        forces = np.stack([_rows(results, f"{name}_1x") for name in FORCES])
        parts.append(xr.Dataset(_changes(results, forces, total, weight)))
    return xr.merge(parts)


def _with_solution(results: xr.Dataset) -> xr.Dataset:
    """The samples that count; others had no values."""
    return results.isel(sample=results["sample_weight"].values[0] > 0.0)


def _rows(results: xr.Dataset, name: str) -> Array:
    """Values by sample with the dimensions of the plain variable, the sample first."""
    dims = [dim for dim in VARIABLES[f"{name}_by_sample"].dims if dim != "sample"]
    return np.asarray(results[f"{name}_by_sample"].transpose("sample", *dims).values)


def _of_variable(name: str, rows: Array, weight: Array, results: xr.Dataset) -> xr.Dataset:
    ends = weighted_quantiles(rows, weight, (QUANTILES[0], 0.5, QUANTILES[1]))
    if VARIABLES[name].statistic == MEAN:
        ends[1] = np.average(rows, axis=0, weights=weight)
    names = (f"{name}{SUFFIXES[LOW]}", name, f"{name}{SUFFIXES[HIGH]}")
    dims = [dim for dim in VARIABLES[f"{_kept(name)}_by_sample"].dims if dim != "sample"]
    coords: Mapping[str, Array] = {dim: results[dim].values for dim in dims}
    plain = VARIABLES[name].dims
    arrays = {
        part: xr.DataArray(values, coords, dims).transpose(*plain)
        for part, values in zip(names, ends, strict=True)
    }
    return xr.Dataset({part: _stamped(part, array) for part, array in arrays.items()})


def _kept(name: str) -> str:
    """Variable that was kept by sample with the dimensions of another."""
    if name == "source_share":
        return "source_level"
    return name if name in _SAMPLED else "level_total"


def _changes(
    results: xr.Dataset, forces: Array, total: Array, weight: Array | None = None
) -> dict[str, xr.DataArray]:
    """Changes of forces and probabilities of measurable changes, nominal without weights."""
    line = (
        results["order_level"].sel(order=1, weighting="Z").transpose("speed", "option", "receiver")
    )
    reference = results["option"].values.tolist().index(REFERENCE_OPTION)
    changes = changes_of(
        forces,
        total,
        np.broadcast_to(line.values, total.shape),
        results["order_frequency"].transpose("speed", "order").values[:, 1],
        reference,
        _measurable(results),
    )
    rows = np.ones(1) if weight is None else weight / weight.sum()
    values: dict[str, Array] = {
        "increase_probability": np.tensordot(rows, changes.increased, axes=1),
        "decrease_probability": np.tensordot(rows, changes.decreased, axes=1),
    }
    for name, change in zip(FORCES, changes.force_db, strict=True):
        ends = weighted_quantiles(change, rows, (QUANTILES[0], 0.5, QUANTILES[1]))
        variable = f"{name}_change_1x"
        values[variable] = ends[1]
        if weight is not None:
            values[f"{variable}{SUFFIXES[LOW]}"] = ends[0]
            values[f"{variable}{SUFFIXES[HIGH]}"] = ends[2]
    coords = {dim: results[dim].values for dim in ("speed", "option", "receiver")}
    labelled = stamped(values, {**coords, "judged_quantity": list(JUDGED)})
    return {str(name): array for name, array in labelled.data_vars.items()}
