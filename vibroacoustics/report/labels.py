"""Names and units in plain words for the vocabulary's coded labels."""

from collections.abc import Mapping
from typing import Final

from ..base.units import split_key

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


def name(label: str, of_study: Mapping[str, str] | None = None) -> str:
    """Plain words for a label such as `added_mass_kg`, without its unit.

    Parameters
    ----------
    label : name with its unit
    of_study : further words, of machine and options
    """
    return (
        (of_study or {}).get(label)
        or _NAMES.get(label)
        or _split(label)[0].replace("_", " ").capitalize()
    )


def unit(label: str) -> str:
    """Unit in the suffix of a label; empty where it has none."""
    return _split(label)[1]


def _split(label: str) -> tuple[str, str]:
    stem, _, suffix = label.rpartition("_")
    if stem and suffix in _MORE_UNITS:
        return stem, _MORE_UNITS[suffix]
    known, found = split_key(label)
    return known, found.symbol if found else ""
