"""Samples of the ranges, weighted by the published level or a measured baseline."""

from dataclasses import replace
from itertools import chain as joined
from typing import Final

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.registry import register
from ..base.vocabulary import REFERENCE_OPTION
from ..levels.baseline import over_baseline
from ..levels.measured_points import evidence
from ..levels.published import published_of
from ..levels.remainder import over_published
from ..study.draws import batches_of_draws
from ..study.sampling import Draw
from ..study.study import Study
from ..transfer.path import ShellPath
from ..transfer.received import Transmission
from ..transfer.study_path import projection_errors
from ..uncertainty.bank import Bank, bank_of
from ..uncertainty.draws import errors_of_projection
from ..uncertainty.hammer_test import HammerTest
from ..uncertainty.share_variables import level_shares
from .chain import Cases, Chain
from .cost_of_samples import cost_of_ensemble
from .levels import NominalSound
from .paths import PublishedCases, with_published
from .sampled import sounds_of
from .stage import Given, Stage, Trial

_WEIGHTED: Final = "draws at the published level"


@register
class PosteriorEnsemble(Stage):
    """Samples of the ranges, weighted by the published level or a measured baseline."""

    name = "ensemble"
    reads = (Cases, PublishedCases, Transmission, NominalSound, ShellPath, HammerTest)
    gives = (
        Bank, "bank_level", "bank_value", "bank_weight", "level_share", "level_share_quality",
        "projection_error", "shell_likelihood", "shell_gain", "shell_frequency_ratio",
        "shell_loss_ratio", "shell_value", "shell_level_before", "shell_weight",
        "shell_peak_loss",
    )  # fmt: skip

    def applies(self, study: Study) -> bool:
        return bool(study.ranges)

    def run(self, chain: Chain) -> Given:
        study, shell = chain.study, chain.get(ShellPath)
        ensemble, of_shell = _weighted(chain)
        results = ensemble.labelled(study.ranges, published_of(study).level_dba).merge(of_shell)
        weight = of_shell["shell_weight"].values if "shell_weight" in of_shell else None
        results = results.merge(level_shares(study.ranges, ensemble, weight))
        errors = {} if shell is None else projection_errors(study, shell, chain.progress)
        return Given(results.merge(errors_of_projection(study.ranges, errors)), (ensemble,))

    def tried(self, chain: Chain, study: Study) -> Trial:
        return Trial(chain, (cost_of_ensemble(_at_points(chain), study),))


def _weighted(chain: Chain) -> tuple[Bank, xr.Dataset]:
    """Weighted samples, and how a hammer test weighs them."""
    study, nominal, test = chain.study, chain[NominalSound], chain.get(HammerTest)
    measured, wanted = evidence(nominal.points), study.uncertainty.random_samples
    at_points = _at_points(chain)
    axes = at_points[NominalSound].axes

    def modelled_db(batch: list[Draw], before: int, expected: int) -> Array:
        def done(number: int) -> None:
            chain.progress(_WEIGHTED, before + number, expected)

        sounds = [sampled.sound for sampled in sounds_of(at_points, batch, done)]
        over = [
            [over_baseline(axes, nominal.points, sound, key) for sound in sounds]
            for key in measured
        ]
        return np.array([over_published(study, axes, sounds), *over])

    published = published_of(study)
    deviation_db = published.deviation_db
    if measured and study.measured is not None and study.measured.baseline is not None:
        deviation_db = study.measured.baseline.tolerance_db
    batches, likelihood = batches_of_draws(study), None
    if test is not None:
        first = next(batches)
        prior_db = np.atleast_2d(modelled_db(first, 0, 2 * len(first)))[0]
        batches = test.agreeing(joined([first], batches), wanted, chain.progress)
        likelihood = test.likelihood
    ensemble = bank_of(batches, modelled_db, deviation_db, published.priors, wanted, likelihood)
    chain.progress(_WEIGHTED, len(ensemble.draws), len(ensemble.draws))
    if test is None:
        return ensemble, xr.Dataset()
    return ensemble, test.labelled(prior_db + published.level_dba, len(ensemble.draws))


def _at_points(chain: Chain) -> Chain:
    """The chain at the receivers and cases alone that weigh the samples."""
    study, nominal = chain.study, chain[NominalSound]
    measured = evidence(nominal.points)
    names = list(dict.fromkeys([study.catalogue_receiver, *(name for name, _ in measured)]))
    keys = [study.catalogue_case, *((speed, REFERENCE_OPTION) for _, speed in measured)]
    cases = with_published(chain)[Cases]
    return chain.having(
        replace(cases, cases={key: cases.cases[key] for key in keys}),
        chain[Transmission].to([nominal.axes.receivers.index(name) for name in names]),
        replace(
            nominal,
            axes=replace(nominal.axes, receivers=names),
            sound={key: nominal.sound[key] for key in keys},
        ),
    )
