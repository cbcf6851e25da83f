"""Forces of all sources, their orders and the motion on the mounts, block by block of speeds."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
import xarray as xr

from ..base.progress import Progress
from ..base.vocabulary import (
    AXES,
    REFERENCE_OPTION,
    check,
    stamp,
)
from ..machine.option import Option
from ..machine.source import Case
from ..mechanics.loads import Loads
from ..mechanics.rotation import uniform_crank_angle
from ..orders.labelled import order_variables
from ..study.study import Study
from ..transfer import largest_foot_force_n, on_mounts
from ..transfer.labelled import housing_variables
from .cases import At, cases_of, loads_of
from .speed_blocks import TIME_SERIES, blocks, check_size, gathered

_TURNING: Final = ("speed", "option", "crank_angle")


@dataclass(frozen=True)
class Motion:
    """What the machine does before it is heard.

    Attributes
    ----------
    results : forces, orders, motion, reported figures
    cases : every speed with every option
    loads : of all sources in each case, without their wrenches, which are in the results
    of_wrench : source of each wrench
    """

    results: xr.Dataset
    cases: dict[At, Case]
    loads: dict[At, dict[str, Loads]]
    of_wrench: dict[str, str]

    def with_results(self, results: xr.Dataset) -> "Motion":
        """The same motion with further results."""
        return replace(self, results=results)


def motion_of(study: Study, progress: Progress) -> Motion:
    """Forces of all sources and the motion that follows, with the values as given."""
    motion = Motion(xr.Dataset(), {}, {}, {})
    parts = _blocks(study, progress, motion)
    return motion.with_results(gathered(parts, len(study.operation.speed_rpm)))


def _blocks(study: Study, progress: Progress, motion: Motion) -> Iterator[xr.Dataset]:
    """One dataset a block; cases and loads are put into the motion, without what is sampled."""
    done, total = 0, len(study.operation.speed_rpm) * len(study.options)

    def advance(task: str, step: int, _: int) -> None:
        progress(task, done + step, total)

    for speeds in blocks(study.operation.speed_rpm):
        block = at_speeds(study, speeds, study.options)
        cases = cases_of(block, advance)
        loads = {at: _with_feet(case, loads_of(study, case)) for at, case in cases.items()}
        part = _forces(block, cases, loads)
        part = part.merge(order_variables(study, part))
        part = part.merge(housing_variables(block, part))
        if not study.operation.keeps_time_series:
            part = part.drop_vars(TIME_SERIES)
        if done == 0:
            check_size(study, part, progress)
        yield part
        for at, case in cases.items():
            motion.cases[at] = _without_courses(case)
            named = {name: who for who, load in loads[at].items() for name in load.wrenches}
            motion.of_wrench.update(named)
            motion.loads[at] = {who: replace(load, wrenches={}) for who, load in loads[at].items()}
        done += len(speeds) * len(study.options)


def _with_feet(case: Case, loads: Mapping[str, Loads]) -> dict[str, Loads]:
    """Loads with the figures of what their tones do to the feet."""
    body = on_mounts(case.machine)
    return {
        name: replace(
            own,
            figures={
                **own.figures,
                **{
                    tone.figure: largest_foot_force_n(body, tone)
                    for tone in own.tones
                    if tone.figure is not None
                },
            },
        )
        for name, own in loads.items()
    }


def _without_courses(case: Case) -> Case:
    """A case without wrenches and paths over crank angle, which the results hold."""
    return replace(
        case,
        revolution=replace(case.revolution, wrenches={}),
        added=replace(case.added, parts=()),
    )


def at_speeds(study: Study, speeds: tuple[float, ...], options: Mapping[str, Option]) -> Study:
    """The study with some of its speeds, or another one, and some options."""
    operation = study.operation
    supplies = operation.supply_frequency_hz
    if supplies is not None:
        known = dict(zip(operation.speed_rpm, supplies, strict=True))
        supplies = tuple(known[speed] for speed in speeds)
    operation = operation.model_copy(update={"speed_rpm": speeds, "supply_frequency_hz": supplies})
    return study.model_copy(update={"operation": operation, "options": dict(options)})


def _forces(
    study: Study, cases: Mapping[At, Case], loads: Mapping[At, Mapping[str, Loads]]
) -> xr.Dataset:
    """Force and moment by what makes them, and the reported figures."""
    speeds, options = list(study.operation.speed_rpm), list(study.options)
    makers = _unique(
        name for own in loads.values() for load in own.values() for name in load.wrenches
    )
    samples = study.operation.crank_angle_samples
    wrenches = np.zeros((len(speeds), len(options), 2, len(makers), 3, samples))
    for (speed, option), own in loads.items():
        for load in own.values():
            for name, wrench in load.wrenches.items():
                place = speeds.index(speed), options.index(option)
                wrenches[(*place, slice(None), makers.index(name))] = wrench
    coords = {
        "speed": speeds,
        "option": options,
        "source": makers,
        "axis": list(AXES),
        "crank_angle": uniform_crank_angle(samples),
    }
    turning = {name: coords[name] for name in _TURNING}
    rotations = [[cases[s, o].revolution.rotation for o in options] for s in speeds]
    shaft_speed = [[turn.speed_rad_per_s for turn in row] for row in rotations]
    figures = {at: _figures(study, at, case, loads[at]) for at, case in cases.items()}
    return check(
        xr.Dataset(
            {
                "force": stamp("force", wrenches[:, :, 0], coords),
                "moment": stamp("moment", wrenches[:, :, 1], coords),
                "shaft_speed": stamp("shaft_speed", shaft_speed, turning),
                "reported_figure": _labelled_figures(figures, speeds, options),
            },
            coords={"crank_time": (_TURNING, [[turn.time_s for turn in row] for row in rotations])},
        )
    )


def _figures(study: Study, at: At, case: Case, loads: Mapping[str, Loads]) -> dict[str, float]:
    """Figures of the machine, as it is and where it is changed, of the option, of the sources."""
    changed = at[1] == REFERENCE_OPTION or case.machine is not study.machine
    figures = dict(case.revolution.figures) if changed else {}
    figures |= case.added.figures
    for load in loads.values():
        figures |= load.figures
    return figures


def _labelled_figures(
    figures: Mapping[At, Mapping[str, float]], speeds: Sequence[float], options: Sequence[str]
) -> xr.DataArray:
    """The figures of all cases; NaN where one has none of that name."""
    names = _unique(name for named in figures.values() for name in named)
    table = [[[figures[s, o].get(name, np.nan) for name in names] for o in options] for s in speeds]
    coords = {"speed": list(speeds), "option": list(options), "figure": names}
    return stamp("reported_figure", table, coords)


def _unique(names: Iterable[str]) -> list[str]:
    return list(dict.fromkeys(names))
