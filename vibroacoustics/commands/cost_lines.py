"""What `vibroacoustics check` says of a file that may be run."""

from collections.abc import Iterator

from ..base.threads import processors
from ..machine.machine import Machine
from ..pipeline.cost import RunCost
from ..study.study import Study


def machine_lines(machine: Machine) -> Iterator[str]:
    """What a machine's file holds."""
    tables = [name for name in type(machine).model_fields if getattr(machine, name) is not None]
    yield f"machine: {machine.name}, {machine.kind}"
    yield f"values: {', '.join(tables)}"


def study_lines(study: Study) -> Iterator[str]:
    """What a study computes."""
    speeds, options = len(study.operation.speed_rpm), len(study.options)
    yield f"study: {study.title}; machine: {study.machine.name}, {study.machine.kind}"
    yield (
        f"cases: {speeds} speeds x {options} options at {len(study.receivers)} microphones, "
        f"sources: {', '.join(['moving_parts', *study.sources])}"
    )
    if study.machine.overall_noise is None:
        yield (
            "level: none is published (overall_noise): levels hold what the model holds, at "
            f"{study.catalogue_receiver} and {study.catalogue_speed_rpm:g} rpm first"
        )
    yield f"samples: {samples_text(study)}"


def samples_text(study: Study) -> str:
    """How many values are sampled how often."""
    if not study.ranges:
        if not study.sources:
            ranges = sum(record.lowest is not None for record in study.records)
            though = f", though {ranges} values have a range" if ranges else ""
            return f"none{though}: values are sampled where a study has sources, [sources.NAME]"
        return "none: no value that is read has a range that is sampled"
    sampled, wanted = len(study.ranges), study.uncertainty.random_samples
    held = len(study.held_ranges)
    return f"{sampled} values until {wanted} samples are effective; {held} ranges are not sampled"


def cost_lines(cost: RunCost) -> Iterator[str]:
    """What a run takes, stage by stage, and how that is known."""
    yield f"size of the result: {cost.result_bytes / 1e6:.2g} MB, of at most 2147 MB"
    yield (
        "radiation: is in the cache"
        if cost.was_cached
        else f"radiation: is computed, {cost.radiation_bytes / 1e6:.0f} MB of memory"
    )
    for one in cost.costs:
        yield f"  {_span(one.low_s, one.high_s):>14}  {one.name}: {one.how}"
    cores = processors()
    yield (
        f"time: {_span(cost.low_s, cost.high_s)} of processor time; "
        f"{_span(cost.low_s / cores, cost.high_s)} on {cores} idle cores"
    )


def _span(low_s: float, high_s: float) -> str:
    """A range of times in the unit of the larger one."""
    for unit, seconds in (("h", 3600.0), ("min", 60.0)):
        if high_s >= 2.0 * seconds:
            return f"{low_s / seconds:.2g} to {high_s / seconds:.2g} {unit}"
    return f"{low_s:.2g} to {high_s:.2g} s"
