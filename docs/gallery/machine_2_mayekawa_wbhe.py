"""
Machine: Mayekawa WBHE, large reciprocating compressor
======================================================

One cylinder of the compressor of Tsuji et al. Piston and rod make a force along the cylinder; a
counterweight moves part of it across. Equations and published values:
:doc:`/machines/reciprocating`.

.. literalinclude:: /gallery/studies/mayekawa.toml
   :language: toml
"""

import matplotlib.pyplot as plt
from rough_radiation import rough_radiation

import vibroacoustics as va

study = va.load_study("studies/mayekawa.toml")
results = va.run(study, radiation=rough_radiation)

# %%
# The path of the force
# ---------------------
# With half of the oscillating mass in the counterweight the line becomes a circle, with all of it a
# line across. Lanchester's two shafts balance the first order and leave the second.
figure, axes = plt.subplots(layout="constrained", figsize=(4.8, 4.8))
for option in ("none", "counterweight-half", "counterweight-full", "lanchester"):
    force = results["force"].sel(speed=1200.0, option=option).sum("source")
    axes.plot(force.sel(axis="x"), force.sel(axis="z"), label=option)
axes.set(xlabel="force x, N", ylabel="force z, N", aspect="equal")
figure.legend(fontsize="small", loc="outside right upper")

# %%
# Orders
# ------
# The finite length of the connecting rod makes the second order, which no counterweight balances.
shown = results["force_amplitude"].sel(speed=1200.0, order=[1, 2, 4, 6])
for option in shown["option"].values:
    print(f"{option:20s}", *(f"{value:9.2f}" for value in shown.sel(option=option).values), "N")

# %%
# Further numbers of the machine are reported figures.
figures = results["reported_figure"].sel(option="none")
for name in results["figure"].values:
    print(f"{name:32s}", *(f"{value:9.3g}" for value in figures.sel(figure=name).values))
