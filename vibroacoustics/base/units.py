"""Units in the suffix of a key: `stroke_mm = 6.75` in a file is `stroke_m = 0.00675` inside."""

from typing import Final, NamedTuple


class Unit(NamedTuple):
    """What a key's suffix means: symbol to print, suffix of the SI key, factor to SI."""

    symbol: str
    si_suffix: str
    factor: float


UNITS: Final[dict[str, Unit]] = {
    "um": Unit("µm", "m", 1e-6),
    "mm": Unit("mm", "m", 1e-3),
    "cm": Unit("cm", "m", 1e-2),
    "m": Unit("m", "m", 1.0),
    "m2": Unit("m²", "m2", 1.0),
    "cm3": Unit("cm³", "m3", 1e-6),
    "m3": Unit("m³", "m3", 1.0),
    "g": Unit("g", "kg", 1e-3),
    "kg": Unit("kg", "kg", 1.0),
    "kg_m2": Unit("kg m²", "kg_m2", 1.0),
    "n": Unit("N", "n", 1.0),
    "n_per_mm": Unit("N/mm", "n_per_m", 1e3),
    "n_per_m": Unit("N/m", "n_per_m", 1.0),
    "ns_per_m": Unit("N s/m", "ns_per_m", 1.0),
    "n_per_m1p5": Unit("N/m^1.5", "n_per_m1p5", 1.0),  # of a Hertz contact
    "mm_per_s": Unit("mm/s", "m_per_s", 1e-3),
    "m_per_s": Unit("m/s", "m_per_s", 1.0),
    "bar": Unit("bar", "pa", 1e5),
    "gpa": Unit("GPa", "pa", 1e9),
    "mpa": Unit("MPa", "pa", 1e6),
    "pa": Unit("Pa", "pa", 1.0),
    "pa_s": Unit("Pa s", "pa_s", 1.0),
    "deg": Unit("°", "rad", 0.017453292519943295),
    "rad": Unit("rad", "rad", 1.0),
    "rad_per_s": Unit("rad/s", "rad_per_s", 1.0),
    "ms": Unit("ms", "s", 1e-3),
    "s": Unit("s", "s", 1.0),
    "hz": Unit("Hz", "hz", 1.0),
    "khz": Unit("kHz", "hz", 1e3),
    "v": Unit("V", "v", 1.0),
    "ohm": Unit("Ω", "ohm", 1.0),
    "uf": Unit("µF", "f", 1e-6),
    "f": Unit("F", "f", 1.0),
    "kg_per_m3": Unit("kg/m³", "kg_per_m3", 1.0),
    "n_m": Unit("N m", "n_m", 1.0),
    "n_m_s": Unit("N m s", "n_m_s", 1.0),
    "rpm": Unit("rpm", "rpm", 1.0),  # the label of a speed; see shaft_frequency_hz
    "db": Unit("dB", "db", 1.0),
    "dba": Unit("dB(A)", "dba", 1.0),
    "eur": Unit("€", "eur", 1.0),
    "percent": Unit("%", "ratio", 1e-2),
    "ratio": Unit("", "ratio", 1.0),
}


def split_key(key: str) -> tuple[str, Unit | None]:
    """Split `stroke_mm` into `stroke` and the unit; the unit is None where there is none."""
    parts = key.split("_")
    for start in range(1, len(parts)):
        unit = UNITS.get("_".join(parts[start:]))
        if unit is not None:
            return "_".join(parts[:start]), unit
    return key, None


def si_key(key: str) -> tuple[str, float]:
    """Name and factor of the SI field that a file's key fills."""
    stem, unit = split_key(key)
    return (key, 1.0) if unit is None else (f"{stem}_{unit.si_suffix}", unit.factor)


def shaft_frequency_hz(speed_rpm: float) -> float:
    """Shaft frequency in Hz of a speed in revolutions per minute: 3000 rpm is 50 Hz."""
    return speed_rpm / 60.0


def orders_below(frequency_hz: float, speed_rpm: float) -> int:
    """Number of shaft orders up to a frequency, which counts if an order meets it in rounding."""
    return int(frequency_hz / shaft_frequency_hz(speed_rpm) + 1e-9)
