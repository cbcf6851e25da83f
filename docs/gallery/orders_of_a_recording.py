"""
Orders of a recording
=====================

The recording of an electric motor in the package has no tacho. The command ``orders`` finds the
speed in the signal, resamples it to crank angle and writes the orders, in a file like that of a
simulation. Method and limits: :doc:`/orders`.
"""

import subprocess
import sys
import tempfile

import matplotlib.pyplot as plt

import vibroacoustics as va

recording = va.read_recording("../../data/recordings/electric_motor_vibration.uff")
print(
    recording["signal"].sizes, recording["channel_unit"].values, recording.attrs["sample_rate_hz"]
)

# %%
# On the command line this is ``vibroacoustics orders FILE …``; the first second is enough here.
folder = tempfile.TemporaryDirectory()
command = [sys.executable, "-m", "vibroacoustics", "orders"]
command += ["../../data/recordings/electric_motor_vibration.uff", "--sample-rate", "51200"]
command += ["--tacholess", "60000", "80000", "--orders", "1,2,4,6,8", "--maximum-order", "9"]
command += ["--resolution", "0.25", "--map", "--to", "1", "--out", folder.name]
done = subprocess.run(command, capture_output=True, text=True, check=True)
print("\n".join(done.stdout.splitlines()[:-1]))

# %%
# The order map
# -------------
# Vertical lines are orders of the speed found. The analysis cannot determine whether this is the
# speed of the shaft: see :doc:`/compare`.
orders = va.open_results(f"{folder.name}/orders.nc")
level = abs(orders["order_map"].isel(channel=0)).clip(min=1e-3)
figure, axes = plt.subplots(layout="constrained")
drawn = axes.pcolormesh(
    orders["map_order"], orders["block_time"], level, norm="log", rasterized=True
)
figure.colorbar(drawn, label=f"amplitude, {orders['channel_unit'].values[0]}")
axes.set(xlabel="order", ylabel="time, s")

# %%
# Mean spectrum over the orders
# -----------------------------
figure, axes = plt.subplots(layout="constrained")
axes.semilogy(orders["map_order"], orders["mean_order_spectrum"].isel(channel=0))
axes.set(xlabel="order", ylabel=f"RMS, {orders['channel_unit'].values[0]}", xlim=(0, 9))
axes.grid(alpha=0.3)
folder.cleanup()
