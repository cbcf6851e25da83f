"""
A redesign in a recording
=========================

The sound of an option in a recording of your machine, with its noise, its room and all sound that
is not modelled. Each order of the study is separated, multiplied by the ratio of the option, and
added again. On the command line: ``vibroacoustics replay machine.wav --results results.nc --option
softer-mounts --pair mic=front_1m --rpm 950``. Limits: :doc:`/replay`.
"""

import matplotlib.pyplot as plt
import numpy as np
from rough_radiation import rough_radiation

import vibroacoustics as va

results = va.run(va.load_study("studies/by_table.toml"), radiation=rough_radiation)

# %%
# Synthetic recording
# -------------------
# Orders of the study without an option, 3 dB louder than the model, and noise.
speed, rate = 950.0, 8192
lines = va.sound.ingredients(results, "none", "front_1m", speed).lines
time = np.arange(12 * rate) / rate
turning = np.exp(2j * np.pi * np.outer(lines.frequency_hz, time))
orders = np.sqrt(2.0) * (lines.pressure_pa @ turning).real
noise = np.random.default_rng(3).normal(0.0, 0.3 * orders.std(), time.size)
recording = va.label_recording([orders + noise], rate, ["mic"], ["Pa"])

# %%
# With the option
# ---------------
# Levels before are measured; the change is that of the study.
replayed = va.replay(
    recording,
    results,
    "softer-mounts",
    {"mic": "front_1m"},
    va.NominalSpeed(speed),
    orders_only=True,
)
summary = replayed.summary.sel(channel="mic")
for line in summary["line"].values:
    level = summary.sel(line=line)
    before, after = (float(level[f"{name}_line_level"]) for name in ("recorded", "replayed"))
    if np.isfinite(after):  # others are below the noise
        print(f"{line}: {before:.1f} dB before, {after:.1f} dB after")

# %%
# Spectra before and after: orders that the option changes, and unchanged noise.
figure, axes = plt.subplots(layout="constrained")
for name, sound in (("before", replayed.before), ("after", replayed.after)):
    pressure = np.asarray(sound)[0]
    window = np.hanning(pressure.size)
    peak = 2.0 * np.abs(np.fft.rfft(window * pressure)) / window.sum()
    level = 20.0 * np.log10(np.maximum(peak / np.sqrt(2.0), 1e-9) / 20e-6)
    axes.plot(np.fft.rfftfreq(pressure.size, 1.0 / rate), level, label=name, linewidth=0.8)
axes.set(xlim=(0.0, 200.0), ylim=(0.0, None), xlabel="frequency, Hz", ylabel="level, dB re 20 µPa")
axes.legend()
