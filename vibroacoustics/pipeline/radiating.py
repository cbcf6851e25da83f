"""The housing's radiation: transfer vectors, and what map and sound power make of them."""

from collections.abc import Callable, Sequence
from typing import Any, Final

import numpy as np
import xarray as xr

from .. import levels, radiation
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.errors import ParameterError
from ..base.hashing import canonical_json
from ..base.progress import Progress
from ..base.units import shaft_frequency_hz
from ..base.vocabulary import (
    VARIABLES,
    WEIGHTINGS,
    check,
    label_coordinates,
    stamp,
)
from ..levels import sound_power
from ..results import provenance, storage
from ..study.sound_power import SoundPowerSettings
from ..study.study import Study
from .shell import shell_path

Radiation = Callable[[Study, Progress, Sequence[radiation.SurfaceMotion]], tuple[xr.Dataset, bool]]
"""From a study and the shell's modes to transfer vectors, and whether they were known already."""

UNIT_VELOCITY_PEAK: Final = np.sqrt(2.0) * 1e-3
"""1 mm/s (1 mrad/s) root mean square as a peak."""


def transfer_vectors(
    study: Study, progress: Progress, motions: Sequence[radiation.SurfaceMotion] = ()
) -> tuple[xr.Dataset, bool]:
    """Pressure per velocity of the housing and of the motions; from the cache if it is there."""
    drawn = study.map is not None or study.directivity is not None
    sound_field = radiation.SoundField(
        study.sound_power,
        study.map,
        study.directivity,
        tuple(map(shaft_frequency_hz, study.operation.speed_rpm)) if drawn else (),
    )
    inputs = (study.machine.shell, study.receivers, study.radiation, sound_field, motions)
    return storage.cached(
        "transfer-vectors",
        radiation.cache_key_material(*inputs),
        lambda: radiation.transfer_vectors(*inputs, progress),
    )


def radiate(
    study: Study, progress: Progress = lambda *_: None, radiation: Radiation = transfer_vectors
) -> xr.Dataset:
    """Only the radiation of the housing: transfer vectors, from the cache if they are there.

    Parameters
    ----------
    study : from `load_study`
    progress : told of the advance of long work
    radiation : gives the transfer vectors: the package's, measured ones or a second method's

    Raises
    ------
    ParameterError, SolverError, StorageError
        An input is out of range, a computation failed, the cache cannot be written.
    """
    try:
        path = shell_path(study)
        motions = () if path is None else path.modes
        radiated, was_cached = radiation(study, progress, motions)
    except ParameterError as error:
        raise ParameterError(f"{study.source_file}: {error}") from None
    if study.sound_power is not None:
        surface = radiated["surface_transfer_vector"]
        area = _surface_area_m2(study.sound_power, surface)
        radiated["unit_sound_power_level"] = unit_sound_power(surface, study.sound_power, area)
    radiated.attrs = attributes(study, radiated, was_cached)
    return check(label_coordinates(radiated))


def unit_sound_power(
    surface_transfer_vector: xr.DataArray, settings: SoundPowerSettings, surface_m2: float
) -> xr.DataArray:
    """Sound power level (dof, frequency) of a housing that moves at 1 mm/s or 1 mrad/s rms, dB.

    Parameters
    ----------
    surface_transfer_vector : (position, dof, frequency), at the positions of an arrangement
    settings : the study's, to be told in the attributes with K1 and K2 of its test stand
    surface_m2 : area of its measurement surface, m²

    Raises
    ------
    ParameterError
        The room of the test stand does not qualify.
    """
    background, environment = sound_power.stand_corrections_db(settings, surface_m2)
    ordered = surface_transfer_vector.transpose("position", "dof", "frequency")
    peak = UNIT_VELOCITY_PEAK * ordered.values
    mean = sound_power.energy_mean(levels.sound_pressure_level(peak), axis=0)
    labelled = stamp(
        "unit_sound_power_level",
        sound_power.sound_power_level(mean, surface_m2),
        {name: ordered[name].values for name in ("dof", "frequency")},
        arrangement=settings.arrangement,
    )
    return labelled.assign_attrs(
        surface_m2=surface_m2,
        test_stand_background_correction_db=background,
        test_stand_environment_correction_db=environment,
    )


