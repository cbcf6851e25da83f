"""What samples will cost: a few are timed at the first speed."""

import time
from collections.abc import Sequence
from math import ceil
from typing import Final

from ..levels.agreement import agreement, effective_draws
from ..levels.axes import LevelAxes
from ..levels.published import published_of
from ..levels.remainder import over_published
from ..radiation.cost import Cost
from ..study.draws import batches_of_draws
from ..study.study import Study
from ..uncertainty.bank import MOST_DRAWS, MOST_ROUNDS
from .chain import Chain
from .levels import NominalSound
from .radiation import Radiated
from .sampled import SampledSound, sounds_of

_SAMPLES: Final = 12
"""That are computed at the point of the published level."""
_SAMPLES_OF_ALL: Final = 2
_LEAST_BATCHES: Final = 2
_MOST_BATCHES: Final = 10
"""Of as many samples as shall be effective, with the studies of the package."""


def cost_of_ensemble(chain: Chain, study: Study) -> Cost:
    """Estimate the cost of the samples at the published level.

    Parameters
    ----------
    chain : at the receivers and cases that weigh the samples
    study : with all speeds
    """
    samples = next(batches_of_draws(study))[:_SAMPLES]
    start = time.process_time()
    sampled = sounds_of(chain, samples, _nothing)
    one_s = (time.process_time() - start) / len(samples)
    known = chain[Radiated].was_cached
    low, high = _expected(study, chain[NominalSound].axes, sampled, known)
    how = f"{one_s:.2g} s for one of {low} to {high} draws, {len(samples)} measured"
    return Cost("draws at the published level", low * one_s, high * one_s, how)


def cost_of_samples(chain: Chain, study: Study) -> Cost:
    """Estimate the cost of all cases of the samples that go on.

    Parameters
    ----------
    chain : at the first speed
    study : with all speeds
    """
    speeds, wanted = len(study.operation.speed_rpm), study.uncertainty.random_samples
    few = next(batches_of_draws(study))[:_SAMPLES_OF_ALL]
    start = time.process_time()
    sounds_of(chain, few, _nothing)
    all_s = speeds * (time.process_time() - start) / len(few)
    how = f"{all_s:.2g} s for one of up to {wanted} draws, {len(few)} measured at one speed"
    return Cost("draws of all cases", 0.3 * wanted * all_s, wanted * all_s, how)


def _expected(
    study: Study, axes: LevelAxes, sampled: Sequence[SampledSound], known: bool
) -> tuple[int, int]:
    """Number of samples until enough agree with the published level, at least and at most.

    With computed transfer vectors, by how well the first few agree: half as many to twice as many.
    """
    wanted = study.uncertainty.random_samples
    most = min(MOST_ROUNDS * wanted, MOST_DRAWS)
    if not known:
        return min(_LEAST_BATCHES * wanted, most), min(_MOST_BATCHES * wanted, most)
    published = published_of(study)
    level = over_published(study, axes, [of_sample.sound for of_sample in sampled])
    weight = agreement(level, published.deviation_db, published.priors[0])
    effective = effective_draws(weight)
    needed = len(sampled) / max(effective, 0.5)
    low, high = (wanted * ceil(factor * needed) for factor in (0.5, 2.0))
    return min(low, most), min(high, most)


def _nothing(_: int) -> None:
    """Report no advance."""
