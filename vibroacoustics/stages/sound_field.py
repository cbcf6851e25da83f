"""Levels beside the microphones: map, sound power, and k-Wave against the closed form."""

import xarray as xr

from ..base.registry import register
from ..levels import sound_field as levels
from ..levels.insertion_loss import airborne_factor
from ..radiation.pressure import pressure_on_map, pressure_on_surface, wrench_pressure
from ..study.study import Study
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
        fields = _sound_field(chain.study, chain.results)
        return Given(fields.merge(_line_difference(chain.study, chain.results)))


def _sound_field(study: Study, results: xr.Dataset) -> xr.Dataset:
    """Level of the 1x line on the map, sound power of every order; what the study asks for."""
    factor = airborne_factor(study.options, results["order_frequency"])
    velocity = factor * results["velocity_order"].sum("source")
    fields = xr.Dataset()
    if "map_transfer_vector" in results:
        fields = fields.merge(levels.map_level(pressure_on_map(velocity, results)))
    if study.sound_power is not None:
        pressure = pressure_on_surface(velocity, results)
        frequency, surface = results["order_frequency"], results["surface_transfer_vector"]
        power = levels.sound_power_variables(pressure, frequency, study.sound_power, surface)
        fields = fields.merge(power)
    return fields


def _line_difference(study: Study, results: xr.Dataset) -> xr.Dataset:
    """1x level with k-Wave's Green's function against the closed form; empty without k-Wave."""
    if "transfer_vector_closed_form" not in results:
        return xr.Dataset()
    first = results.sel(order=1)
    factor = airborne_factor(study.options, results["order_frequency"]).sel(order=1)
    pressure, closed_form = (
        (factor * wrench_pressure(first, name)).sum("source")
        for name in ("transfer_vector", "transfer_vector_closed_form")
    )
    return levels.line_difference(pressure, closed_form)
