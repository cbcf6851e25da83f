"""Forces of all sources, their orders and the motion on the mounts, block by block of speeds."""

import time
from collections.abc import Iterator, Mapping
from typing import NamedTuple

import xarray as xr

from ..base.progress import Progress, no_progress
from ..base.registry import register
from ..base.vocabulary import REFERENCE_OPTION
from ..machine.source import Case, CaseKey
from ..mechanics.loads import Loads
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
from .chain import Cases, Chain
from .stage import Given, Stage, Trial, advanced


class Motion(NamedTuple):
    """What the machine does before it sounds.

    Attributes
    ----------
    results : forces, orders, motion, reported figures
    cases : every speed with every option
    """

    results: xr.Dataset
    cases: Cases


@register
class Forces(Stage):
    """Forces and moments of all sources, and the motion of the machine on its mounts."""

    name = "forces"
    gives = (
        Cases, "force", "moment", "force_order", "force_amplitude", "moment_order",
        "moment_amplitude", "shaft_speed", "shaft_acceleration", "supply_frequency",
        "velocity_order", "block_velocity_order", "foot_force_order", "foot_force_amplitude",
        "natural_frequency", "mode_shape", "mount_transmissibility", "reported_figure",
    )  # fmt: skip

    def run(self, chain: Chain) -> Given:
        motion = motion_of(chain.study, chain.progress)
        return Given(motion.results, (motion.cases,))

    def tried(self, chain: Chain, study: Study) -> Trial:
        speeds = study.operation.speed_rpm
        start = time.process_time()
        after = advanced(chain, self)
        first_s = next_s = time.process_time() - start
        if len(speeds) > 1:
            second = at_speeds(study, speeds[1:2], study.options)
            next_s = processor_time_s(lambda: motion_of(second, no_progress))
        check_size(study, after.results, no_progress)
        seconds = first_s + (len(speeds) - 1) * next_s
        how = f"{len(speeds)} speeds, the first ones measured"
        return Trial(after, (about(self.name, seconds, how),))


def motion_of(study: Study, progress: Progress) -> Motion:
    """Compute the forces of all sources and the motion that follows, with the nominal values.

    Parameters
    ----------
    study : speeds, options, sources
    progress : called with the number of cases that are done
    """
    kept = Cases({}, {}, {})
    parts = _blocks(study, progress, kept)
    return Motion(gathered(parts, len(study.operation.speed_rpm)), kept)


def at_published_speed(study: Study) -> Motion:
    """Compute forces and motion at the speed of the published level, without a balancer."""
    machine = study.catalogue_machine or study.machine
    reference = {REFERENCE_OPTION: study.options[REFERENCE_OPTION]}
    there = study.model_copy(update={"machine": machine})
    return motion_of(at_speeds(there, study.catalogue_case[:1], reference), no_progress)


def _blocks(study: Study, progress: Progress, kept: Cases) -> Iterator[xr.Dataset]:
    """Give one dataset a block; its cases and loads are put into `kept`."""
    done, total = 0, len(study.operation.speed_rpm) * len(study.options)

    def advance(task: str, step: int, _: int) -> None:
        progress(task, done + step, total)

    for speeds in blocks(study.operation.speed_rpm):
        block = at_speeds(study, speeds, study.options)
        cases, named = loaded_cases(study, cases_of(block, advance))
        loads = {key: with_foot_figures(case.machine, named[key]) for key, case in cases.items()}
        part = force_variables(block, cases, loads).merge(supply_variable(block, cases))
        part = part.merge(order_variables(study, part))
        part = part.merge(housing_variables(block, part))
        if not study.operation.keeps_time_series:
            part = part.drop_vars(TIME_SERIES)
        if done == 0:
            check_size(study, part, progress)
        yield part
        for key, case in cases.items():
            _keep(kept, key, case, loads[key], study.highest_order(case.speed_rpm))
        done += len(cases)


def _keep(kept: Cases, key: CaseKey, case: Case, loads: Mapping[str, Loads], highest: int) -> None:
    """Keep a case and its loads without their time series, wrenches up to the highest order."""
    kept.wrenches[key] = wrench_lines(case, loads, highest)
    kept.cases[key], kept.loads[key] = without_time_series(case, loads)
