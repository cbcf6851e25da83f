"""The motor on a supply of another frequency, and the supply that a speed under load needs."""

from typing import Final

from scipy.optimize import brentq, minimize_scalar

from ...base.errors import ParameterError
from ...base.units import shaft_frequency_hz
from .parameters import CapacitorMotor
from .revolving_fields import LARGEST_RUNNING_SLIP, operating_point

_GROW_WITH_FREQUENCY: Final = (
    "line_voltage_v",
    "main_leakage_ohm",
    "auxiliary_leakage_ohm",
    "magnetising_ohm",
    "rotor_leakage_ohm",
)


def on_supply(rated: CapacitorMotor, frequency_hz: float) -> CapacitorMotor:
    """The motor at the same flux: reactances and voltage in proportion to the frequency."""
    ratio = frequency_hz / rated.line_frequency_hz
    grown = {name: ratio * getattr(rated, name) for name in _GROW_WITH_FREQUENCY}
    return rated.model_copy(update={"line_frequency_hz": frequency_hz, **grown})


def supply_frequency_hz(rated: CapacitorMotor, speed_rpm: float, torque_n_m: float) -> float:
    """Supply on which the motor carries a load at a speed, f = p n/(60 (1 - s)).

    By definition the slip is s = (n_s - n)/n_s, the speed n against the synchronous n_s = 60 f/p,
    at which the field turns. It is that at which the motor on this supply, at the same flux, gives
    the torque; the curve is that of its circuit (`operating_point`).

    Parameters
    ----------
    rated : with the values of its line frequency
    speed_rpm : of the shaft
    torque_n_m : mean load against the rotation

    Raises
    ------
    ParameterError
        The motor does not give that torque at that speed on any supply.
    """

    def frequency(slip: float) -> float:
        return rated.pole_pairs * shaft_frequency_hz(speed_rpm) / (1.0 - slip)

    def torque(slip: float) -> float:
        return operating_point(on_supply(rated, frequency(slip)), slip).torque_n_m

    top = minimize_scalar(
        lambda slip: -torque(slip),
        bounds=(0.0, LARGEST_RUNNING_SLIP),
        method="bounded",
        options={"xatol": 1e-9},
    ).x
    least, most = torque(0.0), torque(top)
    if not least <= torque_n_m <= most:
        raise ParameterError(
            f"torque = {torque_n_m:.4g} N m: the motor gives {least:.4g} to {most:.4g} N m at "
            f"{speed_rpm:g} rpm between synchronous speed and breakdown: give "
            "operation.supply_frequency_hz, or change the motor's table"
        )
    return frequency(brentq(lambda slip: torque(slip) - torque_n_m, 0.0, top, xtol=1e-14))
