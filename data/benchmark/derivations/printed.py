"""Printed examples, and what rounding leaves open."""

from collections.abc import Iterator
from math import log10, pi
from pathlib import Path

from .rows import Row, inputs, table


def sound_power_example(folder: Path) -> Iterator[Row]:
    """Printed test sheet of ISO 3744: levels by octave, total and A-weighted total."""
    given = inputs(folder)
    for row in table(folder):
        words = "printed to 0.1 dB, the pressure levels are rounded, too: 0.05 dB + 0.05 dB"
        printed = float(row["printed_power_level_db"])
        yield Row(f"sound power level, octave {row['octave_hz']} Hz", "dB", printed, 0.1, words)
    words = "printed to 0.1 dB: 0.05 dB, and as much for the rounding of its octaves"
    yield Row("sound power level", "dB", given["printed_total"], 0.1, words)
    yield Row("A-weighted sound power level", "dB", given["printed_a_weighted"], 0.1, words)
    words = "4 pi r^2/2 printed to 0.01 m2"
    area = given["printed_area"]
    yield Row("area of the hemisphere", "m2", area, 0.005, words)
    if abs(area - 2.0 * pi * given["radius"] ** 2) > 0.005:
        raise ValueError("the printed area is not that of the hemisphere")
    margin = given["background_margin"]
    words = "K1 = -10 lg(1 - 10^(-margin/10)); 0.01 dB"
    yield Row(
        "background correction K1", "dB", -10.0 * log10(1.0 - 10.0 ** (-margin / 10.0)), 0.01, words
    )
    words = "K2 = 10 lg(1 + 4 S/A); 0.01 dB"
    correction = 10.0 * log10(1.0 + 4.0 * area / given["absorption_area"])
    yield Row("environment correction K2", "dB", correction, 0.01, words)


def tone_audibility(folder: Path) -> Iterator[Row]:
    """Nine printed audibilities; the tolerance is what rounding of the printed numbers leaves open.

    Half a last digit of L_T, L_S and the result: 3 times 0.005 dB. The line spacing of 2.7 Hz is
    rounded from 2.6917 Hz (44.1 kHz over 16384 lines): 10 lg(2.7/2.6917) = 0.0134 dB.
    """
    spacing = 10.0 * log10(2.7 / (44100.0 / 16384.0))
    for row in table(folder):
        words = "printed; half a digit of L_T, L_S and the result, and of the line spacing"
        key, value = f"audibility at {row['frequency_hz']} Hz", float(row["printed_audibility_db"])
        yield Row(key, "dB", value, 0.015 + spacing, words)
