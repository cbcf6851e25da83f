"""
What goes on inside a machine
=============================

Pressures, films, friction, torques and critical speeds are no part of a run's results;
``va.curves`` computes them for a study, or for a machine alone. On the command line that is
``vibroacoustics curves FILE.toml``, with a picture and a table of each. What each machine has:
:doc:`/curves`.
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
# ``va.plot.curves`` draws any of them, with units for reading.
figure = va.plot.curves(inner, "friction_torque")

# %%
# What the best bore is made of: efficiency over bore and speed.
figure = va.plot.curves(inner, "mechanical_efficiency")

# %%
# Numbers and pictures of your own
# --------------------------------
# A curve is a labelled array in SI units, angles in radians. The scroll of a study with sources:
# its source of gas forces shows pockets and force, its keys what they carry.
scroll = va.curves(va.load_study("studies/sources.toml"))
force = scroll["gas_force"]
print(force.dims, force.attrs["units"], force.attrs["long_name"], sep=" | ")
figure, axes = plt.subplots(layout="constrained")
pressure = scroll["pocket_pressure"].squeeze()
axes.plot(np.degrees(pressure[pressure.dims[0]]), 1e-5 * pressure)
axes.set(xlabel="crank angle since the pocket has closed, °", ylabel="pressure, bar")
axes.grid(alpha=0.3)

# %%
# Each says where its equation stands.
for name in ("pocket_pressure", "gas_force", "key_force"):
    print(f"{name}: {scroll[name].attrs['source']}")
