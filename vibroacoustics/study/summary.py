"""Study in a few lines, for the command line, a Python prompt and a notebook."""

from collections.abc import Iterator
from html import escape
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .tables import StudyTables


def study_lines(study: "StudyTables") -> Iterator[str]:
    """Give what a study computes, a line each: title, cases, published level, samples."""
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


def samples_text(study: "StudyTables") -> str:
    """Say how many values are sampled how often."""
    if not study.ranges:
        if not study.sources:
            ranges = sum(record.lowest is not None for record in study.records)
            though = f", though {ranges} values have a range" if ranges else ""
            return f"none{though}: values are sampled where a study has sources, [sources.NAME]"
        return "none: no value that is read has a range that is sampled"
    sampled, wanted = len(study.ranges), study.uncertainty.random_samples
    held = len(study.held_ranges)
    return f"{sampled} values until {wanted} samples are effective; {held} ranges are not sampled"


def html_of(lines: Iterator[str]) -> str:
    """Table of lines `name: text` as HTML."""
    rows = "".join(
        f"<tr><th>{escape(name)}</th><td>{escape(text.strip())}</td></tr>"
        for name, _, text in (line.partition(":") for line in lines)
    )
    return f"<table>{rows}</table>"
