"""A study's chain, open to draws of one's own: no weights, all cases."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

from vibroacoustics import pipeline
from vibroacoustics.levels.axes import LevelAxes
from vibroacoustics.levels.remainder import over_published, remaining_by_draw
from vibroacoustics.pipeline import sound
from vibroacoustics.study.draws import batches_of_draws
from vibroacoustics.study.study import Study


class _ReachedError(Exception):
    """The chain has come to its draws."""


@dataclass(frozen=True)
class DrawnChain:
    """What a run has computed before it draws.

    Attributes
    ----------
    study : whose ranges are drawn
    transmission, cases, given : as of `sound_of_draws`
    axes : of the levels
    """

    study: Study
    transmission: object
    axes: LevelAxes
    cases: dict
    given: dict

    @classmethod
    def of(cls, study, radiation=None):
        """The chain of a study with its draws still to come."""
        reached = []

        def stop(*arguments):
            transmission, axes, _, cases, given, *_ = arguments
            reached.extend([transmission, axes, cases, given])
            raise _ReachedError

        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(sound, "_bank", stop)
            with pytest.raises(_ReachedError):
                pipeline.run(study, **({} if radiation is None else {"radiation": radiation}))
        return cls(study, *reached)

    def hypercube(self, count):
        """As many draws of all ranges, less those that contradict themselves."""
        settings = self.study.uncertainty.model_copy(update={"random_samples": count})
        return next(batches_of_draws(self.study.model_copy(update={"uncertainty": settings})))

    def modelled_db(self, draws):
        """What is modelled over the published level at its point, shape (draw,)."""
        key = self.study.catalogue_case
        sounds = self._sounds(draws, [key])
        return over_published(self.study, self.axes, sounds)

    def mean_squares(self, draws):
        """Modelled mean squares and the remainder's factors, each (draw, speed, option)."""
        sounds = self._sounds(draws, list(self.cases))
        receiver = list(self.axes.receivers).index(self.study.catalogue_receiver)
        part = [self.axes.gathered(one, "part")[:, :, 0].sum(axis=2) for one in sounds]
        one = np.ones(len(draws))
        factor = remaining_by_draw(self.study, self.axes, sounds, draws, one)[..., 0]
        return np.array(part)[..., receiver], factor

    def _sounds(self, draws, keys):
        cases, given = ({key: of[key] for key in keys} for of in (self.cases, self.given))
        transmission = replace(self.transmission, study=self.study)
        drawn = sound.sound_of_draws(
            transmission, self.axes, cases, given, draws, lambda number: None
        )
        return [one.sound for one in drawn]


def of_few_ranges(study, names):
    """The study with the ranges of these values only."""
    ranges = tuple(limits for limits in study.ranges if limits.name in names)
    assert len(ranges) == len(names)
    return study.model_copy(update={"ranges": ranges})
