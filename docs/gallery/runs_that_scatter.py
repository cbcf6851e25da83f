"""
Designs whose runs scatter: keys of a second ring
=================================================

Keys that are nearly dry strike their slots, and the level of a run depends on how they start. Each
run is an experiment with scatter. ``method = "active"`` chooses one run after another by a Gaussian
process, and repeats the best design at the end. All keys: :doc:`/designs`.

.. literalinclude:: /gallery/studies/active_search.toml
   :language: toml
"""

import matplotlib.pyplot as plt
from rough_radiation import rough_radiation

import vibroacoustics as va

study = va.load_study("studies/active_search.toml")
search = va.optimise(study, radiation=rough_radiation)

# %%
# The runs
# --------
# The first runs fill the space. The others are where the expected gain is largest: near the best
# design, and where little is known. Every fifth run repeats the best design with another start.
stroke, inertia = search["design_value"].values.T
level = search["wanted_value"].sel(wanted="level").values
figure, axes = plt.subplots(layout="constrained", figsize=(6.4, 4.0))
points = axes.scatter(stroke, 1e4 * inertia, c=level, s=60, cmap="viridis")
axes.set(xlabel="Stroke of the second ring over the first", ylabel="Driven inertia, 1e-4 kg m²")
figure.colorbar(points, label="Level, dB(A)")

# %%
# What the best design promises
# -----------------------------
# Mean of the last runs, which the search had not seen, with its 95 % interval.
low, mean, high = (search[f"wanted_promised{end}"].item() for end in ("_low", "", "_high"))
print(f"{mean:.2f} dB(A), 95 %: {low:.2f} to {high:.2f}")
print(search.attrs["method"])
