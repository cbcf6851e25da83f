"""Ranking of a template's values: how far each is moved, and what that does."""

from math import log10
from pathlib import Path
from typing import Any

import pytest
from support import ROOT, made_up_radiation

from vibroacoustics import pipeline
from vibroacoustics.commands.example_values import count_lines, ranking, ranking_table
from vibroacoustics.design.example import Effect, Figures, moves_of, planned, ranked
from vibroacoustics.study.loading import load_study
from vibroacoustics.study.record import ParameterRecord
from vibroacoustics.study.study import Study

KEPT = {
    "oldham.mass_kg", "receivers.front_1m.y_mm", "options.counterweight-half.share_ratio",
    "scoring.measurable.level_db",
}  # fmt: skip
"""Values that stay the example's in the study of the tests."""


@pytest.fixture(scope="module")
def study() -> Study:
    study = load_study(ROOT / "pipelines" / "copeland_thesis.toml")
    records = tuple(
        record.model_copy(update={"example": record.field in KEPT}) for record in study.records
    )
    read = study._as_read()
    only_kept = study.model_copy(update={"records": records})
    return only_kept.remember(*read)


@pytest.fixture(scope="module")
def effects(study: Study) -> list[Effect]:
    return ranked(planned(study, made_up_radiation), radiation=made_up_radiation)


def record(value: str, unit: str, *limits: float, field: str = "a.b") -> ParameterRecord:
    lowest, highest = limits or (None, None)
    return ParameterRecord(
        file="machine.toml", field=field, value=value, unit=unit, source="x",
        lowest=lowest, highest=highest, example=True,
    )  # fmt: skip


@pytest.mark.parametrize(
    ("value", "ends"),
    [
        (record("35", "kg", 28.0, 40.0), [28.0, 40.0]),
        (record("35", "kg", 28.0, 35.0), [28.0]),
        (record("35", "kg"), [28.0, 42.0]),
        (record("-50", "µm"), [-40.0, -60.0]),
        (record("[1, -2]", "mm", -5.0, 5.0), [[0.8, -1.6], [1.2, -2.4]]),
        (record("56", "dB(A)"), [56.0 - 20.0 * log10(1.2), 56.0 + 20.0 * log10(1.2)]),
        (record("0", "mm"), []),
        (record("forces.csv", ""), []),
        (record("True", ""), []),
        (record("0.5", "dB", 0.2, 1.5, field="scoring.measurable.level_db"), []),
    ],
)
def test_moves(value: ParameterRecord, ends: list[Any]) -> None:
    moves = [move.value for move in moves_of(value)]
    assert moves == [pytest.approx(end) for end in ends]


def test_force_of_a_mass_is_in_proportion(effects: list[Effect]) -> None:
    """The ring's force is m r ω², and all that sounds at first order goes with it."""
    (ring,) = (effect for effect in effects if effect.record.field == "oldham.mass_kg")
    assert ring.ends == pytest.approx((0.8 * 0.0727, 1.2 * 0.0727))
    speed = 2.0 * 3.141592653589793 * 2900.0 / 60.0
    force_n = 0.0727 * 6.75e-3 * speed**2
    for sign, change in zip((-1.0, 1.0), ring.changes, strict=True):
        assert isinstance(change, Figures)
        assert change.force_1x_n == pytest.approx(sign * 0.2 * force_n, rel=1e-6)
        assert change.modelled_dba == pytest.approx(20.0 * log10(1.0 + sign * 0.2), abs=1e-6)
        assert change.total_dba == pytest.approx(0.0, abs=0.01)  # that of the published level


def test_changes_are_those_of_whole_runs(study: Study, effects: list[Effect]) -> None:
    key = "options.counterweight-half.share_ratio"
    (effect,) = (effect for effect in effects if effect.record.field == key)
    levels = []
    for value in (0.5, *effect.ends):
        results = pipeline.run(study.replace({key: value}), radiation=made_up_radiation)
        at = {"option": "counterweight-half", "receiver": "front_1m", "speed": 2900.0}
        levels.append(float(results["level_modelled"].sel({**at, "weighting": "A"})))
    seen = [change.modelled_dba for change in effect.changes if isinstance(change, Figures)]
    assert seen == pytest.approx([level - levels[0] for level in levels[1:]], abs=1e-9)
    assert abs(seen[0]) > 0.1


def test_order_and_tables(study: Study, effects: list[Effect]) -> None:
    """The radiation is made up: a microphone's position changes nothing; scores are not moved."""
    fields = [effect.record.field for effect in effects]
    assert set(fields[:2]) == {"oldham.mass_kg", "options.counterweight-half.share_ratio"}
    assert fields[2:] == ["receivers.front_1m.y_mm", "scoring.measurable.level_db"]
    ranks = [effect.rank for effect in effects]
    assert ranks == sorted(ranks, reverse=True)
    plan = planned(study, made_up_radiation)
    assert (len(plan.moves), plan.radiations) == (6, 2)
    table = ranking_table(effects)
    assert table["field"] == [fields[0]] * 2 + [fields[1]] * 2 + [fields[2]] * 2 + [fields[3]]
    assert table["change_modelled_dba"][-1] is None
    text = "\n".join(ranking(plan, effects))
    assert "oldham.mass_kg" in text
    assert "2900 rpm" in text


def test_refused_values_are_ranked_last(tmp_path: Path) -> None:
    refused = Effect(record("1", "m"), (0.8,), ("must be 1",))
    still = Effect(record("1", "m"), (0.8,), (Figures(0.0, 0.0, 0.0),))
    assert refused.rank < still.rank


def test_count_of_a_study(study: Study) -> None:
    (line,) = count_lines(study)
    assert f"4 of {len(study.records)} values that this study reads are the example's." in line
