"""File of units and windows for `permit`, and limits of the sound power of units by law."""

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final, NamedTuple

from pydantic import Field

from ..base.errors import ParameterError
from ..base.parameters import Contradictions, Parameters
from ..study.settings_file import settings_of
from ..study.toml_files import read_toml
from .rule import PERMIT_RULES, AnyRule, PermitUnit
from .verdict import PermitVerdict, judged, probability

CAPACITY_W: Final = (6e3, 12e3, 30e3, 70e3)
"""Largest capacity of each class."""
LIMITS_DBA: Final = {
    "EU 813/2013, annex II": (65.0, 70.0, 78.0, 88.0),
    "BEG since 1 January 2026": (55.0, 60.0, 68.0, 78.0),
}


class LabelLimit(NamedTuple):
    """Limit of a unit's sound power by day.

    Attributes
    ----------
    law : law or subsidy, with its date
    limit_dba : largest A-weighted sound power level
    is_met : whether the stated level is at most the limit
    probability : that a measured unit meets it, by the deviation of the unit
    """

    law: str
    limit_dba: float
    is_met: bool
    probability: float


def label_limits(unit: PermitUnit) -> list[LabelLimit]:
    """Return the limits for the capacity of a unit; none without one, or above 70 kW.

    Parameters
    ----------
    unit : sound power and capacity
    """
    capacity = unit.capacity_w
    if capacity is None or capacity > CAPACITY_W[-1]:
        return []
    column = next(number for number, most in enumerate(CAPACITY_W) if capacity <= most)
    return [
        LabelLimit(
            law,
            limits[column],
            unit.day_power_dba <= limits[column],
            probability(unit.day_power_dba, unit.deviation_db, limits[column], None),
        )
        for law, limits in LIMITS_DBA.items()
    ]


class PermitFile(Parameters):
    """Units, and the windows at which they are judged."""

    title: str = Field(default="Permit", min_length=1, max_length=200)
    units: dict[str, PermitUnit] = Field(min_length=1, max_length=20)
    windows: dict[str, dict[str, AnyRule]] = Field(min_length=1, max_length=100)
    """Windows by name, each as the units see it, by name of the unit."""

    def contradictions(self) -> Contradictions:
        for name, window in self.windows.items():
            for unit, rule in window.items():
                yield from (f"windows.{name}: {line}" for line in rule.refusals(self.units[unit]))


def load_permit(path: Path) -> PermitFile:
    """Read units and windows; docs/permits.md has the tables.

    Parameters
    ----------
    path : TOML file

    Raises
    ------
    ParameterError
        Anything is missing, unknown, of the wrong type or outside its allowed range, or a rule does
        not allow it.
    """
    content = read_toml(path)
    units, windows = content.get("units"), content.get("windows")
    if not isinstance(units, dict) or not isinstance(windows, dict):
        raise ParameterError(
            f"{path}: must have tables [units.NAME] and [windows.NAME]; `vibroacoustics new "
            "permit` writes a file to begin with"
        )
    content["windows"] = {
        name: _by_unit(path, name, window, units) for name, window in windows.items()
    }
    try:
        return settings_of(PermitFile, path, content)
    except ParameterError as error:
        raise ParameterError(*(_as_written(str(line), windows) for line in error.args)) from None


def _as_written(line: str, windows: Mapping[str, Any]) -> str:
    """Refusal with the key as the file has it: of the window, or of its table of a unit."""

    def key(written: re.Match[str]) -> str:
        name, unit, field = written.groups()
        is_of_unit = field in windows.get(name, {}).get("units", {}).get(unit, {})
        return f"windows.{name}.units.{unit}.{field}" if is_of_unit else f"windows.{name}.{field}"

    return re.sub(r"windows\.([^.\s]+)\.([^.\s]+)\.(\w+)", key, line)


def _by_unit(
    path: Path, name: str, window: Any, units: Mapping[str, Any]
) -> dict[str, dict[str, Any]]:
    """Table of a window for each unit: the unit's own values beside those of all."""
    of_units = window.get("units", {}) if isinstance(window, dict) else None
    if not isinstance(of_units, dict):
        raise ParameterError(f"{path}: windows.{name}: must be a table, and so must its units")
    for unit, table in of_units.items():
        if not isinstance(table, dict):
            raise ParameterError(f"{path}: windows.{name}.units.{unit} = {table}: must be a table")
        if unit not in units:
            raise ParameterError(
                f"{path}: windows.{name}.units.{unit}: no such unit; known are {', '.join(units)}"
            )
    kind = window.get("kind")
    if not isinstance(kind, str) or kind not in PERMIT_RULES:
        shown = "is missing" if kind is None else f"= {kind}: unknown"
        kinds = ", ".join(PERMIT_RULES)
        raise ParameterError(f"{path}: windows.{name}.kind {shown}; allowed {kinds}")
    common = {key: value for key, value in window.items() if key != "units"}
    return {unit: common | of_units.get(unit, {}) for unit in units}


def judge_permit(path: str | Path) -> dict[str, PermitVerdict]:
    """Judge the units of a file at its windows, by name of the window.

    Parameters
    ----------
    path : TOML file; docs/permits.md has its tables

    Raises
    ------
    ParameterError
        Anything is missing, unknown, of the wrong type or outside its allowed range, or a rule does
        not allow it.

    Examples
    --------
    >>> {name: verdict.is_met for name, verdict in va.judge_permit("heat_pump/permit.toml").items()}
    {'bedroom': True, 'neighbour': True, 'terrace': True}
    """
    file = load_permit(Path(path))
    return {name: judged(file.units, window) for name, window in file.windows.items()}
