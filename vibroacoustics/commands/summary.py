"""Summary of a study by `run` and `check`: text, files and tables, and its cost."""

from collections.abc import Iterator, Mapping
from pathlib import Path

import xarray as xr

from ..base.threads import processors
from ..machine.machine import Machine
from ..pipeline.cost import RunCost
from ..report.analysis import Analysis
from ..report.kwave_words import kwave_difference_db, receiver_methods
from ..results.estimates import has_samples, sample_numbers
from ..study.study import Study
from .outcome import Outcome, columns


def outcome(
    study: Study, results: xr.Dataset, analysis: Analysis, files: Mapping[str, Path], seconds: float
) -> Outcome:
    """Give the outcome of one study, with the seconds that it took."""
    coarse = [f"coarse: {words}" for words in study.coarsened]
    row = {
        "study": study.source_file,
        "title": study.title,
        "machine": study.machine.name,
        "seconds": round(seconds, 1),
        "samples": sample_numbers(results).computed if has_samples(results) else 0,
        "coarsened": "; ".join(study.coarsened),
        "kwave_difference_db": kwave_difference_db(results),
    }
    microphones = [
        {"study": study.source_file, "microphone": name, "method": method, "reason": reason}
        for name, (method, reason) in receiver_methods(results).items()
    ]
    return Outcome(
        "\n".join([*study.left_out, *coarse]),
        files,
        {"studies": columns([row]), "microphones": columns(microphones)},
        {"": analysis},
    )


def summary(
    outcomes: Mapping[str, Outcome], is_several: bool, omitted: Mapping[str, str]
) -> Outcome:
    """Join the outcomes of studies; files and their tables of several begin with the folder.

    Parameters
    ----------
    outcomes : outcome by name of the folder
    is_several : whether several studies were to run
    omitted : reason by name of each study that failed
    """
    if not is_several:
        return next(iter(outcomes.values()))
    tables: dict[str, dict[str, list[object]]] = {"studies": {}, "microphones": {}}
    for each in outcomes.values():
        for name, table in tables.items():
            for head, values in each.tables.get(name, {}).items():
                table.setdefault(head, []).extend(values)
    if omitted:
        tables["omitted"] = {"study": [*omitted], "reason": [*omitted.values()]}
    files = {
        f"{name}/{label}": path
        for name, each in outcomes.items()
        for label, path in each.files.items()
    }
    analyses = {f"{name}/": each.analyses[""] for name, each in outcomes.items()}
    return Outcome("\n".join(each.text for each in outcomes.values()), files, tables, analyses)


def machine_lines(machine: Machine) -> Iterator[str]:
    """Yield the content of a machine's file."""
    tables = [name for name in type(machine).model_fields if getattr(machine, name) is not None]
    yield f"machine: {machine.name}, {machine.kind}"
    yield f"values: {', '.join(tables)}"


def cost_lines(cost: RunCost) -> Iterator[str]:
    """Yield the cost of a run, stage by stage, and how it is known."""
    yield f"size of the result: {cost.result_bytes / 1e6:.2g} MB, of at most 2147 MB"
    yield (
        "radiation: is in the cache"
        if cost.was_cached
        else f"radiation: is computed, {cost.radiation_bytes / 1e6:.0f} MB of memory"
    )
    for part in cost.costs:
        yield f"  {span(part.low_s, part.high_s):>14}  {part.name}: {part.how}"
    cores = processors()
    yield (
        f"time: {span(cost.low_s, cost.high_s)} of processor time; "
        f"{span(cost.low_s / cores, cost.high_s)} on {cores} idle cores"
    )


def span(low_s: float, high_s: float) -> str:
    """Write a range of times in the unit of the larger one."""
    for unit, seconds in (("h", 3600.0), ("min", 60.0)):
        if high_s >= 2.0 * seconds:
            return f"{low_s / seconds:.2g} to {high_s / seconds:.2g} {unit}"
    return f"{low_s:.2g} to {high_s:.2g} s"
