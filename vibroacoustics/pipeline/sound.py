"""Sound of all sources at the receivers, as given and with every draw."""

from collections.abc import Mapping
from dataclasses import replace

import xarray as xr

from ..base.progress import Progress, no_progress
from ..base.vocabulary import REFERENCE_OPTION
from ..levels.axes import LevelAxes
from ..levels.by_source import SourceSound, sound_by_source
from ..levels.labelled import draw_variables, level_variables
from ..levels.lines import line_pressure
from ..levels.remainder import (
    remainder,
    remainder_by_draw,
    remaining,
    remaining_by_draw,
)
from ..machine.source import Case, CaseKey
from ..radiation.pressure import pressure_per_shell_velocity, wrench_pressure
from ..radiation.transfer_vectors import pressure_per_velocity
from ..sources.cases import sources_of
from ..study.draws import draws_of
from ..study.sampling import Draw
from ..study.selection import at_speeds
from ..study.study import Study
from ..transfer.path import ShellPath
from ..transfer.received import BySource, Transmission, by_case_and_source
from ..transfer.study_path import projection_errors
from ..uncertainty.drawn import drawn_cases
from ..uncertainty.draws import drawn_values, errors_of_projection, of_every_draw
from .motion import Motion, motion_of

Sound = dict[CaseKey, SourceSound]


def levels_of(
    study: Study, motion: Motion, shell: ShellPath | None, progress: Progress
) -> xr.Dataset:
    """Levels of all sources with the values as given and with every draw.

    Parameters
    ----------
    study : speeds, options, published level, uncertainty
    motion : its results hold the transfer vectors
    shell : its elastic modes; none where no source drives it
    progress : called with the advance

    Raises
    ------
    ParameterError, SolverError
        The model is louder than the published level, as given or in nearly every draw.
    """
    catalogue = _at_catalogue_speed(study, motion)
    transmission = _transmission(study, motion, catalogue, shell)
    cases = {**catalogue.cases, **motion.cases}
    loads = {**catalogue.loads, **motion.loads}
    axes = LevelAxes.of(study, list(sources_of(study)), motion.results)
    received = transmission.received(cases, loads)
    sound = {key: sound_by_source(one, axes.bands) for key, one in received.items()}
    draws = draws_of(study).draws
    rest = remainder(study, axes, sound, bool(draws))
    left = remaining(study, axes, sound, study.machine, rest)
    lines = line_pressure(axes, received)
    frequency = motion.results["order_frequency"]
    levels = level_variables(axes, sound, lines["pressure_line"], frequency, left, rest)
    levels = levels.merge(lines)
    if not draws:
        return levels
    sounds = sound_of_draws(transmission, axes, cases, sound, draws, progress)
    rests = remainder_by_draw(study, axes, sounds)
    lefts = remaining_by_draw(study, axes, sounds, draws, rests)
    levels = levels.merge(draw_variables(axes, sounds, lefts, rests))
    levels = levels.merge(drawn_values(study.ranges, draws))
    errors = {} if shell is None else projection_errors(study, shell)
    return levels.merge(errors_of_projection(study.ranges, errors))


def sound_of_draws(
    transmission: Transmission,
    axes: LevelAxes,
    cases: Mapping[CaseKey, Case],
    given: Sound,
    draws: list[Draw],
    progress: Progress,
) -> list[Sound]:
    """Mean squares by source of every case, for every draw."""
    study = transmission.study

    def sound_of(draw: Draw) -> Sound:
        drawn = drawn_cases(cases, study, draw, transmission.rigid)
        pressure = {**transmission.wrench_pressure, **drawn.wrench_pressure}
        received = replace(transmission, wrench_pressure=pressure).received(
            drawn.cases, drawn.loads
        )
        return {key: sound_by_source(one, axes.bands) for key, one in received.items()}

    unknown = {key: one.unknown for key, one in given.items()}
    return of_every_draw(draws, sound_of, unknown, progress)


def _at_catalogue_speed(study: Study, motion: Motion) -> Motion:
    """The case of the published level, without a balancer, where it is none of the study's."""
    key = study.catalogue_case
    if key in motion.cases:
        return replace(motion, cases={}, loads={})
    machine = study.catalogue_machine or study.machine
    there = study.model_copy(update={"machine": machine})
    reference = {REFERENCE_OPTION: study.options[REFERENCE_OPTION]}
    motion = motion_of(at_speeds(there, key[:1], reference), no_progress)
    (case,), (loads,) = motion.cases.values(), motion.loads.values()
    return replace(motion, cases={key: case}, loads={key: loads})


def _transmission(
    study: Study, motion: Motion, catalogue: Motion, shell: ShellPath | None
) -> Transmission:
    results, vectors = motion.results, motion.results["transfer_vector"]
    at_catalogue = catalogue.with_results(catalogue.results.assign(transfer_vector=vectors))
    return Transmission(
        study,
        pressure_per_velocity(vectors),
        None if shell is None else pressure_per_shell_velocity(results),
        shell,
        {**_at_its_case(_of_wrenches(at_catalogue), catalogue), **_of_wrenches(motion)},
    )


def _at_its_case(
    pressure: Mapping[CaseKey, BySource], catalogue: Motion
) -> dict[CaseKey, BySource]:
    """Pressure of the only case of the published level, by its key; as it is where it has none."""
    return dict(zip(catalogue.cases, pressure.values(), strict=True)) if catalogue.cases else {}


def _of_wrenches(motion: Motion) -> dict[CaseKey, BySource]:
    pressure = wrench_pressure(motion.results, "transfer_vector")
    return by_case_and_source(pressure, motion.source_of_wrench)
