"""
Results and your own figures
============================

The results of a run are one ``xarray.Dataset``, stored as netCDF. Its variables, with dimensions,
units and meaning: :doc:`/generated/vocabulary`.
"""

import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from rough_radiation import rough_radiation

import vibroacoustics as va

results = va.run(va.load_study("studies/copeland.toml"), radiation=rough_radiation)

# %%
# Attributes of variables
# -----------------------
for name in ("force", "transfer_vector", "level_modelled", "score"):
    variable = results[name]
    print(name, variable.dims, variable.attrs["units"], "|", variable.attrs["long_name"])

# %%
# Attributes of the dataset have study, machine, versions and hash.
for name in sorted(results.attrs):
    print(f"{name:25s} {str(results.attrs[name])[:60]}")

# %%
# Selections and figures
# ----------------------
# The first order at every microphone as a bar chart.
level = results["order_level"].sel(speed=2900.0, order=1, weighting="Z")
figure, axes = plt.subplots(layout="constrained")
place = np.arange(level.sizes["receiver"])
for number, option in enumerate(("none", "counterweight-half", "twin-oldham")):
    axes.bar(place + 0.27 * (number - 1), level.sel(option=option), 0.27, label=option)
axes.set_xticks(place, level["receiver"].values)
axes.set_ylabel("level of the 1× line, dB")
axes.legend(fontsize="small")

# %%
# The pressure at the microphone over one revolution is the real part of the sum of the lines.
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
# ``va.write_report`` writes HTML, Markdown and tables of results, as ``vibroacoustics run`` and
# ``vibroacoustics report RESULTS.nc`` do.
with tempfile.TemporaryDirectory() as folder:
    va.write_report(results, folder)
    print(*sorted(path.name for path in Path(folder).iterdir()), sep="\n")

# %%
# The data sheet
# --------------
# ``vibroacoustics datasheet RESULTS.nc --option twin-oldham`` writes the predicted declaration of a
# machine (:doc:`/data_sheet`). Bands outside the model are empty; unmodelled noise completes the
# published level.
sheet = va.data_sheet(results, "twin-oldham", points_m={"discharge": (0.0, 0.08, 0.35)})
power = sheet.sound_power
print(f"L_WA = {power.level_dba:.1f} dB, of the model alone {power.modelled_dba:.1f} dB")
for one in sheet.vibration[-3:]:
    print(one.point, one.direction, f"{1e6 * one.displacement_peak_to_peak_m:.3g} µm p-p")
figure, axes = plt.subplots(layout="constrained")
for name, width, colour in (("total_db", 0.8, "0.8"), ("modelled_db", 0.4, "C0")):
    bands = np.array([getattr(band, name) for band in power.bands], dtype=float)
    axes.bar(range(bands.size), bands, width, color=colour, label=name)
axes.set_xticks(range(0, 21, 5), [f"{band.band_hz:g}" for band in power.bands[::5]])
axes.set(xlabel="third octave, Hz", ylabel="sound power level, dB re 1 pW")
axes.legend(fontsize="small")
with tempfile.TemporaryDirectory() as folder:
    print(va.write_data_sheet(sheet, folder).name)
