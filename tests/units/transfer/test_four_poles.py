"""Plane waves in pipes: closed forms of chamber and pipe, and what passes on."""

import numpy as np
import pytest
from documents import FORM
from evidence import claim

from vibroacoustics.transfer.four_poles import pipe, pressure_ratio, transmission_loss_db

DENSITY, SOUND = 112.0, 178.0
FREQUENCY = np.linspace(0.0, 4000.0, 301)


@pytest.mark.parametrize("expansion", [1.0, 4.0, 22.0, 0.3])
def test_expansion_chamber(expansion):
    """TL = 10 lg(1 + (m - 1/m)²/4 sin² kL), exact."""
    tube, length = 9e-5, 0.12
    poles = pipe(length, expansion * tube, DENSITY, SOUND, FREQUENCY)
    k = 2.0 * np.pi * FREQUENCY / SOUND
    closed = 1.0 + 0.25 * (expansion - 1.0 / expansion) ** 2 * np.sin(k * length) ** 2
    obtained = transmission_loss_db(poles, DENSITY * SOUND / tube)
    claim(
        f"Transmission loss of a chamber, expansion {expansion:g}", kind="exact", unit="dB",
        source=FORM("10 lg(1 + (m − 1/m)²/4 sin² kL)"), computed=obtained,
        reference=10.0 * np.log10(closed), tolerance=1e-9,
        topics=("discharge-pulsation", "discharge_muffler"),
    )  # fmt: skip


def test_a_pipe_without_reflection_only_delays():
    area, length = 9e-5, 0.3
    poles = pipe(length, area, DENSITY, SOUND, FREQUENCY)
    ratio = pressure_ratio(poles, DENSITY * SOUND / area)
    expected = np.exp(-2j * np.pi * FREQUENCY * length / SOUND)
    np.testing.assert_allclose(ratio, expected, atol=1e-9)


def test_pipes_in_a_row_are_one_and_reciprocal():
    one = pipe(0.5, 2e-4, DENSITY, SOUND, FREQUENCY)
    row = pipe(0.2, 2e-4, DENSITY, SOUND, FREQUENCY) @ pipe(0.3, 2e-4, DENSITY, SOUND, FREQUENCY)
    scale = np.array([[1.0, DENSITY * SOUND / 2e-4], [2e-4 / (DENSITY * SOUND), 1.0]])
    np.testing.assert_allclose(row / scale, one / scale, atol=1e-9)
    np.testing.assert_allclose(np.linalg.det(row), 1.0, atol=1e-9)
