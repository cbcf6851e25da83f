"""Outcome of `run`: text, files and tables of each study, and what the studies took."""

from collections.abc import Mapping
from pathlib import Path

import xarray as xr

from ..report.analysis import Analysis
from ..report.kwave_words import kwave_difference_db, receiver_methods
from ..results.estimates import has_samples, sample_numbers
from ..study.study import Study
from .outcome import Outcome, columns


def outcome(
    study: Study,
    results: xr.Dataset,
    analysis: Analysis,
    files: Mapping[str, Path],
    seconds: float,
) -> Outcome:
    """Give the outcome of one study.

    Parameters
    ----------
    study : that was run
    results : of it
    analysis, files : its report, and the files that were written
    seconds : that it took
    """
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


def summary(outcomes: Mapping[str, Outcome]) -> Outcome:
    """Join the outcomes of studies; files and their tables of several begin with the folder."""
    if len(outcomes) == 1:
        return next(iter(outcomes.values()))
    tables: dict[str, dict[str, list[object]]] = {"studies": {}, "microphones": {}}
    for each in outcomes.values():
        for name, table in tables.items():
            for head, values in each.tables[name].items():
                table.setdefault(head, []).extend(values)
    files = {
        f"{name}/{label}": path
        for name, each in outcomes.items()
        for label, path in each.files.items()
    }
    analyses = {f"{name}/": each.analyses[""] for name, each in outcomes.items()}
    return Outcome("\n".join(each.text for each in outcomes.values()), files, tables, analyses)
