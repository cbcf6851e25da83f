"""What levels will cost, as given and by draw: one speed and a few draws are timed."""

import time
from collections.abc import Sequence
from dataclasses import replace
from math import ceil
from typing import Final

from ..levels.agreement import agreement, effective_draws
from ..levels.axes import LevelAxes
from ..levels.by_source import sound_by_source
from ..levels.published import published_of
from ..levels.remainder import over_published
from ..radiation.cost import Cost, about
from ..sources.cases import sources_of
from ..study.draws import batches_of_draws
from ..study.study import Study
from ..transfer.path import ShellPath
from ..uncertainty.bank import MOST_DRAWS, MOST_ROUNDS
from .motion import Motion
from .sound import DrawnSound, Sound, at_catalogue_speed, sound_of_draws, transmission_of

_DRAWS: Final = 12
"""That are computed at the point of the published level."""
_DRAWS_OF_ALL: Final = 2
_LEAST_BATCHES: Final = 2
_MOST_BATCHES: Final = 10
"""Of as many draws as shall be effective, with the studies of the package."""


def levels_cost(
    study: Study, first: Study, motion: Motion, path: ShellPath | None, known: bool
) -> list[Cost]:
    """Cost of the levels.

    Parameters
    ----------
    study : with all speeds
    first : at its first speed
    motion : at the first speed; its results hold the transfer vectors
    path : the elastic shell; none where no source drives it
    known : whether the transfer vectors are the real ones
    """
    speeds, wanted = len(study.operation.speed_rpm), study.uncertainty.random_samples
    start = time.process_time()
    catalogue = at_catalogue_speed(first, motion)
    transmission = transmission_of(first, motion, catalogue, path)
    cases, loads = {**catalogue.cases, **motion.cases}, {**catalogue.loads, **motion.loads}
    axes = LevelAxes.of(first, list(sources_of(first)), motion.results)
    received = transmission.received(cases, loads)
    sound: Sound = {key: sound_by_source(one, axes.bands) for key, one in received.items()}
    seconds = speeds * (time.process_time() - start)
    as_given = about("levels", seconds, f"{speeds} speeds, one measured")
    if not study.ranges:
        return [as_given]
    draws = next(batches_of_draws(study))[:_DRAWS]
    row, key = axes.receivers.index(study.catalogue_receiver), study.catalogue_case
    there = replace(axes, receivers=[study.catalogue_receiver])
    start = time.process_time()
    drawn = sound_of_draws(
        transmission.to([row]), there, {key: cases[key]}, {key: sound[key]}, draws, _nothing
    )
    one_s = (time.process_time() - start) / len(draws)
    low, high = _draws_expected(study, there, drawn, known)
    how = f"{one_s:.2g} s for one of {low} to {high} draws, {len(draws)} measured"
    bank = Cost("draws at the published level", low * one_s, high * one_s, how)
    few = draws[:_DRAWS_OF_ALL]
    start = time.process_time()
    sound_of_draws(transmission, axes, cases, sound, few, _nothing)
    all_s = speeds * (time.process_time() - start) / len(few)
    how = f"{all_s:.2g} s for one of up to {wanted} draws, {len(few)} measured at one speed"
    return [as_given, bank, Cost("draws of all cases", 0.3 * wanted * all_s, wanted * all_s, how)]


def _draws_expected(
    study: Study, axes: LevelAxes, drawn: Sequence[DrawnSound], known: bool
) -> tuple[int, int]:
    """How many draws it takes until enough agree with the published level, at least and at most.

    With the real transfer vectors, by how well the first few agree: half as many to twice as many.
    """
    wanted = study.uncertainty.random_samples
    most = min(MOST_ROUNDS * wanted, MOST_DRAWS)
    if not known:
        return min(_LEAST_BATCHES * wanted, most), min(_MOST_BATCHES * wanted, most)
    published = published_of(study)
    level = over_published(study, axes, [one.sound for one in drawn])
    weight = agreement(level, published.deviation_db, published.priors[0])
    effective = effective_draws(weight)
    needed = len(drawn) / max(effective, 0.5)
    low, high = (wanted * ceil(factor * needed) for factor in (0.5, 2.0))
    return min(low, most), min(high, most)


def _nothing(_: int) -> None:
    """No advance is told."""
