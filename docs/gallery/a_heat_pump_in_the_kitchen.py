"""
A heat pump in the kitchen
==========================

A machine between cupboards, on a board that its feet drive: level at the table and in the doorway,
airborne and structure-borne, and the effect of options (:doc:`/rooms`, :doc:`/structure_borne`).
The study is coarse: moving parts alone, waves to 250 Hz.

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
# Airborne and structure-borne level
# ----------------------------------
# The range of the structure-borne level holds 90 % of such boards. Dashed lines are the limits.
at = results.sel(listener="table", speed=2900.0)
low, high = at["room_plate_level_low"], at["room_plate_level_high"]
options = at["option"].values
rows = np.arange(options.size)
figure, axes = plt.subplots(layout="constrained")
axes.barh(rows, (high - low).values, left=low.values, height=0.5, color="C1", alpha=0.3)
axes.plot(at["room_plate_level"], rows, "|", color="C1", markersize=14, label="structure-borne")
axes.plot(at["room_level"], rows, "o", color="C0", label="airborne")
for limit in results["room_limit"].values:
    axes.axvline(limit, color="grey", linestyle="--", linewidth=0.8)
axes.set(yticks=rows, yticklabels=options, xlabel="at the table, dB(A)")
figure.legend(loc="outside lower center", ncols=2)

# %%
# Sound
# -----
# Listeners are given by name, as microphones are. The sound is airborne and structure-borne.
with tempfile.TemporaryDirectory() as folder:
    for path in va.listen(results, folder, ["none", "jacket"], ["table"], duration_s=1.0):
        print(path.name)

# %%
# Impulse responses
# -----------------
# Response to a motion of the shell, for convolution with a measured acceleration.
# ``vibroacoustics impulse-responses kitchen.toml`` writes them as WAV.
responses = va.impulse_responses(study)
figure, axes = plt.subplots(layout="constrained")
responses.sel(listener="table", dof="tz").plot(ax=axes, linewidth=0.5)
axes.set(title="vertical motion, at the table", xlabel="time, s", ylabel="Pa/(m/s²) a sample")

# %%
# Level map
# ---------
va.plot.room_map(results)

# %%
# Crossover frequencies
# ---------------------
# Waves at low frequencies, direct sound and a diffuse field above. Around the crossover both are
# computed, and the difference is shown.
va.plot.room_seam(results, listener="doorway")
plt.show()
