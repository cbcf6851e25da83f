"""The ordinary study of each of several machines, and where its axes are among the common ones."""

from collections.abc import Iterator, Mapping
from itertools import combinations
from math import cos, hypot, sin
from pathlib import Path
from typing import Any

import numpy as np

from ..base.arrays import Array
from ..base.errors import ParameterError
from ..base.vocabulary import REFERENCE_OPTION
from .coarse import coarse
from .loading import load_study
from .machines import StudyMachine
from .receivers import Receiver
from .study import Study
from .toml_files import read_toml

_ALONE = ("machines", "base_frame", "common_receivers")
"""Tables of several machines, which the study of each of them lacks."""
_DECIMALS = 9
"""Decimals of a turned position in m: less is rounding."""


def machine_studies(study: Study) -> dict[str, Study]:
    """Make the study of each of several machines: its speed, its option, the common receivers.

    Parameters
    ----------
    study : with tables of several machines

    Raises
    ------
    ParameterError
        There are none, a file is missing, an option or a supply unknown, two shells are in one
        another; all of them at once, a line each.
    """
    if not study.machines:
        raise ParameterError(f"{study.source_file}: machines: is missing; give machines.NAME")
    studies: dict[str, Study] = {}
    problems: list[str] = []
    for name, machine in study.machines.items():
        try:
            studies[name] = _study_of(study, machine)
        except ParameterError as error:
            problems += (f"machines.{name}: {line}" for line in error.args)
    if len(studies) == len(study.machines):
        problems += _overlaps(study.machines, studies)
        problems += _floors(study, studies)
    if problems:
        raise ParameterError(*(f"{study.source_file}: {line}" for line in problems))
    return studies


def turn_of(machine: StudyMachine) -> Array:
    """Return the axes of a machine as columns among the common axes, shape (3, 3)."""
    c, s = cos(machine.angle_rad), sin(machine.angle_rad)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def at_machine(receiver: Receiver, machine: StudyMachine) -> tuple[float, float, float]:
    """Return x and y from the axis of a machine, along its axes, and the height above the floor.

    Parameters
    ----------
    receiver : in the common axes
    machine : with position and angle
    """
    x, y = receiver.x_m - machine.position_m[0], receiver.y_m - machine.position_m[1]
    along = turn_of(machine).T @ np.array([x, y, receiver.height_m])
    x_m, y_m, height_m = np.round(along, _DECIMALS).tolist()
    return x_m, y_m, height_m


def _study_of(study: Study, machine: StudyMachine) -> Study:
    base, changes = _base(study, machine.file)
    if machine.option not in base.options:
        raise ParameterError(
            f"option = {machine.option}: unknown; allowed {', '.join(base.options)}"
        )
    further = {name: at_machine(each, machine) for name, each in study.common_receivers.items()}
    for name in further:
        if name in base.receivers:
            raise ParameterError(f"common_receivers.{name}: is the name of a receiver of its study")
    changes |= _operation(base, machine.speed_rpm)
    changes["receivers"] = {
        name: dict(zip(("x_m", "y_m", "height_m"), point, strict=True))
        for name, point in further.items()
    }
    if study.base_frame is not None:
        height_m = base.machine.shell.floor_clearance_m + study.base_frame.top_height_m
        source = "derived: height of the mounts, and of the base frame's top"
        changes["machine.shell.floor_clearance_m"] = {"value": height_m, "source": source}
    changed = base.replace(changes)
    names = dict.fromkeys((REFERENCE_OPTION, machine.option))
    options = {name: changed.options[name] for name in names}
    judged = {name: values for name, values in changed.given.items() if name in options}
    words = study.coarsened or changed.coarsened
    kept = {"options": options, "given": judged, "coarsened": words}
    return changed.model_copy(update=kept)


def _base(study: Study, file: str) -> tuple[Study, dict[str, Any]]:
    """Study that a machine begins with, and what its file changes of it."""
    alone = [name for name in _ALONE if name in study.as_written()]
    changes: dict[str, Any] = dict.fromkeys(alone)
    if not file:
        return study, changes
    if "kind" in read_toml(Path(file)):
        table = study.as_written()["machine"]
        taken_out = {f"machine.{name}": None for name in ("override", "without") if name in table}
        changes |= {**taken_out, "machine.file": file}
        return study.replace(changes), {}
    base = load_study(file)
    if base.machines:
        raise ParameterError(f"file = {file}: has several machines itself")
    return coarse(base) if study.coarsened else base, {}


def _operation(study: Study, speed_rpm: float) -> dict[str, Any]:
    """Values for one speed, with that of the overall noise where its supply is to be known."""
    supplies = study.operation.supply_frequency_hz
    if supplies is None:
        return {"operation.speed_rpm": [speed_rpm]}
    at_speeds = dict(zip(study.operation.speed_rpm, supplies, strict=True))
    if speed_rpm not in at_speeds and len(set(supplies)) > 1:
        raise ParameterError(
            f"speed_rpm = {speed_rpm:g} rpm: operation.supply_frequency_hz is not known at this "
            f"speed; give one supply frequency, or one of {', '.join(f'{x:g}' for x in at_speeds)}"
        )
    speeds = list(dict.fromkeys((speed_rpm, study.catalogue_speed_rpm)))
    of_speeds = [at_speeds.get(speed, supplies[0]) for speed in speeds]
    return {"operation.speed_rpm": speeds, "operation.supply_frequency_hz": of_speeds}


def _overlaps(machines: Mapping[str, StudyMachine], studies: Mapping[str, Study]) -> Iterator[str]:
    """Give pairs of machines whose shells are in one another, a line each."""
    for first, second in combinations(machines, 2):
        (x, y), (other_x, other_y) = machines[first].position_m, machines[second].position_m
        away_m = hypot(x - other_x, y - other_y)
        least_m = sum(_radius_m(studies[name]) for name in (first, second))
        if away_m < least_m:
            yield (
                f"machines.{second}.position_mm: is {1e3 * away_m:.0f} mm from machines.{first}, "
                f"whose shells need {1e3 * least_m:.0f} mm"
            )


def _radius_m(study: Study) -> float:
    """Return the largest radius of the shell of a study's machine, m."""
    return float(study.machine.shell.profile.radius_m)


def _floors(study: Study, studies: Mapping[str, Study]) -> Iterator[str]:
    """Give machines with a floor of their own on a common frame, a line each."""
    for name, each in studies.items() if study.base_frame is not None else ():
        if each.machine.floor is not None or each.machine.floor_mobility is not None:
            yield (
                f"machines.{name}: has floor, floor_mobility or structure_borne beside base_frame; "
                "remove one"
            )
        if each.measured is not None and each.measured.sound is not None:
            yield f"machines.{name}: has measured.sound on its floor, and is on base_frame"
