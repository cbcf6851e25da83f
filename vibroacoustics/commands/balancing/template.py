"""File to begin with for `balance`: a made-up fan with two planes and two sensors."""

from typing import Final

BALANCING_NAME: Final = "balancing.toml"
TEMPLATE: Final = """\
# Runs with trial weights, for `vibroacoustics balance`. The fan is made up: write your values.
title = "Fan with two planes"
amplitudes = "rms"  # of all readings: "peak", "peak to peak" or "rms"
phases = "lag"  # "lag": the peak comes this angle after the mark passes the tacho; or "lead"
angles = "against rotation"  # of weights and holes; or "with rotation", "clockwise", …
rotation = "counterclockwise"  # of the shaft, seen from the side that angles are read from
trial_weights = "removed"  # after their run; or "left in"
answer = "least squares"  # or "least worst": the largest reading is least

[rotor]
mass_kg = 85.0
service_speed_rpm = 1480

[planes.front]
radius_mm = 200.0
zero_deg = 0.0  # angle of the plane's zero from the mark on the shaft
holes = 12  # evenly spaced from the zero; or hole_angles_deg = [0, 40, 80]; none for any angle
# masses_g = [5, 10, 20]  # that are available; any without it
# maximum_mass_g = 60.0

[planes.rear]
radius_mm = 200.0
holes = 12

[sensors.drive_end]
unit = "mm/s"
limit = 1.8

[sensors.free_end]
unit = "mm/s"
limit = 1.8
# scatter = 0.05  # standard deviation of a reading where no run is repeated

[runs.first]
readings.1480 = { drive_end = "4.61@38", free_end = "3.52@251" }

[runs.repeat]
readings.1480 = { drive_end = "4.66@39", free_end = "3.49@250" }

[runs.front]
weights.front = { mass_g = 20.0, hole = 1 }  # or angle_deg = 0.0
readings.1480 = { drive_end = "4.26@73", free_end = "3.89@267" }

[runs.rear]
weights.rear = { mass_g = 20.0, hole = 4 }
readings.1480 = { drive_end = "4.25@29", free_end = "1.43@215" }

# A run may have recordings with a tacho in place of readings; their channels have the names of
# sensors. Several of a run at one speed are repeats.
# [runs.check]
# recordings = ["check.wav"]
# weights.a = { plane = "front", mass_g = 31.0, hole = 3 }
# [speed]
# channel = "tacho"
"""
