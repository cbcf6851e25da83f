"""Sound of all sources at the receivers, as given and with every draw."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Final, NamedTuple

import xarray as xr

from ..base.arrays import Array
from ..base.progress import Progress, no_progress
from ..base.vocabulary import REFERENCE_OPTION
from ..levels.agreement import priors_of
from ..levels.axes import LevelAxes
from ..levels.baseline import baseline_variables, with_baseline
from ..levels.by_source import SourceSound, sound_by_source
from ..levels.labelled import draw_variables, level_variables
from ..levels.lines import line_pressure
from ..levels.remainder import (
    over_published,
    remainder,
    remainder_by_draw,
    remaining,
    remaining_by_draw,
)
from ..machine.source import Case, CaseKey
from ..radiation.pressure import pressure_per_shell_velocity, wrench_pressure
from ..radiation.transfer_vectors import pressure_per_velocity
from ..sources.cases import sources_of
from ..study.draws import batches_of_draws
from ..study.sampling import Draw
from ..study.selection import at_speeds
from ..study.study import Study
from ..transfer.path import ShellPath
from ..transfer.received import BySource, Transmission, by_case_and_source
from ..transfer.study_path import projection_errors
from ..uncertainty.bank import Bank, bank_of
from ..uncertainty.drawn import drawn_cases
from ..uncertainty.draws import drawn_values, errors_of_projection, of_every_draw
from ..uncertainty.first_order import first_order_by_draw, unknown_first_order
from ..uncertainty.share_variables import change_shares, level_shares
from .contributions import contributions_of
from .motion import Motion, motion_of

Sound = dict[CaseKey, SourceSound]
_WEIGHED: Final = "draws at the published level"


class DrawnSound(NamedTuple):
    """What a draw makes.

    Attributes
    ----------
    sound : of every case
    first_order : forces at 1x of the cases that move otherwise than as given
    """

    sound: Sound
    first_order: Mapping[CaseKey, Array]


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
    ParameterError
        The model as given is louder than the published level, and nothing is drawn.
    """
    catalogue = _at_catalogue_speed(study, motion)
    transmission = _transmission(study, motion, catalogue, shell)
    cases = {**catalogue.cases, **motion.cases}
    loads = {**catalogue.loads, **motion.loads}
    axes = LevelAxes.of(study, list(sources_of(study)), motion.results)
    received = transmission.received(cases, loads)
    sound = {key: sound_by_source(one, axes.bands) for key, one in received.items()}
    rest = remainder(study, axes, sound, bool(study.ranges))
    left = remaining(study, axes, sound, study.machine, rest)
    left = with_baseline(study, axes, sound, left)
    lines = line_pressure(axes, received)
    frequency = motion.results["order_frequency"]
    levels = level_variables(axes, sound, lines["pressure_line"], frequency, left, rest)
    levels = levels.merge(lines).merge(baseline_variables(study, axes, sound))
    levels = levels.merge(contributions_of(transmission, motion, axes, levels))
    if not study.ranges:
        return levels
    row, name = axes.receivers.index(study.catalogue_receiver), study.catalogue_receiver
    bank = _bank(transmission.to(row), replace(axes, receivers=[name]), cases, sound, progress)
    levels = levels.merge(bank.labelled(study.ranges, study.machine.overall_noise.level_dba))
    levels = levels.merge(level_shares(study.ranges, bank))
    errors = {} if shell is None else projection_errors(study, shell)
    levels = levels.merge(errors_of_projection(study.ranges, errors))
    if not bank.suffices:
        return levels
    drawn = _of_draws(bank, transmission, axes, cases, sound, progress, motion)
    return levels.merge(drawn)


def _bank(
    transmission: Transmission,
    axes: LevelAxes,
    cases: Mapping[CaseKey, Case],
    given: Sound,
    progress: Progress,
) -> Bank:
    """Draws at the point of the published level, weighed by it.

    Parameters
    ----------
    transmission : to the receiver of the published level alone
    axes : with this receiver
    cases : with that of the published level
    given : their sound with the values as given
    progress : called with the advance
    """
    study = transmission.study
    wanted, key = study.uncertainty.random_samples, study.catalogue_case
    there, known = {key: cases[key]}, {key: given[key]}

    def modelled_db(batch: list[Draw], before: int, expected: int) -> Array:
        def done(number: int) -> None:
            progress(_WEIGHED, before + number, expected)

        drawn = sound_of_draws(transmission, axes, there, known, batch, done)
        return over_published(study, axes, [one.sound for one in drawn])

    deviation_db = study.machine.overall_noise.deviation_db
    priors = priors_of(study.machine.remainder)
    bank = bank_of(batches_of_draws(study), modelled_db, deviation_db, priors, wanted)
    progress(_WEIGHED, len(bank.draws), len(bank.draws))
    return bank


def _of_draws(
    bank: Bank,
    transmission: Transmission,
    axes: LevelAxes,
    cases: Mapping[CaseKey, Case],
    given: Sound,
    progress: Progress,
    motion: Motion,
) -> xr.Dataset:
    """All cases with the draws that agree with the published level."""
    study = transmission.study
    index, weight = bank.chosen(study.uncertainty.seed)
    draws = [bank.draws[number] for number in index]

    def done(number: int) -> None:
        progress("sources", number, len(draws))

    drawn = sound_of_draws(transmission, axes, cases, given, draws, done)
    sounds = [one.sound for one in drawn]
    rests = remainder_by_draw(study, bank.modelled_db[index])
    lefts = remaining_by_draw(study, axes, sounds, draws, rests[0])
    levels = draw_variables(axes, sounds, lefts, rests, weight)
    moved = first_order_by_draw([one.first_order for one in drawn], motion.results)
    levels = levels.merge(moved)
    levels = levels.merge(drawn_values(study.ranges, draws))
    return levels.merge(change_shares(study, levels))


def sound_of_draws(
    transmission: Transmission,
    axes: LevelAxes,
    cases: Mapping[CaseKey, Case],
    given: Sound,
    draws: list[Draw],
    progress: Callable[[int], None],
) -> list[DrawnSound]:
    """Mean squares by source of every case, for every draw."""
    study = transmission.study

    def sound_of(draw: Draw) -> DrawnSound:
        drawn = drawn_cases(cases, study, draw, transmission.rigid)
        pressure = {**transmission.wrench_pressure, **drawn.wrench_pressure}
        received = replace(transmission, wrench_pressure=pressure).received(
            drawn.cases, drawn.loads
        )
        sound = {key: sound_by_source(one, axes.bands) for key, one in received.items()}
        return DrawnSound(sound, drawn.first_order)

    unknown = DrawnSound({key: given[key].unknown for key in cases}, unknown_first_order(cases))
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
