"""A study at some of its speeds, or at another one, with some of its options."""

from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np

from ..base.vocabulary import REFERENCE_OPTION
from ..machine.option import Option
from .study import Study

_OF_RUN_UP: Final = 25
"""Speeds between the slowest and the fastest, besides those of the study."""
_BESIDE: Final = 0.2
"""Share of a study's only speed that the run-up reaches below and above it."""


def at_speeds(study: Study, speeds_rpm: Sequence[float], options: Mapping[str, Option]) -> Study:
    """The study at other speeds and with other options.

    Parameters
    ----------
    study : study of all speeds
    speeds_rpm : among those of the study, where that gives supply frequencies
    options : by name
    """
    operation = study.operation
    supplies = operation.supply_frequency_hz
    if supplies is not None:
        supply_of_speed = dict(zip(operation.speed_rpm, supplies, strict=True))
        supplies = tuple(supply_of_speed[speed] for speed in speeds_rpm)
    changed = {"speed_rpm": tuple(speeds_rpm), "supply_frequency_hz": supplies}
    operation = operation.model_copy(update=changed)
    return study.model_copy(update={"operation": operation, "options": dict(options)})


def running_up(study: Study) -> Study:
    """Return the study at many speeds between its slowest and fastest, without an option.

    About its speed where it has one. The frequency of the motor's supply, where the study gives
    it, is interpolated; beside the only speed it is in proportion. Speeds at which the crank angles
    do not resolve the highest orders are omitted.

    Parameters
    ----------
    study : with few speeds
    """
    operation = study.operation
    speeds, supplies = np.array(operation.speed_rpm), operation.supply_frequency_hz
    beside = _BESIDE if speeds.size == 1 else 0.0
    slowest, fastest = (1.0 - beside) * speeds.min(), (1.0 + beside) * speeds.max()
    between = np.linspace(slowest, fastest, _OF_RUN_UP)
    every = [
        speed
        for speed in np.unique(np.concatenate([speeds, between])).tolist()
        if 2 * study.highest_order(speed) < operation.crank_angle_samples
    ]
    if supplies is not None:
        ratio = np.interp(every, np.sort(speeds), (np.array(supplies) / speeds)[speeds.argsort()])
        supplies = tuple((ratio * every).tolist())
    changed = {"speed_rpm": tuple(every), "supply_frequency_hz": supplies}
    reference = {REFERENCE_OPTION: study.options[REFERENCE_OPTION]}
    operation = operation.model_copy(update=changed)
    return study.model_copy(update={"operation": operation, "options": reference})
