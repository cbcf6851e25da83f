"""First screens of five kinds of study, kept as text: a change of what is said first is seen.

`WRITE_FIRST_SCREENS=1 pytest tests/report/test_first_screens.py` writes the texts anew.
"""

import os
from functools import partial

import numpy as np
import pytest
import xarray as xr
from kept_results import kept
from rooms_made_up import KITCHEN, made_up_vectors
from sources_study import SOURCES_STUDY, run_made_up, sources_run
from support import PIPELINES, ROOT, TINY, made_up_radiation

import vibroacoustics as va
from vibroacoustics.report.blocks import Intervals
from vibroacoustics.report.sections.verdict import words as first_screen
from vibroacoustics.results.titles import titled
from vibroacoustics.stages import room as room_stage

TEXTS = ROOT / "tests" / "report" / "first_screens"
OWN_MACHINE = {
    "machine.without": ["frame", "overall_noise"],
    "catalogue_receiver": None,
    **{f"sources.{name}": None for name in ("keys", "torque_ripple", "motor")},
    "options.twin-oldham": None,
    "operation.stopping": False,
    "operation.supply_frequency_hz": None,
    "radiation.maximum_frequency_hz": 1500.0,
    "uncertainty.random_samples": 20,
}
"""Without a published level, and with gas alone."""


def rigid():
    study = va.load_study(PIPELINES / "copeland_thesis.toml")
    return va.run(study, radiation=made_up_radiation)


def room():
    def vectors(study, settings, motions, progress):
        highest_hz = study.radiation.maximum_frequency_hz
        return made_up_vectors(settings.listeners, motions, highest_hz=highest_hz), False

    level = va.stamp(
        "room_map_level",
        np.full((2, 2), 40.0),
        {"room_map_y": [1.0, 2.0], "room_map_x": [1.0, 2.0]},
    )
    level.attrs |= {"speed_rpm": 2900.0, "height_m": 1.2, "highest_band_hz": 800.0}
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(room_stage, "vectors_of", vectors)
        patch.setattr(room_stage, "_map", lambda *_: xr.Dataset({"room_map_level": level}))
        title = {"options.counterweight-half.title": "half-force counterweight"}
        study = va.load_study(TINY).replace({"room": KITCHEN, **title})
        return va.run(study, radiation=made_up_radiation)


def table():
    study = va.load_study(PIPELINES / "reciprocating_table.toml")
    return va.run(study, radiation=made_up_radiation)


def own_machine():
    return run_made_up(va.load_study(SOURCES_STUDY).replace(OWN_MACHINE))


KINDS = {
    "rigid": partial(kept, "first_screen_rigid", rigid),
    "sources": sources_run,
    "room": partial(kept, "first_screen_room", room),
    "table": partial(kept, "first_screen_table", table),
    "own_machine": partial(kept, "first_screen_own_machine", own_machine),
}


def chart(block: Intervals) -> list[str]:
    rows = [f"- {row.name}: {row.text} ({row.word})" for row in block.rows]
    return ["", block.caption, *rows, block.note]


def text_of(results: xr.Dataset) -> str:
    results = titled(results)
    changes = first_screen.changes(results)
    lines = [*first_screen.sentences(results), *chart(first_screen.contributions(results))]
    return "\n".join([*lines, *(chart(changes) if changes else [])]) + "\n"


@pytest.mark.parametrize("kind", KINDS)
def test_the_first_screen_is_the_one_that_is_kept(kind):
    text, path = text_of(KINDS[kind]()), TEXTS / f"{kind}.txt"
    if os.environ.get("WRITE_FIRST_SCREENS"):
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, "utf-8")
    assert text == path.read_text("utf-8")
    sentences = text.partition("\n\n")[0]
    assert len(sentences.split()) <= 90
    assert len(sentences.splitlines()) <= 6
