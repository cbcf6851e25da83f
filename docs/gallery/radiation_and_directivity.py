"""
Radiation, map and directivity
==============================

Sound of the vibrating shell on a coarse grid: cut cells around the shell, joined by reciprocity
with the Green's function of the floor (:doc:`/radiation`). The study also has sound power by ISO
3744, a map of levels and the directivity. ``vibroacoustics radiation STUDY.toml`` (``va.radiate``)
computes the radiation alone.

.. literalinclude:: /gallery/studies/field.toml
   :language: toml
"""

import matplotlib.pyplot as plt
import numpy as np

import vibroacoustics as va

study = va.load_study("studies/field.toml")
results = va.run(study)

# %%
# Transfer vectors
# ----------------
# Pressure at a microphone per velocity of the housing, with the estimated error of the grid.
vectors = results["transfer_vector"].sel(receiver="front_1m")
errors = results["transfer_vector_error"].sel(receiver="front_1m")
figure, axes = plt.subplots(layout="constrained")
for dof in ("tx", "tz", "ry"):
    size, error = abs(vectors.sel(dof=dof)), errors.sel(dof=dof)
    axes.loglog(vectors["frequency"], size, label=dof)
    axes.fill_between(vectors["frequency"], size - error, size + error, alpha=0.3)
axes.set(xlabel="frequency, Hz", ylabel="Pa s/m (ry: Pa s/rad)")
axes.legend()

# %%
# A map of the 1x line
# --------------------
# In the plane along the stroke. The machine vibrates along x: two lobes above their mirror images.
level = results["map_level"].sel(speed=2900.0, option="none")
level = level.clip(min=level.max() - 40.0)  # the plane between the lobes is silent
figure, axes = plt.subplots(layout="constrained")
drawn = axes.contourf(results["map_x"], results["map_z"], level, levels=20)
figure.colorbar(drawn, label="level of the 1× line, dB")
axes.set(xlabel="x, m", ylabel="z, m", aspect="equal")

# %%
# Directivity
# -----------
# Around the machine at ten metres, for motion along x and along y, each in dB of its largest.
around = abs(results["directivity_transfer_vector"].isel(line_frequency=0))
figure, axes = plt.subplots(subplot_kw={"projection": "polar"}, layout="constrained")
azimuth = np.append(around["azimuth"], 2.0 * np.pi)
for dof, name in (("tx", "motion along x"), ("ty", "motion along y")):
    ring = around.sel(dof=dof).isel(polar_angle=-1)
    decibel = 20.0 * np.log10(np.maximum(ring / ring.max(), 1e-2))
    axes.plot(azimuth, np.append(decibel, decibel[0]), label=name)
axes.set(rmin=-40.0, rmax=0.0)
figure.legend(fontsize="small", loc="outside lower center", ncols=2)

# %%
# Sound power level
# -----------------
power = results["sound_power_level"].sel(speed=2900.0, weighting="A")
for option in power["option"].values:
    print(f"{option:20s} {power.sel(option=option).item():6.1f} dB(A)")
