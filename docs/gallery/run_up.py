"""
A run-up
========

In a run-up orders are straight lines over the speed, natural frequencies are constant, and levels
are high where they cross. Three commands: ``map`` shows spectra over the speed, ``track`` follows
orders through the crossing (Vold-Kalman), ``export`` writes the recording for other programs.
Methods: :doc:`/orders`, :doc:`/recordings`.
"""

import tempfile
from pathlib import Path

import numpy as np
from scipy.signal import lfilter

import vibroacoustics as va

# %%
# Synthetic test stand
# --------------------
# From 900 to 3900 rpm within 15 s. Orders 1 and 4 drive a structure with a resonance at 140 Hz; the
# microphone records it with noise.
rate_hz, seconds = 1024.0, 15.0
time = np.arange(int(rate_hz * seconds)) / rate_hz
speed_rpm = 900.0 + 3000.0 * time / seconds
angle = 2.0 * np.pi * np.cumsum(speed_rpm) / 60.0 / rate_hz
drive = np.cos(angle) + 0.5 * np.cos(4.0 * angle)
pole = np.exp((-0.02 + 1j) * 2.0 * np.pi * 140.0 / rate_hz)
ringing = lfilter([1.0 - abs(pole)], [1.0, -2.0 * pole.real, abs(pole) ** 2], drive)
noise = np.random.default_rng(3).normal(0.0, 1e-3, time.size)
recording = va.label_recording(
    [0.02 * ringing + noise, speed_rpm], rate_hz, ["front", "speed"], ["Pa", "rpm"]
)

# %%
# Over speed and frequency
# ------------------------
# ``vibroacoustics map run_up.csv --speed-channel speed --resolution 4``
mapped = va.speed_frequency_map(recording, va.SpeedChannel("speed"), resolution_hz=4.0)
figure = va.plot.speed_frequency_map(mapped, "front")

# %%
# The level over the speed has its maximum where order 4 crosses 140 Hz, at 2100 rpm.
figure = va.plot.levels_over_speed(mapped)
level = mapped["block_level"].sel(channel="front", weighting="Z")
loudest = level["block_speed"][int(np.argmax(level.values))].item()
print(f"loudest at {loudest:.0f} rpm, {level.max().item():.0f} dB")

# %%
# Orders over the time
# --------------------
# ``vibroacoustics track run_up.csv --speed-channel speed --orders 1,4 --bandwidth 3``
tracked = va.track_orders(recording, va.SpeedChannel("speed"), [1.0, 4.0], bandwidth_hz=3.0)
figure = va.plot.tracked_orders(tracked)
fourth = abs(tracked["tracked_order"].sel(channel="front", order=4.0))
peak = int(np.argmax(fourth.values))
print(
    f"order 4: {1e3 * fourth[peak].item():.1f} mPa at {tracked['track_speed'][peak].item():.0f} rpm"
)

# %%
# For other programs
# ------------------
# ``vibroacoustics export run_up.csv --out run_up.wav``; the suffix selects CSV, WAV or netCDF.
with tempfile.TemporaryDirectory() as folder:
    for ending in ("csv", "wav", "nc"):
        file = va.export_recording(recording, Path(folder) / f"run_up.{ending}")
        print(f"{file.name:12s} {file.stat().st_size / 1e3:6.0f} kB")
    again = va.read_recording(Path(folder) / "run_up.csv")
    print(
        "read back bit by bit:", bool((again["signal"].values == recording["signal"].values).all())
    )
