"""Time records of a hammer test whose truth is exact: modes under pulses of sin²."""

from pathlib import Path

import numpy as np

import vibroacoustics as va

RATE = 4096.0
NATURAL = 2.0 * np.pi * np.array([38.0, 95.0, 171.0, 260.0, 402.0, 555.0])
DAMPING = np.array([0.02, 0.012, 0.01, 0.01, 0.012, 0.015])
SHAPES = np.array([[0.5, 0.4, -0.3, 0.25, 0.3, 0.2], [0.3, -0.45, 0.35, 0.3, -0.2, 0.35]])
POLES = NATURAL * (-DAMPING + 1j * np.sqrt(1.0 - DAMPING**2))
NAMES, UNITS = ["hammer", "a1", "a2"], ["N", "m/s²", "m/s²"]
SETTINGS = """
title = "Bench"
[hammer]
force_channel = "hammer"
[responses]
a1 = { node = 1, direction = "+z" }
a2 = { node = 2, direction = "+z" }
[hits]
"""


def accelerance(response, hit, frequency_hz):
    """Σ φ φ s² / (s² + 2 ζ ω s + ω²), shape (frequency,)."""
    s = 2j * np.pi * frequency_hz[:, None]
    modal = s**2 / (s**2 + 2.0 * DAMPING * NATURAL * s + NATURAL**2)
    return modal @ (SHAPES[response] * SHAPES[hit])


def pulse(time, width, size):
    return np.where((time >= 0.0) & (time <= width), size * np.sin(np.pi * time / width) ** 2, 0.0)


def accelerations(hit, time, width, size):
    """Exact responses: the pulse is a sum of exponentials, which integrate in closed form."""
    rates = 2j * np.pi / width * np.array([0.0, 1.0, -1.0])
    parts = size * np.array([0.5, -0.25, -0.25])
    shares = SHAPES * SHAPES[hit]
    total = shares.sum(axis=1, keepdims=True) * pulse(time, width, size)
    begun = time >= 0.0
    within, after = np.minimum(time[begun], width), np.maximum(time[begun] - width, 0.0)
    during = np.exp(np.outer(np.append(within[within < width], width), rates))
    for pole, share in zip(POLES, shares.T, strict=True):
        driven = (during - np.exp(pole * np.append(within[within < width], width))[:, None]) @ (
            parts / (rates - pole)
        )
        padded = np.append(driven[:-1], np.full(np.count_nonzero(within == width), driven[-1]))
        ringing = padded * np.exp(pole * after)
        total[:, begun] += 2.0 * np.outer(share, np.real(pole**2 / (2j * pole.imag) * ringing))
    return total


def hit_record(hit, seed, *, seconds=2.0, noise=0.03, begin_s=0.1, second=0.0, gap_s=0.02):
    """Force and two responses of one hit, with noise of a share of the RMS of each."""
    rng = np.random.default_rng(seed)
    time = np.arange(round(seconds * RATE)) / RATE - begin_s - rng.uniform(0.0, 1.0 / RATE)
    size, width = rng.uniform(60.0, 160.0), rng.uniform(0.002, 0.003)
    hits = [(0.0, size), (gap_s, second * size)]
    hits = [(0.0, size), *([(gap_s, second * size)] if second else [])]
    signal = sum(
        np.vstack([pulse(time - at, width, each), *accelerations(hit, time - at, width, each)])
        for at, each in hits
    )
    rms = np.sqrt(np.mean(signal**2, axis=1, keepdims=True))
    return signal + noise * rms * rng.normal(size=signal.shape)


def write_record(signal, path):
    return va.export_recording(va.label_recording(signal, RATE, NAMES, UNITS), path)


def write(folder: Path, hits: int = 3, extra: str = "") -> Path:
    """Write a test of two points, one file a hit, and return its settings."""
    folder.mkdir(exist_ok=True)
    text = SETTINGS.replace('"hammer"\n', f'"hammer"\n{extra}')
    for point in (0, 1):
        for number in range(hits):
            signal = hit_record(point, 100 * point + number)
            write_record(signal, folder / f"record_{point + 1}_{number}.csv")
        text += f'"record_{point + 1}_*.csv" = {{ node = {point + 1}, direction = "+z" }}\n'
    (folder / "hammer.toml").write_text(text)
    return folder / "hammer.toml"
