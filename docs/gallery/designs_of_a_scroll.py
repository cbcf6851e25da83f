"""
Designs: a counterweight or a sprung mass, and which mounts
===========================================================

The best balancer, its mass and tuning, and the best mounts. The table ``design`` of a study has
variables, objectives and tolerances. :func:`vibroacoustics.optimise` finds the front, on the
command line ``vibroacoustics optimise designs.toml``; ``vibroacoustics sweep`` computes a grid or a
sample of the same table. All keys: :doc:`/designs`.

.. literalinclude:: /gallery/studies/designs.toml
   :language: toml
"""

import matplotlib.pyplot as plt
from rough_radiation import rough_radiation

import vibroacoustics as va

study = va.load_study("studies/designs.toml")
search = va.optimise(study, radiation=rough_radiation)

# %%
# The front
# ---------
# No design of the front is better than another in both objectives. It consists of sprung masses: a
# rotating counterweight balances at best half of the oscillating force of the ring.
values = search["wanted_value"].sel(wanted=["line", "foot"])
allowed, front = search["meets_constraints"] == 1, search["on_front"] == 1
figure, axes = plt.subplots(layout="constrained", figsize=(6.4, 4.0))
axes.plot(*values[allowed].T, ".", color="0.75", label="allowed designs")
axes.plot(*values[front].T, "o", label="front")
axes.set(xlabel="Change of the 1x line, dB, worse speed", ylabel="1x force into a foot, N")
axes.set(xlim=(-12, 6), ylim=(0.15, 0.6))
axes.legend()

# %%
# Promised values
# ---------------
# Nine of ten of 2000 specimens that the search did not use reach the promised values.
for rank in search["best_rank"].values:
    row = int(search["best_design"].sel(best_rank=rank))
    design = search["design_value"].sel(design=row).dropna("design_variable")
    for key, value in zip(design["design_variable"].values, design.values, strict=True):
        print(f"{rank}  {key:45s} {value:9.2f}")
    for name in ("line", "foot"):
        meant, promised = (
            search[kind].sel(best_rank=rank, wanted=name).item()
            for kind in ("wanted_as_meant", "wanted_promised")
        )
        print(f"{rank}  {name:10s} as meant {meant:6.2f}, promised {promised:6.2f}")

# %%
# Influence of the variables
# --------------------------
# Share of each variable in the variance over the design space, with the lower end of its bootstrap
# interval. Below the floor it is not resolved from chance.
print(search["design_share"].to_pandas().T.round(2).to_string())
print(search["design_share_low"].to_pandas().T.round(2).to_string())
print(search["design_share_floor"].to_pandas().round(3).to_string())
