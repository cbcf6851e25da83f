"""
Sound power from ten microphones
================================

``vibroacoustics sound-power`` computes sound power from recordings of microphones around a machine,
corrected for background and room (ISO 3744, :doc:`/sound_power`).
"""

import subprocess
import sys
import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import vibroacoustics as va

folder = Path(tempfile.mkdtemp())

# %%
# Ten microphones
# ---------------
# Synthetic: noise of 70 dB re 1 pW in each third octave, a quieter background, one metre away.
random = np.random.default_rng(1)
rate, names = 25600.0, [f"microphone {number}" for number in range(1, 11)]
frequency = np.fft.rfftfreq(int(2 * rate), 1.0 / rate)


def noise(level_db):
    """Return ten signals with this level in each third octave at 1 m on a hemisphere."""
    phase = np.exp(2j * np.pi * random.random((10, frequency.size)))
    density = 10.0 ** (level_db / 10.0) / (0.2308 * np.maximum(frequency, 1.0))
    peak = 20e-6 * np.sqrt(2.0 * density * 0.5 / (2.0 * np.pi))
    return np.fft.irfft(phase * peak * rate, axis=1)


still = noise(60.0)
for name, signal in (("running", noise(70.0) + still), ("still", still)):
    va.export_recording(
        va.label_recording(signal, rate, names, ["Pa"] * 10), folder / f"{name}.wav"
    )

# %%
# Command
# -------
command = [sys.executable, "-m", "vibroacoustics", "sound-power", "running.wav", "--unit", "*=Pa"]
command += ["--hemisphere", "1.0", "--background", "still.wav", "--out", "."]
command += ["--reverberation-time", "0.3", "--volume", "300"]
done = subprocess.run(command, capture_output=True, text=True, check=True, cwd=folder)
print(done.stdout)

# %%
# Comparison with the truth
# -------------------------
# 70 dB less K2: the command corrects for room reflections, which these signals do not have.
power = va.open_results(folder / "sound_power.nc")
found = power["measured_power_level"] + power["environment_correction"]
print(f"largest error of a band: {abs(found - 70.0).max().item():.2f} dB")
figure, axes = plt.subplots(layout="constrained")
at = range(power.sizes["band"])
axes.bar(at, power["mean_position_level"], color="0.8", label="mean Lp")
axes.plot(at, power["measured_power_level"], "o", label="L_W")
axes.set_xticks(at[::4], [f"{band:g}" for band in power["band"].values[::4]])
axes.set(xlabel="third octave, Hz", ylabel="level, dB", ylim=(50, 75))
axes.legend()
plt.show()
