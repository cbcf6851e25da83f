"""File to begin with for `permit`: a made-up heat pump at three windows."""

from typing import Final

PERMIT_NAME: Final = "permit.toml"
TEMPLATE: Final = """\
# Units and windows, for `vibroacoustics permit`. The heat pump is made up: write your values.
title = "Heat pump at the boundary"

[units.heat_pump]
day_power_dba = 58.0  # sound power level, A-weighted
night_power_dba = 52.0  # in the night setting; as by day without it
# octave_power_db = [62, 60, 58, 56, 53, 48, 42, 35]  # 63 Hz to 8 kHz; only their shape counts
tone_adjustment_db = 3.0  # 0, 3 or 6; 3 where nothing is known
deviation_db = 1.5  # standard deviation of the level at a window, assumed
height_m = 1.0
capacity_kw = 8.0  # heating capacity, for limits of the sound power by law

[windows.bedroom]
kind = "lai-guide"  # Germany
area = "general-residential"
distance_m = 12.0
reflection_db = 3  # 0 free, 3 at a wall, 6 in a corner
shielding_db = 0  # 0, 5 or 15

[windows.neighbour]
kind = "mcs-020"  # United Kingdom
distance_m = 6.5
surfaces = 2  # reflecting surfaces within 1 m, the ground one of them
view = "full"  # or "partial", "none" behind the barrier

[windows.terrace]
kind = "cercle-bruit"  # Switzerland
area = "II"
distance_m = 14.0
directivity_db = 6  # 3 free, 6 at a wall, 9 in a corner
"""
