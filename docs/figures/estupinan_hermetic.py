"""Draws the mechanism of the hermetic compressor from its machine file: estupinan_hermetic.svg.

Run in the repository's root: python docs/figures/estupinan_hermetic.py
"""

from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.patches import Arc, Circle, FancyBboxPatch, Rectangle

import vibroacoustics as va

FIGURE = Path(__file__).with_suffix(".svg")
MACHINE = Path(__file__).parents[2] / "data" / "machines" / "estupinan_hermetic.toml"
CRANK_ANGLE_DEG = 55.0
STEEL, LIGHT, OIL = "#5b6770", "#d5dade", "#c98a1b"


def main() -> None:
    mpl.rcParams.update({"svg.hashsalt": "estupinan", "font.size": 9, "svg.fonttype": "path"})
    machine = va.load_machine(MACHINE)
    figure, (along, beside) = plt.subplots(
        1, 2, figsize=(10.0, 4.6), width_ratios=[1.0, 1.1], layout="constrained"
    )
    _along_the_shaft(along, machine)
    _from_the_side(beside, machine)
    for axes in (along, beside):
        axes.set_aspect("equal")
        axes.set_axis_off()
    figure.savefig(FIGURE, metadata={"Date": None})


def _along_the_shaft(axes: Axes, machine: Any) -> None:
    """Slider-crank in the paper's X and Y, mm."""
    bore, radius = 1e3 * machine.piston.diameter_m, 1e3 * machine.crank.radius_m
    angle = np.deg2rad(CRANK_ANGLE_DEG)
    pin = radius * np.array([np.cos(angle), np.sin(angle)])
    piston = pin[0] + np.sqrt((1e3 * machine.rod.length_m) ** 2 - pin[1] ** 2)
    end = 1e3 * machine.rod.length_m + radius + 7.0
    for low in (0.5 * bore, -0.5 * bore - 4.0):
        _box(axes, 28.0, low, end - 28.0, 4.0, LIGHT)
    _box(axes, end, -0.5 * bore - 4.0, 4.0, bore + 8.0, LIGHT)
    _box(axes, piston - 6.0, -0.5 * bore, 12.0, bore, "white")
    axes.add_patch(Circle((0.0, 0.0), 1e3 * machine.bearing.radius_m, fc="white", ec=OIL, lw=2.5))
    axes.add_patch(Circle((0.0, 0.0), radius, fill=False, ec=STEEL, ls=":"))
    axes.plot([-14.0, end + 11.0], [0.0, 0.0], color="black", lw=0.6, ls="-.")
    axes.plot([0.0, 0.0], [-22.0, 15.0], color="black", lw=0.6, ls="-.")
    axes.plot([0.0, pin[0]], [0.0, pin[1]], color=STEEL, lw=5, solid_capstyle="round")
    axes.plot([pin[0], piston], [pin[1], 0.0], color=STEEL, lw=3, solid_capstyle="round")
    axes.plot([0.0, pin[0], piston], [0.0, pin[1], 0.0], "o", color="white", mec=STEEL, zorder=3)
    axes.add_patch(Arc((0.0, 0.0), 10.0, 10.0, theta1=0.0, theta2=CRANK_ANGLE_DEG))
    axes.add_patch(Arc((piston, 0.0), 28.0, 28.0, theta1=171.0, theta2=180.0))
    for words, at in {
        "θ": (5.6, 1.9), "α": (piston - 17.0, 0.4), "A": (pin[0] - 1.0, pin[1] + 2.6),
        "B": (piston + 1.5, 1.8), "$r_c$": (-3.0, 4.4), "$l$": (19.0, 5.4),
        "C": (-4.4, -4.6), "X": (end + 9.0, 1.2), "Y": (1.0, 13.0),
    }.items():  # fmt: skip
        axes.annotate(words, at)
    middle = 0.5 * (piston + 6.0 + end)
    axes.text(middle, -6.0, "gas", rotation=90, ha="center", va="center")
    _dimension(axes, (0.0, -20.0), (piston, -20.0), "$x_B$")
    axes.set_title("Along the shaft: crank, rod, piston")


