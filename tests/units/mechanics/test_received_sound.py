"""What an insertion loss leaves of received lines and noise."""

import numpy as np
import pytest

from vibroacoustics.mechanics.added import InsertionLoss
from vibroacoustics.mechanics.loads import Lines
from vibroacoustics.mechanics.received_sound import NoisePower, ReceivedSound

SOUND = ReceivedSound(
    Lines(("order 0", "order 1", "motor: hum"), np.array([0.0, 50.0, 1000.0]), {}),
    np.full((2, 1, 3), 2.0 + 1.0j),
    (NoisePower(1, np.array([50.0, 1000.0]), np.array([[3.0, 5.0]])),),
)


def test_loss_lowers_pressure_and_power_in_its_bands_only():
    """6 dB in the third octave of 1 kHz: half the pressure, a quarter of the power, nearly."""
    left = SOUND.behind(InsertionLoss(np.array([1000.0]), np.array([20.0 * np.log10(2.0)])))
    assert left.pressure[0, 0] == pytest.approx((2.0 + 1.0j) * np.array([1.0, 1.0, 0.5]))
    (noise,) = left.noise
    assert noise.source == 1
    assert noise.power[0] == pytest.approx([3.0, 1.25])
    assert SOUND.pressure[0, 0, 2] == 2.0 + 1.0j


def test_without_a_loss_all_is_left():
    assert SOUND.behind(None) is SOUND
