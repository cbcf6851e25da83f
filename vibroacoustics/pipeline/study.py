"""The main job, from the machine to the scores.

study -> moving parts -> orders -> transfer -> radiation -> levels -> scores, one dataset.
"""

from collections.abc import Iterable, Sequence
from typing import Final

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from .. import levels, radiation, scoring
from ..balancers import BALANCERS
from ..errors import ParameterError
from ..mechanisms import MECHANISMS
from ..moving_parts import Array, Balancing, MovingPart, wrench
from ..orders import order_spectrum, semi_major_axis
from ..parameters.study import Study
from ..schema import (
    AXES,
    REFERENCE_OPTION,
    RIGID_BODY_DOFS,
    VARIABLES,
    WEIGHTINGS,
    check,
    label_coordinates,
    stamp,
)
from ..transfer import FOOT_NAMES, RigidBodyOnMounts
from ..units import shaft_frequency_hz
from .progress import Progress
from .radiating import attributes, sound_field, transfer_vectors

MOUNT_FREQUENCY_HZ: Final[Array] = np.asarray(np.geomspace(1.0, 200.0, 400), dtype=np.float64)


def run(study: Study, progress: Progress = lambda *_: None) -> xr.Dataset:
    """Carry a study from the machine's parameters to the scores of its options.

    Parameters
    ----------
    study : from `load_study`
    progress : told of the advance of long work

    Returns
    -------
    one dataset with all variables of `schema.VARIABLES`

    Raises
    ------
    ParameterError, SolverError, StorageError
        An input is out of range, a computation failed, the cache cannot be written.
    """
    try:
        return _run(study, progress)
    except ParameterError as error:
        raise ParameterError(f"{study.source_file}: {error}") from None


def _run(study: Study, progress: Progress) -> xr.Dataset:
    results = _forces(study, progress)
    results = results.merge(_orders(study, results))
    results = results.merge(_housing(study, results))
    radiated, was_cached = transfer_vectors(study, progress)
    results = results.merge(radiated)
    results = results.merge(_pressures(results))
    results = results.merge(sound_field(study, results))
    results = results.merge(_levels(study, results))
    results = results.merge(_scores(study, results))
    results.attrs = attributes(study, radiated, was_cached)
    return check(label_coordinates(results))


def _forces(study: Study, progress: Progress) -> xr.Dataset:
    """Force and moment of every source, and what each option reports of itself."""
    samples = study.operation.crank_angle_samples
    crank_angle = 2.0 * np.pi * np.arange(samples) / samples
    speeds, options = list(study.operation.speed_rpm), list(study.options)
    machine_parts = [
        part
        for mechanism in MECHANISMS[study.machine.kind]
        for part in mechanism(study.machine, crank_angle)
    ]
    added = _balancing(study, crank_angle, progress)
    sources = [*_unique(part.source for part in machine_parts), "balancer"]
    wrenches = np.array(  # speed, option, force and moment, source, axis, crank angle
        [
            [_by_source([*machine_parts, *added[s, o].parts], sources, s) for o in options]
            for s in speeds
        ]
    )
    coords = {
        "speed": speeds,
        "option": options,
        "source": sources,
        "axis": list(AXES),
        "crank_angle": crank_angle,
    }
    revolution_s = 1.0 / (shaft_frequency_hz(1.0) * np.array(speeds))
    return check(
        xr.Dataset(
            {
                "force": stamp("force", wrenches[:, :, 0], coords),
                "moment": stamp("moment", wrenches[:, :, 1], coords),
                "option_fact": _option_facts(added, speeds, options),
            },
            coords={
                "crank_time": (
                    ("speed", "crank_angle"),
                    np.outer(revolution_s, crank_angle / 2 / np.pi),
                )
            },
        )
    )


def _balancing(
    study: Study, crank_angle: Array, progress: Progress
) -> dict[tuple[float, str], Balancing]:
    """What each option adds at each speed."""
    cases = [(speed, name) for speed in study.operation.speed_rpm for name in study.options]
    added = {}
    for number, (speed, name) in enumerate(cases):
        option = study.options[name]
        try:
            balancing = BALANCERS[option.kind](option, study.machine, speed, crank_angle)
        except ParameterError as error:
            raise ParameterError(f"options.{name}: {error}") from None
        added[speed, name] = balancing
        progress("forces", number + 1, len(cases))
    return added


