"""Oldham ring and rotating set."""

import numpy as np
import pytest
from support import CRANK_ANGLE, machine_parts, turning

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.mechanics.moving_parts import wrench
from vibroacoustics.mechanisms.oldham_scroll.revolution import (
    counterweight,
    oldham_ring,
    rotating_set,
    two_plane_balance,
)
from vibroacoustics.orders import order_spectrum


def test_oldham_ring_slides_along_x(thesis_study):
    (ring,) = oldham_ring(thesis_study.machine, CRANK_ANGLE)
    assert ring.source == "oldham"
    assert ring.position_m[0, 0] == pytest.approx(6.75e-3)
    assert not ring.position_m[1].any()
    assert np.all(ring.position_m[2] == thesis_study.machine.oldham.height_m)


def test_sources_are_named_once(thesis_study):
    sources = [part.source for part in machine_parts(thesis_study)]
    assert sources == [
        "oldham", "orbiting_scroll", "crank_pin", "brake",
        "upper_counterweight", "lower_counterweight",
    ]  # fmt: skip


def test_orbiting_scroll_force(thesis_study):
    """1.2 kg on 6.75 mm at 3500 rpm: m r ω² = 1088.1 N, thesis (6.1)."""
    scroll = next(p for p in machine_parts(thesis_study) if p.source == "orbiting_scroll")
    force, _ = wrench([scroll], turning(3500.0 / 60.0))
    line = order_spectrum(force, 2)[:, 1]
    assert abs(line[0]) == pytest.approx(1088.1, abs=0.05)
    assert line[1] == pytest.approx(-1j * line[0], rel=1e-9)  # y follows x by 90°: anticlockwise


def test_radius_of_its_own(thesis_study):
    machine = thesis_study.machine
    brake = machine.brake.model_copy(update={"radius_m": 0.004})
    parts = rotating_set(machine.model_copy(update={"brake": brake}), CRANK_ANGLE)
    assert next(p for p in parts if p.source == "brake").position_m[0, 0] == pytest.approx(0.004)


def test_two_plane_balance_by_hand():
    """1 g m at 100 mm, planes at 50 and -50 mm: upper -1.5, lower +0.5 g m."""
    upper, lower = two_plane_balance([1e-3], [0.1], 0.05, -0.05)
    assert [upper, lower] == pytest.approx([-1.5e-3, 0.5e-3])


def test_counterweight_keeps_its_mass_moment():
    weight = counterweight("w", -1.5e-3, 0.025, 0.05, CRANK_ANGLE)
    assert weight.mass_kg == pytest.approx(0.06)
    assert weight.position_m[0, 0] == pytest.approx(-0.025)  # opposite the crank pin


def test_machine_without_a_brake(thesis_study):
    """The counterweights then balance scroll and pin alone."""
    bare = thesis_study.machine.model_copy(update={"brake": None, "turning_back": None})
    parts = rotating_set(bare, CRANK_ANGLE)
    assert [part.source for part in parts] == [
        "orbiting_scroll", "crank_pin", "upper_counterweight", "lower_counterweight",
    ]  # fmt: skip
    force, moment = wrench(parts, turning(50.0))
    largest = max(np.abs(part.mass_kg * part.position_m).max() for part in parts)
    rounding = 1e-9 * largest * (2.0 * np.pi * 50.0) ** 2
    assert np.abs(force).max() < rounding
    assert np.abs(moment).max() < rounding


def test_study_of_a_machine_without_a_brake(thesis_study):
    study = thesis_study.replace({"machine.without": ["brake", "turning_back"]})
    assert study.machine.brake is None
    assert not [record for record in study.records if record.field.startswith("brake.")]
    with pytest.raises(ParameterError, match="turning_back: needs the table brake"):
        thesis_study.replace({"machine.without": ["brake"]})
