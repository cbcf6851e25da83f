"""
Scores with given criteria
==========================

Criteria without a model, such as cost or space, are given in the study. Fixed scales give utilities
from 0 to 1, and weights a score. See :doc:`/criteria`.

.. literalinclude:: /gallery/studies/given.toml
   :language: toml
   :lines: 13-
"""

import matplotlib.pyplot as plt
import numpy as np
from rough_radiation import rough_radiation

import vibroacoustics as va

study = va.load_study("studies/given.toml")
results = va.run(study, radiation=rough_radiation)

# %%
# Values, score and rank of every option
# --------------------------------------
names = results["criterion"].values
print(f"{'':15s}", *(f"{name:>16s}" for name in names), f"{'score':>8s} {'rank':>5s}")
for option in results["option"].values:
    one = results.sel(option=option)
    score, rank = (
        one[name].sel(scoring_method="weighted_sum").item() for name in ("score", "rank")
    )
    values = (f"{value:16.3g}" for value in one["criterion_value"].values)
    print(f"{option:15s}", *values, f"{score:8.2f} {rank:5.0f}")

# %%
# Dependence of the ranking on the weights
# ----------------------------------------
# Share of random weightings in which an option ranks first.
figure, axes = plt.subplots(layout="constrained")
axes.bar(results["option"].values, 100.0 * results["first_place_share"])
axes.set_ylabel("first place, % of random weightings")

# %%
# Other weights
# -------------
# ``va.score`` ranks results again (``vibroacoustics score RESULTS.nc``), here with increasing
# weight of the cost, in a copy of the settings.
shares = np.linspace(0.0, 0.9, 10)
scores = []
for share in shares:
    weights = {
        "foot_force_1x_n": 0.8 * (1.0 - share),
        "cost_eur": share,
        "room": 0.2 * (1.0 - share),
    }
    scales = {
        name: scale.model_copy(update={"weight": max(weights[name], 1e-9)})
        for name, scale in study.scoring.criteria.items()
    }
    settings = study.scoring.model_copy(update={"criteria": scales})
    scores.append(va.score(results, settings)["score"].sel(scoring_method="weighted_sum"))

figure, axes = plt.subplots(layout="constrained")
for option in results["option"].values:
    axes.plot(shares, [score.sel(option=option).item() for score in scores], label=option)
axes.set(xlabel="weight of the cost", ylabel="score", ylim=(0, 1))
axes.legend(fontsize="small")