def _by_source(
    parts: Sequence[MovingPart], sources: Sequence[str], speed_rpm: float
) -> tuple[Array, Array]:
    """Force and moment per source, shape (source, axis, crank_angle) each."""
    samples = parts[0].position_m.shape[-1]
    force = np.zeros((len(sources), 3, samples))
    moment = np.zeros_like(force)
    for number, source in enumerate(sources):
        own = [part for part in parts if part.source == source]
        if own:
            force[number], moment[number] = wrench(own, shaft_frequency_hz(speed_rpm))
    return force, moment


def _option_facts(
    added: dict[tuple[float, str], Balancing], speeds: Sequence[float], options: Sequence[str]
) -> xr.DataArray:
    """The figures that the options report; NaN where an option has none of that name."""
    facts = _unique(fact for balancing in added.values() for fact in balancing.facts)
    figures = [
        [[added[s, o].facts.get(fact, np.nan) for fact in facts] for o in options] for s in speeds
    ]
    return stamp(
        "option_fact", figures, {"speed": list(speeds), "option": list(options), "fact": facts}
    )


def _orders(study: Study, results: xr.Dataset) -> xr.Dataset:
    """Order spectra of force and moment, and the ellipses of their resultants."""
    highest = study.operation.maximum_order
    order = np.arange(highest + 1)
    speeds = np.array(study.operation.speed_rpm)
    coords = {name: results[name] for name in ("speed", "option", "source", "axis")}
    spectra = {}
    for name in ("force", "moment"):
        spectrum = order_spectrum(results[name].values, highest)
        spectra[f"{name}_order"] = stamp(f"{name}_order", spectrum, {**coords, "order": order})
        resultant = semi_major_axis(spectrum.sum(axis=2), axis=2)
        spectra[f"{name}_amplitude"] = stamp(
            f"{name}_amplitude",
            resultant,
            {"speed": coords["speed"], "option": coords["option"], "order": order},
        )
    frequency = shaft_frequency_hz(1.0) * speeds[:, None] * order
    return check(xr.Dataset(spectra, coords={"order_frequency": (("speed", "order"), frequency)}))


def _housing(study: Study, results: xr.Dataset) -> xr.Dataset:
    """Motion of the housing on its mounts and the forces into the feet."""
    machine = study.machine
    body = RigidBodyOnMounts(
        machine.housing, machine.mounts, -machine.shell.centre_of_mass_height_m
    )
    parts = [results[name].transpose(..., "order", "axis") for name in _WRENCH]
    load = np.concatenate([part.values for part in parts], axis=-1)
    frequency = results["order_frequency"].values[:, None, None, :]
    velocity = np.moveaxis(body.velocity(load, frequency), -1, -2)
    foot_force = np.moveaxis(body.foot_force(load, frequency), (-2, -1), (-3, -2))
    frequencies, shapes = body.natural_modes()
    coords = {name: results[name] for name in ("speed", "option", "source", "order")}
    feet = {"foot": list(FOOT_NAMES), "axis": list(AXES)}
    modes = [f"mode_{number}" for number in range(1, 7)]
    ellipse = semi_major_axis(foot_force.sum(axis=2), axis=3)
    return check(
        xr.Dataset(
            {
                "velocity_order": stamp(
                    "velocity_order", velocity, {**coords, "dof": list(RIGID_BODY_DOFS)}
                ),
                "foot_force_order": stamp("foot_force_order", foot_force, {**coords, **feet}),
                "foot_force_amplitude": stamp(
                    "foot_force_amplitude",
                    ellipse,
                    {
                        **{name: coords[name] for name in ("speed", "option", "order")},
                        "foot": feet["foot"],
                    },
                ),
                "natural_frequency": stamp("natural_frequency", frequencies, {"mode": modes}),
                "mode_shape": stamp(
                    "mode_shape", shapes, {"mode": modes, "dof": list(RIGID_BODY_DOFS)}
                ),
                "mount_transmissibility": stamp(
                    "mount_transmissibility",
                    _transmissibility(body),
                    {"axis": list(AXES), "mount_frequency": MOUNT_FREQUENCY_HZ},
                ),
            },
            coords={"foot_position": (("foot", "axis"), body.foot_position)},
        )
    )


_WRENCH: Final = ("force_order", "moment_order")


