"""
What carries the level, and how well is it known?
=================================================

Gas forces, Oldham keys and motor drive an elastic shell. What is not known is sampled from its
range; every sample keeps its levels. Method and findings: :doc:`/sources_of_sound`.

.. literalinclude:: /gallery/studies/sources.toml
   :language: toml
   :lines: 5-12, 28-44
"""

import matplotlib.pyplot as plt
import numpy as np
from rough_radiation import rough_radiation

import vibroacoustics as va

study = va.load_study("studies/sources.toml")
results = va.run(study, radiation=rough_radiation).sel(receiver="front_1m", speed=2900.0)

# %%
# Levels by source, as assumed
# ----------------------------
alone = results["source_level"].sel(option="none")
for source in alone["sound_source"].values:
    print(f"{source:15s} {alone.sel(sound_source=source).item():7.1f} dB(A)")
print(
    f"{'all of them':15s} {results['level_modelled'].sel(option='none', weighting='A').item():7.1f}"
)

# %%
# Which way it comes
# ------------------
# Source, where it acts, in which direction: shares of the modelled energy add up to one over all
# paths, and those that work against the others are negative (:doc:`/report`).
share = results["path_share"].sel(option="none", path_speed=2900.0)
for path in share["path"].values[np.argsort(-abs(share.values))[:6]]:
    print(f"{path:35s} {100.0 * share.sel(path=path).item():+6.1f} %")

# %%
# With the samples
# --------------
# Samples were weighed by how well they agree with the published level; those that do went on.
print(f"{results.sizes['prior_sample']} samples were weighed, {results.sizes['sample']} went on")
sampled = results["source_level_by_sample"].sel(option="none")
figure, axes = plt.subplots(layout="constrained")
for number, source in enumerate(("gas", "keys", "moving_parts")):
    levels = sampled.sel(sound_source=source)
    axes.plot(np.full(levels.size, number), levels, "o", alpha=0.5)
    axes.plot(number, alone.sel(sound_source=source), "k_", markersize=30)
axes.set(xticks=range(3), xticklabels=["gas", "keys", "moving parts"], ylabel="level, dB(A)")

# %%
# What makes the spread
# ---------------------
# Rank correlation of each sampled value with the level of all modelled sources, the twelve largest;
# more samples make it sharper.
level = results["level_modelled_by_sample"].sel(option="none")
ranks = {
    name: np.argsort(np.argsort(results["sampled_value"].sel(uncertain_parameter=name)))
    for name in results["uncertain_parameter"].values
}
loudness = np.argsort(np.argsort(level))
correlation = {name: np.corrcoef(rank, loudness)[0, 1] for name, rank in ranks.items()}
names = sorted(correlation, key=lambda name: abs(correlation[name]))[-12:]
figure, axes = plt.subplots(layout="constrained")
axes.barh(names, [correlation[name] for name in names])
axes.set(xlabel="rank correlation with the level", xlim=(-1, 1), xticks=[-1, 0, 1])
