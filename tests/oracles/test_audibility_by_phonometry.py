"""Audibility of tones against phonometry, a second implementation of ISO/PAS 20065.

It needs Python 3.13; the variable PHONOMETRY_PYTHON names the interpreter of an environment
that holds it.
"""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from scipy import signal

from vibroacoustics.base.weighting import a_weighting
from vibroacoustics.sound.audibility import tonal_adjustment_db
from vibroacoustics.sound.audible_tones import audible_tones
from vibroacoustics.sound.mean_audibility import decisive_tone, mean_of_spectra, narrow_band_levels

RATE_HZ = 32000.0
SECONDS = 12.0
RATER = Path(__file__).parents[1] / "helpers" / "rated_by_phonometry.py"
INTERPRETER = os.environ.get("PHONOMETRY_PYTHON", "")


def sounds():
    """Forty sounds: one to five tones in white, pink or low noise; steady, trembling or pausing."""
    rng = np.random.default_rng(20065)
    time = np.arange(round(SECONDS * RATE_HZ)) / RATE_HZ
    made = []
    for number in range(40):
        noise = rng.standard_normal(time.size)
        colour = number % 3
        if colour:
            corner_hz = (0.0, 300.0, 1500.0)[colour]
            noise = signal.sosfilt(signal.butter(1, corner_hz, fs=RATE_HZ, output="sos"), noise)
        pressure = 0.02 * noise / np.std(noise)
        frequency_hz = np.exp(rng.uniform(np.log(80.0), np.log(6000.0), 1 + number % 5))
        for tone_hz in frequency_hz:
            phase = 2.0 * np.pi * tone_hz * time + rng.uniform(0.0, 6.28)
            if number % 7 == 3:
                phase += 0.5 * np.sin(2.0 * np.pi * 1.5 * time)
            tone = 10.0 ** rng.uniform(-3.5, -1.9) * np.sin(phase)
            if number % 6 == 4:
                tone = tone * (1.0 + 0.6 * np.sin(2.0 * np.pi * 0.7 * time))
            if number % 10 == 9:
                tone = tone * (time % 4.0 < 2.5)
            pressure = pressure + tone
        made.append(pressure)
    return made


def own_levels(pressure):
    """A-weighted narrow-band spectra of 3 s by plain transforms of Hann windows."""
    length = 2 * round(0.5 * RATE_HZ / 2.7)
    window = signal.get_window("hann", length)
    blocks = pressure.reshape(4, -1)
    frequency_hz = np.fft.rfftfreq(length, 1.0 / RATE_HZ)
    square = []
    for block in blocks:
        starts = range(0, block.size - length + 1, length // 2)
        parts = [block[s : s + length] for s in starts]
        lines = [np.fft.rfft(window * (part - part.mean())) for part in parts]
        square.append(2.0 * np.mean(np.abs(lines) ** 2, axis=0) / np.sum(window) ** 2)
    level = 10.0 * np.log10(np.maximum(square, 1e-30) / 4e-10)
    judged = (frequency_hz > 0.0) & (frequency_hz < 13000.0)
    return frequency_hz[judged], level[:, judged] + a_weighting(frequency_hz[judged])


def test_spectra_are_those_of_plain_transforms():
    pressure = sounds()[4]
    frequency_hz, level_db = narrow_band_levels(pressure, RATE_HZ)
    own_hz, own_db = own_levels(pressure)
    assert own_hz[: frequency_hz.size] == pytest.approx(frequency_hz)
    assert level_db == pytest.approx(own_db[:, : frequency_hz.size], abs=1e-6)


@pytest.mark.skipif(not INTERPRETER, reason="PHONOMETRY_PYTHON names no interpreter")
def test_forty_sounds_are_rated_as_by_phonometry():
    spectra = [own_levels(pressure) for pressure in sounds()]
    asked = [
        {"step_hz": hertz[1] - hertz[0], "frequency_hz": hertz.tolist(), "level_db": db.tolist()}
        for hertz, db in spectra
    ]
    done = subprocess.run(
        [INTERPRETER, RATER], input=json.dumps(asked), stdout=subprocess.PIPE, text=True,
        check=True, env={"PATH": os.environ["PATH"]}, timeout=900,
    )  # fmt: skip
    theirs = json.loads(done.stdout)
    ours = [
        mean_of_spectra([decisive_tone(audible_tones(row, hertz)) for row in db]).audibility_db
        for hertz, db in spectra
    ]
    other = np.array([rated["mean_db"] for rated in theirs])
    difference = np.abs(np.array(ours) - other)
    same = tonal_adjustment_db(np.array(ours)) == [rated["adjustment_db"] for rated in theirs]
    print(
        f"largest difference {difference.max():.3f} dB, adjustments equal {same.sum()} of 40, "
        f"audible {np.sum(other > 0.0)}",
        file=sys.stderr,
    )
    assert difference.max() <= 0.5
    assert same.sum() >= 38
    assert np.sum(other > 0.0) >= 20
