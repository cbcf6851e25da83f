"""Forces, reported figures and tones of a sample, where they are not the nominal ones."""

from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.ellipse import semi_major_axis
from ..base.units import shaft_frequency_hz
from ..levels.axes import LevelAxes
from ..levels.baseline import baseline_orders, baseline_variables, points_of
from ..levels.sample_levels import Deviating, Levels, line_squares
from ..machine.cases import Cases
from ..machine.source import Case, CaseKey
from ..mechanics.loads import PortLoads, summed
from ..sound.tone_spectra import ToneSpectra, noise_square, tone_levels
from ..sources.labelled import figures_of
from ..study.study import Study
from ..transfer import on_mounts
from ..transfer.foot_figures import with_foot_figures


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


AMPLITUDES: Final = ("force_amplitude", "moment_amplitude", "foot_force_amplitude")
FIGURES: Final = "reported_figure"
_LARGEST: Final = "largest_foot_force"

Forces = dict[CaseKey, dict[str, Array]]
"""Values by variable of cases that do not have the nominal ones."""


def amplitudes(case: Case, wrenches: Mapping[str, PortLoads]) -> dict[str, Array]:
    """Compute force N and moment N m on the housing and force N into each foot by order, peak.

    Parameters
    ----------
    case : machine and speed
    wrenches : lines of the wrenches over crank angle by source

    Returns
    -------
    shapes (order,), (order,) and (foot, order)
    """
    phasor = summed(wrenches.values())[case.machine.mechanism_port]
    frequency = shaft_frequency_hz(case.speed_rpm) * np.arange(phasor.shape[1], dtype=np.float64)
    foot_force = on_mounts(case.machine).response(phasor.T, frequency).foot_force
    of_feet = semi_major_axis(foot_force, -1).T
    return dict(
        zip(AMPLITUDES, (semi_major_axis(phasor[:3], 0), semi_major_axis(phasor[3:], 0), of_feet),
            strict=True)
    )  # fmt: skip


def sampled_forces(study: Study, nominal: Cases, sampled: Cases, results: xr.Dataset) -> Forces:
    """Compute the forces of the cases that move otherwise than nominally, and figures of all.

    Parameters
    ----------
    study : its options
    nominal, sampled : cases with the same keys
    results : names of the figures
    """
    names = results[FIGURES]["figure"].values.tolist()
    forces: Forces = {}
    cases = {key: case for key, case in sampled.cases.items() if key[1] in study.options}
    for key, case in cases.items():
        loads = with_foot_figures(case.machine, sampled.loads[key])
        of_case = figures_of(study, key, case, loads)
        forces[key] = {FIGURES: np.array([of_case.get(name, np.nan) for name in names])}
        if sampled.wrenches[key] is not nominal.wrenches[key]:
            forces[key] |= amplitudes(case, sampled.wrenches[key])
    return forces


def force_variables(sampled: Forces, results: xr.Dataset) -> dict[str, Array]:
    """Return forces and figures of a sample by variable, shape (speed, option, ...).

    Parameters
    ----------
    sampled : result of `sampled_forces`
    results : nominal values, which cases without own ones have
    """
    values = {name: _of_sample(name, sampled, results) for name in (*AMPLITUDES, FIGURES)}
    return values | {_LARGEST: values[AMPLITUDES[-1]].max(axis=2)}


def _of_sample(name: str, sampled: Forces, results: xr.Dataset) -> Array:
    array = results[name].transpose("speed", "option", ...).values.copy()
    speeds, options = results["speed"].values.tolist(), results["option"].values.tolist()
    for s, speed in enumerate(speeds):
        for o, option in enumerate(options):
            values = sampled.get((speed, option), {}).get(name)
            if values is not None:
                array[s, o, ..., : values.shape[-1]] = values
    return np.asarray(array)
