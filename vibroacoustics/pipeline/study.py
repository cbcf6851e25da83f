"""The main job, from the machine to the scores.

study -> moving parts -> orders -> transfer -> radiation -> levels -> scores, one dataset.
"""

from collections.abc import Iterable, Mapping, Sequence
from itertools import product
from typing import Final

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from .. import levels, scoring
from ..base.hashing import canonical_json
from ..errors import ParameterError
from ..mechanics.added import Added
from ..mechanics.moving_parts import Revolution, wrench
from ..mechanics.rotation import Array, uniform_crank_angle
from ..orders import order_spectra, semi_major_axis
from ..parameters.machine import Machine
from ..parameters.option import Option
from ..parameters.study import Study
from ..radiation import interpolate_transfer_vector
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
from ..transfer import FOOT_NAMES, RigidBodyOnMounts, SuspendedBlock
from ..units import shaft_frequency_hz
from .inner_sound import shell_path
from .inside import inside_sound
from .progress import Progress
from .radiating import (
    Radiation,
    airborne_factor,
    attributes,
    even_losses_db,
    sound_field,
    transfer_vectors,
    within,
)
from .speed_blocks import TIME_SERIES, blocks, check_size, joined
from .stopping import stopping_sound
from .words import words

Case = tuple[float, str]
"""Speed in rpm and option."""

MOUNT_FREQUENCY_HZ: Final[Array] = np.asarray(np.geomspace(1.0, 200.0, 400), dtype=np.float64)


def run(
    study: Study,
    progress: Progress = lambda *_: None,
    radiation: Radiation = transfer_vectors,
) -> xr.Dataset:
    """Carry a study from the machine's parameters to the scores of its options.

    Parameters
    ----------
    study : from `load_study`
    progress : told of the advance of long work
    radiation : gives the transfer vectors: the package's, measured ones or a second method's

    Returns
    -------
    one dataset with all variables of `schema.VARIABLES`

    Raises
    ------
    ParameterError, SolverError, StorageError
        An input is out of range, a computation failed, the cache cannot be written.
    """
    try:
        return _run(study, progress, radiation)
    except ParameterError as error:
        raise ParameterError(f"{study.source_file}: {error}") from None


def _run(study: Study, progress: Progress, radiation: Radiation) -> xr.Dataset:
    results, added = _motion(study, progress)
    machine, path = study.machine, shell_path(study)
    motions = () if path is None else path.modes
    radiated, was_cached = radiation(study, progress, motions)
    results = results.merge(radiated)
    results = results.merge(_pressures(study, results))
    results = results.merge(sound_field(study, results))
    results = results.merge(_levels(study, results))
    if study.inside is not None and path is not None:
        sound = inside_sound(study, study.inside, added, results, path, progress)
        results = results.merge(sound)
        stopped = stopping_sound(study, study.inside.inside, machine, _on_mounts(machine), results)
        results = results.merge(stopped)
    results = results.merge(_scores(study, results))
    results.attrs = attributes(study, radiated, was_cached)
    results.attrs["words"] = canonical_json(words(study, results))
    return check(label_coordinates(results))


def _motion(study: Study, progress: Progress) -> tuple[xr.Dataset, dict[Case, Added]]:
    """Forces, their orders and the motion that follows, block by block of speeds.

    Also what each option adds in each case.
    """
    parts: list[xr.Dataset] = []
    everything: dict[Case, Added] = {}
    done, total = 0, len(study.operation.speed_rpm) * len(study.options)

    def advance(task: str, step: int, _: int) -> None:
        progress(task, done + step, total)

    for speeds in blocks(study.operation.speed_rpm):
        part, added = _forces(_at_speeds(study, speeds, study.options), advance)
        part = part.merge(_orders(study, part))
        part = part.merge(_housing(study, part))
        if not study.operation.keeps_time_series:
            part = part.drop_vars(TIME_SERIES)
        if not parts:
            check_size(study, part, progress)
        parts.append(part)
        everything |= added
        done += len(speeds) * len(study.options)
    return joined(parts), everything


