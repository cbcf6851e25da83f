"""
Machine: rolling-piston compressor
==================================

The compressor of most air conditioners: the gas torque of its single cylinder makes the shaft speed
fluctuate, and the reaction of the rotor rolls the machine at 1×. An inverter whose torque follows
the load, or a second cylinder at 180°, reduces this. Equations and checks:
:doc:`/machines/rolling_piston`.

.. literalinclude:: /gallery/studies/rolling_piston.toml
   :language: toml
   :lines: 1-33
"""

import matplotlib.pyplot as plt
import numpy as np
from rough_radiation import rough_radiation

import vibroacoustics as va

study = va.load_study("studies/rolling_piston.toml")
results = va.run(study, radiation=rough_radiation)

# %%
# Reported figures
# ----------------
# Speed fluctuation, residual torque, vane, roller and bearings at 3000 rpm.
print(f"{'':34s}", *(f"{name:>24s}" for name in results["option"].values))
for name in results["figure"].values:
    values = results["reported_figure"].sel(figure=name, speed=3000.0).values
    print(f"{name:34s}", *(f"{value:24.4g}" for value in values))

# %%
# Torques over the crank angle
# ----------------------------
# Load, motor and residual torque, without and with an ideal torque control.
figure, axes = plt.subplots(1, 2, sharey=True, figsize=(9, 3.6), layout="constrained")
for panel, option in zip(axes, ("none", "torque-control"), strict=True):
    machine = study.options[option].applied_to(study.machine)
    curves = va.curves(machine, speed_rpm=3000.0)
    for torque in curves["torque_of"].values:
        course = curves["shaft_torque"].sel(torque_of=torque)
        panel.plot(np.degrees(curves["crank_angle"]), course, label=torque)
    panel.set(title=option, xlabel="crank angle, °", xlim=(0, 360))
axes[0].set_ylabel("torque, N m")
axes[0].legend(fontsize="small")

# %%
# Roll moment on the machine
# --------------------------
# With two cylinders only even orders remain.
figure, axes = plt.subplots(layout="constrained")
for option in results["option"].values:
    moment = results["moment"].sel(option=option, axis="z", speed=3000.0).sum("source")
    axes.plot(np.degrees(results["crank_angle"]), moment, label=option)
axes.set(xlabel="crank angle, °", ylabel="roll moment, N m", xlim=(0, 360))
axes.legend(fontsize="small")
