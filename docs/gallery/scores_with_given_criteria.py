"""
Scores with given criteria
==========================

What no model computes, such as cost or free room, is given in the study beside what is computed.
Fixed scales turn both into utilities from 0 to 1, weights into a score. See :doc:`/criteria`.

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
# How much the ranking depends on the weights
# -------------------------------------------
# The share of random weightings in which an option comes first.
figure, axes = plt.subplots(layout="constrained")
axes.bar(results["option"].values, 100.0 * results["first_place_share"])
axes.set_ylabel("first place, % of random weightings")

# %%
# Other weights
# -------------
# ``va.score`` ranks finished results again (``vibroacoustics score RESULTS.nc``), here with cost
# counting more and more. The settings of the study are changed through a copy.
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
