"""What `vibroacoustics check` says of a file that may be run."""

from collections.abc import Iterator

from ..base.threads import processors
from ..machine.machine import Machine
from ..pipeline.cost import RunCost


def machine_lines(machine: Machine) -> Iterator[str]:
    """What a machine's file holds."""
    tables = [name for name in type(machine).model_fields if getattr(machine, name) is not None]
    yield f"machine: {machine.name}, {machine.kind}"
    yield f"values: {', '.join(tables)}"


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
