"""Hammer tests from time records: exact truth, faults of hits and of windows."""

import hammer_records as bench
import numpy as np
import pytest

import vibroacoustics as va
from vibroacoustics.measured.hammer_hits import hits_of, longest_block, pulses
from vibroacoustics.measured.hammer_responses import block_ending, estimates, window_constant_s
from vibroacoustics.recordings.functions import read_functions
from vibroacoustics.recordings.remarks import RecordingWarning

HITS = 10


def of_point(folder, signals, extra=""):
    """Test of one point, a file for each signal."""
    for number, signal in enumerate(signals):
        bench.write_record(signal, folder / f"record_{number}.csv")
    text = bench.SETTINGS.replace('"hammer"\n', f'"hammer"\n{extra}')
    path = folder / "hammer.toml"
    path.write_text(text + '"record_*.csv" = { node = 1, direction = "+z" }\n')
    return va.hammer_test(path)


def ratio_to_truth(pair):
    h1 = pair.h1
    truth = bench.accelerance(h1.response.number - 1, h1.reference.number - 1, h1.frequency_hz)
    return h1.values / truth


def test_functions_are_those_of_the_structure(tmp_path):
    found = va.hammer_test(bench.write(tmp_path, HITS))
    assert found.faults == found.remarks == ()
    assert [str(pair.h1) for pair in found.pairs] == [
        f"frequency response {response}+z/{hit}+z" for hit in (1, 2) for response in (1, 2)
    ]
    for pair in found.pairs:
        good = pair.coherence > 0.95
        assert pair.hits == HITS
        assert good.mean() > 0.8
        # Bendat and Piersol, Random Data, 9.2.3: standard error of H1 by coherence.
        error = np.sqrt((1.0 - pair.coherence) / (pair.coherence * HITS))[good]
        deviation = ratio_to_truth(pair)[good] - 1.0
        # Of ten hits it is itself uncertain: mean squares of the ratio are 9/8 · 10/9 and more.
        assert 1.0 < np.mean(np.abs(deviation / error) ** 2) < 2.0
        # Of lines of this error at most exp(-2.5²) = 0.2 % are beyond 1 %, which is 0.6° too.
        certain = error < 0.004
        assert certain.sum() > 100
        assert np.quantile(np.abs(deviation[certain]), 0.98) < 0.01
        weighted = np.sum(deviation / error**2) / np.sum(1.0 / error**2)
        assert abs(weighted) < 0.001 + 3.0 / np.sqrt(np.sum(1.0 / error**2))


def test_functions_without_noise_are_exact(tmp_path):
    signals = [bench.hit_record(0, seed, seconds=3.0, noise=0.0) for seed in (1, 2)]
    for pair in of_point(tmp_path, signals).pairs:
        truth = pair.h1.values / ratio_to_truth(pair)
        # Without an anti-aliasing filter the pulse's spectrum beyond the sample rate is 1e-3.
        assert np.abs(pair.h1.values - truth).max() < 1e-3 * np.abs(truth).max()
        high = np.abs(truth) > 0.1 * np.abs(truth).max()
        assert pair.coherence[high].min() > 1.0 - 1e-5


def test_h1_h2_and_coherence_by_hand():
    force = np.array([[1.0 + 0j], [2.0]])
    response = np.array([[2j], [6j]])
    found = estimates(force, response)
    assert found.h1[0] == pytest.approx(14j / 5.0)
    assert found.h2[0] == pytest.approx(40.0 / -14j)
    assert found.coherence[0] == pytest.approx(14.0**2 / (5.0 * 40.0))
    assert found.scatter[0] == pytest.approx(0.5**0.5 / 2.8)


def seconds_of(signal):
    found = pulses(signal[0])
    return [hit.second for hit in hits_of(found, longest_block(found, signal.shape[1], bench.RATE))]


def test_double_hits_are_found():
    for seed in range(20):
        rng = np.random.default_rng(1000 + seed)
        second, gap_s = rng.uniform(0.1, 0.9), rng.uniform(0.006, 0.15)
        (found,) = seconds_of(bench.hit_record(0, seed, seconds=0.5, second=second, gap_s=gap_s))
        assert found == pytest.approx(second, abs=0.06)


def test_clean_hits_are_not_double():
    for seed in range(100):
        noise = (0.0, 0.01, 0.03, 0.1)[seed % 4]
        assert seconds_of(bench.hit_record(0, 5000 + seed, seconds=0.5, noise=noise)) == [0.0]


def test_bad_hits_are_left_out_by_name(tmp_path):
    signals = [bench.hit_record(0, seed) for seed in range(6)]
    signals[1] = bench.hit_record(0, 1, second=0.4)
    signals[2][0] = np.minimum(signals[2][0], 0.8 * signals[2][0].max())
    largest = 0.7 * np.abs(signals[3][2]).max()
    signals[3][2] = np.clip(signals[3][2], -largest, largest)
    signals[4] = bench.hit_record(0, 4, begin_s=0.001)
    with pytest.warns(RecordingWarning, match="full scale"):
        found = of_point(tmp_path, signals)
    omitted = [hit.omitted.split(",")[0] for hit in found.hits]
    assert omitted == ["", "double hit", "overload of the force", "overload of a2",
                       "record begins in the hit", ""]  # fmt: skip
    assert [pair.hits for pair in found.pairs] == [3, 2]


