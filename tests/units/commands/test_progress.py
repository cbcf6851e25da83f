"""Advance of long work: a bar on a terminal, a line a stage elsewhere."""

import io
import re
from contextlib import redirect_stderr

import pytest

from vibroacoustics.commands import cli, progress
from vibroacoustics.commands.progress import Lines


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def lines_of(*advance: tuple[float, str, int, int]) -> list[str]:
    """Lines of an advance: seconds, task, steps done, steps in all."""
    written: list[str] = []
    clock = iter([second for second, *_ in advance])
    lines = Lines(written.append, lambda: next(clock))
    for _, task, done, total in advance:
        lines(task, done, total)
    return written


def test_a_stage_has_one_line_with_its_seconds() -> None:
    assert lines_of((5.0, "forces", 0, 2), (7.0, "forces", 1, 2), (17.2, "forces", 2, 2)) == [
        "progress: forces: done in 12 s"
    ]


def test_a_short_stage_has_none() -> None:
    assert lines_of((5.0, "forces", 0, 2), (5.9, "forces", 2, 2), (9.0, "size", 1, 1)) == []


def test_a_long_stage_has_a_line_every_half_minute_with_what_remains() -> None:
    hour = [(float(second), "sources", second, 3600) for second in range(3601)]
    written = lines_of(*hour)
    assert written[0] == "progress: sources: 30 of 3600 after 30 s, ETA 3570 s"
    assert written[1] == "progress: sources: 60 of 3600 after 60 s, ETA 3540 s"
    assert written[-1] == "progress: sources: done in 3600 s"
    assert len(written) == 120


def test_stages_beside_each_other_and_one_that_comes_again() -> None:
    assert lines_of(
        (0.0, "a", 0, 4), (1.0, "b", 0, 2), (30.5, "b", 1, 2), (31.0, "a", 1, 4),
        (32.0, "b", 2, 2), (33.0, "b", 0, 2), (35.0, "b", 2, 2), (40.0, "a", 4, 4),
    ) == [
        "progress: a: 1 of 4 after 31 s, ETA 93 s",
        "progress: b: done in 31 s",
        "progress: b: done in 2 s",
        "progress: a: done in 40 s",
    ]  # fmt: skip


def test_lines_of_a_command_where_stderr_is_no_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(progress, "SHORTEST_S", 0.0)
    monkeypatch.setattr(cli, "app", run_two_stages)
    with redirect_stderr(io.StringIO()) as errors:
        cli.main()
    assert errors.getvalue() == ("progress: forces: done in 0 s\nprogress: sources: done in 0 s\n")


def run_two_stages() -> None:
    with progress.progress_on_stderr() as advance:
        for task in ("forces", "sources"):
            advance(task, 0, 1)
            advance(task, 1, 1)


def test_a_bar_on_a_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TERM", "xterm")
    with redirect_stderr(Terminal()) as errors:
        run_two_stages()
    shown = re.sub(r"\x1b\[[0-9;?]*[A-Za-z]", "", errors.getvalue())
    assert "forces" in shown
    assert "ETA" in shown
    assert "progress:" not in shown
