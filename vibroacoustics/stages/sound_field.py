"""Levels beside the microphones: map, sound power, and k-Wave against the closed form."""

import xarray as xr

from ..base.registry import register
from ..levels import sound_field as levels
from ..levels.remainder import airborne
from ..radiation.pressure import pressure_on_map, pressure_on_surface, wrench_pressure
from .chain import Chain
from .stage import Given, Stage


@register
class SoundField(Stage):
    """Level of the 1x line on the map, sound power by order, difference of two room methods."""

    name = "sound-field"
    reads = (
        "velocity_order", "transfer_vector", "transfer_vector_closed_form", "map_transfer_vector",
        "surface_transfer_vector",
    )  # fmt: skip
    gives = ("map_level", "order_sound_power_level", "sound_power_level", "line_difference")

    def run(self, chain: Chain) -> Given:
        study, results = chain.study, airborne(chain.study.options, chain.results)
        velocity, fields = results["velocity_order"].sum("source"), xr.Dataset()
        if "map_transfer_vector" in results:
            fields = fields.merge(levels.map_level(pressure_on_map(velocity, results)))
        if study.sound_power is not None:
            pressure = pressure_on_surface(velocity, results)
            frequency, surface = results["order_frequency"], results["surface_transfer_vector"]
            power = levels.sound_power_variables(pressure, frequency, study.sound_power, surface)
            fields = fields.merge(power)
        if "transfer_vector_closed_form" in results:
            names = ("transfer_vector", "transfer_vector_closed_form")
            first = results.sel(order=1)
            computed, closed = (wrench_pressure(first, name).sum("source") for name in names)
            fields = fields.merge(levels.line_difference(computed, closed))
        return Given(fields)
