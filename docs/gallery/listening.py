"""
Listening to options
====================

The sound of options at a microphone as files, all at one gain, with the calibration tone, and its
tones. On the command line: ``vibroacoustics listen results.nc --calibration 94``, and
``vibroacoustics tones FILE`` for a recording. Method: :doc:`/listening`.

.. literalinclude:: /gallery/studies/by_table.toml
   :language: toml
"""

import tempfile

import matplotlib.pyplot as plt
import numpy as np
from rough_radiation import rough_radiation

import vibroacoustics as va

study = va.load_study("studies/by_table.toml")
results = va.run(study, radiation=rough_radiation)
with tempfile.TemporaryDirectory() as folder:
    sounds = ["none", "lanchester"]
    for path in va.listen(results, folder, sounds, duration_s=2.0, calibration_db=94.0):
        print(path.name)

# %%
# Some revolutions
# ----------------
# Lines have the phase of the model. The noise is the same for all options, so differences are those
# of the options.
speed, rate = 800.0, 48000
figure, axes = plt.subplots(layout="constrained")
for option in sounds:
    parts = va.sound.ingredients(results, option, "front_1m", speed)
    pressure = va.sound.rendered(parts, va.sound.whole_revolutions(4.0, speed, rate))
    shown = pressure[: rate // 4]
    axes.plot(np.arange(shown.size) / rate, shown, label=option, linewidth=0.8)
axes.set(xlabel="time, s", ylabel="sound pressure, Pa")
axes.legend(fontsize="small")

# %%
# Tones
# -----
# A tone of 80 dB at 1 kHz is added and found as in a recording: its level, and its ratios to the
# noise of its critical band and to the neighbouring bands.
time = np.arange(pressure.size) / rate
recorded = pressure + np.sqrt(2.0) * 0.2 * np.sin(2.0 * np.pi * 1000.0 * time)
bands = va.sound.narrow_bands(recorded, rate)
for tone in va.sound.tones(va.sound.recorded_spectrum(bands))[:1]:
    print(f"{tone.frequency_hz:.0f} Hz: {tone.level_db:.1f} dB, prominent: {tone.prominent}")
    print(f"over the noise {tone.noise_ratio_db:.1f} dB, over bands {tone.prominence_db:.1f} dB")