def _at_speeds(study: Study, speeds: tuple[float, ...], options: Mapping[str, Option]) -> Study:
    """The study with other speeds and options."""
    operation = study.operation.model_copy(update={"speed_rpm": speeds})
    return study.model_copy(update={"operation": operation, "options": dict(options)})


def _forces(study: Study, progress: Progress) -> tuple[xr.Dataset, dict[Case, Added]]:
    """Force and moment of every source, what each option reports of itself, and what it adds."""
    speeds, options = list(study.operation.speed_rpm), list(study.options)
    revolutions, added = _revolutions(study, progress)
    sources = [
        *_unique(name for turned in revolutions.values() for name in turned.wrenches),
        "balancer",
    ]
    samples = study.operation.crank_angle_samples
    wrenches = np.zeros((len(speeds), len(options), 2, len(sources), 3, samples))
    for (s, speed), (o, option) in product(enumerate(speeds), enumerate(options)):
        turned = revolutions[speed, option]
        balancer = wrench(added[speed, option].parts, turned.rotation)
        named = {**turned.wrenches, "balancer": balancer}
        for source, own in named.items():
            wrenches[s, o, :, sources.index(source)] = own
    coords = {
        "speed": speeds,
        "option": options,
        "source": sources,
        "axis": list(AXES),
        "crank_angle": uniform_crank_angle(samples),
    }
    turning = {name: coords[name] for name in _TURNING}
    rotations = [[revolutions[s, o].rotation for o in options] for s in speeds]
    shaft_speed = [[turn.speed_rad_per_s for turn in row] for row in rotations]
    labelled = check(
        xr.Dataset(
            {
                "force": stamp("force", wrenches[:, :, 0], coords),
                "moment": stamp("moment", wrenches[:, :, 1], coords),
                "shaft_speed": stamp("shaft_speed", shaft_speed, turning),
                "option_fact": _option_facts(_facts(study, revolutions, added), speeds, options),
            },
            coords={"crank_time": (_TURNING, [[turn.time_s for turn in row] for row in rotations])},
        )
    )
    return labelled, added


_TURNING: Final = ("speed", "option", "crank_angle")


def _revolutions(
    study: Study, progress: Progress
) -> tuple[dict[Case, Revolution], dict[Case, Added]]:
    """Steady revolution of the machine and what the option adds to it, in each case."""
    revolutions: dict[Case, Revolution] = {}
    added: dict[Case, Added] = {}
    cases = list(product(study.operation.speed_rpm, study.options))
    for number, (speed, name) in enumerate(cases):
        option = study.options[name]
        machine = option.applied_to(study.machine)
        shared = revolutions.get((speed, REFERENCE_OPTION)) if machine is study.machine else None
        try:
            turned = shared or machine.revolution(speed, study.operation.crank_angle_samples)
            revolutions[speed, name] = turned
            added[speed, name] = option.added(machine, turned)
        except ParameterError as error:
            raise ParameterError(f"options.{name}: {error}") from None
        progress("forces", number + 1, len(cases))
    return revolutions, added


def _facts(
    study: Study, revolutions: dict[Case, Revolution], added: dict[Case, Added]
) -> dict[Case, dict[str, float]]:
    """Figures of the machine, as it is and where it is changed, and of the options."""
    changed = {
        name
        for name, option in study.options.items()
        if name == REFERENCE_OPTION or option.applied_to(study.machine) is not study.machine
    }
    return {
        case: {**(turned.figures if case[1] in changed else {}), **added[case].figures}
        for case, turned in revolutions.items()
    }


def _option_facts(
    found: dict[Case, dict[str, float]], speeds: Sequence[float], options: Sequence[str]
) -> xr.DataArray:
    """The figures of all cases; NaN where one has none of that name."""
    facts = _unique(fact for named in found.values() for fact in named)
    figures = [[[found[s, o].get(fact, np.nan) for fact in facts] for o in options] for s in speeds]
    return stamp(
        "option_fact", figures, {"speed": list(speeds), "option": list(options), "fact": facts}
    )


