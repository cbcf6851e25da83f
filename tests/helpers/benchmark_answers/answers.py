"""All answers of the package to the open benchmark, and their submission."""

import csv
import io
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Final

from .case import Answers, Case, read_case
from .gas import scroll_gas
from .measured import changed_mounts, sound_power_example, tone_audibility
from .mechanics import (
    counterweight_optimum,
    minicrank_torque,
    oldham_force,
    slider_link_invariants,
)
from .sound import exact_room, point_and_ring_sources

ANSWERS: Final[Mapping[str, Callable[[Case], Answers]]] = {
    "changed_mounts": changed_mounts,
    "counterweight_optimum": counterweight_optimum,
    "exact_room": exact_room,
    "minicrank_torque": minicrank_torque,
    "oldham_force": oldham_force,
    "point_and_ring_sources": point_and_ring_sources,
    "scroll_gas": scroll_gas,
    "slider_link_invariants": slider_link_invariants,
    "sound_power_example": sound_power_example,
    "tone_audibility": tone_audibility,
}
"""Functions that answer a case, by the name of its folder."""


def submission(cases: Path) -> bytes:
    """Answer all cases; returns a CSV file with the columns case, key, unit and value.

    Parameters
    ----------
    cases : folder with a folder for each case
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["case", "key", "unit", "value"])
    for name, answers in ANSWERS.items():
        for answer in answers(read_case(cases / name)):
            writer.writerow([name, answer.key, answer.unit, f"{answer.value:.9g}"])
    return text.getvalue().encode()
