"""
Machine: given by a table of its forces
=======================================

Force and moment by order from a multibody program or a test bench. The machine has five feet, with
mounts whose stiffness grows with frequency. File layouts: :doc:`/machines/table` and
:doc:`/mounts`.

.. literalinclude:: /gallery/studies/by_table.toml
   :language: toml
"""

import matplotlib.pyplot as plt
from rough_radiation import rough_radiation

import vibroacoustics as va

study = va.load_study("studies/by_table.toml")
results = va.run(study, radiation=rough_radiation)

# %%
# Forces of the table and of options
# ----------------------------------
# The table has no options; further tables give the sliding mass and the planes of the weights.
shown = results["force_amplitude"].sel(speed=950.0, order=[1, 2, 4])
for option in shown["option"].values:
    print(f"{option:20s}", *(f"{value:9.2f}" for value in shown.sel(option=option).values), "N")

# %%
# Five feet
# ---------
figure, axes = plt.subplots(layout="constrained", figsize=(6.4, 3.6))
force = results["foot_force_amplitude"].sel(order=1, option="none")
for foot in force["foot"].values:
    axes.plot(force["speed"], force.sel(foot=foot), marker="o", label=foot)
axes.set(xlabel="rpm", ylabel="1x force into a foot, N", title="Without a balancer")
axes.legend(fontsize="small")
