"""
Comparison of a recording with a study
======================================

A synthetic recording of the simulated force, by a sensor that reads 5 % too much, and the
comparison of its orders with the study in level and phase, with limits of agreement
(:doc:`/compare`).
"""

import subprocess
import sys
import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from rough_radiation import rough_radiation

import vibroacoustics as va

results = va.run(va.load_study("studies/copeland.toml"), radiation=rough_radiation)
force = results["force"].sel(option="pendulum-side", speed=2900.0).sum("source")

# %%
# Synthetic test stand
# --------------------
# 100 revolutions, noise of 0.5 N, and a tacho that pulses when the crank points along +x.
samples, revolutions = force.sizes["crank_angle"], 100
angle = 2.0 * np.pi / samples * np.arange(samples * revolutions)
generator = np.random.default_rng(1)
sensors = 1.05 * np.tile(force.sel(axis=["x", "z"]).values, revolutions)
sensors += generator.normal(0.0, 0.5, sensors.shape)
tacho = np.clip(0.5 + ((angle + np.pi) % (2.0 * np.pi) - np.pi) / 0.1, 0.0, 1.0)

folder = Path(tempfile.mkdtemp())
time = np.arange(angle.size) / (samples * 2900.0 / 60.0)
np.savetxt(
    folder / "stand.csv",
    np.column_stack([time, *sensors, tacho]),
    delimiter=",",
    header="time [s],force x [N],force z [N],tacho [V]",
    comments="",
    fmt="%.9g",
)

# %%
# Its orders: on the command line
# ``vibroacoustics orders stand.csv --speed-channel tacho --orders 1,2,3``.
command = [sys.executable, "-m", "vibroacoustics", "orders", str(folder / "stand.csv")]
command += ["--speed-channel", "tacho", "--orders", "1,2,3", "--out", str(folder)]
done = subprocess.run(command, capture_output=True, text=True, check=True)
print("\n".join(done.stdout.splitlines()[:-1]))

# %%
# Comparison
# ----------
# ``vibroacoustics compare`` does the same with two result files. A low coherence shows orders that
# noise masks.
measured = va.open_results(folder / "orders.nc")
compared = va.compare(results, measured, option="pendulum-side")
figure, axes = plt.subplots(2, 1, sharex=True, layout="constrained")
for channel in compared["channel"].values:
    one = compared.sel(channel=channel).isel(speed=0)
    axes[0].plot(one["order"], one["order_difference"], "o", label=channel)
    axes[1].plot(one["order"], np.degrees(one["order_phase_difference"]), "o", label=channel)
for panel, limit in zip(axes, (1.0, 5.0), strict=True):
    panel.axhspan(-limit, limit, color="tab:green", alpha=0.15, label="within limits")
axes[0].set(ylabel="recording − study, dB")
axes[1].set(ylabel="phase, °", xlabel="order", xticks=[1, 2, 3])
axes[0].legend(fontsize="small")

# %%
# The 5 % are 0.42 dB in every order above the noise.
first = compared["order_difference"].sel(order=1).isel(speed=0)
for channel in first["channel"].values:
    print(f"{channel}: {first.sel(channel=channel).item():+.2f} dB")