def sound_field(study: Study, results: xr.Dataset) -> xr.Dataset:
    """Level of the 1x line on the map, sound power of every order; what the study asks for."""
    velocity = airborne_factor(study, results) * results["velocity_order"].sum("source")
    fields: dict[str, xr.DataArray] = {}
    if "map_transfer_vector" in results:
        by_speed = results["map_transfer_vector"].rename(line_frequency="speed")
        first = velocity.sel(order=1, drop=True)
        line = xr.dot(first, by_speed.assign_coords(speed=first["speed"]), dim="dof")
        dims = VARIABLES["map_level"].dims
        coords = {name: results[name].values for name in dims}
        level = levels.sound_pressure_level(line.transpose(*dims).values)
        fields["map_level"] = stamp("map_level", level, coords)
    if study.sound_power is not None:
        surface = results["surface_transfer_vector"]
        vectors = radiation.interpolate_transfer_vector(
            surface.rename(position="receiver", position_distance="distance"),
            within(results, surface),
        )
        pressure = xr.dot(velocity, vectors, dim="dof")
        dims = ("speed", "option", "order", "receiver")
        mean = sound_power.energy_mean(
            levels.sound_pressure_level(pressure.transpose(*dims).values), axis=3
        )
        power = sound_power.sound_power_level(mean, _surface_area_m2(study.sound_power, surface))
        frequency = results["order_frequency"].values[:, None, :]
        weighted = np.stack([power + levels.WEIGHTING[a](frequency) for a in WEIGHTINGS], axis=-1)
        total = levels.energy_sum(weighted[:, :, 1:], axis=2)  # order 0 is no sound
        for name, level in (("order_sound_power_level", weighted), ("sound_power_level", total)):
            by = {dim: results[dim] for dim in VARIABLES[name].dims if dim in results}
            by["weighting"] = xr.DataArray(list(WEIGHTINGS), dims="weighting")
            fields[name] = stamp(name, level, by, arrangement=study.sound_power.arrangement)
    return check(xr.Dataset(fields))


def airborne_factor(study: Study, results: xr.Dataset) -> xr.DataArray:
    """What each option leaves of the airborne sound at every order, (option, speed, order)."""
    frequency = results["order_frequency"]
    losses = [option.insertion_loss() for option in study.options.values()]
    factor = [
        np.ones(frequency.shape) if loss is None else loss.amplitude_factor(frequency.values)
        for loss in losses
    ]
    coords = {"option": list(study.options), **{n: frequency[n] for n in frequency.dims}}
    return xr.DataArray(factor, coords, ("option", *frequency.dims))


def even_losses_db(study: Study) -> dict[str, float]:
    """What each option takes off the sound that is not modelled, spread evenly over its bands."""
    losses = {name: option.insertion_loss() for name, option in study.options.items()}
    return {name: 0.0 if loss is None else loss.even_db for name, loss in losses.items()}


def within(results: xr.Dataset, tabulated: xr.DataArray) -> xr.DataArray:
    """Frequencies of the orders; those beyond the table, which are silent, at its highest one."""
    frequency: xr.DataArray = results["order_frequency"].clip(
        max=tabulated["frequency"].max().item()
    )
    return frequency


def _surface_area_m2(settings: SoundPowerSettings, surface: xr.DataArray) -> float:
    edges = (surface.attrs[f"reference_{name}_m"] for name in ("length", "width", "height"))
    return sound_power.surface_area_m2(settings, *edges)


def attributes(study: Study, radiated: xr.Dataset, was_cached: bool) -> dict[str, Any]:
    """Global attributes of a result of a study."""
    return {
        **provenance.attributes(study),
        "reference_pressure_pa": REFERENCE_PRESSURE_PA,
        "transfer_vectors": "from the cache" if was_cached else "computed in this run",
        "radiation": canonical_json(radiated.attrs),
    }
