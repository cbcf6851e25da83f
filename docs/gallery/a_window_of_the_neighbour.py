"""
At the neighbour's window
=========================

The rating level at a window, with the adjustment for tones, and the limit at night
(:doc:`/rating`). The study is coarse, to 250 Hz.

.. literalinclude:: /gallery/studies/neighbour.toml
   :language: toml
"""

import subprocess
import sys
import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import vibroacoustics as va

study = va.load_study("studies/neighbour.toml")
results = va.run(study)

# %%
# Rating levels of options
# ------------------------
# The machine runs for the full hour, or for half of it.
at = results.sel(speed=2900.0)
rows = np.arange(at.sizes["option"])
figure, axes = plt.subplots(layout="constrained")
for window, marker in zip(at["rating_window"].values, "os", strict=True):
    level = at["rating_level"].sel(rating_window=window)
    axes.plot(level, rows, marker, label=str(window).replace("_", " "))
axes.axvline(float(results["rating_limit"][0]), color="grey", linestyle="--")
axes.set(yticks=rows, yticklabels=at["option"].values, xlabel="rating level, dB(A)")
figure.legend(loc="outside lower center", ncols=2)

# %%
# A barrier before the window
# ---------------------------
# A fence 2 m high, 3 m from the machine, as a table of the study file (:doc:`/outdoors`):
#
# .. code-block:: toml
#
#    [radiation.surroundings.barrier]
#    side = "+x"
#    distance_mm = 3000.0
#    height_mm = 2000.0
#
# It lowers the rating level by 15 dB. The radiation takes 4.1 s of processor time in place of
# 1.7 s, to 250 Hz. A wall 1.5 m behind the machine, ``[radiation.surroundings.walls."-x"]``, raises
# the level by 1.6 dB and takes 31 s.
fence = {"side": "+x", "distance_mm": 3000.0, "height_mm": 2000.0}
behind = va.run(study.replace({"radiation.surroundings.barrier": fence}))
for option in ("none", "jacket"):
    case = {"speed": 2900.0, "option": option, "rating_window": "bedroom"}
    before, after = (one["rating_level"].sel(case).item() for one in (results, behind))
    print(f"{option}: {before:.1f} dB(A) without the fence, {after:.1f} dB(A) behind it")

# %%
# By the rules of an authority
# ----------------------------
# ``vibroacoustics permit`` judges a unit by its sound power, as an authority does: each line of the
# calculation is on the page (:doc:`/permits`).
folder = Path(tempfile.mkdtemp())
command = [sys.executable, "-m", "vibroacoustics", "new", "permit", "--out", "unit"]
subprocess.run(command, capture_output=True, check=True, cwd=folder)
command = [sys.executable, "-m", "vibroacoustics", "permit", "unit/permit.toml", "--out", "permit"]
done = subprocess.run(command, capture_output=True, text=True, check=True, cwd=folder)
print(done.stdout)
