"""What a run will cost, before it starts: its first speed and a few draws are timed."""

import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from .. import radiation
from ..base.errors import ParameterError
from ..base.progress import Progress, no_progress
from ..radiation.cost import Cost, about, cost_of, processor_time_s
from ..radiation.given import Radiation, given_radiation
from ..radiation.rooms.cost import room_cost
from ..radiation.rooms.of_study import room_key
from ..radiation.transfer_vectors import frequencies_hz, method_of, task_of
from ..results.size import check_size, result_bytes
from ..results.storage import is_cached
from ..study.selection import at_speeds
from ..study.study import Study
from ..transfer.path import ShellPath
from .cost_of_draws import levels_cost
from .motion import Motion, motion_of
from .radiating import inputs_of, transfer_vectors
from .shell import shell_path

_REPORT_S: Final = (2.0, 6.0)


@dataclass(frozen=True)
class RunCost:
    """What a run will take.

    Attributes
    ----------
    costs : of its stages, in their order
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
    """What a run of a study will cost; radiation is taken from the cache if it is there.

    The processor time so far counts as that of the start.

    Raises
    ------
    ParameterError, SolverError
        The machine cannot run, the result is too large, or memory does not suffice.
    """
    try:
        return _run_cost(study, progress)
    except ParameterError as error:
        raise ParameterError(f"{study.source_file}: {error}") from None


def _run_cost(study: Study, progress: Progress) -> RunCost:
    costs = [about("start and study", time.process_time(), "measured")]
    first = at_speeds(study, study.operation.speed_rpm[:1], study.options)
    progress("cost of the forces", 0, 1)
    motion, path, forces = _forces_and_shell(study, first)
    costs += forces
    check_size(study, motion.results, no_progress)
    progress("cost of the radiation", 0, 1)
    material = radiation.cache_key_material(*inputs_of(study, _modes(path)))
    known = is_cached("transfer-vectors", material)
    costs += [] if known else _radiation(study, path)
    source = transfer_vectors if known else _made_up(study, path)
    radiated, _ = source(study, no_progress, _modes(path))
    progress("cost of the draws", 0, 1)
    motion = motion.with_results(motion.results.merge(radiated))
    costs += levels_cost(study, first, motion, path, known)
    costs += _room(study, path)
    costs.append(Cost("report", *_REPORT_S, "not measured: as that of the package's studies"))
    return RunCost(tuple(costs), result_bytes(study, motion.results), known)


def _modes(path: ShellPath | None) -> Sequence[radiation.SurfaceMotion]:
    return () if path is None else path.modes


def _forces_and_shell(study: Study, first: Study) -> tuple[Motion, ShellPath | None, list[Cost]]:
    """Motion at the first speed, the shell, and what those of all speeds cost."""
    start = time.process_time()
    motion = motion_of(first, no_progress)
    first_s = next_s = time.process_time() - start
    speeds = study.operation.speed_rpm
    if len(speeds) > 1:
        second = at_speeds(study, speeds[1:2], study.options)
        next_s = processor_time_s(lambda: motion_of(second, no_progress))
    start = time.process_time()
    path = shell_path(study)
    shell_s = time.process_time() - start
    total_s = first_s + (len(speeds) - 1) * next_s
    forces = about("forces", total_s, f"{len(speeds)} speeds, the first ones measured")
    return motion, path, [forces, about("shell", shell_s, "measured")]


def _radiation(study: Study, path: ShellPath | None) -> list[Cost]:
    inputs = inputs_of(study, _modes(path))
    task = task_of(*inputs)
    return cost_of(method_of(inputs[0], task), task)


def _room(study: Study, path: ShellPath | None) -> list[Cost]:
    settings = study.room
    if settings is None:
        return []
    material = room_key(study, settings, _modes(path))
    if is_cached("room-responses", material):
        return []
    return [room_cost(study, settings)]


def _made_up(study: Study, path: ShellPath | None) -> Radiation:
    """Silence of the right shape, which takes as long."""
    frequency, receivers = frequencies_hz(study.radiation), len(study.receivers)
    housing, modes = (np.zeros((receivers, n, frequency.size)) for n in (6, len(_modes(path))))
    return given_radiation(housing, frequency, None if path is None else modes)
