"""Cost of a run, before it starts: its stages are tried at the first speed."""

import time
from dataclasses import dataclass
from functools import partial
from typing import Final

from ..base.linear_algebra import one_thread_of_linear_algebra
from ..base.progress import Progress, no_progress
from ..measured.floor_functions import on_measured_floor
from ..radiation.cost import Cost, about
from ..results.size import result_bytes
from ..stages.chain import Chain
from ..stages.radiation import Radiated, transfer_vectors
from ..stages.stage import STAGES, applying
from ..study.failing import surviving
from ..study.selection import at_speeds
from ..study.study import Study

_REPORT_S: Final = (2.0, 6.0)


@dataclass(frozen=True)
class RunCost:
    """Time and memory that a run will take.

    Attributes
    ----------
    costs : costs of its stages, in their order
    result_bytes : size of the result
    was_cached : whether the transfer vectors are cached
    """

    costs: tuple[Cost, ...]
    result_bytes: int
    was_cached: bool

    @property
    def low_s(self) -> float:
        """Processor time at least, s."""
        return sum(cost.low_s for cost in self.costs)

    @property
    def high_s(self) -> float:
        """Processor time at most, s."""
        return sum(cost.high_s for cost in self.costs)

    @property
    def radiation_bytes(self) -> float:
        """Memory that the radiation takes at its peak."""
        return max(cost.memory_bytes for cost in self.costs)


def run_cost(study: Study, progress: Progress = no_progress) -> RunCost:
    """Estimate what a run of a study will cost; radiation is taken from the cache if it is there.

    The processor time so far counts as that of the start.
    """
    with one_thread_of_linear_algebra():  # as in a run
        return surviving(study, partial(_run_cost, progress=progress))


def _run_cost(study: Study, progress: Progress) -> RunCost:
    costs = [about("start and study", time.process_time(), "measured")]
    study = on_measured_floor(study)
    first = at_speeds(study, study.operation.speed_rpm[:1], study.options)
    chain = Chain(first, transfer_vectors)
    for stage in applying(study):
        progress(f"cost of {stage.name}", 0, 1)
        with STAGES.spared():
            chain, of_stage = stage.tried(chain, study)
            costs += of_stage
    costs.append(Cost("report", *_REPORT_S, "not measured: as that of the package's studies"))
    size = result_bytes(study, chain.results)
    return RunCost(tuple(costs), size, chain[Radiated].was_cached)
