"""
Softer mounts, from measurements
================================

A compressor is on two mounts on a plate. Its level on softer mounts, with a mass on the plate, or
with an absorber, follows from hammer tests and one recording of the running machine, without a
model of source or plate. Formula, files and units: :doc:`/measured_changes`.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import vibroacoustics as va

folder = Path(tempfile.mkdtemp())
random = np.random.default_rng(1)

# %%
# Synthetic bench
# ---------------
# Heave and pitch of a machine of 25 kg, fifteen modes of a plate, two mounts, a microphone. The
# prediction does not use these values; at the end they are the truth.
frequency = np.arange(24.0, 601.0, 4.0)
omega = 2.0 * np.pi * frequency[:, None]
mode = np.arange(1, 16)
mass = np.r_[25.0, 0.6, np.full(15, 4.0)]
own = np.r_[0.0, 0.0, 2.0 * np.pi * 14.0 * mode**2]
plate = np.sin(np.pi * np.outer([0.33, 0.62], mode))
shape = np.block([[np.array([[1.0, -0.15], [1.0, 0.15]]), np.zeros((2, 15))],
                  [np.zeros((2, 2)), plate]])  # fmt: skip
sound = 0.02 * random.standard_normal(17) * np.r_[0.01, 0.01, np.ones(15)]
load = np.zeros((frequency.size, 17, 1), complex)
load[:, :2, 0] = [30.0, 3.0] * np.exp(2j * np.pi * random.random((frequency.size, 2)))
mounts = np.hstack([np.eye(2), -np.eye(2)])
as_measured = mounts.T @ np.diag([2.5e5 * (1.0 + 0.12j)] * 2) @ mounts


def state(stiffness):
    """Return responses of two feet, two plate points and a microphone: per force, and running."""
    diagonal = mass * (own**2 * (1.0 + 0.02j) - omega**2)
    dynamic = np.einsum("fm,mn->fmn", diagonal, np.eye(17)) + shape.T @ stiffness @ shape
    seen = np.concatenate(
        [np.broadcast_to(shape, (frequency.size, 4, 17)), -(omega[:, None] ** 2) * sound], axis=1
    )
    solved = np.linalg.inv(dynamic)
    return seen @ solved @ shape.T, (seen @ solved @ load)[..., 0]


def noisy(values):
    """Return values with an error of 3 %."""
    error = random.standard_normal(values.shape) + 1j * random.standard_normal(values.shape)
    return values * (1.0 + 0.03 * error / np.sqrt(2.0))


# %%
# Files of the measurement
# ------------------------
# Three hammer tests as UFF 58b, accelerances and sound pressure by force, and a table of operating
# spectra. The repeats give the error of the frequency responses.
nodes = [va.Node(1, "+z"), va.Node(2, "+z"), va.Node(11, "+z"), va.Node(12, "+z"), va.Node(101)]
units = ["m"] * 4 + ["Pa"]
responses, running = state(as_measured)
for test in (1, 2, 3):
    functions = [
        va.MeasuredFunction(
            "frequency response", frequency, noisy(responses[:, i, j]), nodes[i], nodes[j],
            units[i], "N",
        ).with_response_in("m/s²" if i < 4 else "Pa")
        for i in range(5) for j in range(4)
    ]  # fmt: skip
    va.export_functions(functions, folder / f"hammer_{test}.uff")
spectra = [
    va.MeasuredFunction("spectrum", frequency, noisy(running[:, i]), nodes[i], None, units[i])
    for i in range(5)
]
print(va.export_functions(spectra, folder / "running.csv").read_text()[:140])

# %%
# Settings
# --------
measured = """
[measured]
frequency_responses = ["hammer_1.uff", "hammer_2.uff", "hammer_3.uff"]
operating = ["running.csv"]
relative_error_percent = 3.0  # of the operating spectra, which have no repeats

