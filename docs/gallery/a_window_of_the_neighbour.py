"""
At the neighbour's window
=========================

The rating level at a window, with the adjustment for tones, against the limit at night
(:doc:`/rating`); coarsely, to 250 Hz.

.. literalinclude:: /gallery/studies/neighbour.toml
   :language: toml
"""

import matplotlib.pyplot as plt
import numpy as np

import vibroacoustics as va

study = va.load_study("studies/neighbour.toml")
results = va.run(study)

# %%
# Will it be allowed?
# -------------------
# Rating levels of all options if the machine runs the whole hour, and half of it.
at = results.sel(speed=2900.0)
rows = np.arange(at.sizes["option"])
figure, axes = plt.subplots(layout="constrained")
for window, marker in zip(at["rating_window"].values, "os", strict=True):
    level = at["rating_level"].sel(rating_window=window)
    axes.plot(level, rows, marker, label=str(window).replace("_", " "))
axes.axvline(float(results["rating_limit"][0]), color="grey", linestyle="--")
axes.set(yticks=rows, yticklabels=at["option"].values, xlabel="rating level, dB(A)")
figure.legend(loc="outside lower center", ncols=2)
