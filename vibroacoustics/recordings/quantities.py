"""Units that a channel may have. A unit that is not in this list is refused, never guessed."""

from math import pi
from typing import Final, NamedTuple

from ..base.constants import STANDARD_GRAVITY_M_PER_S2
from ..base.errors import ParameterError
from ..base.unit_spelling import plain_unit

_INCH_M: Final = 0.0254
_POUND_N: Final = 0.45359237 * STANDARD_GRAVITY_M_PER_S2
"""Inch and pound-force: NIST Special Publication 811, 2008, appendix B.8."""


class Quantity(NamedTuple):
    """Measured quantity: kind, SI unit of its samples in our form, factor to that unit."""

    kind: str
    unit: str
    factor: float


QUANTITIES: Final[dict[str, Quantity]] = {
    "Pa": Quantity("sound pressure", "Pa", 1.0),
    "mPa": Quantity("sound pressure", "Pa", 1e-3),
    "µPa": Quantity("sound pressure", "Pa", 1e-6),
    "kPa": Quantity("sound pressure", "Pa", 1e3),
    "bar": Quantity("sound pressure", "Pa", 1e5),
    "mbar": Quantity("sound pressure", "Pa", 1e2),
    "µbar": Quantity("sound pressure", "Pa", 0.1),
    "psi": Quantity("sound pressure", "Pa", _POUND_N / _INCH_M**2),
    "m/s²": Quantity("acceleration", "m/s²", 1.0),
    "mm/s²": Quantity("acceleration", "m/s²", 1e-3),
    "mg": Quantity("acceleration", "m/s²", 1e-3 * STANDARD_GRAVITY_M_PER_S2),
    "g": Quantity("acceleration", "m/s²", STANDARD_GRAVITY_M_PER_S2),
    "m/s": Quantity("velocity", "m/s", 1.0),
    "mm/s": Quantity("velocity", "m/s", 1e-3),
    "µm/s": Quantity("velocity", "m/s", 1e-6),
    "in/s": Quantity("velocity", "m/s", _INCH_M),
    "m": Quantity("displacement", "m", 1.0),
    "mm": Quantity("displacement", "m", 1e-3),
    "µm": Quantity("displacement", "m", 1e-6),
    "nm": Quantity("displacement", "m", 1e-9),
    "mil": Quantity("displacement", "m", 1e-3 * _INCH_M),
    "N": Quantity("force", "N", 1.0),
    "kN": Quantity("force", "N", 1e3),
    "mN": Quantity("force", "N", 1e-3),
    "lbf": Quantity("force", "N", _POUND_N),
    "N m": Quantity("moment", "N m", 1.0),
    "V": Quantity("voltage", "V", 1.0),
    "mV": Quantity("voltage", "V", 1e-3),
    "µV": Quantity("voltage", "V", 1e-6),
    "A": Quantity("current", "A", 1.0),
    "mA": Quantity("current", "A", 1e-3),
    "rpm": Quantity("speed", "rpm", 1.0),  # the label of a speed, as in units.py
    "Hz": Quantity("speed", "rpm", 60.0),
    "rev/s": Quantity("speed", "rpm", 60.0),
    "rad/s": Quantity("angular velocity", "rad/s", 1.0),
    "rad": Quantity("angle", "rad", 1.0),
    "°": Quantity("angle", "rad", pi / 180.0),
    "1": Quantity("number", "1", 1.0),
}

TIME_UNITS: Final = {
    "s": 1.0, "ms": 1e-3, "µs": 1e-6, "us": 1e-6, "ns": 1e-9, "min": 60.0, "h": 3600.0
}  # fmt: skip
"""Units of a time axis and their factors to s."""
_TIME_SPELLINGS: Final = {
    word + plural: TIME_UNITS[unit]
    for words, unit in (
        ("sec second", "s"),
        ("msec millisecond millisec", "ms"),
        ("usec microsecond microsec μs μsec", "µs"),
        ("nsec nanosecond nanosec", "ns"),
        ("minute", "min"),
        ("hr hour", "h"),
    )
    for word in words.split()
    for plural in ("", "s")
} | {"day": 86400.0, "days": 86400.0}
"""Other spellings, in small letters."""

_BY_SPELLING: Final = {plain_unit(unit): measured for unit, measured in QUANTITIES.items()}


def quantity(unit: str) -> Quantity:
    """Return the quantity of a unit in a file or from a user.

    Parameters
    ----------
    unit : a unit of QUANTITIES, or another spelling of it: `m/s2`, `m/s^2`, `m s-2` for `m/s²`

    Raises
    ------
    ParameterError
        The unit is not in the list.
    """
    measured = find_quantity(unit)
    if measured is None:
        raise ParameterError(f"unit {unit!r} is unknown; known are {', '.join(QUANTITIES)}")
    return measured


def find_quantity(unit: str) -> Quantity | None:
    """Return the quantity of a unit, or None where it is not in the list."""
    return _BY_SPELLING.get(plain_unit(unit))


def time_factor(unit: str) -> float:
    """Factor to s of the unit of a time axis; `s since DATE` is s."""
    return axis_factor("time", unit)


def axis_factor(axis: str, unit: str) -> float:
    """Factor to s of the unit of an axis.

    Parameters
    ----------
    axis : name of the axis, for the message
    unit : unit in the file; `s since DATE` is s

    Raises
    ------
    ParameterError
        The unit is none of a time.
    """
    factor = find_time_factor(unit)
    if factor is None:
        raise ParameterError(
            f"{axis} has the unit {unit!r}: a recording needs a time; allowed are "
            f"{', '.join(TIME_UNITS)}"
        )
    return factor


def find_time_factor(unit: str) -> float | None:
    """Factor to s of a unit of time in any spelling; None where it is none."""
    plain = unit.split(" since ", maxsplit=1)[0].strip().strip("[]()")
    return TIME_UNITS.get(plain) or _TIME_SPELLINGS.get(plain.lower().removesuffix("."))
