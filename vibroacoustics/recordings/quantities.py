"""Units that a channel may have. A unit that is not in this list is refused, never guessed."""

import re
from math import pi
from typing import Final, NamedTuple

from ..base.constants import STANDARD_GRAVITY_M_PER_S2
from ..base.errors import ParameterError
from ..base.unit_spelling import plain_unit


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
    "m/s²": Quantity("acceleration", "m/s²", 1.0),
    "mm/s²": Quantity("acceleration", "m/s²", 1e-3),
    "g": Quantity("acceleration", "m/s²", STANDARD_GRAVITY_M_PER_S2),
    "m/s": Quantity("velocity", "m/s", 1.0),
    "mm/s": Quantity("velocity", "m/s", 1e-3),
    "m": Quantity("displacement", "m", 1.0),
    "mm": Quantity("displacement", "m", 1e-3),
    "µm": Quantity("displacement", "m", 1e-6),
    "N": Quantity("force", "N", 1.0),
    "kN": Quantity("force", "N", 1e3),
    "N m": Quantity("moment", "N m", 1.0),
    "V": Quantity("voltage", "V", 1.0),
    "mV": Quantity("voltage", "V", 1e-3),
    "A": Quantity("current", "A", 1.0),
    "mA": Quantity("current", "A", 1e-3),
    "rpm": Quantity("speed", "rpm", 1.0),  # the label of a speed, as in units.py
    "rad/s": Quantity("angular velocity", "rad/s", 1.0),
    "rad": Quantity("angle", "rad", 1.0),
    "°": Quantity("angle", "rad", pi / 180.0),
    "1": Quantity("number", "1", 1.0),
}

TIME_UNITS: Final = {"s": 1.0, "ms": 1e-3, "µs": 1e-6, "us": 1e-6}
"""Units of a time axis and their factors to s."""

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
    """Factor to s of the unit of a time axis; `s since DATE` is s.

    Raises
    ------
    ParameterError
        The unit is not in the list.
    """
    plain = re.sub(r"seconds?", "s", unit.split(" since ", maxsplit=1)[0])
    if plain not in TIME_UNITS:
        raise ParameterError(f"time has the unit {unit!r}; allowed are {', '.join(TIME_UNITS)}")
    return TIME_UNITS[plain]
