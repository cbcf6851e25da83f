"""Critical speeds by ROSS of the shafts that test_critical_speed computes; see README.md."""

import csv
from importlib.metadata import version
from itertools import pairwise

import numpy as np
import ross

STEEL = ross.Material("steel", rho=7850.0, E=2.06e11, Poisson=0.3)
SHAFTS = [  # diameter m, bearing stiffness N/m, rotor kg, pin kg
    (0.025, 1e8, 2.3, 1.25),
    (0.025, 1e8, 2.3, 0.0),
    (0.020, 1e7, 3.2, 1.25),
    (0.030, 1e9, 1.8, 1.25),
]
DISCS = 0.065 + 0.085 * (np.arange(4) + 0.5) / 4
MAIN_BEARING, LENGTH = 0.185, 0.220


def nodes():
    """Ends, discs, bearings; no more than 10 mm apart."""
    fixed = [0.0, *DISCS, MAIN_BEARING, LENGTH]
    spans = [
        np.linspace(a, b, int(np.ceil((b - a) / 0.01)), endpoint=False) for a, b in pairwise(fixed)
    ]
    return np.append(np.concatenate(spans), LENGTH)


def rotor(diameter, stiffness, rotor_kg, pin_kg, shear):
    places = nodes()
    beams = [
        ross.ShaftElement(
            float(length),
            0.0,
            diameter,
            material=STEEL,
            shear_effects=shear,
            rotary_inertia=True,
            gyroscopic=True,
        )
        for length in np.diff(places)
    ]
    mass = rotor_kg / 4
    squares = (0.07**2 + diameter**2) / 4
    axial = 0.5 * mass * squares
    transverse = mass * (squares / 4 + (0.085 / 4) ** 2 / 12)
    at = [int(np.argmin(np.abs(places - place))) for place in (*DISCS, MAIN_BEARING)]
    discs = [ross.DiskElement(n, mass, transverse, axial) for n in at[:4]]
    discs.append(ross.DiskElement(len(places) - 1, pin_kg, 0.0, 0.0))
    bearings = [ross.BearingElement(n, kxx=stiffness, cxx=0.0) for n in (0, at[4])]
    return ross.Rotor(beams, discs, bearings)


def forward_critical_speeds(model):
    """Forward whirl frequency = speed, by iteration from rest."""
    found = []
    for mode in range(2):
        speed, before = 1.0, 0.0
        while abs(speed - before) > 1e-8 * speed:
            modal = model.run_modal(speed, num_modes=40)
            forward = np.sort(modal.wd[modal.whirl_direction() == "Forward"])
            speed, before = forward[mode], speed
        found.append(speed)
    return found


with open("results.csv", "w", newline="", encoding="utf-8") as file:
    file.write(f"# Made by run.py with ross-rotordynamics {version('ross-rotordynamics')}.\n")
    file.write(
        "# First two forward critical speeds in rad/s, with and without shear in the beams.\n"
    )
    writer = csv.writer(file)
    writer.writerow(
        ["diameter_m", "bearing_n_per_m", "rotor_kg", "pin_kg", "shear", "first", "second"]
    )
    for shaft in SHAFTS:
        for shear in (False, True):
            speeds = forward_critical_speeds(rotor(*shaft, shear))
            writer.writerow([*shaft, int(shear), *(f"{speed:.6f}" for speed in speeds)])
            print(shaft, shear, speeds)
