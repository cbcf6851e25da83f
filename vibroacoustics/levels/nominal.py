"""Sound and levels of a study with the nominal values."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.vocabulary import REFERENCE_OPTION
from ..machine.source import CaseKey
from ..mechanics.received_sound import ReceivedSound
from ..study.study import Study
from .axes import LevelAxes
from .baseline import baseline_variables, over_baseline, points_of, with_baseline
from .by_source import Measured, SourceSound, sound_by_source
from .changes import change_variables
from .labelled import level_variables
from .lines import line_pressure, noise_levels
from .measured_points import BASELINE_BANDS, MeasuredPoint, PointKey, evidence
from .remainder import in_spectrum, remaining, unmodelled_square
from .spectrum_data import spectrum_data

Sound = dict[CaseKey, SourceSound]


@dataclass(frozen=True)
class NominalSound:
    """Sound by source with the nominal values.

    Attributes
    ----------
    study : with its options and published level
    axes : axes of the levels
    points : points of a measured baseline
    sound : mean squares by source of every case, that of the published level among them
    """

    study: Study
    axes: LevelAxes
    points: Mapping[PointKey, MeasuredPoint]
    sound: Sound

    @classmethod
    def of(
        cls, study: Study, axes: LevelAxes, received: Mapping[CaseKey, ReceivedSound]
    ) -> "NominalSound":
        """Compute mean squares by source from the sound of every case at the receivers."""
        sound = by_source(study, axes, received)
        return cls(study, axes, points_of(study, axes), sound)

    def weighing(self) -> "NominalSound":
        """Return the receivers and cases alone whose levels weigh samples."""
        measured, spectrum = evidence(self.points), spectrum_data(self.study)
        names = [self.study.catalogue_receiver, *(name for name, _ in measured)]
        keys = [self.study.catalogue_case, *((speed, REFERENCE_OPTION) for _, speed in measured)]
        if spectrum is not None:
            names, keys = [*names, spectrum.receiver], [*keys, spectrum.case]
        axes = replace(self.axes, receivers=list(dict.fromkeys(names)))
        return replace(self, axes=axes, sound={key: self.sound[key] for key in keys})

    def relative_to_measured(self, sound: Sound) -> Array:
        """Compute levels of a sample relative to those measured that weigh, dB, shape (point,)."""
        keys = evidence(self.points)
        return np.array([over_baseline(self.axes, self.points, sound, key) for key in keys])

    def levels(
        self, received: Mapping[CaseKey, ReceivedSound], order_frequency: xr.DataArray
    ) -> xr.Dataset:
        """Compute levels of lines, noise, sources and totals, with the unmodelled noise.

        Parameters
        ----------
        received : sound of every case at the receivers
        order_frequency : (speed, order), Hz
        """
        study, axes, points, sound = self.study, self.axes, self.points, self.sound
        replaced = any(receiver == study.catalogue_receiver for receiver, _ in points)
        unmodelled = unmodelled_square(study, axes, sound, replaced or bool(study.ranges))
        noise_pa2 = in_spectrum(study.machine, unmodelled)
        residual = remaining(study, axes, study.machine, noise_pa2)
        lines, noise = line_pressure(axes, received), noise_levels(axes, received, residual)
        residual = with_baseline(study, axes, points, sound, residual)
        measured = baseline_variables(study, axes, points, sound)
        levels = level_variables(
            axes, sound, lines["pressure_line"], order_frequency, residual, unmodelled, measured
        )
        return levels.merge(lines).merge(measured).merge(noise)

    def changes(self, levels: xr.Dataset, forces: xr.Dataset) -> xr.Dataset:
        """Label the changes of forces at 1x, and which quantities change by what could be measured.

        Parameters
        ----------
        levels : result of `levels`
        forces : amplitudes by order, with the frequencies of the orders
        """
        return change_variables(self.study.scoring.measurable, levels, forces)


def by_source(study: Study, axes: LevelAxes, received: Mapping[CaseKey, ReceivedSound]) -> Sound:
    """Compute mean squares by source of every case; with a baseline its orders too."""
    measured = None if study.baseline is None else Measured(BASELINE_BANDS, axes.measured_orders)
    return {
        key: sound_by_source(of_case, axes.bands, measured) for key, of_case in received.items()
    }
