"""A study's chain, open to samples of one's own: no weights, all cases."""

from dataclasses import dataclass, replace

from vibroacoustics.levels.axes import LevelAxes
from vibroacoustics.levels.nominal import NominalSound
from vibroacoustics.levels.remainder import over_published
from vibroacoustics.machine.cases import Cases
from vibroacoustics.stages.chain import Chain
from vibroacoustics.stages.forces import with_published
from vibroacoustics.stages.radiation import transfer_vectors
from vibroacoustics.stages.sampled import sounds_of
from vibroacoustics.stages.stage import advanced, applying
from vibroacoustics.study.samples import batches_of_samples
from vibroacoustics.transfer.contributions import Transmission


@dataclass(frozen=True)
class SampledChain:
    """What a run has computed before it samples: the chain with its nominal sound."""

    chain: Chain

    @classmethod
    def of(cls, study, radiation=None):
        """The chain of a study with its samples still to come."""
        chain = Chain(study, radiation or transfer_vectors)
        stages = [stage.name for stage in applying(study)]
        for stage in applying(study)[: stages.index("levels") + 1]:
            chain = advanced(chain, stage)
        nominal = chain[NominalSound]
        row = nominal.axes.receivers.index(study.catalogue_receiver)
        axes = replace(nominal.axes, receivers=[study.catalogue_receiver])
        heard = chain.having(chain[Transmission].to([row]), replace(nominal, axes=axes))
        return cls(with_published(heard))

    @property
    def study(self):
        """Whose ranges are sampled."""
        return self.chain.study

    @property
    def axes(self) -> LevelAxes:
        """Axes of the levels."""
        return self.chain[NominalSound].axes

    def hypercube(self, count, seed=6):
        """As many samples of all ranges, less those that contradict themselves."""
        update = {"random_samples": count, "seed": seed}
        settings = self.study.uncertainty.model_copy(update=update)
        return next(batches_of_samples(self.study.model_copy(update={"uncertainty": settings})))

    def modelled_db(self, samples):
        """What is modelled over the published level at its point, shape (sample,)."""
        key = self.study.catalogue_case
        sounds = self._sounds(samples, [key])
        return over_published(self.study, self.axes, sounds)

    def sounds(self, samples):
        """Sound of every case at the published level's receiver, by sample."""
        return self._sounds(samples, list(self.chain[Cases].cases))

    def _sounds(self, samples, keys):
        of, nominal = self.chain[Cases], self.chain[NominalSound]
        chain = self.chain.having(
            replace(of, cases={key: of.cases[key] for key in keys}),
            replace(nominal, sound={key: nominal.sound[key] for key in keys}),
        )
        return sounds_of(chain, samples, lambda number: None)


def of_few_ranges(study, names):
    """The study with the ranges of these values only."""
    ranges = tuple(limits for limits in study.ranges if limits.name in names)
    assert len(ranges) == len(names)
    return study.model_copy(update={"ranges": ranges})
