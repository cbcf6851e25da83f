"""The machine on its mounts: special cases that can be worked out by hand."""

import numpy as np
import pytest

from vibroacoustics.machine.feet import FOOT_NAMES, Mounts
from vibroacoustics.machine.housing import Housing
from vibroacoustics.transfer import MachineOnMounts


@pytest.fixture
def body() -> MachineOnMounts:
    """35 kg on four grommets of 20 / 50 N/mm, their plane through the centre of mass."""
    housing = Housing(
        mass_kg=35.0, inertia_xx_kg_m2=0.57, inertia_yy_kg_m2=0.57, inertia_zz_kg_m2=0.12
    )
    mounts = Mounts(
        pitch_m=0.2,
        lateral_stiffness_n_per_m=2e4,
        vertical_stiffness_n_per_m=5e4,
        loss_factor_ratio=0.1,
    )
    return MachineOnMounts(housing, mounts, 0.0)


def test_foot_names_tell_their_places(body):
    for name, (x, y, _) in zip(FOOT_NAMES, body.foot_position, strict=True):
        assert ("front" in name) == (x > 0.0)
        assert ("left" in name) == (y > 0.0)


def test_frequencies_by_hand(body):
    """Uncoupled: √(4k/m), √(4 k_z a²/I), √(4 · 2 k a²/I_z) with a = 0.1 m."""
    by_hand = np.sqrt(
        [4 * 2e4 / 35] * 2 + [4 * 5e4 / 35] + [4 * 5e4 * 0.01 / 0.57] * 2 + [8 * 2e4 * 0.01 / 0.12]
    ) / (2.0 * np.pi)
    frequencies, _ = body.isolation.natural_modes()
    np.testing.assert_allclose(frequencies, np.sort(by_hand), rtol=1e-12)


def test_static_vertical_load_spreads_over_the_feet(body):
    force = body.response(np.array([0, 0, 100.0, 0, 0, 0], complex), 0.0).foot_force
    np.testing.assert_allclose(force, [[0, 0, 25.0]] * 4, atol=1e-12)


def test_static_rocking_moment(body):
    """20 N m about y: the front feet are pushed down, 20 / (4 · 0.1) = 50 N each."""
    force = body.response(np.array([0, 0, 0, 0, 20.0, 0], complex), 0.0).foot_force
    np.testing.assert_allclose(force[:, 2], [-50, -50, 50, 50], rtol=1e-12)


def test_bounce_is_a_single_degree_of_freedom(body):
    """F_foot/F = k'/(k' - ω²m), complex stiffness k' = 4k(1 + jη)."""
    for frequency in (5.0, 12.0, 48.33, 200.0):
        omega = 2.0 * np.pi * frequency
        stiffness = 4 * 5e4 * (1 + 0.1j)
        force = body.response(np.array([0, 0, 1.0, 0, 0, 0], complex), frequency).foot_force
        expected = stiffness / (stiffness - omega**2 * 35.0)
        assert force[:, 2].sum() == pytest.approx(expected, rel=1e-12)


def test_velocity_at_resonance_is_limited_by_the_loss_factor(body):
    """At ω0: v = F / (m ω0 η) in phase with the force."""
    omega = np.sqrt(4 * 5e4 / 35.0)
    velocity = body.response(
        np.array([0, 0, 1.0, 0, 0, 0], complex), omega / (2.0 * np.pi)
    ).velocity
    assert velocity[2] == pytest.approx(1.0 / (35.0 * omega * 0.1), rel=1e-9)


def test_low_mounts_couple_sway_and_rock(thesis_study):
    machine = thesis_study.machine
    body = MachineOnMounts(machine.housing, machine.mounts, -0.19)
    stiffness = body.isolation.stiffness_matrix
    # A sway of +x about mounts 0.19 m below: moment about y of 0.19 · 80 N/mm.
    assert stiffness[0, 4] == pytest.approx(-0.19 * 8e4, rel=1e-12)
    assert stiffness[1, 3] == pytest.approx(0.19 * 8e4, rel=1e-12)
    assert stiffness[2, 5] == 0.0
    np.testing.assert_allclose(stiffness, stiffness.T, atol=1e-9)
    assert np.all(np.linalg.eigvalsh(stiffness) > 0.0)


def test_symmetric_machine_moves_alike_in_x_and_y(thesis_study):
    machine = thesis_study.machine
    body = MachineOnMounts(machine.housing, machine.mounts, -0.19)
    along = body.response(np.array([1.0, 0, 0, 0, 0.1, 0], complex), 58.0).velocity
    across = body.response(np.array([0, 1.0, 0, -0.1, 0, 0], complex), 58.0).velocity
    np.testing.assert_allclose(along[[0, 4]], across[[1, 3]] * [1, -1], rtol=1e-12)
