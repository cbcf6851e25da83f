"""Names and units in plain words for the vocabulary's coded labels."""

from collections.abc import Mapping
from typing import Any, Final

from ..base.units import split_key

_NO_WORDS: Final[Mapping[str, Any]] = {}
_MORE_UNITS: Final = {"nm": "N m", "db": "dB", "w": "W"}

DOF_WORDS: Final = {
    "tx": "moves along x",
    "ty": "moves along y",
    "tz": "moves along z",
    "rx": "turns about x",
    "ry": "turns about y",
    "rz": "turns about z",
}

_NAMES: Final = {
    "dissipated_power_w": "Dissipated power",
    "weighted_sum": "Weighted sum",
    "topsis": "TOPSIS",
}


def name(label: str, of_study: Mapping[str, Any] = _NO_WORDS) -> str:
    """Plain words for a label such as `added_mass_kg`, without its unit."""
    return (
        of_study.get("labels", {}).get(label)
        or _NAMES.get(label)
        or _split(label, of_study)[0].replace("_", " ").capitalize()
    )


def unit(label: str, of_study: Mapping[str, Any] = _NO_WORDS) -> str:
    """Unit in the suffix of a label; empty where it has none."""
    return _split(label, of_study)[1]


def _split(label: str, of_study: Mapping[str, Any]) -> tuple[str, str]:
    units = _MORE_UNITS | of_study.get("units", {})
    parts = label.split("_")
    for start in range(1, len(parts)):
        symbol = units.get("_".join(parts[start:]))
        if symbol is not None:
            return "_".join(parts[:start]), symbol
    stem, unit = split_key(label)
    return stem, unit.symbol if unit else ""
