"""
A heat pump on a terrace
========================

Lawn instead of a hard floor, a fence towards the neighbour, and under the feet a base of sheet
steel that radiates (:doc:`/outdoors`, :doc:`/structure_borne`). The study is coarse, to 250 Hz.

.. literalinclude:: /gallery/studies/terrace.toml
   :language: toml
"""

import matplotlib.pyplot as plt
import numpy as np

import vibroacoustics as va

study = va.load_study("studies/terrace.toml")
results = va.run(study)

# %%
# Effect of lawn and fence
# ------------------------
# Pressure at the neighbour's per velocity of the machine, relative to the hard floor. Over a hard
# floor vertical vibration (``tz``) and its image nearly cancel; over lawn they do not.
ways = "radiation.surroundings.ground", "radiation.surroundings.barrier"
hard = va.radiate(study.replace(dict.fromkeys(ways)))["transfer_vector"]
lawn = va.radiate(study.replace({ways[1]: None}))["transfer_vector"]
figure, axes = plt.subplots(layout="constrained")
for name, vectors, style in (
    ("lawn", lawn, "--"),
    ("lawn and fence", results["transfer_vector"], "-"),
):
    for dof, colour in (("tx", "C0"), ("tz", "C1")):
        ratio = abs(vectors / hard).sel(receiver="neighbour", dof=dof)
        axes.plot(
            ratio["frequency"], 20.0 * np.log10(ratio), style, color=colour, label=f"{dof}, {name}"
        )
axes.axhline(0.0, color="grey", linewidth=0.5)
axes.set(xlabel="frequency, Hz", ylabel="dB relative to the hard floor")
axes.legend()

# %%
# Airborne and structure-borne sound
# ----------------------------------
# The 1× line at the neighbour's by each path. The range holds 90 % of such plates.
at = results.sel(receiver="neighbour", speed=2900.0)
by_air = at["order_level"].sel(order=1, weighting="A")
by_plate = at["structure_borne_line_level"].sel(line="order 1", weighting="A")
low, high = (at[f"structure_borne_line_{end}"].sel(line="order 1") for end in ("low", "high"))
options = at["option"].values
rows = np.arange(options.size)
figure, axes = plt.subplots(layout="constrained")
axes.barh(
    rows, (high - low).values, left=(by_plate + low).values, height=0.5, color="C1", alpha=0.3
)
axes.plot(by_plate, rows, "|", color="C1", markersize=14, label="structure-borne")
axes.plot(by_air, rows, "o", color="C0", label="airborne")
axes.set(yticks=rows, yticklabels=options, xlabel="1× at the neighbour's, dB(A)")
axes.set_xlim(left=-60.0)
figure.legend(loc="outside lower center", ncols=2)
plt.show()
