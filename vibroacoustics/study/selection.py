"""A study at some of its speeds, or at another one, with some of its options."""

from collections.abc import Mapping, Sequence

from ..machine.option import Option
from .study import Study


def at_speeds(study: Study, speeds_rpm: Sequence[float], options: Mapping[str, Option]) -> Study:
    """The study at other speeds and with other options.

    Parameters
    ----------
    study : of all speeds
    speeds_rpm : among those of the study, where that gives supply frequencies
    options : by name
    """
    operation = study.operation
    supplies = operation.supply_frequency_hz
    if supplies is not None:
        known = dict(zip(operation.speed_rpm, supplies, strict=True))
        supplies = tuple(known[speed] for speed in speeds_rpm)
    changed = {"speed_rpm": tuple(speeds_rpm), "supply_frequency_hz": supplies}
    operation = operation.model_copy(update=changed)
    return study.model_copy(update={"operation": operation, "options": dict(options)})
