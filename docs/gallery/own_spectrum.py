"""
A measured spectrum as evidence
===============================

Third octaves of the machine contain more information on its sources than its published level. A
study names a table of them, which weights the samples together with the level. Method and limits:
:doc:`/uncertainty`.

.. literalinclude:: /gallery/studies/own_spectrum.toml
   :language: toml
   :lines: 6-10

The table has the columns ``frequency_hz`` and ``level_db`` (unweighted) or ``level_dba``:

.. literalinclude:: /gallery/studies/own_third_octaves.csv
   :lines: 1-4
"""

import matplotlib.pyplot as plt
from rough_radiation import rough_radiation

import vibroacoustics as va

study = va.load_study("studies/own_spectrum.toml")
results = va.run(study, radiation=rough_radiation)
effective = results["alternative_effective"].sel(alternative="level alone").item()
print(
    f"{results.sizes['prior_sample']} samples; with the level alone {effective:.0f} are effective"
)

# %%
# Shares with and without the spectrum
# ------------------------------------
# Shares of the energy of the machine, mean and 80 % interval: with the published level alone, and
# with the spectrum too.
at = {"speed": 2900.0, "option": "none", "receiver": "front_1m"}
shares = {name: ("source_share", {"sound_source": name, **at}) for name in ("gas", "keys")}
shares["unmodelled"] = ("unmodelled_share", at)
for name, (variable, where) in shares.items():
    alone = va.estimate(results, "alternative_share", alternative="level alone", energy_part=name)
    both = va.estimate(results, variable, **where)
    ratio = (both.high - both.low) / (alone.high - alone.low)
    print(
        f"{name:10s} {alone.value:5.2f} ({alone.low:.2f} to {alone.high:.2f}) -> "
        f"{both.value:.2f} ({both.low:.2f} to {both.high:.2f}), {ratio:.2f} times as wide"
    )

# %%
# Difference of model and measurement
# -----------------------------------
# Before the data the model has a wide range in each band. The report names bands in which the
# weighted samples miss the measured level.
bands = results["spectrum_band"].values
figure, axes = plt.subplots(figsize=(7.0, 3.5))
for name, label, colour in (
    ("spectrum_before", "expected by the model", "0.7"),
    ("spectrum_after", "weighted", "tab:blue"),
):
    low, median, high = results[name].transpose("datum_quantile", "spectrum_band").values
    axes.fill_between(bands, low, high, color=colour, alpha=0.4)
    axes.plot(bands, median, color=colour, label=label)
axes.plot(bands, results["spectrum_measured"].values, "ko", label="measured")
axes.set_xscale("log")
axes.set_xticks(bands, [f"{band:g}" for band in bands], minor=False)
axes.minorticks_off()
axes.set_xlabel("Third octave, Hz")
axes.set_ylabel("Level, dB(A)")
axes.legend()
figure.tight_layout()
