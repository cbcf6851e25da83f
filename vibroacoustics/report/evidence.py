"""Results beside published values: error and its uncertainty, in the form of ASME V&V 20.

Simulation S, data D, error E = S - D; validation uncertainty u = √(u_num² + u_input² + u_D²), all
standard uncertainties (ASME V&V 20-2009, sections 1 and 6). With a tolerance T stated before, S
agrees with D within T where |E| + 1.64 u <= T (equivalence test: Schuirmann 1987, J.
Pharmacokinetics and Biopharmaceutics 15, 657); it differs where |E| > 2 u; else that is undecided.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import xarray as xr

from ..base import rounding
from ..base.arrays import Array
from ..base.decibel import level_of_amplitude
from ..base.vocabulary import REFERENCE_OPTION
from ..results.estimates import nominal, prior_ensemble
from ..results.stored_study import (
    at_catalogue,
    catalogue_receiver,
    has_sources,
    overall_noise,
    parameters,
)
from .source_words import elsewhere
from .tables import Table

COVERAGE: Final = 2.0
"""About 95 % of a normal distribution."""
ONE_SIDED: Final = 1.64
"""95 % of a normal distribution lie below it."""
LEVEL_TOLERANCE_DB: Final = 5.0
FORCE_TOLERANCE: Final = 0.1
"""Relative to the published force."""
AGREES: Final = "agrees"
DIFFERS: Final = "differs"
UNDECIDED: Final = "undecided"
_OF_A_RANGE: Final = 1.0 / np.sqrt(12.0)
"""Standard uncertainty of what lies evenly in a range, over its width (JCGM 100:2008, 4.3.7)."""
_DEVIATION_DB: Final = 2.0
"""Of the published level, where files of older versions give none."""


@dataclass(frozen=True)
class Rung:
    """A result beside what is published of it; uncertainties are standard ones, in its unit."""

    quantity: str
    unit: str
    simulation: float
    data: float
    numerical: float
    inputs: float
    published: float
    source: str

    @property
    def error(self) -> float:
        """E = S - D."""
        return self.simulation - self.data

    @property
    def uncertainty(self) -> float:
        """Of validation, u."""
        return float(np.hypot(np.hypot(self.numerical, self.inputs), self.published))

    @property
    def tolerance(self) -> float:
        """Tolerance T of the agreement."""
        is_level = self.unit.startswith("dB")
        return LEVEL_TOLERANCE_DB if is_level else FORCE_TOLERANCE * abs(self.data)

    @property
    def verdict(self) -> str:
        """`AGREES`, `DIFFERS` or `UNDECIDED`."""
        if abs(self.error) + ONE_SIDED * self.uncertainty <= self.tolerance:
            return AGREES
        return DIFFERS if abs(self.error) > COVERAGE * self.uncertainty else UNDECIDED


def rungs(results: xr.Dataset) -> list[Rung]:
    """All that is published of what the results hold."""
    evidence = parameters(results).get("evidence") or {}
    return [
        *_catalogue_level(results),
        *_forces(results, evidence.get("forces", ())),
    ]


def _catalogue_level(results: xr.Dataset) -> Iterator[Rung]:
    """Level of all that is modelled beside that of the machine; what is left out is in E."""
    noise, receiver = overall_noise(results), catalogue_receiver(results)
    if noise is None:
        return
    ensemble = prior_ensemble(results)
    sampled = np.zeros(0) if ensemble is None else ensemble.level_dba
    sampled = sampled[np.isfinite(sampled)]
    speed = noise["speed_rpm"]
    if speed in results["speed"].values and not elsewhere(results):
        at = at_catalogue(results, speed=speed, weighting="A")
        level = nominal(results, "level_modelled").sel(at)
        simulated = float(level)
    elif sampled.size:
        simulated = float(np.median(sampled))
    else:
        return
    what = "all modelled sources" if has_sources(results) else "moving parts"
    yield Rung(
        f"Level at {receiver}, {speed:g} rpm: {what}, beside the whole machine",
        "dB(A)",
        simulated,
        noise["level_dba"],
        grid_error_db(results, receiver),
        float(np.std(sampled)) if sampled.size else 0.0,
        noise.get("deviation_db", _DEVIATION_DB),
        _source(results, "overall_noise.level_dba"),
    )


def grid_error_db(results: xr.Dataset, receiver: str) -> float:
    """Of the transfer vectors, from their grids, rms over motions and frequencies."""
    error, size = 0.0, 0.0
    for name in ("transfer_vector", "pattern_transfer_vector"):
        if f"{name}_error" in results:
            error += float((results[f"{name}_error"].sel(receiver=receiver) ** 2).sum())
            size += float((np.abs(results[name].sel(receiver=receiver)) ** 2).sum())
    return level_of_amplitude(1.0 + np.sqrt(error / size)) if size > 0.0 else 0.0


def _forces(results: xr.Dataset, rows: Iterable[dict[str, Any]]) -> Iterator[Rung]:
    """Forces of moving parts at 1x, where the results have part and speed."""
    for row in rows if "force_order" in results else ():
        known = row["part"] in results["source"].values
        if not known or row["speed_rpm"] not in results["speed"].values:
            continue
        phasors = results["force_order"].sel(
            source=row["part"], speed=row["speed_rpm"], option=REFERENCE_OPTION, order=1
        )
        force = _largest(phasors.values)
        inputs = [_relative_range(results, field) for field in row["proportional_to"].split()]
        yield Rung(
            f"Force of the part {row['part'].replace('_', ' ')} at 1×, {row['speed_rpm']:g} rpm",
            "N",
            force,
            row["force_1x_n"],
            0.0,
            force * float(np.linalg.norm(inputs)),
            row["deviation_n"],
            row["source"],
        )


def _largest(phasor: Array) -> float:
    """Semi-major axis of the ellipse that a phasor (axis,) draws."""
    squared = np.sum(np.abs(phasor) ** 2)
    return float(np.sqrt(0.5 * (squared + np.abs(np.sum(phasor**2)))))


def _relative_range(results: xr.Dataset, field: str) -> float:
    """Standard uncertainty of a value of the machine over the value, from its range; 0 without."""
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


def agreement_sentence(results: xr.Dataset) -> str:
    """Whether the modelled level agrees with the published one; empty where none is published."""
    (level, *_) = (*_catalogue_level(results), None)
    if level is None:
        return ""
    published, tolerance = f"{rounding.fixed(level.data)} dB(A)", f"{level.tolerance:g} dB"
    words = {
        AGREES: f"agrees with the published {published} within {tolerance}",
        DIFFERS: f"differs from the published {published}",
        UNDECIDED: f"is too uncertain to be compared with the published {published}",
    }[level.verdict]
    return (
        f"The modelled level before any published datum {words}: E = "
        f"{rounding.signed(level.error)} dB, u = {rounding.fixed(level.uncertainty)} dB."
    )


def evidence_table(results: xr.Dataset) -> Table:
    """All that is published of what the results hold."""
    return rungs_table("Results beside published values", rungs(results))


def rungs_table(caption: str, shown: Iterable[Rung]) -> Table:
    """A rung a row."""
    head = (
        "Quantity", "Unit", "Simulation S", "Data D", "E = S − D", "u_num", "u_input", "u_D",
        "u", "Verdict", "Data from",
    )  # fmt: skip
    return Table(caption, head, tuple(map(_row, shown)), frozenset({0, 1, 9, 10}))


def _row(rung: Rung) -> tuple[str, ...]:
    numbers = (rung.simulation, rung.data)
    spreads = (rung.numerical, rung.inputs, rung.published, rung.uncertainty)
    is_level = rung.unit.startswith("dB")
    write = rounding.fixed if is_level else rounding.significant
    tolerance = f"{write(rung.tolerance)} {rung.unit.removesuffix('(A)')}"
    verdict = f"{AGREES} within {tolerance}" if rung.verdict == AGREES else rung.verdict
    return (
        rung.quantity,
        rung.unit,
        *map(write, numbers),
        rounding.signed(rung.error) if is_level else _with_sign(rung.error),
        *(rounding.significant(spread, 2) for spread in spreads),
        verdict,
        rung.source,
    )


def _with_sign(value: float) -> str:
    text = rounding.significant(value)
    return f"+{text}" if value > 0.0 else text
