"""Forces of all sources, their orders and the motion on the mounts, block by block of speeds."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial

import xarray as xr

from ..base.progress import Progress, no_progress
from ..base.registry import register
from ..base.vocabulary import REFERENCE_OPTION
from ..machine.cases import Cases
from ..orders.labelled import order_variables
from ..radiation.cost import about, processor_time_s
from ..results.size import check_size
from ..results.speed_blocks import TIME_SERIES, blocks, gathered
from ..sources.cases import cases_of, loaded_cases, without_time_series, wrench_lines
from ..sources.labelled import force_variables, supply_variable
from ..study.selection import at_speeds
from ..study.study import Study
from ..transfer.foot_figures import with_foot_figures
from ..transfer.labelled import housing_variables
from .chain import Chain
from .stage import Given, Stage, Trial, timed


@dataclass(frozen=True)
class PublishedCases(Cases):
    """The case of the published level, where it is none of the study's; else empty."""


@register
class Forces(Stage):
    """Forces and moments of all sources, and the motion of the machine on its mounts."""

    name = "forces"
    gives = (
        Cases, PublishedCases, "force", "force_order", "force_amplitude", "moment", "moment_order",
        "moment_amplitude", "shaft_*", "supply_frequency", "velocity_order", "block_velocity_order",
        "foot_force_order", "foot_force_amplitude", "largest_foot_force", "natural_frequency",
        "mode_shape", "mode_energy", "spring_displacement",
        "mount_transmissibility", "reported_figure", "option_*",
    )  # fmt: skip

    def run(self, chain: Chain) -> Given:
        results, cases = motion_of(chain.study, chain.progress)
        return Given(results, (cases, _published(chain.study, cases)))

    def tried(self, chain: Chain, study: Study) -> Trial:
        """Time the first speed, with which code is compiled, and try every other one."""
        after, costs = timed(chain, self)
        check_size(study, after.results, no_progress)
        further = [at_speeds(study, (rpm,), study.options) for rpm in study.operation.speed_rpm[1:]]
        further_s = sum(processor_time_s(partial(motion_of, each, no_progress)) for each in further)
        if further_s:
            costs += (about("forces at further speeds", further_s, "measured"),)
        return Trial(after, costs)


def motion_of(study: Study, progress: Progress) -> tuple[xr.Dataset, Cases]:
    """Compute the forces of all sources and the motion that follows, with the nominal values.

    Returns
    -------
    forces, orders, motion and reported figures; every speed with every option
    """
    kept = Cases({}, {}, {})
    return gathered(_blocks(study, progress, kept), len(study.operation.speed_rpm)), kept


def _blocks(study: Study, progress: Progress, kept: Cases) -> Iterator[xr.Dataset]:
    """Give one dataset a block; its cases are kept without their time series."""
    total = sum(len(study.options) for _ in study.operation.speed_rpm)

    def advance(task: str, step: int, _: int) -> None:
        progress(task, len(kept.cases) + step, total)

    for speeds in blocks(study.operation.speed_rpm):
        block = at_speeds(study, speeds, study.options)
        cases, named = loaded_cases(study, cases_of(block, advance))
        loads = {key: with_foot_figures(case.machine, named[key]) for key, case in cases.items()}
        part = force_variables(block, cases, loads).merge(supply_variable(block, cases))
        part = part.merge(order_variables(study, part))
        part = part.merge(housing_variables(block, part))
        if not study.operation.keeps_time_series:
            part = part.drop_vars(TIME_SERIES)
        if not kept.cases:
            check_size(study, part, progress)
        yield part
        for key, case in cases.items():
            highest = study.highest_order(case.speed_rpm)
            kept.wrenches[key] = wrench_lines(case, loads[key], highest)
            kept.cases[key], kept.loads[key] = without_time_series(case, loads[key])


def _published(study: Study, nominal: Cases) -> PublishedCases:
    """Compute the case of the published level under its key, where the study has it not."""
    key = study.catalogue_case
    if key in nominal.cases:
        return PublishedCases({}, {}, {})
    machine = study.catalogue_machine or study.machine
    reference = {REFERENCE_OPTION: study.options[REFERENCE_OPTION]}
    published = study.model_copy(update={"machine": machine})
    _, of = motion_of(at_speeds(published, key[:1], reference), no_progress)
    cases, loads, wrenches = (dict.fromkeys([key], *part.values()) for part in vars(of).values())
    return PublishedCases(cases, loads, wrenches)


def with_published(chain: Chain) -> Chain:
    """Return the chain with the case of the published level among its cases."""
    return chain.having(chain[PublishedCases].joined(chain[Cases]))
