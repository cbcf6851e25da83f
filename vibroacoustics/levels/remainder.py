"""What the sources leave unexplained of the machine's published level, by speed and option."""

from collections.abc import Mapping, Sequence

import numpy as np

from ..base.arrays import Array
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import mean_square_level, power_of_level
from ..base.errors import ParameterError
from ..machine.machine import Machine
from ..machine.source import CaseKey
from ..study.draws import with_draw
from ..study.sampling import Draw
from ..study.study import Study
from .agreement import remainder_level
from .axes import LevelAxes
from .baseline import points_of, with_baseline
from .by_source import SourceSound
from .insertion_loss import remaining_factor
from .measured_points import REMAINDER_BANDS
from .published import published_of
from .weighting import WEIGHTING


def remainder(
    study: Study, axes: LevelAxes, sound: Mapping[CaseKey, SourceSound], may_be_none: bool
) -> float:
    """Mean square that the model leaves of the published level at its microphone and speed, Pa².

    None without a published level.

    Parameters
    ----------
    study : with the published level
    axes : with its receiver
    sound : of the case without a balancer at its speed and operating point, and of other cases
    may_be_none : whether none is left where the model alone is louder, as in a draw

    Raises
    ------
    ParameterError
        The model alone is louder.
    """
    published = study.machine.overall_noise
    if published is None:
        return 0.0
    receiver = list(axes.receivers).index(study.catalogue_receiver)
    alone = sound[study.catalogue_case].total[0, receiver]
    rest = REFERENCE_PRESSURE_PA**2 * power_of_level(published.level_dba) - alone
    if rest <= 0.0 and not may_be_none:
        level = mean_square_level(alone, REFERENCE_PRESSURE_PA)
        raise ParameterError(
            f"machine: overall_noise.level_dba = {published.level_dba:g} dB(A): the model alone "
            f"gives {level:.1f} dB(A) at {study.catalogue_receiver}"
        )
    return float(max(rest, 0.0))


def remaining(
    study: Study,
    axes: LevelAxes,
    sound: Mapping[CaseKey, SourceSound],
    machine: Machine,
    rest: float,
) -> Array:
    """What there is of the remainder by third octave, A-weighted, (speed, option, band), Pa².

    The bands are `REMAINDER_BANDS`. It grows with speed, and an option takes its insertion loss off
    each band.

    Parameters
    ----------
    study : options, speed and receiver of the published level
    axes : speeds, bands and receivers
    sound : of the case of the published level, and of others
    machine : growth and spectrum of the remainder
    rest : the remainder at the published speed without an option, Pa²
    """
    if rest == 0.0:
        return np.zeros((len(axes.speeds), len(study.options), len(REMAINDER_BANDS)))
    receiver = list(axes.receivers).index(study.catalogue_receiver)
    middle_hz = np.array([band.middle_hz for band in REMAINDER_BANDS])
    modelled = _a_weighted_bands(sound[study.catalogue_case].band[:, receiver].sum(axis=0), axes)
    spectrum = spectrum_left(machine.remainder.spectrum(middle_hz), modelled, rest)
    published_rpm = study.catalogue_speed_rpm
    growth = machine.remainder.speed_factor(np.array(axes.speeds), published_rpm)
    factor = remaining_factor(study.options, middle_hz)
    return np.asarray(growth[:, None, None] * factor * spectrum)


def spectrum_left(expected: Array, modelled: Array, rest: float) -> Array:
    """Bands of the remainder: those of the machine as expected, less what is modelled in each.

    max(a e - m, 0) with the factor a for which the bands sum to the remainder.

    Parameters
    ----------
    expected : spectrum of the whole machine, of any size, shape (band,)
    modelled : mean squares, shape (band,), Pa²
    rest : the remainder, Pa²
    """
    order = np.argsort(modelled / expected)  # the more is modelled, the later a band counts
    factor = np.min((rest + np.cumsum(modelled[order])) / np.cumsum(expected[order]))
    return np.asarray(np.maximum(factor * expected - modelled, 0.0))


def _a_weighted_bands(mean_square: Array, axes: LevelAxes) -> Array:
    """A-weighted mean squares of the bands of the remainder, from those of the levels."""
    known = dict(zip(axes.bands, mean_square.tolist(), strict=True))
    middle_hz = np.array([band.middle_hz for band in REMAINDER_BANDS])
    modelled = np.array([known.get(band, 0.0) for band in REMAINDER_BANDS])
    return modelled * power_of_level(np.asarray(WEIGHTING["A"](middle_hz)))


def remaining_by_draw(
    study: Study,
    axes: LevelAxes,
    sounds: Sequence[Mapping[CaseKey, SourceSound]],
    draws: Sequence[Draw],
    rests: Array,
) -> Array:
    """`remaining` of every draw with the baseline, shape (draw, speed, option, receiver), Pa²."""
    machines = [with_draw(study.machine, study.machine, draw) for draw in draws]
    rows = zip(sounds, machines, rests.tolist(), strict=True)
    points = points_of(study, axes)
    return np.array(
        [
            with_baseline(study, axes, points, sound, remaining(study, axes, sound, machine, rest))
            for sound, machine, rest in rows
        ]
    )


def over_published(
    study: Study, axes: LevelAxes, sounds: Sequence[Mapping[CaseKey, SourceSound]]
) -> Array:
    """What draws model over the published level, shape (draw,), dB; not a number without solution.

    Over 0 dB(A) where none is published.

    Parameters
    ----------
    study : with the published level
    axes : with its receiver
    sounds : of the case of the published level, by draw
    """
    receiver = list(axes.receivers).index(study.catalogue_receiver)
    square = np.array([sound[study.catalogue_case].total[0, receiver] for sound in sounds])
    over = mean_square_level(np.nan_to_num(square), REFERENCE_PRESSURE_PA)
    return np.where(np.isnan(square), np.nan, over - published_of(study).level_dba)


def remainder_by_draw(study: Study, modelled_db: Array) -> Array:
    """One remainder of each draw by prior, drawn from what the published level leaves open, Pa².

    None without a published level.

    Parameters
    ----------
    study : with the published level
    modelled_db : of `over_published`

    Returns
    -------
    shape (prior, draw)
    """
    published, count = published_of(study), modelled_db.size
    if study.machine.overall_noise is None:
        return np.zeros((len(published.priors), count))
    evenly = (np.arange(count) + 0.5) / count
    share = np.random.default_rng(study.uncertainty.seed).permutation(evenly)
    below = [
        remainder_level(modelled_db, published.deviation_db, prior, share)
        for prior in published.priors
    ]
    return REFERENCE_PRESSURE_PA**2 * power_of_level(published.level_dba + np.array(below))
