"""Counterweights of a study's option: best moments by influence coefficients of the machine."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import pi
from typing import Final, Literal

import numpy as np

from ..balancers.counterweight import Counterweight
from ..base.arrays import Array, ComplexArray
from ..base.errors import ParameterError
from ..base.vocabulary import REFERENCE_OPTION
from ..machine.combination import Combination, members_by_name
from ..machine.option import Option
from ..mechanics.balancing.moments import (
    chosen_moments,
    least_squares_moments,
    sums_of_squares,
    worst_speed_moments,
)
from ..radiation.given import Radiation
from ..stages.radiation import transfer_vectors
from ..study.study import Study
from .engine.on_mounts import ADDED, SOUND, Arrays, Lines, lines_of, pressure_by_source
from .engine.probe import Probe, machine_of_design, probe
from .engine.response import displacement, foot_forces
from .engine.sound_path import Responses, SoundPaths

BALANCED: Final = ("force_n", "moment_nm", "foot_force_n", "pressure_pa")
"""Figures whose sum of squares at the shaft frequency may be made least."""
MOTION: Final = "motion_m"
"""Translation and rotation of the body on the feet, m and rad."""
_LIGHTEST_KG: Final = 1e-9
_NO_SOUND: Final = Responses(np.zeros((0, 6, 0), complex), np.zeros((0, 0, 0), complex), ())
"""Responses where no microphone counts, for which no radiation is computed."""


@dataclass(frozen=True)
class Balanced:
    """Counterweights with the least sum of squares of a figure at the shaft frequency.

    Attributes
    ----------
    moment_kg_m : mass times radius of each counterweight, at its angle, complex, shape (weight,)
    values : masses and angles by key, for `Study.replace`
    before, after : root of the sum of squares without and with the counterweights, shape (speed,):
        of forces or moments, N or N m peak; of pressures the effective value over the microphones,
        Pa

    Examples
    --------
    >>> values = {"options.weight.mass_kg": 0.005, "options.weight.angle_deg": 180.0}
    >>> best = va.Balanced(np.array([-1e-4 + 0j]), values, np.array([40.0]), np.array([10.0]))
    >>> (best.after / best.before).tolist()
    [0.25]
    """

    moment_kg_m: ComplexArray
    values: Mapping[str, float]
    before: Array
    after: Array


def balance(
    study: Study,
    option: str,
    figure: str = "foot_force_n",
    speeds: Literal["worst", "all"] = "worst",
    holes: Mapping[str, tuple[int, Sequence[float]]] | None = None,
    radiation: Radiation = transfer_vectors,
) -> Balanced:
    """Find masses and angles of the counterweights of an option, the other values kept.

    Forces and sound are linear in the complex moments of counterweights at given radii and heights.
    Their influence is found with each of them turned by 180°.

    Parameters
    ----------
    study : study with the option, a counterweight or a combination that joins some
    option : name of the option
    figure : `force_n` or `moment_nm` of the moving parts, `foot_force_n` of all feet, or
        `pressure_pa` at all microphones
    speeds : `worst` makes the largest sum of squares of a speed least, `all` the sum over speeds
    holes : number of evenly spaced bolt holes, the first at the angle of the option, and the
        masses in kg that fit there, by name of each counterweight; any mass and angle without it
    radiation : function that gives the transfer vectors

    Raises
    ------
    ParameterError
        The option has no counterweight, or holes or figure are unknown.

    Examples
    --------
    >>> weight = {"kind": "counterweight", "mass_g": 10.0, "radius_mm": 20.0, "angle_deg": 0.0}
    >>> study = va.load_study("pipelines/copeland_thesis.toml").replace({
    ...     "options.upper": {**weight, "height_mm": 60.0},
    ...     "options.lower": {**weight, "height_mm": -60.0},
    ...     "options.upper + lower": {},
    ... })
    >>> frequency = np.arange(25.0, 2501.0, 25.0)
    >>> vectors = 1e-4j * frequency * np.ones((len(study.receivers), 6, 1))  # made up
    >>> best = va.balance(study, "upper + lower", radiation=va.given_radiation(vectors, frequency))
    >>> bool(np.all(best.after < best.before))
    True
    """
    weights = counterweights_of(study, option)
    if figure not in BALANCED:
        raise ParameterError(f"figure = {figure}: unknown; allowed {', '.join(BALANCED)}")
    response, influence = influence_of_weights(
        study, option, weights, (figure,), SoundPaths(radiation)
    )
    rows = response, influence
    if speeds == "all":
        rows = response.reshape(1, -1), influence.reshape(1, -1, len(weights))
    if holes is None:
        moment = (least_squares_moments if speeds == "all" else worst_speed_moments)(*rows)
    else:
        positions = [_positions(name, weight, holes) for name, weight in weights.items()]
        numbers = chosen_moments(*rows, positions)
        moment = np.array([some[item] for some, item in zip(positions, numbers, strict=True)])
    before, after = (
        np.sqrt(sums_of_squares(response, influence, item)) for item in (0.0 * moment, moment)
    )
    values: dict[str, float] = {}
    for (name, weight), item in zip(weights.items(), moment.tolist(), strict=True):
        values[f"options.{name}.mass_kg"] = max(abs(item) / weight.radius_m, _LIGHTEST_KG)
        values[f"options.{name}.angle_deg"] = float(np.angle(item, deg=True))
    return Balanced(moment, values, before, after)


def counterweights_of(study: Study, option: str) -> dict[str, Counterweight]:
    """Find the counterweights of an option by name.

    Parameters
    ----------
    study : study with the option
    option : name of the option

    Raises
    ------
    ParameterError
        There is no such option, or it has no counterweight.
    """
    if option not in study.options:
        raise ParameterError(
            f"option = {option}: there is no such option; allowed {', '.join(study.options)}"
        )
    members = members_by_name(option, study.options[option])
    weights = {name: part for name, part in members.items() if isinstance(part, Counterweight)}
    if not weights:
        raise ParameterError(f"options.{option}: has no counterweight; join some to it")
    return weights


def _positions(
    name: str, weight: Counterweight, holes: Mapping[str, tuple[int, Sequence[float]]]
) -> ComplexArray:
    """Moments of a counterweight in its bolt holes, shape (position,), kg m."""
    count, masses_kg = holes.get(name, (0, ()))
    if count < 1 or not masses_kg or min(masses_kg) <= 0.0:
        raise ParameterError(f"holes.{name}: give at least one hole and masses above 0 kg")
    angle = weight.angle_rad + 2.0 * pi * np.arange(count) / count
    return np.asarray(
        np.outer(masses_kg, weight.radius_m * np.exp(1j * angle)).ravel(), dtype=complex
    )


def influence_of_weights(
    study: Study,
    option: str,
    weights: Mapping[str, Counterweight],
    figures: Sequence[str],
    paths: SoundPaths,
) -> tuple[ComplexArray, ComplexArray]:
    """Return the response without the counterweights, and per moment; see `sums_of_squares`.

    Parameters
    ----------
    study : study with the option
    option : name of the option
    weights : its counterweights by name
    figures : some of `BALANCED`, or `MOTION`; their rows one after another
    paths : paths to the microphones
    """
    as_given = _response(study, option, {}, figures, paths)
    parts = []
    for name, weight in weights.items():
        turned = weight.model_copy(update={"angle_rad": weight.angle_rad + pi})
        parts.append(0.5 * (as_given - _response(study, option, {name: turned}, figures, paths)))
    moments = [w.mass_kg * w.radius_m * np.exp(1j * w.angle_rad) for w in weights.values()]
    part = np.stack(parts, axis=-1)
    return as_given - part.sum(axis=-1), np.asarray(part / np.array(moments))


def _response(
    study: Study,
    option: str,
    changed: Mapping[str, Option],
    figures: Sequence[str],
    paths: SoundPaths,
) -> ComplexArray:
    """Response with some counterweights changed, shape (speed, row)."""
    joined = study.options[option]
    other = changed.get(option, joined)
    if isinstance(joined, Combination):
        other = joined.rejoined(members_by_name(option, joined) | dict(changed))
    options = {REFERENCE_OPTION: study.options[REFERENCE_OPTION], option: other}
    with_changed = study.model_copy(update={"options": options})
    made = probe(with_changed, option)
    machine = machine_of_design(with_changed, option, None, with_bodies=True)
    responses = [_NO_SOUND] * len(made.layout)
    if "pressure_pa" in figures:
        responses = list(paths(with_changed).path(machine).responses(made.layout))
    lines = lines_of(study.operation.speed_rpm, made.layout, responses)
    return np.concatenate([_at_shaft_frequency(made, lines, each) for each in figures], axis=1)


def _at_shaft_frequency(made: Probe, lines: Sequence[Lines], figure: str) -> ComplexArray:
    """Complex peaks of a figure at 1x, shape (speed, row)."""
    body = {name: np.asarray(array)[None] for name, array in made.body.items()}
    rows = []
    for of_speed, part in zip(lines, made.by_speed, strict=True):
        arrays = {name: np.asarray(array)[None] for name, array in part.items()}
        rows.append(_row(figure, of_speed, arrays, body))
    return np.array(rows)


def _row(figure: str, lines: Lines, arrays: Arrays, body: Arrays) -> ComplexArray:
    """Complex peaks of a figure at 1x of one speed, shape (row,)."""
    line = lines.row(1)
    if figure == "pressure_pa":
        few = {name: arrays[name][:, line] for name in SOUND if name in arrays}
        pressure = pressure_by_source(lines.select(line), few, body)[0].sum(axis=0).ravel()
        return np.asarray(pressure / np.sqrt(2.0 * pressure.size))
    wrench = arrays["wrench"][:, line[0]]
    if figure == MOTION:
        more = arrays["added"][:, line] if "added" in arrays else None
        motion = displacement(body, more, wrench[:, None], lines.frequency_hz[line])
        return np.asarray(motion[0, 0, :6])
    if figure == "foot_force_n":
        added = {name: arrays[name] for name in ADDED if name in arrays}
        return foot_forces(body, added, wrench, lines.frequency_hz, line).ravel()
    on_mechanism: ComplexArray = wrench.reshape(-1, 6).sum(axis=0)
    return on_mechanism[:3] if figure == "force_n" else on_mechanism[3:]
