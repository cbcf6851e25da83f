"""
Dominant sources and their uncertainty
======================================

Gas forces, Oldham keys and motor drive an elastic shell. Uncertain parameters are sampled from
their ranges, and every quantity is computed in every sample. Results: :doc:`/sources_of_sound`;
method: :doc:`/uncertainty`.

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
print(f"{results.sizes['prior_sample']} samples at the published level")
print(f"{results.sizes['sample']} rows in all cases: samples with ten discrepancies each")

# %%
# Levels by source
# ----------------
# ``va.estimate`` gives the median of the weighted samples and its 80 % interval; the nominal value
# has a variable of its own. Levels of sources do not add up to that of the machine.
none = results.sel(option="none")
for source in none["sound_source"].values:
    low, value, high = va.estimate(none, "source_level", sound_source=source)
    nominal = none["source_level_nominal"].sel(sound_source=source).item()
    print(f"{source:15s} {value:7.1f} ({low:.1f} to {high:.1f}), nominal {nominal:.1f} dB(A)")
low, value, high = va.estimate(none, "level_total")
print(f"{'machine':15s} {value:7.1f} ({low:.1f} to {high:.1f}) dB(A)")

# %%
# Shares of the energy are means: with that of unmodelled noise they add up to 100 %.
shares = {
    str(source): none["source_share"].sel(sound_source=source).item()
    for source in none["sound_source"].values
}
shares["unmodelled"] = none["unmodelled_share"].item()
for name, share in shares.items():
    print(f"{name:15s} {round(100.0 * share, 1) + 0.0:6.1f} %")
print(f"{'sum':15s} {100.0 * sum(shares.values()):6.1f} %")

# %%
# Changes
# -------
# A change is the median of the changes in the samples. Its probability is the weight of the samples
# with a measurable change.
damping = results.sel(option="damping")
low, value, high = (round(one, 1) + 0.0 for one in va.estimate(damping, "change_total"))
print(f"damping changes the total by {value:+.1f} dB ({low:+.1f} to {high:+.1f})")
louder = damping["increase_probability"].sel(judged_quantity="level_total").item()
print(f"probability that it is louder by 0.5 dB or more: {100.0 * louder:.0f} %")

# %%
# What would change the answer
# ----------------------------
# The same samples, reweighted: with fewer data, another prior of unmodelled noise, no discrepancy,
# or other oil on the keys (:doc:`/changed_inputs`). The report shows rows with at least 20
# effective samples.
for name in none["alternative"].values:
    row = none.sel(alternative=name)
    level, share = (row[f"alternative_{what}"] for what in ("level", "share"))
    size, gas = row["alternative_effective"].item(), share.sel(energy_part="gas").item()
    print(f"{name:45s} {level.item():5.1f} dB(A), gas {100.0 * gas:3.0f} %, effective {size:4.0f}")

# %%
# Transfer paths
# --------------
# Source, where it acts, in which direction: shares of the modelled energy add up to one over all
# paths, and those of opposing paths are negative (:doc:`/report`). They are means over the samples.
share = results["path_share"].sel(path_speed=2900.0)
for path in share["path"].values[np.argsort(-abs(share.values))[:6]]:
    print(f"{path:35s} {100.0 * share.sel(path=path).item():+6.1f} %")

# %%
# Samples
# -------
# Dots are samples with a discrepancy, with an area by weight. Lines are medians, crosses are
# nominal values.
sampled = none["source_level_by_sample"]
size = 400.0 * results["sample_weight"].isel(prior=0)
figure, axes = plt.subplots(layout="constrained")
for number, source in enumerate(("gas", "keys", "moving_parts")):
    levels = sampled.sel(sound_source=source)
    axes.scatter(np.full(levels.size, number), levels, s=size, alpha=0.5)
    axes.plot(number, none["source_level"].sel(sound_source=source), "k_", markersize=30)
    axes.plot(number, none["source_level_nominal"].sel(sound_source=source), "kx")
axes.set(xticks=range(3), xticklabels=["gas", "keys", "moving parts"], ylabel="level, dB(A)")

# %%
# Uncertain parameters
# --------------------
# The twelve largest rank correlations of a sampled value with the level of all modelled sources.
level = none["level_modelled_by_sample"]
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
