"""Lines of `check` on the values that a study still has of its template."""

from collections.abc import Iterator, Sequence
from typing import Any, Final

from ..base.threads import processors
from ..design.example import LEVEL_DB, SHARE, Effect, Figures, Plan
from ..report.tables import Table, to_text
from ..study.example import example_sentence
from ..study.study import Study
from .messages import inform
from .outcome import columns
from .summary import span

_NOTHING: Final = "-"
_REFUSED: Final = "refused"


def count_lines(study: Study) -> Iterator[str]:
    """Count the example's values that the study reads, and name stale sources."""
    examples = sum(record.example for record in study.records)
    sentence = example_sentence(examples, len(study.records))
    if sentence:
        yield f"example: {sentence} `check --example` lists and ranks them"
    stale = [record.field for record in study.records if record.stale]
    if stale:
        yield (
            "example: values were changed whose sources are still the example's; write yours: "
            f"{', '.join(stale)}"
        )


def show_price(plan: Plan) -> None:
    """Say what the ranking costs, before it begins."""
    cores = processors()
    inform(
        f"price: {len(plan.moves)} runs in the coarse setting, {plan.radiations} of them with a "
        f"radiation of their own: {span(plan.low_s, plan.high_s)} of processor time, "
        f"{span(plan.low_s / cores, plan.high_s / cores)} on {cores} idle cores; Ctrl-C ends it"
    )


def ranking(plan: Plan, effects: Sequence[Effect]) -> Iterator[str]:
    """Table of the example's values, those that change the level most first."""
    receiver = plan.study.catalogue_receiver
    caption = (
        f"Changes at {receiver} and {plan.speed_rpm:g} rpm by the example's values, each moved "
        "alone"
    )
    head = ("Value", "Is", "Moved to", "Total, dB", "Modelled, dB", "1x force, N")
    yield to_text(Table(caption, head, tuple(map(_cells, effects)), frozenset({0, 1, 2})))
    yield (
        f"A value is moved to the ends of its range, else by {100.0 * SHARE:g} %, a level by "
        f"{LEVEL_DB:.1f} dB. Nothing is sampled. A published level fixes the total, not the "
        "modelled level. Names of files are not moved. Values of an option or of a microphone "
        "have their changes with this option or at this microphone."
    )


def _cells(effect: Effect) -> tuple[str, ...]:
    record = effect.record
    ends = [_short(end) for end in effect.ends]
    changes = [
        [_REFUSED if isinstance(change, str) else f"{change[figure]:+.2f}" for change in
         effect.changes]
        for figure in range(len(Figures._fields))
    ]  # fmt: skip
    value = f"{_short(record.value)} {record.unit}".rstrip()
    return record.field, value, *(" / ".join(each) or _NOTHING for each in (ends, *changes))


def _short(value: Any) -> str:
    """Return a number or a word; of a list that there is one."""
    text = f"{value:.6g}" if isinstance(value, float) else str(value)
    return "list" if text.startswith("[") else text


def ranking_table(effects: Sequence[Effect]) -> dict[str, list[Any]]:
    """Columns of the ranking for programs: a row a move, or a value that is not moved."""
    rows = []
    for rank, effect in enumerate(effects, 1):
        record = effect.record.model_dump(include={"field", "value", "unit", "source", "file"})
        for end, change in zip(effect.ends or [None], effect.changes or [""], strict=True):
            figures = change._asdict() if isinstance(change, Figures) else {}
            rows.append({
                "rank": rank,
                **record,
                "moved_to": str(end) if isinstance(end, list) else end,
                **{f"change_{name}": figures.get(name) for name in Figures._fields},
                "refused": change if isinstance(change, str) else "",
            })  # fmt: skip
    return columns(rows)
