"""Sound of all sources at the receivers, as given and with every draw."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from itertools import chain
from typing import Final, NamedTuple

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.progress import Progress, no_progress
from ..base.vocabulary import REFERENCE_OPTION
from ..levels.axes import LevelAxes
from ..levels.baseline import baseline_variables, over_baseline, points_of, with_baseline
from ..levels.by_source import Measured, SourceSound, sound_by_source
from ..levels.continuous import noise_levels
from ..levels.labelled import draw_variables, level_variables
from ..levels.lines import line_pressure
from ..levels.measured_points import BASELINE_BANDS, MeasuredPoint, PointKey, evidence
from ..levels.published import published_of
from ..levels.remainder import (
    over_published,
    remainder,
    remainder_by_draw,
    remaining,
    remaining_by_draw,
)
from ..machine.source import Case, CaseKey
from ..mechanics.received_sound import ReceivedSound
from ..radiation.pressure import pressure_per_shell_velocity
from ..radiation.transfer_vectors import pressure_per_velocity
from ..sources.cases import sources_of
from ..study.draws import batches_of_draws
from ..study.sampling import Draw
from ..study.selection import at_speeds
from ..study.study import Study
from ..transfer.force_sound import ForceSound
from ..transfer.observers import Observers
from ..transfer.path import ShellPath
from ..transfer.received import Transmission
from ..transfer.study_path import projection_errors
from ..uncertainty.bank import Bank, bank_of
from ..uncertainty.drawn import drawn_cases
from ..uncertainty.draws import drawn_values, errors_of_projection, of_every_draw
from ..uncertainty.first_order import first_order_by_draw, unknown_first_order
from ..uncertainty.share_variables import change_shares, level_shares
from .calibration import ShellTest
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
    study: Study,
    motion: Motion,
    shell: ShellPath | None,
    progress: Progress,
    test: ShellTest | None = None,
    by_force: ForceSound | None = None,
) -> xr.Dataset:
    """Levels of all sources with the values as given and with every draw.

    Parameters
    ----------
    study : speeds, options, published level, uncertainty
    motion : its results hold the transfer vectors
    shell : its elastic modes; none where no source drives it
    progress : called with the advance
    test : of the shell with a hammer, which weighs the draws
    by_force : measured pressure per force, in place of the transfer vectors

    Raises
    ------
    ParameterError
        The model as given is louder than the published level, and nothing is drawn.
    """
    catalogue = at_catalogue_speed(study, motion)
    transmission = transmission_of(study, motion, catalogue, shell, by_force)
    cases = {**catalogue.cases, **motion.cases}
    loads = {**catalogue.loads, **motion.loads}
    axes = LevelAxes.of(study, list(sources_of(study)), motion.results)
    received = transmission.received(cases, loads)
    points = points_of(study, axes)
    sound = _by_source(study, axes, received)
    replaced = any(receiver == study.catalogue_receiver for receiver, _ in points)
    rest = remainder(study, axes, sound, replaced or bool(study.ranges))
    left = remaining(study, axes, sound, study.machine, rest)
    noise = noise_levels(axes, received, left)
    left = with_baseline(study, axes, points, sound, left)
    lines = line_pressure(axes, received)
    frequency = motion.results["order_frequency"]
    measured = baseline_variables(study, axes, points, sound)
    levels = level_variables(axes, sound, lines["pressure_line"], frequency, left, rest, measured)
    levels = levels.merge(lines).merge(measured).merge(noise)
    levels = levels.merge(contributions_of(transmission, motion, axes, levels, progress))
    if not study.ranges:
        return levels
    bank, of_shell = _bank(transmission, axes, points, cases, sound, progress, test)
    levels = levels.merge(bank.labelled(study.ranges, published_of(study).level_dba))
    levels = levels.merge(of_shell)
    weight = of_shell["shell_weight"].values if "shell_weight" in of_shell else None
    levels = levels.merge(level_shares(study.ranges, bank, weight))
    errors = {} if shell is None else projection_errors(study, shell, progress)
    levels = levels.merge(errors_of_projection(study.ranges, errors))
    if not bank.suffices:
        return levels
    drawn = _of_draws(bank, transmission, axes, cases, sound, progress, motion)
    return levels.merge(drawn)


def _bank(
    transmission: Transmission,
    axes: LevelAxes,
    points: Mapping[PointKey, MeasuredPoint],
    cases: Mapping[CaseKey, Case],
    given: Sound,
    progress: Progress,
    test: ShellTest | None,
) -> tuple[Bank, xr.Dataset]:
    """Draws at the point of the published level, weighed by it or, in its stead, by a baseline.

    Also what a test of the shell tells of them.

    Parameters
    ----------
    transmission : to all receivers
    axes : of the levels
    points : of the baseline
    cases : with that of the published level
    given : their sound with the values as given
    progress : called with the advance
    test : of the shell
    """
    study, measured = transmission.study, evidence(points)
    wanted, name = study.uncertainty.random_samples, study.catalogue_receiver
    names = list(dict.fromkeys([name, *(receiver for receiver, _ in measured)]))
    transmission = transmission.to([axes.receivers.index(one) for one in names])
    axes = replace(axes, receivers=names)
    keys = [study.catalogue_case, *((speed, REFERENCE_OPTION) for _, speed in measured)]
    there, known = {key: cases[key] for key in keys}, {key: given[key] for key in keys}

    def modelled_db(batch: list[Draw], before: int, expected: int) -> Array:
        def done(number: int) -> None:
            progress(_WEIGHED, before + number, expected)

        drawn = sound_of_draws(transmission, axes, there, known, batch, done)
        sounds = [one.sound for one in drawn]
        over = [[over_baseline(axes, points, one, key) for one in sounds] for key in measured]
        return np.array([over_published(study, axes, sounds), *over])

    published = published_of(study)
    deviation_db = published.deviation_db
    if measured and study.measured is not None and study.measured.baseline is not None:
        deviation_db = study.measured.baseline.tolerance_db
    batches, besides = batches_of_draws(study), None
    if test is not None:
        first = next(batches)
        prior_db = np.atleast_2d(modelled_db(first, 0, 2 * len(first)))[0]
        batches = test.agreeing(chain([first], batches), wanted, progress)
        besides = test.likelihood
    bank = bank_of(batches, modelled_db, deviation_db, published.priors, wanted, besides)
    progress(_WEIGHED, len(bank.draws), len(bank.draws))
    if test is None:
        return bank, xr.Dataset()
    prior_dba = prior_db + published.level_dba
    return bank, test.labelled(prior_dba, len(bank.draws))


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
    levels = draw_variables(axes, sounds, lefts, rests, weight, bank.prior_names)
    moved = first_order_by_draw([one.first_order for one in drawn], motion.results)
    levels = levels.merge(moved)
    levels = levels.merge(drawn_values(study.ranges, draws))
    return levels.merge(change_shares(study, levels))


def _by_source(study: Study, axes: LevelAxes, received: Mapping[CaseKey, ReceivedSound]) -> Sound:
    """Mean squares by source of every case; with a baseline its orders too."""
    has_baseline = study.measured is not None and study.measured.baseline is not None
    measured = Measured(BASELINE_BANDS, axes.measured_orders) if has_baseline else None
    return {key: sound_by_source(one, axes.bands, measured) for key, one in received.items()}


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
        drawn = drawn_cases(cases, study, draw)
        wrenches = {**transmission.wrenches, **drawn.wrenches}
        received = replace(transmission, wrenches=wrenches).received(drawn.cases, drawn.loads)
        return DrawnSound(_by_source(study, axes, received), drawn.first_order)

    unknown = DrawnSound({key: given[key].unknown for key in cases}, unknown_first_order(cases))
    return of_every_draw(draws, sound_of, unknown, progress)


def at_catalogue_speed(study: Study, motion: Motion) -> Motion:
    """The case of the published level, without a balancer, where it is none of the study's."""
    key = study.catalogue_case
    if key in motion.cases:
        return replace(motion, cases={}, loads={})
    machine = study.catalogue_machine or study.machine
    there = study.model_copy(update={"machine": machine})
    reference = {REFERENCE_OPTION: study.options[REFERENCE_OPTION]}
    motion = motion_of(at_speeds(there, key[:1], reference), no_progress)
    (case,), (loads,) = motion.cases.values(), motion.loads.values()
    (wrenches,) = motion.wrenches.values()
    return replace(motion, cases={key: case}, loads={key: loads}, wrenches={key: wrenches})


def transmission_of(
    study: Study,
    motion: Motion,
    catalogue: Motion,
    shell: ShellPath | None,
    by_force: ForceSound | None = None,
) -> Transmission:
    """The way of the sound to the receivers, with that of the moving parts as given.

    Parameters
    ----------
    study : with all options
    motion : its results hold the transfer vectors
    catalogue : at the point of the published level
    shell : its elastic modes; none where no source drives it
    by_force : measured pressure per force, in place of the transfer vectors
    """
    wrenches = {**catalogue.wrenches, **motion.wrenches}
    if by_force is not None:
        return Transmission(study, Observers(by_force), None, wrenches)
    microphones = Observers(
        pressure_per_velocity(motion.results["transfer_vector"]),
        None if shell is None else pressure_per_shell_velocity(motion.results),
    )
    return Transmission(study, microphones, shell, wrenches)
