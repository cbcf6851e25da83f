"""Settings that a study leaves to this package: the word `auto` in place of a number."""

from collections.abc import Mapping
from math import ceil, log2
from typing import Any, Final

from ..base.units import orders_below, shaft_frequency_hz
from ..machine.machine import Machine
from ..machine.source import Source
from .operation import speed_range
from .radiation import KWAVE_LIMIT_HZ, RadiationSettings
from .reader import is_number

AUTO: Final = "auto"
OPTIONAL: Final = {
    "operation": ("maximum_order",),
    "radiation": ("near_field_spacing_m", "room_spacing_m", "frequency_step_hz"),
}
"""Fields by table that are automatic where a file omits them."""
COMPUTED: Final = {"operation": ("crank_angle_samples",), "radiation": ("maximum_frequency_hz",)}
"""Fields by table with a default, which speeds and sources set where a file says `auto`."""
ORDERS: Final = 20
"""Shaft orders of a machine whose shell no source drives."""
SAMPLES_OF_ORDER: Final = 3
"""Fewest crank angles for one cycle of the highest order."""
LEAST_SAMPLES: Final = 256
LEAST_RPM: Final = 60.0
"""Slowest speed of a study."""
_STEP_HZ: Final = 100.0
_ROUNDING: Final = 1e-9


def fill_in_automatic(content: Mapping[str, Any], machine: Machine | None) -> None:
    """Put numbers in place of `auto` in a study's tables `operation` and `radiation`.

    Parameters
    ----------
    content : tables in SI, sources as parameters of their kind
    machine : machine of the study; none where it is refused
    """
    operation, radiation = content.get("operation"), content.get("radiation")
    if not isinstance(operation, dict) or not isinstance(radiation, dict):
        return  # refused by the study
    for table, names in OPTIONAL.items():
        for name in names:
            if content[table].get(name) == AUTO:
                del content[table][name]
    speeds = _speeds_rpm(operation, machine)
    requested = operation.get("maximum_order")
    orders = int(requested) if requested is not None and is_number(requested) else None
    if radiation.get("maximum_frequency_hz") == AUTO:
        sources = content.get("sources")
        listed = sources.values() if isinstance(sources, Mapping) else ()
        drives_shell = any(isinstance(each, Source) and each.drives_shell for each in listed)
        highest = max(speeds) * (ORDERS if orders is None else orders)
        radiation["maximum_frequency_hz"] = highest_frequency_hz(
            highest, operation.get("supply_frequency_hz"), drives_shell
        )
    if operation.get("crank_angle_samples") == AUTO:
        default = RadiationSettings.model_fields["maximum_frequency_hz"].default
        frequency = radiation.get("maximum_frequency_hz", default)
        if orders is None and is_number(frequency):
            orders = orders_below(frequency, min(speeds))
        operation["crank_angle_samples"] = samples_for(orders or 0)


def highest_frequency_hz(highest_rpm: float, supply_hz: Any, drives_shell: bool) -> float:
    """Choose the highest frequency of the radiation, Hz.

    Parameters
    ----------
    highest_rpm : speed of the highest order
    supply_hz : supply frequencies of a motor, of which twice is reached
    drives_shell : whether a source drives the elastic shell: then up to k-Wave's highest frequency
    """
    if drives_shell:
        return KWAVE_LIMIT_HZ
    supplies = supply_hz if isinstance(supply_hz, tuple | list) else ()
    twice = [2.0 * supply for supply in supplies if is_number(supply)]
    highest = max([shaft_frequency_hz(highest_rpm), *twice, _STEP_HZ])
    return float(_STEP_HZ * ceil(highest / _STEP_HZ - _ROUNDING))


def samples_for(orders: int) -> int:
    """Choose the crank angles of a revolution: a power of two, three a cycle of the last order."""
    return int(max(LEAST_SAMPLES, 2 ** ceil(log2(max(SAMPLES_OF_ORDER * orders, 1)))))


def _speeds_rpm(operation: Mapping[str, Any], machine: Machine | None) -> list[float]:
    """Speeds of the study and of the published level; the slowest allowed where none is allowed."""
    speeds_rpm = operation.get("speed_rpm")
    if isinstance(speeds_rpm, Mapping):
        try:
            speeds_rpm = speed_range(speeds_rpm)
        except ValueError:
            speeds_rpm = ()
    listed = speeds_rpm if isinstance(speeds_rpm, tuple | list) else ()
    noise = None if machine is None else machine.overall_noise
    published = () if noise is None else (noise.speed_rpm,)
    speeds = [float(speed) for speed in (*listed, *published) if is_number(speed)]
    return [speed for speed in speeds if speed >= LEAST_RPM] or [LEAST_RPM]
