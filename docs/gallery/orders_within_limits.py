"""
Orders within limits
====================

Orders of a test stand checked against limits in a CSV file: ``orders`` and ``compare`` take it by
``--limits``, ``va.check_limits`` checks results of a study. ``compare`` also has limits of third
octaves, overall levels and criteria. Exit code 1 means that a limit is broken. Columns and rules:
:doc:`/compare`.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from rough_radiation import rough_radiation

import vibroacoustics as va

folder = Path(tempfile.mkdtemp())
(folder / "limits.csv").write_text(
    "# example\n"
    "channel,order,limit,unit,speed_from_rpm,speed_to_rpm\n"
    "shell,1,0.5,mm/s,,\n"
    "shell,2,0.2,mm/s,,3000\n"
    "front,1,45,dB,,\n",
    encoding="utf-8",
)

# %%
# A recording
# -----------
# Synthetic velocity of the shell and sound pressure at 2900 rpm, each with two orders.
turn = 2.0 * np.pi * 2900.0 / 60.0 * np.arange(16384) / 4096.0
shell = 0.6e-3 * np.cos(turn) + 0.4e-3 * np.cos(2.0 * turn)  # m/s
front = 4e-3 * np.cos(turn) + 1e-3 * np.cos(2.0 * turn)  # Pa
recording = va.label_recording([shell, front], 4096.0, ["shell", "front"], ["m/s", "Pa"])
va.export_recording(recording, folder / "stand.csv")

# %%
# On the command line
# -------------------
# A limit is an RMS: 0.4 mm/s of the second order are 0.28 mm/s, 3 dB too much. All margins are in
# ``orders_limits.csv``.
command = [sys.executable, "-m", "vibroacoustics", "orders", "stand.csv", "--rpm", "2900"]
command += ["--orders", "1,2", "--maximum-order", "4", "--limits", "limits.csv", "--out", "."]
done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=folder)
print(done.stdout)

# %%
# Figure
# ------
# Figures show the limits of the results.
figure = va.plot.order_spectrum(va.open_results(folder / "orders.nc"), "shell")

# %%
# Limits of more than orders
# --------------------------
# ``compare`` compares two results, here the recording with itself; its page is ``compared.html``.
# Each broken limit has a line.
(folder / "more.csv").write_text(
    "channel,order,band_hz,limit,unit,side\n"
    "front,1,,45,dB,\n"
    "front,,50,40,dB,\n"
    "front,,,5,dB(A),lowest\n",
    encoding="utf-8",
)
command = [sys.executable, "-m", "vibroacoustics", "compare", "orders.nc", "orders.nc"]
command += ["--limits", "more.csv", "--out", "compared"]
done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=folder)
print("exit code", done.returncode)
print(*(line for line in done.stdout.splitlines() if line.startswith("broken")), sep="\n")

# %%
# Limits of a prediction
# ----------------------
# A limit may name a channel of a study: a microphone, or force and velocity along an axis.
results = va.run(va.load_study("studies/copeland.toml"), radiation=rough_radiation)
limits = [va.Limit("pressure front_1m", 1.0, 45.0, "dB")]
for option in results["option"].values:
    checked = va.check_limits(results, limits, option=option)
    margin = checked["limit_margin"].sel(channel="pressure front_1m", order=1.0, speed=2900.0)
    print(f"{option:20s} {margin.item():+6.1f} dB")