def test_hits_of_one_long_record_are_told_apart(tmp_path):
    parts = [bench.hit_record(0, seed, begin_s=0.3) for seed in range(6)]
    parts[3] = bench.hit_record(0, 3, begin_s=0.3, second=0.4, gap_s=0.25)
    found = of_point(tmp_path, [np.concatenate(parts, axis=1)])
    assert [bool(hit.omitted) for hit in found.hits] == [False] * 3 + [True] + [False] * 2
    for pair in found.pairs:
        weak = np.sqrt((1.0 - pair.coherence) / (5.0 * pair.coherence)) > 0.003
        assert np.quantile(np.abs(ratio_to_truth(pair)[~weak] - 1.0), 0.95) < 0.01


def test_a_pulling_force_channel_is_reversed_and_named(tmp_path):
    signals = [bench.hit_record(0, seed) * np.array([[-1.0], [1.0], [1.0]]) for seed in (0, 1)]
    found = of_point(tmp_path, signals)
    assert found.remarks[0].startswith("force pulls in record_0.csv, record_1.csv")
    assert np.median(ratio_to_truth(found.pairs[0]).real) == pytest.approx(1.0, abs=0.01)


def test_short_windows_are_named_with_the_length_that_they_need(tmp_path):
    found = of_point(tmp_path, [bench.hit_record(0, seed, seconds=0.6) for seed in range(3)])
    assert len(found.faults) == 1
    assert found.faults[0].startswith("hits at 1+z: blocks of 0.5")
    needed_s = float(found.faults[0].split("record ")[1].split(" s")[0])
    # 38 Hz at a damping of 2 % falls to 1 % in ln(100) / (0.02 · 2π · 38 Hz).
    assert needed_s == pytest.approx(np.log(100.0) / (0.02 * bench.NATURAL[0]), rel=0.1)


def test_block_ending_is_the_decay_of_the_slowest_mode():
    time = np.arange(4096) / 4096.0
    fast = np.exp(-30.0 * time) * np.sin(2.0 * np.pi * 400.0 * time)
    slow = 0.2 * np.exp(-3.0 * time) * np.sin(2.0 * np.pi * 60.0 * time)
    noise = 1e-4 * np.random.default_rng(0).normal(size=(3, 4096))
    share, frequency_hz = block_ending(fast + slow + noise, 4096.0)
    assert share == pytest.approx(np.exp(-3.0), rel=0.02)
    assert frequency_hz == pytest.approx(60.0, abs=2.0)


def test_window_of_the_recorder_is_named_and_corrected(tmp_path):
    signals = [bench.hit_record(0, seed) for seed in range(3)]
    window = np.exp(-np.arange(signals[0].shape[1]) / bench.RATE / 0.4)
    for signal in signals:
        signal[1:] *= window
    found = of_point(tmp_path, signals)
    assert "exponential window of about 0.4 s" in found.faults[0]
    corrected = of_point(tmp_path, signals, "recorder_window_s = 0.4\n")
    assert corrected.faults == ()
    at_peak = np.argmin(np.abs(corrected.pairs[0].h1.frequency_hz - 38.0))
    assert ratio_to_truth(found.pairs[0])[at_peak].real < 0.6
    assert ratio_to_truth(corrected.pairs[0])[at_peak].real == pytest.approx(1.0, abs=0.02)


def test_no_window_is_seen_in_steady_noise():
    noise = np.random.default_rng(0).normal(size=(200, 8192))
    assert not any(window_constant_s(each, 40, bench.RATE) for each in noise)


def test_other_commands_read_the_functions(tmp_path):
    found = va.hammer_test(bench.write(tmp_path))
    for name in ("functions.uff", "functions.csv"):
        path = va.export_functions(found.functions, tmp_path / name)
        read = read_functions(path)
        assert [str(each) for each in read] == [str(each) for each in found.functions]
        for each, written in zip(read, found.functions, strict=True):
            np.testing.assert_allclose(each.values, written.values, rtol=1e-12)


@pytest.mark.parametrize(
    ("old", "new", "line"),
    [
        ('1, direction = "+z" }\n"rec', '1 }\n"rec', r"hits.record_1_\*.csv.direction: is missing"),
        ("record_1_", "records_", r"hits.records_\*.csv: is the name of no file"),
        ('force_channel = "hammer"', 'force_channel = "a1"', "responses.a1: is the channel of"),
        ("a2 = {", "a3 = {", "a3"),
    ],
)
def test_wrong_settings_are_refused(tmp_path, old, new, line):
    path = bench.write(tmp_path, 1)
    path.write_text(path.read_text().replace(old, new, 1))
    with pytest.raises(va.ParameterError, match=line):
        va.hammer_test(path)
