"""Forces of all sources over the crank angle and the figures they report, labelled."""

from collections.abc import Iterable, Mapping, Sequence

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.vocabulary import AXES, DERIVED_SUPPLY, GIVEN_SUPPLY, REFERENCE_OPTION, check, stamp
from ..machine.source import Case, CaseKey
from ..mechanics.loads import Loads
from ..mechanics.rotation import uniform_crank_angle
from ..study.study import Study

_OVER_ANGLE = ("speed", "option", "crank_angle")


def force_variables(
    study: Study, cases: Mapping[CaseKey, Case], loads: Mapping[CaseKey, Mapping[str, Loads]]
) -> xr.Dataset:
    """Force and moment by what makes them, and the reported figures."""
    speeds, options = list(study.operation.speed_rpm), list(study.options)
    names = _unique(
        name for case in loads.values() for load in case.values() for name in load.wrenches
    )
    samples = study.operation.crank_angle_samples
    wrenches = _wrenches(speeds, options, names, samples, loads)
    coords = {
        "speed": speeds,
        "option": options,
        "source": names,
        "axis": list(AXES),
        "crank_angle": uniform_crank_angle(samples),
    }
    over_angle = {name: coords[name] for name in _OVER_ANGLE}
    rotations = [[cases[s, o].revolution.rotation for o in options] for s in speeds]
    shaft_speed = [[rotation.speed_rad_per_s for rotation in row] for row in rotations]
    acceleration = [[rotation.acceleration_rad_per_s2 for rotation in row] for row in rotations]
    time = [[rotation.time_s for rotation in row] for row in rotations]
    arrays = {
        "force": stamp("force", wrenches[:, :, 0], coords),
        "moment": stamp("moment", wrenches[:, :, 1], coords),
        "shaft_speed": stamp("shaft_speed", shaft_speed, over_angle),
        "shaft_acceleration": stamp("shaft_acceleration", acceleration, over_angle),
        "reported_figure": _figures(study, cases, loads),
    }
    return check(xr.Dataset(arrays, coords={"crank_time": (_OVER_ANGLE, time)}))


def supply_variable(study: Study, cases: Mapping[CaseKey, Case]) -> xr.Dataset:
    """Frequency of the motor's supply and where it comes from; empty where there is none."""
    operation = study.operation
    supplies = [cases[speed, REFERENCE_OPTION].supply_frequency_hz for speed in operation.speed_rpm]
    if None in supplies:
        return xr.Dataset()
    source = DERIVED_SUPPLY if operation.supply_frequency_hz is None else GIVEN_SUPPLY
    coords = {"speed": list(operation.speed_rpm)}
    supply = stamp("supply_frequency", supplies, coords, source=source)
    return check(xr.Dataset({"supply_frequency": supply}))


def _wrenches(
    speeds: Sequence[float],
    options: Sequence[str],
    names: Sequence[str],
    samples: int,
    loads: Mapping[CaseKey, Mapping[str, Loads]],
) -> Array:
    """Shape (speed, option, force or moment, wrench, axis, crank angle)."""
    wrenches = np.zeros((len(speeds), len(options), 2, len(names), 3, samples))
    for (speed, option), of_case in loads.items():
        rows = wrenches[speeds.index(speed), options.index(option)]
        for load in of_case.values():
            for name, wrench in load.wrenches.items():
                rows[:, names.index(name)] = wrench
    return wrenches


def _figures(
    study: Study, cases: Mapping[CaseKey, Case], loads: Mapping[CaseKey, Mapping[str, Loads]]
) -> xr.DataArray:
    """The figures of all cases; NaN where one has none of that name."""
    speeds, options = list(study.operation.speed_rpm), list(study.options)
    figures = {key: figures_of(study, key, case, loads[key]) for key, case in cases.items()}
    names = _unique(name for of_case in figures.values() for name in of_case)
    table = [[[figures[s, o].get(name, np.nan) for name in names] for o in options] for s in speeds]
    coords = {"speed": speeds, "option": options, "figure": names}
    return stamp("reported_figure", table, coords)


def figures_of(
    study: Study, key: CaseKey, case: Case, loads: Mapping[str, Loads]
) -> dict[str, float]:
    """Figures of the machine, as it is and where it is changed, of the option, of the sources."""
    option = study.options[key[1]]
    is_changed = option.applied_to(study.machine) is not study.machine
    changed = key[1] == REFERENCE_OPTION or is_changed
    figures = dict(case.revolution.figures) if changed else {}
    figures |= case.added.figures
    for load in loads.values():
        figures |= load.figures
    return figures


def _unique(names: Iterable[str]) -> list[str]:
    return list(dict.fromkeys(names))
