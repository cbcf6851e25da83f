"""
Machine: Copeland scroll with Oldham ring
=========================================

The machine of the thesis. Its Oldham ring oscillates without balance, which is the force at shaft
frequency, at 2900 rpm, that the options of this study balance. Equations and published values:
:doc:`/machines/copeland_scroll`.

.. literalinclude:: /gallery/studies/copeland.toml
   :language: toml
"""

import matplotlib.pyplot as plt
import numpy as np
from rough_radiation import rough_radiation

import vibroacoustics as va

study = va.load_study("studies/copeland.toml")
results = va.run(study, radiation=rough_radiation)  # default: radiation of the package

# %%
# Force by moving part
# --------------------
# Force along the stroke of the ring over one revolution. Orbiting scroll, crank pin and
# counterweights cancel; the force of the ring remains.
force = results["force"].sel(speed=2900.0, option="none", axis="x")
degrees = np.degrees(results["crank_angle"])
figure, (parts, rest) = plt.subplots(2, 1, sharex=True, layout="constrained", figsize=(6.4, 6.4))
for part in force:
    if abs(part).max() > 0.0:
        parts.plot(degrees, part, label=part["source"].item().replace("_", " "))
rest.plot(degrees, force.sum("source"), "k", label="sum of all")
rest.plot(degrees, force.sel(source="oldham"), "--", label="oldham")
parts.set(ylabel="force along the stroke, N", xlim=(0, 360))
rest.set(xlabel="crank angle, °", ylabel="sum, N")
parts.legend(fontsize="small", ncols=2, loc="lower center")
rest.legend(fontsize="small")

# %%
# Options compared
# ----------------
# First order of the resultant force, and the largest force into a foot.
table = results[["force_amplitude", "foot_force_amplitude"]].sel(order=1, speed=2900.0)
worst = table["foot_force_amplitude"].max("foot")
for option in results["option"].values:
    force_n, foot_n = table["force_amplitude"].sel(option=option), worst.sel(option=option)
    print(f"{option:20s} {force_n.item():7.1f} N   {foot_n.item():6.2f} N into a foot")

# %%
# Change of the 1x line relative to no balancer, at one metre.
change = results["change_1x"].sel(speed=2900.0, receiver="front_1m").drop_sel(option="none")
figure, axes = plt.subplots(layout="constrained")
axes.barh(change["option"].values, change)
axes.axvline(0.0, color="k", linewidth=0.8)
axes.set_xlabel("change of the 1× line, dB")
