"""
Beats of two compressors
========================

Two reciprocating compressors side by side, at 1200 and 1192 rpm. Each runs as an ordinary study;
together their orders beat at 0.133 Hz times the order (:doc:`/several_machines`).
``pipelines/two_compressors.toml`` has two scrolls at 2900 and 2880 rpm, with gas, keys and motor.

.. literalinclude:: /gallery/studies/two_compressors.toml
   :language: toml
"""

import matplotlib.pyplot as plt
import numpy as np
from rough_radiation import rough_radiation

import vibroacoustics as va

study = va.load_study("studies/two_compressors.toml")
tree = va.run_machines(study, radiation=rough_radiation)
front = tree.to_dataset().sel(common_receiver="front")
for name, level in zip(front["machine"].values, front["machine_level"].values, strict=True):
    print(f"{name:10s} {level:5.1f} dB(A)")
print(f"together   {front['machines_level'].item():5.1f} dB(A)")
print(f"at maximum {front['machines_highest_level'].item():5.1f} dB(A)")

# %%
# Levels of the beats
# -------------------
# The sum of the energies is that of a long average; the maximum occurs once a beat.
figure, axes = plt.subplots(layout="constrained")
loud = front.sel(beat=front["beat_highest_level"] > 0.0)
beat = loud["beat_frequency"]
lowest = np.maximum(loud["beat_lowest_level"], 0.0)
axes.vlines(beat, lowest, loud["beat_highest_level"], linewidth=5, color="C0", alpha=0.4)
axes.plot(beat, loud["beat_energy_level"], "o", color="C1", label="sum of the energies")
axes.set(xlabel="beat, Hz", ylabel="level, dB, unweighted")
axes.legend()

# %%
# Over time
# ---------
# Order 2 of both machines: once a beat, every 3.75 s, the envelope is the sum of both peaks.
time = np.arange(0.0, 8.0, 1e-3)
lines = [f"{name}: order 2" for name in ("west", "east")]
two = front.sel(machine_line=lines)
turn = np.exp(2j * np.pi * two["machine_line_frequency"].values[:, None] * time)
envelope = np.abs((two["machines_pressure_line"].values[:, None] * turn).sum(axis=0))
largest = np.abs(two["machines_pressure_line"]).sum().item()
figure, axes = plt.subplots(layout="constrained")
axes.plot(time, 1e3 * envelope, color="C0")
axes.axhline(1e3 * largest, color="grey", linestyle="--", label="|p1| + |p2|")
axes.set(xlabel="time, s", ylabel="envelope of order 2, mPa")
axes.legend()

# %%
# Both on one frame
# -----------------
# On a light frame with its own mounts each machine moves the other one, which radiates too.
frame = {
    "base_frame.position_mm": [0.0, 0.0],
    "base_frame.height_mm": 150.0,
    "base_frame.top_height_mm": 250.0,
    "base_frame.body": {
        "mass_kg": 300.0, "inertia_xx_kg_m2": 80.0, "inertia_yy_kg_m2": 30.0,
        "inertia_zz_kg_m2": 100.0,
    },
    "base_frame.mounts": {
        "pitch_mm": 1500.0, "lateral_stiffness_n_per_mm": 1000.0,
        "vertical_stiffness_n_per_mm": 2500.0, "loss_factor_ratio": 0.1,
    },
}  # fmt: skip
on_frame = va.run_machines(study.replace(frame), radiation=rough_radiation).to_dataset()
print(
    "natural frequencies:", *(f"{hertz:.1f}" for hertz in on_frame["base_natural_frequency"].values)
)
at_front = on_frame.sel(common_receiver="front")["machines_pressure_line"]
for line in ("west: order 1", "east: order 1"):
    before, after = (
        20.0 * np.log10(np.abs(each.sel(machine_line=line)).item() / np.sqrt(2.0) / 20e-6)
        for each in (front["machines_pressure_line"], at_front)
    )
    print(f"{line}: {before:.1f} dB on the floor, {after:.1f} dB on the frame")

# %%
# On the command line
# -------------------
# ``vibroacoustics run studies/two_compressors.toml`` writes the report of each machine,
# ``machines.html``, CSV files of levels and beats, and the sound as WAV.
plt.show()
