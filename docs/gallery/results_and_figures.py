"""
Results on file, and figures of your own
========================================

Everything that a run computes is one ``xarray.Dataset``, on file one netCDF. Its variables, with
dimensions, units and meaning, are on the page :doc:`/generated/vocabulary`.
"""

import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from rough_radiation import rough_radiation

import vibroacoustics as va

results = va.run(va.load_study("studies/copeland.toml"), radiation=rough_radiation)

# %%
# Each variable says what it is
# -----------------------------
for name in ("force", "transfer_vector", "level_modelled", "score"):
    variable = results[name]
    print(name, variable.dims, variable.attrs["units"], "|", variable.attrs["long_name"])

# %%
# Where the numbers come from is in the attributes: study, machine, versions, hash.
for name in sorted(results.attrs):
    print(f"{name:25s} {str(results.attrs[name])[:60]}")

# %%
# Select, reduce, draw
# --------------------
# The first order at every microphone as an ordinary bar chart.
level = results["order_level"].sel(speed=2900.0, order=1, weighting="Z")
figure, axes = plt.subplots(layout="constrained")
place = np.arange(level.sizes["receiver"])
for number, option in enumerate(("none", "counterweight-half", "twin-oldham")):
    axes.bar(place + 0.27 * (number - 1), level.sel(option=option), 0.27, label=option)
axes.set_xticks(place, level["receiver"].values)
axes.set_ylabel("level of the 1× line, dB")
axes.legend(fontsize="small")

# %%
# Sound by phasors: the pressure at the microphone over one revolution is the real part of the sum
# of the lines.
line = results["pressure_line"].sel(speed=2900.0, receiver="front_1m").isel(sound_source=0)
angle = np.linspace(0.0, 2.0 * np.pi, 721)
figure, axes = plt.subplots(layout="constrained")
for option in ("none", "counterweight-half"):
    peaks, order = line.sel(option=option).values[1:], results["line_order"].values[1:]
    pressure = np.real(peaks @ np.exp(1j * np.outer(order, angle)))
    axes.plot(np.degrees(angle), 1e3 * pressure, label=option)
axes.set(xlabel="crank angle, °", ylabel="sound pressure, mPa", xlim=(0, 360))
axes.legend(fontsize="small")

# %%
# The report
# ----------
# ``va.write_report`` makes HTML, Markdown and tables of the results; ``vibroacoustics run`` calls
# it, ``vibroacoustics report RESULTS.nc`` does it again from the results alone.
with tempfile.TemporaryDirectory() as folder:
    va.write_report(results, folder)
    print(*sorted(path.name for path in Path(folder).iterdir()), sep="\n")
