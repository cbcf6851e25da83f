"""
Machine: slider-link compressor on springs
==========================================

The household compressor of Dagilis et al.: the crank pin moves in a link of the piston, and the
block is on springs in the shell. Equations and published values: :doc:`/machines/slider_link`.

.. literalinclude:: /gallery/studies/dagilis.toml
   :language: toml
"""

import matplotlib.pyplot as plt
from rough_radiation import rough_radiation

import vibroacoustics as va

study = va.load_study("studies/dagilis.toml")
results = va.run(study, radiation=rough_radiation)

# %%
# Two stages of isolation
# -----------------------
# The displacement of the block is a hundred times that of the shell.
first = {"order": 1, "speed": 2950.0, "option": "none", "dof": "tx"}
for name in ("block_velocity_order", "velocity_order"):
    along = abs(results[name].sel(first).sum("source")).item()
    print(f"{results[name].attrs['long_name']:52s} {1e3 * along:8.3f} mm/s along the stroke")

# %%
# Natural frequencies: block on its springs and shell on its grommets, twelve in all.
print(*(f"{value:.1f}" for value in results["natural_frequency"].values), "Hz")

# %%
# Softer springs and better balance
# ---------------------------------
foot = results["foot_force_amplitude"].sel(speed=2950.0, order=1).max("foot")
figure, axes = plt.subplots(layout="constrained")
axes.barh(foot["option"].values, 1e3 * foot)
axes.set_xlabel("largest 1× force into a foot, mN")
