"""
Machine: hermetic compressor with oil films
===========================================

The compressor of Estupiñan & Santos: a flexible crankshaft in the oil films of two bearings, and a
block on springs. Equations and published values: :doc:`/machines/estupinan_hermetic`.

.. literalinclude:: /gallery/studies/estupinan.toml
   :language: toml
   :lines: 1-30
"""

import matplotlib.pyplot as plt
import numpy as np
from rough_radiation import rough_radiation

import vibroacoustics as va

study = va.load_study("studies/estupinan.toml")
results = va.run(study, radiation=rough_radiation)

# %%
# Reported figures
# ----------------
# Minimum film, power and speed fluctuation for every option.
print(f"{'':40s}", *(f"{name:>18s}" for name in results["option"].values))
for name in results["figure"].values:
    values = results["reported_figure"].sel(figure=name).isel(speed=0).values
    print(f"{name:40s}", *(f"{value:18.4g}" for value in values))

# %%
# Force along the cylinder, with and without a balancer
# -----------------------------------------------------
figure, axes = plt.subplots(layout="constrained")
for option in results["option"].values:
    force = results["force"].sel(option=option, axis="x").isel(speed=0).sum("source")
    axes.plot(np.degrees(results["crank_angle"]), force, label=option)
axes.set(xlabel="crank angle, °", ylabel="force along the cylinder, N", xlim=(0, 360))
axes.legend(fontsize="small")
