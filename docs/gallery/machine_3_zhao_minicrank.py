"""
Machine: scroll with mini-cranks
================================

The scroll of Zhao et al. is guided by small cranks. If their radius differs from that of the main
crank, the linkage is no parallelogram, and speed, torque and force fluctuate. Equations and
published values: :doc:`/machines/zhao_minicrank`.

.. literalinclude:: /gallery/studies/zhao.toml
   :language: toml
"""

import matplotlib.pyplot as plt
import numpy as np
from rough_radiation import rough_radiation

import vibroacoustics as va

study = va.load_study("studies/zhao.toml")
results = va.run(study, radiation=rough_radiation)

# %%
# Speed of the shaft over a revolution
# ------------------------------------
speed = results["shaft_speed"].sel(speed=3000.0)
figure, axes = plt.subplots(layout="constrained")
for option in ("none", "twice-the-error", "matched-links", "heavier-rotor"):
    rpm = speed.sel(option=option) * 30.0 / np.pi
    axes.plot(np.degrees(results["crank_angle"]), rpm - 3000.0, label=option)
axes.set(xlabel="crank angle, °", ylabel="speed above 3000 rpm, rpm", xlim=(0, 360))
axes.legend(fontsize="small")

# %%
# Orders of the force
# -------------------
# The mass moment of the mini-cranks makes the first order. Counterweights on the mini-cranks
# balance it, the ideal parallelogram does not. With both no bar remains.
amplitude = results["force_amplitude"].sel(speed=3000.0, order=[1, 2])
figure, axes = plt.subplots(layout="constrained")
options = ["none", "matched-links", "balanced-minicranks", "matched-and-balanced"]
for number, option in enumerate(options):
    place = amplitude["order"] + 0.2 * (number - 1.5)
    axes.bar(place, amplitude.sel(option=option), width=0.2, label=option)
axes.set(xlabel="order", xticks=[1, 2], ylabel="force, N", yscale="log", ylim=(1e-4, None))
axes.legend(fontsize="small")