def _orders(study: Study, results: xr.Dataset) -> xr.Dataset:
    """Order spectra of force and moment, and the ellipses of their resultants.

    The slowest speed of the study has the most orders. Beyond the highest one of a speed there is
    silence: force, moment and all that follows of them are zero.
    """
    speeds = results["speed"].values
    order = np.arange(study.highest_order(min(study.operation.speed_rpm)) + 1)
    held = order <= np.array([[study.highest_order(speed)] for speed in speeds])
    coords = {name: results[name] for name in ("speed", "option", "source", "axis")}
    spectra = {}
    for name in ("force", "moment"):
        spectrum = order_spectra(results[name].values, results["shaft_speed"].values, order[-1])
        spectrum = np.where(held[:, None, None, None], spectrum, 0.0)
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
    """Motion of the housing on its mounts and the forces into the feet.

    Every option moves on its own mounts; the natural modes are those of the machine as it is.
    """
    bodies = [_on_mounts(option.applied_to(study.machine)) for option in study.options.values()]
    parts = [results[name].transpose("option", ..., "order", "axis") for name in _WRENCH]
    loads = np.concatenate([part.values for part in parts], axis=-1)
    frequency = results["order_frequency"].values[:, None, :]

    def response(name: str) -> NDArray[np.complex128]:
        """Of each option's own body, shape (speed, option, source, order, ...)."""
        moved: dict[int, NDArray[np.complex128]] = {}
        for body in dict.fromkeys(bodies):
            rows = [row for row, other in enumerate(bodies) if other == body]
            moved.update(zip(rows, getattr(body, name)(loads[rows], frequency), strict=True))
        return np.stack([moved[row] for row in range(len(bodies))], axis=1)

    body = bodies[list(study.options).index(REFERENCE_OPTION)]
    foot_force = np.moveaxis(response("foot_force"), (-2, -1), (-3, -2))
    frequencies, shapes = body.natural_modes()
    coords = {name: results[name] for name in ("speed", "option", "source", "order")}
    feet = {"foot": list(FOOT_NAMES), "axis": list(AXES)}
    modes = [f"mode_{number}" for number in range(1, len(frequencies) + 1)]
    ellipse = semi_major_axis(foot_force.sum(axis=2), axis=3)
    motions = {"velocity_order": "velocity"}
    if isinstance(body, SuspendedBlock):
        motions["block_velocity_order"] = "block_velocity"
    return check(
        xr.Dataset(
            {
                **{
                    name: stamp(
                        name,
                        np.moveaxis(response(motion), -1, -2),
                        {**coords, "dof": list(RIGID_BODY_DOFS)},
                    )
                    for name, motion in motions.items()
                },
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
                    "mode_shape",
                    shapes.reshape(len(modes), len(body.bodies), -1),
                    {"mode": modes, "body": list(body.bodies), "dof": list(RIGID_BODY_DOFS)},
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


def _on_mounts(machine: Machine) -> RigidBodyOnMounts | SuspendedBlock:
    """The machine on its mounts: one rigid body, or a block on springs in a shell."""
    foot_height = -machine.shell.centre_of_mass_height_m
    if machine.suspension is None:
        return RigidBodyOnMounts(machine.housing, machine.mounts, foot_height)
    return SuspendedBlock(machine.housing, machine.mounts, machine.suspension, foot_height)


_WRENCH: Final = ("force_order", "moment_order")


def _transmissibility(body: RigidBodyOnMounts | SuspendedBlock) -> NDArray[np.complex128]:
    """Sum of the foot forces along an axis per force along it, shape (axis, frequency)."""
    unit = np.eye(6)[:3].astype(complex)
    force = body.foot_force(unit[:, None, :], MOUNT_FREQUENCY_HZ[None, :])
    return np.stack([force[axis, :, :, axis].sum(axis=-1) for axis in range(3)])


def _pressures(study: Study, results: xr.Dataset) -> xr.Dataset:
    """Pressure at each microphone: contraction of velocity and transfer vector over the dofs."""
    left = airborne_factor(study, results)
    pressure = left * _pressure(results, "transfer_vector")
    dims = VARIABLES["pressure_order"].dims
    coords = {name: results[name] for name in dims}
    found = {"pressure_order": stamp("pressure_order", pressure.transpose(*dims).values, coords)}
    if "transfer_vector_closed_form" in results:
        first = results.sel(order=1)
        other = left.sel(order=1) * _pressure(first, "transfer_vector_closed_form")
        both = [
            levels.sound_pressure_level(field.sum("source").transpose(*_CHANGE).values)
            for field in (pressure.sel(order=1), other)
        ]
        at = {name: results[name] for name in _CHANGE}
        found["line_difference"] = stamp("line_difference", both[0] - both[1], at)
    return check(xr.Dataset(found))


def _pressure(results: xr.Dataset, name: str) -> xr.DataArray:
    """Pressure of every source at every order by the transfer vectors of a name."""
    tabulated = results[name]
    vectors = interpolate_transfer_vector(tabulated, within(results, tabulated))
    pressure: xr.DataArray = xr.dot(results["velocity_order"], vectors, dim="dof")
    return pressure


_CHANGE: Final = ("speed", "option", "receiver")


def _levels(study: Study, results: xr.Dataset) -> xr.Dataset:
    """Order levels, modelled and total levels, and their changes against `none`."""
    order_level, modelled = _order_levels(results["pressure_order"], results["order_frequency"])
    coords = {name: results[name] for name in ("speed", "option", "receiver")}
    weighted = {**coords, "weighting": list(WEIGHTINGS)}
    modelled_level = stamp("level_modelled", modelled, weighted)
    remainder = _remainder(study, results, modelled_level)
    a_level = modelled_level.sel(weighting="A").values
    left = remainder - np.array(list(even_losses_db(study).values()))[:, None]
    total = levels.energy_sum(np.stack([a_level, np.broadcast_to(left, a_level.shape)]), axis=0)
    reference = list(study.options).index(REFERENCE_OPTION)
    first = order_level[..., 1, WEIGHTINGS.index("Z")]
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


def _order_levels(pressure: xr.DataArray, frequency: xr.DataArray) -> tuple[Array, Array]:
    """Levels (speed, option, receiver, order, weighting), and of all orders together."""
    summed = pressure.sum("source").transpose("speed", "option", "receiver", "order")
    unweighted = levels.sound_pressure_level(summed.values)
    hertz = frequency.values[:, None, None, :]
    order_level = np.stack(
        [unweighted + levels.WEIGHTING[name](hertz) for name in WEIGHTINGS], axis=-1
    )
    audible = order_level[:, :, :, 1:, :]  # order 0 is no sound
    return order_level, levels.energy_sum(audible, axis=3)


def _remainder(study: Study, results: xr.Dataset, modelled: xr.DataArray) -> float:
    """What the model leaves of the published level at its microphone and speed, dB(A)."""
    published = study.machine.overall_noise
    if published.speed_rpm not in study.operation.speed_rpm:
        modelled = _modelled_alone(study, results, published.speed_rpm)
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
            f"machine: overall_noise.level_dba = {published.level_dba:g} dB(A): "
            f"the model alone gives {explained:.1f} dB(A) at {study.catalogue_receiver}"
        ) from None


def _modelled_alone(study: Study, results: xr.Dataset, speed_rpm: float) -> xr.DataArray:
    """Modelled level of the reference option at a speed that is none of the study's."""
    reference = {REFERENCE_OPTION: study.options[REFERENCE_OPTION]}
    motion, _ = _motion(_at_speeds(study, (speed_rpm,), reference), lambda *_: None)
    motion = motion.assign(transfer_vector=results["transfer_vector"])
    pressure = _pressure(motion, "transfer_vector")
    coords = {name: pressure[name] for name in ("speed", "option", "receiver")}
    level = _order_levels(pressure, motion["order_frequency"])[1]
    return stamp("level_modelled", level, {**coords, "weighting": list(WEIGHTINGS)})


def _scores(study: Study, results: xr.Dataset) -> xr.Dataset:
    given = scoring.given_values(study.given, list(study.options))
    scores = scoring.score(results.merge(given), study.scoring).merge(given)
    if study.scoring.published is None:
        return scores
    return scores.merge(scoring.published_table(study.scoring.published))


def _unique(names: Iterable[str]) -> list[str]:
    return list(dict.fromkeys(names))
