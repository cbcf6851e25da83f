"""
In the kitchen
==============

A machine between cupboards, on a board that its feet push: how loud it is at the table and in the
doorway, by which path, and what changes that (:doc:`/rooms`, :doc:`/structure_borne`); coarsely,
with the moving parts alone and waves to 250 Hz.

.. literalinclude:: /gallery/studies/kitchen.toml
   :language: toml
"""

import tempfile

import matplotlib.pyplot as plt
import numpy as np

import vibroacoustics as va

study = va.load_study("studies/kitchen.toml")
results = va.run(study)

# %%
# How loud, and by which path
# ---------------------------
# By air, and by the feet and the board with the span that holds 90 % of such boards. The levels
# that are to be kept stand as lines.
at = results.sel(listener="table", speed=2900.0)
low, high = at["room_plate_level_low"], at["room_plate_level_high"]
options = at["option"].values
rows = np.arange(options.size)
figure, axes = plt.subplots(layout="constrained")
axes.barh(rows, (high - low).values, left=low.values, height=0.5, color="C1", alpha=0.3)
axes.plot(at["room_plate_level"], rows, "|", color="C1", markersize=14, label="by the feet")
axes.plot(at["room_level"], rows, "o", color="C0", label="by air")
for limit in results["room_limit"].values:
    axes.axvline(limit, color="grey", linestyle="--", linewidth=0.8)
axes.set(yticks=rows, yticklabels=options, xlabel="at the table, dB(A)")
figure.legend(loc="outside lower center", ncols=2)

# %%
# What it sounds like
# -------------------
# Listeners are asked for by name, as microphones are; the sound comes by air and by the feet.
with tempfile.TemporaryDirectory() as folder:
    for path in va.listen(results, folder, ["none", "jacket"], ["table"], duration_s=1.0):
        print(path.name)

# %%
# From an acceleration to the table
# ---------------------------------
# The response to a motion of the shell, to be convolved with what an accelerometer measured;
# ``vibroacoustics impulse-responses kitchen.toml`` writes them as WAV.
responses = va.impulse_responses(study)
figure, axes = plt.subplots(layout="constrained")
responses.sel(listener="table", dof="tz").plot(ax=axes, linewidth=0.5)
axes.set(title="up and down, at the table", xlabel="time, s", ylabel="Pa/(m/s²) a sample")

# %%
# Where it is loud
# ----------------
va.plot.room_map(results)

# %%
# Two methods and their seam
# --------------------------
# Waves at low frequencies, above them direct sound and a diffuse field. Both are computed around
# the seam, and the difference stays to be seen.
va.plot.room_seam(results, listener="doorway")
plt.show()
