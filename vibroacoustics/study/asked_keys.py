"""The key that a message asks for: in the unit that the example files use."""

from difflib import get_close_matches
from typing import Final

from ..base.units import si_key, split_key

_BY_QUANTITY: Final = {
    "floor_clearance_m": "mm",
    "clearance_m": "um",
    "_gap_m": "um",
    "oil_layer_m": "um",
    "crown_radius_m": "m",
    "error_m": "um",
    "crankcase_pressure_pa": "mpa",
    "pressure_pa": "bar",
    "per_rad": "rad",
    "_modulus_pa": "gpa",
    "bearing_stiffness_n_per_m": "n_per_m",
    "duration_s": "ms",
    "dead_time_s": "us",
    "grade_m_per_s": "mm_per_s",
}
"""Words by the end of a field's name, the first that fits."""
_BY_UNIT: Final = {
    "m": "mm",
    "rad": "deg",
    "n_per_m": "n_per_mm",
    "m3": "cm3",
    "f": "uf",
    "h": "mh",
    "pa_s_per_m2": "kpa_s_per_m2",
}
_LONGEST_KEY: Final = 100
_LIKENESS: Final = 0.7


def asked_key(field: str) -> str:
    """Key for a field of the model, such as `stroke_mm` for `stroke_m`."""
    stem, unit = split_key(field)
    if unit is None:
        return field
    usual = next((suffix for end, suffix in _BY_QUANTITY.items() if field.endswith(end)), None)
    return f"{stem}_{usual or _BY_UNIT.get(unit.suffix, unit.suffix)}"


def meant_field(key: str, fields: list[str]) -> str | None:
    """The field that a misspelt key most likely means; None where none is like it."""
    if len(key) > _LONGEST_KEY:
        return None
    by_name = {split_key(field)[0]: field for field in fields} | {field: field for field in fields}
    for name in (split_key(key)[0], key, key.rpartition("_")[0]):
        for match in get_close_matches(name, by_name, 1, _LIKENESS):
            return by_name[match]
    return None


def meant_key(key: str, field: str) -> str:
    """Key for a field, in the unit of the misspelt one where it fits."""
    stem, unit = split_key(field)
    parts = split_key(key)[1]
    fits = parts is not None and si_key(f"{stem}_{parts.suffix}")[0] == field
    return f"{stem}_{parts.suffix}" if parts is not None and unit and fits else asked_key(field)
