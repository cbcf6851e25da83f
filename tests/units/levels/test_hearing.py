"""Threshold of hearing beside the average one of ISO 389-7, table 1, free field."""

import documents
import pytest
from evidence import claim

from vibroacoustics.levels.hearing import hearing_threshold_db

ISO_389_7 = {
    100.0: 26.5, 125.0: 22.1, 160.0: 17.9, 200.0: 14.4, 250.0: 11.4, 315.0: 8.6, 400.0: 6.2,
    500.0: 4.4, 630.0: 3.0, 800.0: 2.2, 1000.0: 2.4, 1250.0: 3.5, 1600.0: 1.7, 2000.0: -1.3,
    2500.0: -4.2, 3150.0: -6.0, 4000.0: -5.4, 5000.0: -1.5, 6300.0: 4.3,
}  # fmt: skip


@pytest.mark.parametrize(("hertz", "average_db"), ISO_389_7.items())
def test_the_lower_threshold_is_10_db_below_the_average(hertz, average_db):
    """That of the best ears, to 2 dB."""
    claim(
        f"Lower threshold of hearing at {hertz:g} Hz", kind="printed", unit="dB",
        source=documents.ISO_389_7("table 1, free field, less 10 dB"), tolerance=2.0,
        computed=hearing_threshold_db(hertz), reference=average_db - 10.0, topics=("receivers",),
    )  # fmt: skip


@pytest.mark.parametrize(
    ("hertz", "level_db"), [(167.5, 8.621226), (1157.5, -7.600754), (7250.0, -3.149339)]
)
def test_in_the_middle_of_a_range_it_is_the_constant_of_the_polynomial(hertz, level_db):
    assert hearing_threshold_db(hertz) == pytest.approx(level_db)


@pytest.mark.parametrize("edge_hz", [305.0, 2230.0])
def test_ranges_meet(edge_hz):
    below, above = (hearing_threshold_db(edge_hz + side) for side in (-1e-3, 0.0))
    assert below == pytest.approx(above, abs=0.05)
