"""Beats as a listener would measure them: envelope of two lines of a recording."""

import numpy as np

NEAR = 2
"""Lines of the transform on both sides of a tone that its filter lets through."""


def measured_beat(
    sound: np.ndarray, rate_hz: float, first_hz: float, second_hz: float
) -> tuple[float, float, float]:
    """Frequency of the beat, largest and smallest envelope of two lines near two frequencies.

    Both pass through narrow filters; the squared envelope of what is left turns once a beat, and
    its phase advances from the first half of the sound to the second by the error of the expected
    frequency.
    """
    spectrum = np.fft.rfft(sound)
    seconds = sound.size / rate_hz
    middles = [round(hertz * seconds) for hertz in (first_hz, second_hz)]
    bins = np.unique([m + k for m in middles for k in range(-NEAR, NEAR + 1)])
    count = 64 * (bins[-1] - bins[0] + 1)
    shifted = np.zeros(count, dtype=complex)
    shifted[bins - bins[0]] = spectrum[bins]
    envelope = np.abs(np.fft.ifft(shifted)) * count * 2.0 / sound.size
    square = envelope**2 - np.mean(envelope**2)
    time, half = np.arange(count) * seconds / count, count // 2
    expected = abs(first_hz - second_hz)
    turned = square * np.exp(-2j * np.pi * expected * time)
    window = np.hanning(half)
    phases = [np.sum(window * turned[start : start + half]) for start in (0, half)]
    off_hz = np.angle(phases[1] / phases[0]) / (np.pi * seconds)
    return expected + off_hz, envelope.max(), envelope.min()