[measured.points]
foot_1 = { node = 1, direction = "+z" }
foot_2 = { node = 2, direction = "+z" }
plate_1 = { node = 11, direction = "+z" }
plate_2 = { node = 12, direction = "+z" }

[measured.microphones]
front = { node = 101 }
"""
mount = 'ends = ["foot_{0}", "plate_{0}"]\nstiffness_n_per_mm = 250.0\nloss_factor_percent = 12.0\n'
softer = "stiffness_n_per_mm = 80.0\nloss_factor_percent = 12.0\n"
(folder / "bench.toml").write_text(f"""
title = "Softer mounts, a mass, an absorber"
{measured}
[mounts.left]
{mount.format(1)}
[mounts.right]
{mount.format(2)}
[changes.softer.mounts.left]
{softer}
[changes.softer.mounts.right]
{softer}
[changes.mass.masses.block]
points = ["plate_1"]
mass_kg = 2.0

[changes.absorber.absorbers.tuned]
points = ["plate_2"]
mass_kg = 0.6
stiffness_n_per_mm = 300.0
loss_factor_percent = 10.0
""")

# %%
# On the command line
# -------------------
# ``vibroacoustics hammer`` makes such functions of time records of force and responses.
# ``vibroacoustics check-functions`` asks before whether the functions can be those of a passive
# structure: each point by itself, then each pair.
command = [sys.executable, "-m", "vibroacoustics", "check-functions", "bench.toml"]
done = subprocess.run(command, capture_output=True, text=True, check=True, cwd=folder)
print(done.stdout)

command = [sys.executable, "-m", "vibroacoustics", "predict", "bench.toml", "--out", "."]
done = subprocess.run(command, capture_output=True, text=True, check=True, cwd=folder)
print(done.stdout)

# %%
# Interval and truth
# ------------------
# Dots are the bench with softer mounts. If a line falls by 20 dB, 3 % of the measured value are a
# third of the residual, and the interval is wide.
predicted = va.open_results(folder / "prediction.nc")
after = state(mounts.T @ np.diag([8.0e4 * (1.0 + 0.12j)] * 2) @ mounts)[1][:, 4]
truth = 20.0 * np.log10(np.abs(after) / np.sqrt(2.0) / 20e-6)
figure = va.plot.predicted_levels(predicted)
figure.axes[0].plot(frequency, truth, "k.", markersize=3)

at = predicted.sel(option="softer", receiver="front")
held = (at["predicted_level_low"] <= truth) & (truth <= at["predicted_level_high"])
error = np.abs(at["predicted_level"] - truth)
print(f"within the interval: {held.mean().item():.0%} of {frequency.size} lines")
print(f"error: median {error.median().item():.2f} dB")
before = 20.0 * np.log10(np.abs(running[:, 4]) / np.sqrt(2.0) / 20e-6)
total = 10.0 * np.log10(np.sum(10.0 ** (truth / 10.0)) / np.sum(10.0 ** (before / 10.0)))
print(f"change of the total, truth: {total:+.1f} dB")

# %%
# Blocked forces of the source
# ----------------------------
# The same measurements give blocked forces (ISO 20270), which hold on every other structure: on the
# command line ``vibroacoustics blocked-forces source.toml``, see :doc:`/blocked_forces`. The
# microphone, which the inversion does not use, validates them.
(folder / "source.toml").write_text(f"""
title = "The source in place"
{measured}
[blocked_forces]
points = ["foot_1", "foot_2"]
responses = ["foot_1", "foot_2", "plate_1", "plate_2"]
validation = ["front"]
""")
source = va.blocked_forces(folder / "source.toml")
truth = np.abs(np.linalg.solve(shape[:2, :2].T, load[:, :2, 0].T))
difference = np.abs(20.0 * np.log10(np.abs(source["blocked_force"].values) / truth))
print(f"forces, difference from the truth: median {np.median(difference):.2f} dB")
plt.show()
