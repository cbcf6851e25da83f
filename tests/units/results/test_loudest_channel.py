"""The loudest channel and order of a recording, and the sentences that say so."""

import numpy as np
import pytest

import vibroacoustics as va
from vibroacoustics.levels import a_weighting
from vibroacoustics.report.recordings import analysis_of_orders
from vibroacoustics.report.run_up_tables import loudest_sentences
from vibroacoustics.results.over_speed.loudest_channel import loudest_channel, orders_at_speeds

RATE_HZ = 4096.0
TIME_S = np.arange(int(8.0 * RATE_HZ)) / RATE_HZ


def analysed(shaft_hz, peaks, units):
    """Orders 1 and 2 with given peaks on every channel, and the speed; analysed."""
    angle = 2.0 * np.pi * np.cumsum(shaft_hz) / RATE_HZ
    signal = [one * np.cos(angle) + two * np.cos(2.0 * angle) for one, two in peaks]
    names = [f"channel {number}" for number in range(len(peaks))]
    recording = va.label_recording(
        [*signal, 60.0 * shaft_hz], RATE_HZ, [*names, "speed"], [*units, "rpm"]
    )
    speed = va.SpeedChannel("speed")
    settings = va.OrderAnalysis(speed, (1.0, 2.0), with_map=None)
    return va.analyse_orders(recording, settings)


def level_db_a(peak_pa, frequency_hz):
    return 20.0 * np.log10(peak_pa / 2.0**0.5 / 20e-6) + a_weighting(np.array(frequency_hz)).item()


def test_the_loudest_channel_at_an_even_speed():
    """Order 2 is 6 dB below order 1 but less attenuated by the A-weighting."""
    steady = np.full(TIME_S.size, 25.0)
    orders = analysed(steady, [(1.0, 0.5), (1.0, 0.7), (0.2, 0.1)], ["Pa"] * 3)
    loudest = loudest_channel(orders_at_speeds(orders))
    parts_db = np.array([level_db_a(1.0, 25.0), level_db_a(0.7, 50.0)])
    assert loudest.curves.channel == "channel 1"
    assert loudest.order == 2.0
    assert loudest.order_db == pytest.approx(parts_db[1], abs=0.02)
    overall_db = 10.0 * np.log10(np.sum(10.0 ** (parts_db / 10.0)))
    assert loudest.overall_db == pytest.approx(overall_db, abs=0.05)
    words = loudest_sentences(loudest)
    assert words[0] == f"channel 1 is the loudest channel: {overall_db:.1f} dB(A) at 1500 rpm."
    assert words[1] == f"Its loudest order is 2×: {parts_db[1]:.1f} dB(A) at 1500 rpm (50 Hz)."
    assert words[2].startswith("The greatest levels of the 3 channels of sound pressure are ")
    assert words[2].endswith(f" to {overall_db:.1f} dB(A).")


def test_vibration_alone_has_an_order_and_no_overall_level():
    steady = np.full(TIME_S.size, 50.0)
    orders = analysed(steady, [(1.0, 0.5), (3.0, 0.1)], ["m/s²"] * 2)
    loudest = loudest_channel(orders_at_speeds(orders))
    assert loudest.overall_db is None
    assert loudest_sentences(loudest) == (
        "channel 1: the loudest order is 1×: 2.12 m/s² RMS at 3000 rpm (50 Hz).",
    )


def test_the_page_of_a_run_up_begins_with_the_answer_and_folds_long_tables():
    run_up = 20.0 + 4.0 * TIME_S
    peaks = [(0.5, 0.1 * number) for number in range(6)]
    page = analysis_of_orders(analysed(run_up, peaks, ["Pa"] * 6))
    assert page.summary[0].startswith("channel 5 is the loudest channel: ")
    assert page.summary[1].startswith("Its loudest order is 2×: ")
    assert [(part.name, part.folded) for part in page.parts] == [
        ("answer", False), ("map", False), ("figures", False), ("others", True), ("levels", False),
        ("orders", True), ("settings", False),
    ]  # fmt: skip
    assert page.parts[2].title == "Orders of channel 5"
    text = page.html().decode()
    assert text.index("is the loudest channel") < text.index("Interactive map")
    assert page.text().startswith("channel 5 is the loudest channel")
