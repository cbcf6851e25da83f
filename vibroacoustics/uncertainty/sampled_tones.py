"""Tones of a sample, in its own noise."""

from collections.abc import Sequence

import numpy as np

from ..levels.axes import LevelAxes
from ..levels.baseline import baseline_orders, baseline_variables, points_of
from ..levels.sample_levels import Deviating, Levels, line_squares
from ..sound.tone_spectra import ToneSpectra, noise_square, tone_levels
from ..study.study import Study


def sampled_tones(
    study: Study, axes: LevelAxes, names: Sequence[str], sample: Deviating, levels: Levels
) -> Levels:
    """Judge the tones of a sample; with a baseline, in what was measured.

    Parameters
    ----------
    study : with its baseline
    axes : axes of the levels
    names : names of the lines
    sample : sound with its discrepancies
    levels : noise of the sources and unmodelled noise in third octaves
    """
    noise = noise_square(levels["noise_band_level"], levels["unmodelled_band_level"])
    spectra = ToneSpectra(*line_squares(axes, sample, names), noise)
    points = points_of(study, axes)
    if not points:
        return tone_levels(spectra)
    measured = [baseline_variables(study, axes, points, sound) for sound in sample.sounds]
    band_db = np.array([part["baseline_band_level"].values for part in measured])
    order_db = np.array([baseline_orders(study, axes, points, sound) for sound in sample.sounds])
    return tone_levels(spectra.with_measured(names, axes.measured_orders, order_db, band_db))
