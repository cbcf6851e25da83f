"""Levels over speed between the speeds of a study that has few."""

from dataclasses import replace
from typing import Final

from ..base.errors import ParameterError, SolverError
from ..base.progress import no_progress
from ..base.registry import register
from ..base.vocabulary import REFERENCE_OPTION
from ..levels.nominal import NominalSound
from ..levels.run_up import at_study_levels, run_up_variables, unmodelled_over_speed
from ..machine.cases import Cases
from ..sources.cases import cases_of, loaded_cases, wrench_lines
from ..study.selection import running_up
from ..study.study import Study
from ..transfer.contributions import Transmission
from .chain import Chain
from .shown import SHOWN, Shown
from .stage import Given, Stage

_ENOUGH: Final = 6
"""Speeds of a study that show the levels over speed themselves."""


@register
class RunUp(Stage):
    """Levels of sources, machine and orders in a run-up without an option."""

    name = "run-up"
    is_tried = True
    reads = (
        *SHOWN, NominalSound, "level_total", "level_unmodelled", "source_level", "order_level"
    )  # fmt: skip
    gives = ("run_up_*",)

    def applies(self, study: Study) -> bool:
        few = len(study.operation.speed_rpm) < _ENOUGH
        return few and study.machine.runs_up and study.baseline is None

    def run(self, chain: Chain) -> Given:
        shown = Shown.of(chain)
        study = running_up(chain.study.model_copy(update={"machine": shown.machine}))
        try:
            cases = _cases(study)
        except (ParameterError, SolverError):  # a machine that cannot run at all of the speeds
            return Given()
        like = dict.fromkeys(cases.cases, shown.gain.get((shown.speed_rpm, REFERENCE_OPTION)))
        gain = {key: factor for key, factor in like.items() if factor is not None}
        sound = replace(shown, cases=cases, gain=gain).received(chain[Transmission])
        speeds = study.operation.speed_rpm
        noise = unmodelled_over_speed(
            shown.unmodelled.sel(option=REFERENCE_OPTION),
            shown.machine.remainder,
            shown.speed_rpm,
            speeds,
        )
        by_speed = dict(zip(speeds, sound, strict=True))
        levels = run_up_variables(chain[NominalSound].axes, by_speed, noise)
        if shown.gain:  # of a sample
            published = study.catalogue_receiver, study.catalogue_speed_rpm
            levels = at_study_levels(levels, chain.results, published)
        return Given(levels)


def _cases(study: Study) -> Cases:
    """Compute all cases of a study with the loads of the sources."""
    cases, loads = loaded_cases(study, cases_of(study, no_progress))
    wrenches = {
        (speed, option): wrench_lines(case, loads[speed, option], study.highest_order(speed))
        for (speed, option), case in cases.items()
    }
    return Cases(cases, loads, wrenches)
