"""
Machine: Mayekawa WBHE, large reciprocating compressor
======================================================

One cylinder of the compressor of Tsuji et al. Piston and rod make a force along the cylinder; a
counterweight turns it from the stroke into the plane across. Equations and published numbers:
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
# Half of the oscillating mass in the counterweight makes a circle of the line, all of it turns the
# line; Lanchester's two shafts take the first order and leave the second.
figure, axes = plt.subplots(layout="constrained", figsize=(4.8, 4.8))
for option in ("none", "counterweight-half", "counterweight-full", "lanchester"):
    force = results["force"].sel(speed=1200.0, option=option).sum("source")
    axes.plot(force.sel(axis="x"), force.sel(axis="z"), label=option)
axes.set(xlabel="force x, N", ylabel="force z, N", aspect="equal")
figure.legend(fontsize="small", loc="outside right upper")

# %%
# Orders
# ------
# The connecting rod's finite length makes the second order; it stays with every counterweight.
shown = results["force_amplitude"].sel(speed=1200.0, order=[1, 2, 4, 6])
for option in shown["option"].values:
    print(f"{option:20s}", *(f"{value:9.2f}" for value in shown.sel(option=option).values), "N")

# %%
# What the machine file gives beside forces is kept as reported figures.
figures = results["reported_figure"].sel(option="none")
for name in results["figure"].values:
    print(f"{name:32s}", *(f"{value:9.3g}" for value in figures.sel(figure=name).values))