def _from_the_side(axes: Axes, machine: Any) -> None:
    """Block on its springs in the shell, heights in mm from the crank's centre."""
    half, radius = 1e3 * machine.bearing.radius_m, 1e3 * machine.crank.radius_m
    pin, lower = 1e3 * machine.crank.pin_offset_m, -1e3 * machine.shaft.bearing_distance_m
    foot = lower - 1e3 * machine.shaft.rotor_distance_m
    inside, shell = machine.suspension, machine.shell
    block = -1e3 * machine.crank_height_m
    centre = block - 1e3 * inside.height_m
    bottom = centre - 1e3 * shell.centre_of_mass_height_m
    spring = block + 1e3 * inside.springs_height_m
    wide, high = 1e3 * shell.outer_diameter_m, 1e3 * shell.height_m
    outline = FancyBboxPatch(
        (-0.5 * wide + 40.0, bottom + 40.0), wide - 80.0, high - 80.0,
        boxstyle="round,pad=40", fc="none", ec=STEEL, lw=2.0,
    )  # fmt: skip
    axes.add_patch(outline)
    for side in (-1.0, 1.0):
        _box(axes, side * 47.0 - 16.0, spring, 32.0, 4.0 - spring, LIGHT)
        _box(axes, side * 22.0 - 9.0, lower - 4.0, 18.0, 8.0 - lower, LIGHT)
        _coil(axes, side * 500.0 * inside.springs.pitch_m, spring, bottom + 8.0)
        _coil(axes, side * 500.0 * machine.mounts.pitch_m, bottom, bottom - 20.0)
    _box(axes, -28.0, foot - 25.0, 56.0, 50.0, "white")
    _box(axes, -half, foot, 2.0 * half, -foot, "white")
    for height in (0.0, lower):
        for side in (-half - 5.0, half):
            _box(axes, side, height - 500.0 * machine.bearing.width_m, 5.0, 6.0, OIL)
    _box(axes, -half, 3.0, 2.0 * half + 8.0, 5.0, STEEL)
    _box(axes, radius - 5.0, 8.0, 10.0, 10.0, STEEL)
    _box(axes, radius, pin - 2.0, 34.0, 4.0, STEEL)
    _box(axes, radius + 30.0, pin - 11.5, 20.0, 23.0, "white")
    axes.plot([0.0, 0.0], [bottom + 8.0, 40.0], color="black", lw=0.6, ls="-.")
    line = {"arrowstyle": "-", "lw": 0.6}
    for words, at, to in (
        ("upper bearing", (-150.0, 10.0), (-half - 3.0, 0.0)),
        ("lower bearing", (-150.0, lower + 6.0), (-half - 3.0, lower)),
        ("rotor", (-150.0, foot - 10.0), (-20.0, foot - 10.0)),
        ("block and stator", (-150.0, 0.5 * lower), (-48.0, 0.5 * lower)),
        ("piston", (105.0, 30.0), (radius + 46.0, pin + 6.0)),
        ("internal spring", (105.0, foot - 4.0), (500.0 * inside.springs.pitch_m, spring - 12.0)),
        ("shell", (105.0, 0.5 * lower), (0.5 * wide, 0.4 * lower)),
        ("grommet", (105.0, bottom - 16.0), (500.0 * machine.mounts.pitch_m, bottom - 12.0)),
    ):
        axes.annotate(words, to, at, arrowprops=line, va="center")
    axes.annotate("z", (2.0, 38.0))
    _dimension(axes, (3.0, 0.0), (3.0, lower), "$L$")
    _dimension(axes, (26.0, 0.0), (26.0, pin), "")
    axes.annotate("$h_p$", (28.0, -6.0))
    axes.set_title("From the side: block on springs in the shell")
    axes.margins(0.02)


def _box(axes: Axes, x: float, y: float, wide: float, high: float, colour: str) -> None:
    axes.add_patch(Rectangle((x, y), wide, high, fc=colour, ec=STEEL, lw=1.0))


def _coil(axes: Axes, x: float, first: float, last: float) -> None:
    along = np.linspace(first, last, 13)
    axes.plot(x + 5.0 * np.r_[0.0, np.resize([1.0, -1.0], 11), 0.0], along, color=STEEL, lw=1.0)


def _dimension(
    axes: Axes, first: tuple[float, float], last: tuple[float, float], words: str
) -> None:
    axes.annotate(
        "", first, last, arrowprops={"arrowstyle": "<->", "lw": 0.8, "shrinkA": 0, "shrinkB": 0}
    )
    middle = 0.5 * np.add(first, last)
    axes.annotate(words, (middle[0] + 1.5, middle[1] + 1.0))


if __name__ == "__main__":
    main()
