"""
Runs with trial weights
=======================

A fan with two planes on the bench: which weights balance it, and how far?
``vibroacoustics balance`` reads the runs from a file, :doc:`/balancing` says what the file holds.
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
# The file of the runs
# --------------------
# A template has a run without weights, and one with a trial weight in each plane. Readings are
# ``amplitude@phase`` against the mark of the tacho.
command = [sys.executable, "-m", "vibroacoustics", "new", "balance", "--out", "fan"]
subprocess.run(command, capture_output=True, check=True, cwd=folder)
file = folder / "fan" / "balancing.toml"
print(*(line for line in file.read_text().splitlines() if "@" in line), sep="\n")

# %%
# On the command line
# -------------------
# Weights are split between holes. The last table is what other answers would leave: with one plane
# less, or with no weight.
command = [sys.executable, "-m", "vibroacoustics", "balance", str(file), "--out", "weights"]
done = subprocess.run(command, capture_output=True, text=True, check=True, cwd=folder)
print(done.stdout)

# %%
# In Python
# ---------
# ``va.balance_runs`` gives the same. A band holds 80 %: a reading cannot fall below its scatter.
balanced = va.balance_runs(file)
for weight in balanced.weights:
    angle_deg = np.degrees(weight.angle_rad)
    print(f"{weight.plane}: {1e3 * weight.mass_kg:.1f} g in hole {weight.hole}, {angle_deg:.0f}°")

low, middle, high = balanced.after_band
figure, axes = plt.subplots(figsize=(6.0, 3.0), layout="constrained")
rows = np.arange(middle.size)
axes.bar(rows - 0.2, np.abs(balanced.before), 0.4, label="before")
axes.bar(rows + 0.2, middle, 0.4, yerr=[middle - low, high - middle], label="with the weights")
axes.set(xticks=rows, xticklabels=["drive end", "free end"], ylabel="velocity, mm/s rms")
axes.legend()
