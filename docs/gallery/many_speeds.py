"""
Many speeds
===========

A range of speeds in place of a list, up to a thousand of them; at each as many orders as the
highest frequency holds.

.. literalinclude:: /gallery/studies/many_speeds.toml
   :language: toml
   :lines: 5-10
"""

from rough_radiation import rough_radiation

import vibroacoustics as va

study = va.load_study("studies/many_speeds.toml")
results = va.run(study, radiation=rough_radiation)
print(results.sizes["speed"], "speeds,", results.sizes["order"] - 1, "orders at the slowest")

# %%
# Level over the speed
# --------------------
# The spring-mass is tuned to 3500 rpm: a narrow valley there, and a hill at 2000 rpm, where mass
# and ring swing against each other. A counterweight does the same at every speed. The total hardly
# follows: most of it is not modelled.
figure = va.plot.levels_over_speed(results)

# %%
# Orders over the speed
# ---------------------
# Any channel of a study: sound pressure, forces, moments, feet.
figure = va.plot.orders_over_speed(results, "foot force rear_left z", "spring-mass")

# %%
# Campbell diagram
# ----------------
# Of a rigid machine the modes on the mounts alone, far below 1×. Shell and gas need sources that
# drive them: :doc:`/over_speed`.
figure = va.plot.campbell(results, option="spring-mass")

# %%
# Speeds to avoid
# ---------------
# Where level or foot force stands out by 3 dB; shaded here, in the report also a table and
# ``speeds.csv``.
figure = va.plot.levels_over_speed(results, options=["spring-mass"])
