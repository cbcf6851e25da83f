"""
Inner curves of a machine
=========================

Pressures, films, friction, torques and critical speeds are not in the results of a run.
``va.curves`` computes them for a study or a machine. On the command line ``vibroacoustics curves
FILE.toml`` writes a picture and a table of each. List of curves: :doc:`/curves`.
"""

import matplotlib.pyplot as plt
import numpy as np

import vibroacoustics as va

machine = va.load_machine("../../data/machines/mayekawa_wbhe.toml")
inner = va.curves(machine, 1200.0)
for name, curve in inner.data_vars.items():
    print(f"{name:24s} {curve.attrs['units']:6s} {' × '.join(curve.dims)}")

# %%
# The picture of a curve
# ----------------------
# ``va.plot.curves`` plots any of them, in the units of the machine file.
figure = va.plot.curves(inner, "friction_torque")

# %%
# Efficiency over bore and speed, which determines the best bore.
figure = va.plot.curves(inner, "mechanical_efficiency")

# %%
# Your own numbers and pictures
# -----------------------------
# A curve is a labelled array in SI units, angles in radians. For a scroll with sources the gas has
# pressures and forces, and the keys have contact forces.
scroll = va.curves(va.load_study("studies/sources.toml"))
force = scroll["gas_force"]
print(force.dims, force.attrs["units"], force.attrs["long_name"], sep=" | ")
figure, axes = plt.subplots(layout="constrained")
pressure = scroll["pocket_pressure"].squeeze()
axes.plot(np.degrees(pressure[pressure.dims[0]]), 1e-5 * pressure)
axes.set(xlabel="crank angle since the pocket has closed, °", ylabel="pressure, bar")
axes.grid(alpha=0.3)

# %%
# Each has the source of its equation.
for name in ("pocket_pressure", "gas_force", "key_force"):
    print(f"{name}: {scroll[name].attrs['source']}")
