"""
A stop
======

After switch-off the gas brakes the machine within two or three revolutions. Force, foot force and
sound around that time, from each speed, in a study with samples for the representative sample.
Model and neglected effects: :doc:`/mechanisms`.

.. literalinclude:: /gallery/studies/stopping.toml
   :language: toml
   :lines: 5-11
"""

import matplotlib.pyplot as plt
import numpy as np
from rough_radiation import rough_radiation

import vibroacoustics as va

study = va.load_study("studies/stopping.toml")
results = va.run(study, radiation=rough_radiation)
for speed in results["speed"].values:
    one = results.sel(speed=speed)
    print(
        f"{speed:.0f} rpm: stops in {one['stopping_duration'].item():.3f} s,"
        f" {one['stopping_revolutions'].item():.1f} revolutions; into a foot",
        " -> ".join(f"{value:.2f} N" for value in one["stopping_foot_force"].values),
    )

# %%
# Around the switch-off
# ---------------------
one = results.sel(speed=2900.0)
time = one["stopping_time"]
figure, axes = plt.subplots(3, 1, sharex=True, layout="constrained", figsize=(6.4, 6.4))
axes[0].plot(time, one["stopping_shaft_speed"] * 30.0 / np.pi)
axes[0].set(ylabel="speed, rpm")
for axis in ("x", "y"):
    axes[1].plot(time, one["stopping_force"].sel(axis=axis), label=axis)
axes[1].set(ylabel="force, N")
axes[1].legend(fontsize="small")
axes[2].plot(time, one["stopping_moment"].sel(axis="z"))
axes[2].set(ylabel="roll moment, N m", xlabel="time from switch-off, s", xlim=(-0.05, 0.2))

# %%
# Reverse rotation
# ----------------
# Trapped gas turns the shaft back until the brake jams, and a valve shuts. If a source drives the
# elastic shell, the sound of the brake is computed through it.
onwards = va.run(study.replace({"operation.turning_back": True}), radiation=rough_radiation)
one = onwards.sel(speed=2900.0)
turned = np.degrees(one["stopping_turned_back_angle"].item())
held = one["stopping_brake_force"].item()
print(f"turns back by {turned:.1f}°, where the brake holds up to {held:.0f} N")
print(f"stands after {one['stopping_duration'].item():.3f} s")
