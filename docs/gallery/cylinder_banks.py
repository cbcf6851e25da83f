"""
Banks of cylinders: four, six, eight
====================================

The compressors of Tsuji et al., figure 1: two opposite crank throws, on each the rods of two, three
or four banks. Throws and banks determine the remaining orders of the force. Comparison with closed
forms: :doc:`/machines/reciprocating`.

.. literalinclude:: /gallery/studies/banks.toml
   :language: toml
"""

import matplotlib.pyplot as plt
from rough_radiation import rough_radiation

import vibroacoustics as va

study = va.load_study("studies/banks.toml")
results = va.run(study, radiation=rough_radiation)

# %%
# Orders of force and moment
# --------------------------
# Opposite throws have no force of the first order but a couple. It rotates with the crank if the
# banks are evenly spaced over half a turn, and counterweights balance it. The second order has the
# same sign on both throws and adds up.
figure, axes = plt.subplots(1, 2, layout="constrained", figsize=(8.0, 3.6))
shown = {"force_amplitude": "force, N", "moment_amplitude": "moment, N m"}
for panel, (name, label) in zip(axes, shown.items(), strict=True):
    for number, option in enumerate(results["option"].values):
        values = results[name].sel(speed=1000.0, option=option, order=slice(1, 6))
        panel.bar(values["order"] + 0.2 * (number - 1.5), values, width=0.18, label=option)
    panel.set(xlabel="order", ylabel=label)
axes[0].legend(fontsize="small")

# %%
# With more cylinders the gas torque is more even, and the speed fluctuation is smaller.
figures = results["reported_figure"].sel(speed=1000.0, figure="speed_fluctuation_percent")
for option in results["option"].values:
    print(f"{option:20s} {figures.sel(option=option).item():6.2f} % speed fluctuation")
