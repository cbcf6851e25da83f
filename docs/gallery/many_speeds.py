"""
Many speeds
===========

A range of speeds in place of a list, up to a thousand of them; at each as many orders as the
highest frequency holds.

.. literalinclude:: /gallery/studies/many_speeds.toml
   :language: toml
   :lines: 5-10
"""

import matplotlib.pyplot as plt
from rough_radiation import rough_radiation

import vibroacoustics as va

study = va.load_study("studies/many_speeds.toml")
results = va.run(study, radiation=rough_radiation)
print(results.sizes["speed"], "speeds,", results.sizes["order"] - 1, "orders at the slowest")

# %%
# Where a tuned mass helps
# ------------------------
# It is tuned to 3500 rpm: a narrow valley, and a hill beside it. A counterweight does the same at
# every speed.
level = results["order_level"].sel(order=1, weighting="A", receiver="front_1m")
figure, axes = plt.subplots(layout="constrained")
for option in results["option"].values:
    axes.plot(level["speed"], level.sel(option=option), label=option)
axes.set(xlabel="speed, rpm", ylabel="level of the 1× line, dB(A)")
axes.legend(fontsize="small")

# %%
# Foot force over speed
# ---------------------
# Above the machine's six natural frequencies the force into the feet hardly depends on speed.
foot = results["foot_force_amplitude"].sel(option="none").max("foot").sel(order=1)
figure, axes = plt.subplots(layout="constrained")
axes.plot(foot["speed"], foot)
axes.set(xlabel="speed, rpm", ylabel="largest 1× force into a foot, N", ylim=(0.0, None))
