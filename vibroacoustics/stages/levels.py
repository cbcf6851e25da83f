"""Levels of all sources at the receivers, with the nominal values."""

from collections.abc import Mapping
from dataclasses import dataclass

from ..base.registry import register
from ..levels.axes import LevelAxes
from ..levels.baseline import baseline_variables, points_of, with_baseline
from ..levels.by_source import Measured, SourceSound, sound_by_source
from ..levels.continuous import noise_levels
from ..levels.labelled import level_variables
from ..levels.lines import line_pressure
from ..levels.measured_points import BASELINE_BANDS, MeasuredPoint, PointKey
from ..levels.remainder import remainder, remaining
from ..machine.source import CaseKey
from ..mechanics.received_sound import ReceivedSound
from ..sources.cases import sources_of
from ..study.study import Study
from ..transfer.received import Transmission
from .chain import Cases, Chain
from .paths import PublishedCases, with_published
from .stage import Given, Stage, Trial, timed

Sound = dict[CaseKey, SourceSound]


@dataclass(frozen=True)
class NominalSound:
    """Sound by source with the nominal values.

    Attributes
    ----------
    axes : of the levels
    points : of a measured baseline
    sound : mean squares by source of every case, that of the published level among them
    """

    axes: LevelAxes
    points: Mapping[PointKey, MeasuredPoint]
    sound: Sound


@register
class Levels(Stage):
    """Levels of lines, noise, sources and totals, with the unmodelled noise."""

    name = "levels"
    reads = (Cases, PublishedCases, Transmission, "velocity_order")
    gives = (
        NominalSound, "pressure_line", "order_level", "noise_band_level", "remainder_band_level",
        "level_modelled", "level_remainder", "level_total", "change_1x", "change_modelled",
        "change_total", "source_level", "source_band_level", "source_share",
        "baseline_band_level", "baseline_order_level", "baseline_order_phase",
        "baseline_order_pressure", "baseline_order_share", "baseline_share",
    )  # fmt: skip

    def run(self, chain: Chain) -> Given:
        study, results, cases = chain.study, chain.results, with_published(chain)[Cases]
        axes = LevelAxes.of(study, list(sources_of(study)), results)
        received = chain[Transmission].received(cases.cases, cases.loads)
        points = points_of(study, axes)
        sound = by_source(study, axes, received)
        replaced = any(receiver == study.catalogue_receiver for receiver, _ in points)
        unmodelled = remainder(study, axes, sound, replaced or bool(study.ranges))
        left = remaining(study, axes, sound, study.machine, unmodelled)
        noise = noise_levels(axes, received, left)
        left = with_baseline(study, axes, points, sound, left)
        lines = line_pressure(axes, received)
        measured = baseline_variables(study, axes, points, sound)
        levels = level_variables(
            axes, sound, lines["pressure_line"], results["order_frequency"], left, unmodelled,
            measured,
        )  # fmt: skip
        levels = levels.merge(lines).merge(measured).merge(noise)
        return Given(levels, (NominalSound(axes, points, sound),))

    def tried(self, chain: Chain, study: Study) -> Trial:
        return timed(chain, self, study, self.name)


def by_source(study: Study, axes: LevelAxes, received: Mapping[CaseKey, ReceivedSound]) -> Sound:
    """Compute mean squares by source of every case; with a baseline its orders too."""
    has_baseline = study.measured is not None and study.measured.baseline is not None
    measured = Measured(BASELINE_BANDS, axes.measured_orders) if has_baseline else None
    return {key: sound_by_source(one, axes.bands, measured) for key, one in received.items()}
