"""Samples of a study's ranges, weighted by the published level and by measurements."""

from collections.abc import Callable
from itertools import chain as joined

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.progress import Progress
from ..levels.published import published_of
from ..study.draws import batches_of_draws
from ..study.sampling import Draw
from ..study.study import Study
from .bank import Bank, bank_of
from .hammer_test import HammerTest
from .share_variables import level_shares


def posterior(
    study: Study,
    over_evidence: Callable[[list[Draw], int, int], Array],
    deviation_db: float,
    test: HammerTest | None,
    progress: Progress,
) -> tuple[Bank, xr.Dataset]:
    """Weigh as many samples as a study wants to be effective.

    Parameters
    ----------
    study : with its ranges and published level
    over_evidence : see `bank_of`
    deviation_db : standard deviation of the levels that weigh
    test : of the shell, where there is one; samples that do not agree with it do not go on
    progress : called with the number of samples that were held against the test

    Returns
    -------
    weighted samples, and their variables with the shares of the values in the level
    """
    published, wanted = published_of(study), study.uncertainty.random_samples
    batches, likelihood, prior_db = batches_of_draws(study), None, np.zeros(0)
    if test is not None:
        first = next(batches)
        prior_db = np.atleast_2d(over_evidence(first, 0, 2 * len(first)))[0]
        batches = test.agreeing(joined([first], batches), wanted, progress)
        likelihood = test.likelihood
    ensemble = bank_of(batches, over_evidence, deviation_db, published.priors, wanted, likelihood)
    results, weight = ensemble.labelled(study.ranges, published.level_dba), None
    if test is not None:
        count = len(ensemble.draws)
        results = results.merge(test.labelled(prior_db + published.level_dba, count))
        weight = test.likelihood(0, count)
    return ensemble, results.merge(level_shares(study.ranges, ensemble, weight))