def _transmissibility(body: RigidBodyOnMounts) -> NDArray[np.complex128]:
    """Sum of the foot forces along an axis per force along it, shape (axis, frequency)."""
    unit = np.eye(6)[:3].astype(complex)
    force = body.foot_force(unit[:, None, :], MOUNT_FREQUENCY_HZ[None, :])
    return np.stack([force[axis, :, :, axis].sum(axis=-1) for axis in range(3)])


def _pressures(results: xr.Dataset) -> xr.Dataset:
    """Pressure at each microphone: contraction of velocity and transfer vector over the dofs."""
    pressure = _pressure(results, "transfer_vector")
    dims = VARIABLES["pressure_order"].dims
    coords = {name: results[name] for name in dims}
    found = {"pressure_order": stamp("pressure_order", pressure.transpose(*dims).values, coords)}
    if "transfer_vector_closed_form" in results:
        first, second = (
            levels.sound_pressure_level(field.sel(order=1).sum("source").transpose(*_CHANGE).values)
            for field in (pressure, _pressure(results, "transfer_vector_closed_form"))
        )
        at = {name: results[name] for name in _CHANGE}
        found["line_difference"] = stamp("line_difference", first - second, at)
    return check(xr.Dataset(found))


def _pressure(results: xr.Dataset, name: str) -> xr.DataArray:
    """Pressure of every source at every order by the transfer vectors of a name."""
    vectors = radiation.interpolate_transfer_vector(results[name], results["order_frequency"])
    pressure: xr.DataArray = xr.dot(results["velocity_order"], vectors, dim="dof")
    return pressure


_CHANGE: Final = ("speed", "option", "receiver")


def _levels(study: Study, results: xr.Dataset) -> xr.Dataset:
    """Order levels, modelled and total levels, and their changes against `none`."""
    pressure = results["pressure_order"].sum("source")
    frequency = results["order_frequency"].values[:, None, None, :]
    unweighted = levels.sound_pressure_level(pressure.values)
    order_level = np.stack(
        [unweighted + levels.WEIGHTING[name](frequency) for name in WEIGHTINGS], axis=-1
    )
    audible = order_level[:, :, :, 1:, :]  # order 0 is no sound
    modelled = levels.energy_sum(audible, axis=3)
    coords = {name: results[name] for name in ("speed", "option", "receiver")}
    weighted = {**coords, "weighting": list(WEIGHTINGS)}
    modelled_level = stamp("level_modelled", modelled, weighted)
    remainder = _remainder(study, modelled_level)
    a_level = modelled_level.sel(weighting="A").values
    total = levels.energy_sum(np.stack([a_level, np.full_like(a_level, remainder)]), axis=0)
    reference = list(study.options).index(REFERENCE_OPTION)
    first = unweighted[..., 1]
    changes = {"change_1x": first, "change_modelled": a_level, "change_total": total}
    return check(
        xr.Dataset(
            {
                "order_level": stamp(
                    "order_level", order_level, {**weighted, "order": results["order"]}
                ),
                "level_modelled": modelled_level,
                "level_total": stamp("level_total", total, coords),
                "level_remainder": stamp("level_remainder", remainder),
                **{
                    name: stamp(name, level - level[:, [reference]], coords)
                    for name, level in changes.items()
                },
            }
        )
    )


def _remainder(study: Study, modelled: xr.DataArray) -> float:
    """What the model leaves of the published level at its microphone and speed, dB(A)."""
    published = study.machine.published_noise
    explained = modelled.sel(
        speed=published.speed_rpm,
        option=REFERENCE_OPTION,
        receiver=study.catalogue_receiver,
        weighting="A",
    ).item()
    try:
        return levels.energy_difference(published.level_dba, explained)
    except ValueError:
        raise ParameterError(
            f"machine: published_noise.level_dba = {published.level_dba:g} dB(A): "
            f"the model alone gives {explained:.1f} dB(A) at {study.catalogue_receiver}"
        ) from None


def _scores(study: Study, results: xr.Dataset) -> xr.Dataset:
    scores = scoring.score(results, study.scoring)
    if study.scoring.published is None:
        return scores
    return scores.merge(scoring.published_table(study.scoring.published))


def _unique(names: Iterable[str]) -> list[str]:
    return list(dict.fromkeys(names))
