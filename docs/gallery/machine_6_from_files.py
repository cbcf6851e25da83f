"""
Machine: from files to the report
=================================

A reciprocating compressor with a table of forces, a data sheet of its mounts and a run-up on the
test stand. This page writes the files of a user. Layouts: :doc:`/machines/table`, :doc:`/mounts`
and
:doc:`/measured_baseline`.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from rough_radiation import rough_radiation

import vibroacoustics as va

folder = Path(tempfile.mkdtemp())

# %%
# Forces and mounts
# -----------------
# Peaks and phases by order from a multibody program, at two speeds; dynamic transfer stiffness and
# loss factor over frequency by ISO 10846.
head = "speed_rpm,order,source"
for name, unit in zip(("fx", "fy", "fz", "mx", "my", "mz"), 3 * ["n"] + 3 * ["nm"], strict=True):
    head += f",{name}_{unit},{name}_phase_deg"
rows = [
    f"{rpm},{order},piston,0,0,0,0,{force * (rpm / 1000) ** 2},10,0,0,{moment},{20 * order},0,0"
    for rpm in (700, 1300)
    for order, force, moment in ((1, 2100, 60), (2, 520, 140), (3, 0, 90), (4, 30, 60))
]
(folder / "forces.csv").write_text("\n".join([head, *rows]))
(folder / "mount.csv").write_text(
    "frequency_hz,lateral_n_per_mm,vertical_n_per_mm,loss_factor\n"
    "5,90,140,0.10\n50,110,170,0.12\n500,160,300,0.25\n"
)

# %%
# Machine and study
# -----------------
# The machine is a copy of a shipped one with other files. ``vibroacoustics new table`` writes
# a machine and a study with comments, ``vibroacoustics schema`` the schemas for an editor, and
# ``vibroacoustics check study.toml`` gives errors, time and memory before a run.
data = Path("../../data")
machine = (data / "machines" / "reciprocating_table.toml").read_text()
machine = machine.replace("../tables/reciprocating_forces.csv", "forces.csv")
machine = machine.replace("../tables/reciprocating_mount.csv", "mount.csv")
(folder / "machine.toml").write_text(machine)
(folder / "study.toml").write_text("""
title = "My compressor"
catalogue_receiver = "front_1m"
machine.file = "machine.toml"
operation = { speed_rpm = [850.0, 1000.0], maximum_order = 10 }
scoring.criteria.foot_force_1x_n = { weight = 1.0, best = 0.0, worst = 1000.0 }

[options.none]
kind = "none"

[options.counterweight]
kind = "rotating-counterweight"
share_ratio = 0.5

[receivers.front_1m]
x_mm = 1250.0
y_mm = 0.0
height_mm = 410.0

[radiation]
maximum_frequency_hz = 400.0
""")
study = va.load_study(folder / "study.toml")
model = va.run(study, radiation=rough_radiation)

# %%
# The test stand
# --------------
# Synthetic here: the modelled orders, gas tones without a model, noise, and a tacho pulse at 90°.
rate, seconds, first, last = 2048, 30.0, 800.0, 1050.0
time = np.arange(int(rate * seconds)) / rate
rpm = first + (last - first) * time / seconds
angle = 2.0 * np.pi / 60.0 * (first * time + (last - first) * time**2 / (2.0 * seconds))
random = np.random.default_rng(1)
gas = 0.05 * np.exp(2j * np.pi * random.random(10)) / np.arange(1, 11)  # Pa, peak
lines = model["pressure_line"].sel(receiver="front_1m").sum("sound_source")
lines = lines.isel(line=slice(1, 11)).transpose("option", "speed", "line")


def orders_at(option, speeds):
    """Interpolate complex peaks of the machine, order by speed, between the study's speeds."""
    share = (np.asarray(speeds) - 850.0) / 150.0
    slow, fast = lines.sel(option=option).values
    return gas[:, None] + slow[:, None] * (1.0 - share) + fast[:, None] * share


pressure = 0.02 * random.standard_normal(time.size)
for order, peak in enumerate(orders_at("none", rpm), 1):
    pressure += (peak * np.exp(1j * order * angle)).real
tacho = np.where((angle - np.pi / 2.0) % (2.0 * np.pi) < 0.5, 4.0, 0.0)
recording = va.label_recording([pressure, tacho], rate, ["front_1m", "tacho"], ["Pa", "V"])
va.export_recording(recording, folder / "stand.csv")

# %%
# Its orders, on the command line ``vibroacoustics orders stand.csv …``. The map is needed for third
# octaves over speed.
command = [sys.executable, "-m", "vibroacoustics", "orders", str(folder / "stand.csv")]
command += ["--speed-channel", "tacho", "--pulses", "1", "--orders", "1,2,3,4,5,6,7,8,9,10"]
command += ["--maximum-order", "45", "--resolution", "0.1", "--speed-step", "25", "--map"]
done = subprocess.run([*command, "--out", str(folder)], capture_output=True, text=True, check=True)
print("\n".join(done.stdout.splitlines()[:3]))

# %%
# The baseline
# ------------
# Two lines in the study: measured - modelled (none) + modelled (option), as complex peaks. The
# truth is the recording with the counterweight.
with (folder / "study.toml").open("a") as file:
    file.write('\n[measured.baseline]\nfile = "orders.nc"\ntacho_angle_deg = 90.0\n')
study = va.load_study(folder / "study.toml")
results = va.run(study, radiation=rough_radiation)
print("rpm   order  measured  model alone  baseline  truth, dB, with the counterweight")
for speed in (850.0, 1000.0):
    truth = np.abs(orders_at("counterweight", [speed])[:, 0]) / np.sqrt(2.0) / 2e-5
    alone = np.abs(lines.sel(option="counterweight", speed=speed).values) / np.sqrt(2.0) / 2e-5
    at = results["baseline_order_level"].sel(speed=speed, receiver="front_1m")
    for order in (1, 2, 3):
        levels = (
            at.sel(option="none", baseline_order=order).item(),
            20.0 * np.log10(alone[order - 1]),
            at.sel(option="counterweight", baseline_order=order).item(),
            20.0 * np.log10(truth[order - 1]),
        )
        print(f"{speed:5.0f} {order:5d}", *(f"{level:10.1f}" for level in levels))

# %%
# The report
# ----------
# ``vibroacoustics run study.toml`` does all of this section. The report lists measured bands and
# the limits of the measurement.
va.write_report(results, folder / "report")
print(*sorted(file.name for file in (folder / "report").iterdir()))
figure = va.plot.baseline_third_octaves(results)
