"""Third octaves of one sample with one discrepancy and one level of unmodelled noise."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ..base.arrays import Array
from ..levels.axes import LevelAxes
from ..levels.nominal import by_source
from ..levels.remainder import in_gain_bands, remaining
from ..machine.machine import Machine
from ..machine.source import CaseKey
from ..mechanics.received_sound import ReceivedSound
from ..study.study import Study
from .discrepancy import Discrepancy
from .evidence import Evidence
from .prior_ensemble import PriorEnsemble


@dataclass(frozen=True)
class SampleBands:
    """Converter of the sound of a machine into levels by third octave at one speed.

    Attributes
    ----------
    study : with this speed alone, and its options
    axes : axes of the levels
    discrepancy : the one of the sample
    unmodelled_pa2 : unmodelled noise where the level is published, A-weighted, shape (band,)
    """

    study: Study
    axes: LevelAxes
    discrepancy: Discrepancy
    unmodelled_pa2: Array

    @classmethod
    def of_pair(
        cls,
        evidence: Evidence,
        ensemble: PriorEnsemble,
        pair: tuple[int, int],
        study: Study,
        axes: LevelAxes,
    ) -> "SampleBands":
        """Return those of one pair of a discrepancy and an unmodelled level.

        Parameters
        ----------
        evidence : which gives the pairs of a sample
        ensemble : all samples
        pair : number of the sample in the ensemble, and of the pair
        study : with one speed
        axes : axes of the levels
        """
        number, row = pair
        batch = ensemble.batch
        machine = batch.machines[number]
        pairs = evidence.pairs_of(batch.sounds[number], machine, number)
        discrepancy = pairs.discrepancy.some(slice(row, row + 1))
        return cls(study, axes, discrepancy, evidence.unmodelled_pa2(pairs, machine)[row])

    def of(self, received: Mapping[CaseKey, ReceivedSound], machine: Machine) -> Array:
        """Compute A-weighted mean squares in `GAIN_BANDS`, (option, receiver, band), Pa².

        Parameters
        ----------
        received : sound of every case, without discrepancy
        machine : without an option
        """
        sound = by_source(self.study, self.axes, received)
        gains = self.discrepancy.gains(sound)
        (unmodelled,) = in_gain_bands(
            remaining(self.study, self.axes, machine, self.unmodelled_pa2)
        )
        modelled = [of_case.bands(gains[key][0]) for key, of_case in sound.items()]
        return np.asarray(np.array(modelled) + unmodelled)
