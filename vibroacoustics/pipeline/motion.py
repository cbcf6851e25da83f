"""Forces of all sources, their orders and the motion on the mounts, block by block of speeds."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace

import xarray as xr

from ..base.progress import Progress
from ..machine.source import Case, CaseKey
from ..mechanics.loads import Loads, PortLoads
from ..orders.labelled import order_variables
from ..results.size import check_size
from ..results.speed_blocks import TIME_SERIES, blocks, gathered
from ..sources.cases import cases_of, loaded_cases, without_time_series, wrench_lines
from ..sources.labelled import force_variables, supply_variable
from ..study.selection import at_speeds
from ..study.study import Study
from ..transfer.foot_figures import with_foot_figures
from ..transfer.labelled import housing_variables


@dataclass(frozen=True)
class Motion:
    """What the machine does before it sounds.

    Attributes
    ----------
    results : forces, orders, motion, reported figures
    cases : every speed with every option
    loads : of all sources in each case, without their wrenches, which are in the results
    wrenches : lines of these by case and source
    """

    results: xr.Dataset
    cases: dict[CaseKey, Case] = field(default_factory=dict)
    loads: dict[CaseKey, dict[str, Loads]] = field(default_factory=dict)
    wrenches: dict[CaseKey, dict[str, PortLoads]] = field(default_factory=dict)

    def with_results(self, results: xr.Dataset) -> "Motion":
        """The same motion with further results."""
        return replace(self, results=results)

    def keep(self, key: CaseKey, case: Case, loads: Mapping[str, Loads], highest: int) -> None:
        """Keep a case and its loads, without their time series, up to the highest order."""
        self.wrenches[key] = wrench_lines(case, loads, highest)
        self.cases[key], self.loads[key] = without_time_series(case, loads)


def motion_of(study: Study, progress: Progress) -> Motion:
    """Forces of all sources and the motion that follows, with the values as given."""
    motion = Motion(xr.Dataset())
    parts = _blocks(study, progress, motion)
    return motion.with_results(gathered(parts, len(study.operation.speed_rpm)))


def _blocks(study: Study, progress: Progress, motion: Motion) -> Iterator[xr.Dataset]:
    """One dataset a block; cases and loads are put into the motion."""
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
            motion.keep(key, case, loads[key], study.highest_order(case.speed_rpm))
        done += len(cases)
