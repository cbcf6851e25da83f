"""
Many speeds
===========

A range of up to a thousand speeds; each has the orders up to the highest frequency.

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
# The spring-mass is tuned to 3500 rpm: a narrow minimum there, and a maximum at 2000 rpm, where
# mass and ring vibrate in opposite phase. A counterweight has the same effect at every speed. The
# total hardly changes, as most of it is unmodelled noise.
figure = va.plot.levels_over_speed(results)

# %%
# Orders over the speed
# ---------------------
# Any channel of a study: sound pressure, forces, moments, feet.
figure = va.plot.orders_over_speed(results, "foot force rear_left z", "spring-mass")

# %%
# Campbell diagram
# ----------------
# A rigid machine has only modes on its mounts, far below 1×. Modes of shell and gas need sources
# that drive them: :doc:`/over_speed`.
figure = va.plot.campbell(results, option="spring-mass")

# %%
# Speeds to avoid
# ---------------
# Maxima of level or foot force by 3 dB: shaded here, in the report also a table and ``speeds.csv``.
figure = va.plot.levels_over_speed(results, options=["spring-mass"])
