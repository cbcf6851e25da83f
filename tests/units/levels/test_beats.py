"""Beats: which lines, and the levels of sums of phasors by every relative phase."""

import numpy as np
import pytest

from vibroacoustics.levels.beats import (
    MachineLine,
    beats,
    envelope_maximum,
    envelope_minimum,
    groups,
)

PA = np.array([0.3 + 0.1j, -0.05 + 0.2j, 0.02j])


def orders(machine: str, rpm: float, highest: int = 17) -> list[MachineLine]:
    return [MachineLine(machine, n, n * rpm / 60.0) for n in range(1, highest + 1)]


def test_orders_1_to_15_of_2900_and_2880_rpm_beat():
    """Order 15 beats at 5.0 Hz, to rounding; order 16 would at 5.33 Hz."""
    lines = orders("a", 2900.0) + orders("b", 2880.0)
    pairs = beats(lines)
    assert [lines[pair.first].order for pair in pairs] == [*range(1, 16)]
    assert [lines[pair.second].order for pair in pairs] == [*range(1, 16)]
    each = np.array([pair.frequency_hz for pair in pairs])
    assert each == pytest.approx(np.arange(1, 16) / 3.0, abs=1e-12)


def test_order_2_of_one_beats_with_order_1_of_another_at_twice_the_speed():
    lines = orders("slow", 1440.0, 2) + orders("fast", 2900.0, 1)
    assert [(lines[a].order, lines[b].order) for a, b, _ in beats(lines)] == [(2, 1)]


def test_tones_and_lines_of_one_machine_do_not_beat():
    lines = [MachineLine("a", 0, 100.0), MachineLine("b", 2, 100.5), MachineLine("a", 2, 101.0)]
    assert [(a, b) for a, b, _ in beats(lines)] == [(1, 2)]


def test_lines_that_beat_with_one_another_are_one_group():
    lines = [*orders("a", 2900.0, 1), *orders("b", 2880.0, 1), *orders("c", 2600.0, 2)]
    lines += orders("d", 2650.0, 1)
    assert sorted(groups(len(lines), beats(lines))) == [[0, 1, 2, 4], [3]]


def test_extremes_are_those_over_all_relative_phases():
    turn = np.exp(1j * np.linspace(0.0, 2.0 * np.pi, 721))
    sums = np.abs(PA[0] + PA[1] * turn)
    assert envelope_maximum(PA[:2]) == pytest.approx(sums.max(), rel=1e-5)
    assert envelope_minimum(PA[:2]) == pytest.approx(sums.min(), rel=1e-4)
    assert envelope_minimum(np.array([0.2, 0.1, 0.15])) == 0.0


def test_axes():
    table = np.array([PA, 2.0 * PA])
    for extreme in (envelope_maximum, envelope_minimum):
        assert extreme(table, axis=-1) == pytest.approx(np.array([extreme(row) for row in table]))
