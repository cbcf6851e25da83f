"""
A motor on an inverter
======================

The scroll with variable speed: a permanent-magnet synchronous motor in place of the capacitor
motor. Its torque by order and at the sidebands of the switching frequency: :doc:`/motors`.

.. literalinclude:: ../../pipelines/copeland_inverter.toml
   :language: toml
   :lines: 7-9, 20-36
"""

import matplotlib.pyplot as plt
import numpy as np
from rough_radiation import rough_radiation

import vibroacoustics as va

study = va.load_study("../../pipelines/copeland_inverter.toml")
few = {f"options.{name}": None for name in study.options if name != "none"}
few |= {"operation.speed_rpm": [2900.0], "uncertainty.random_samples": 8, "sources.keys": None}
results = va.run(study.replace(few), radiation=rough_radiation)
results = results.sel(receiver="front_1m", option="none", speed=2900.0)

# %%
# Levels by source, medians
# -------------------------
for name in ("gas", "motor", "forces"):
    print(f"{name:6s} {results['source_level'].sel(sound_source=name).item():6.1f} dB(A)")

# %%
# Orders and sidebands of the motor
# ---------------------------------
# Cogging and six times the electrical frequency meet at orders 18 and 36; the sidebands of the
# switching frequency are no orders.
motor = results["pressure_line"].sel(sound_source="motor")
level = 20.0 * np.log10(np.maximum(np.abs(motor.values), 1e-9) / np.sqrt(2.0) / 20e-6)
figure, axes = plt.subplots(layout="constrained")
axes.stem(results["tone_frequency"], level, bottom=-30.0, markerfmt="C0.")
axes.set(xlabel="frequency, Hz", ylabel="level of the line, dB", ylim=(-30, None))
