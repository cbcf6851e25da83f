"""Draws the mechanism of the hermetic compressor from its machine file: estupinan_hermetic.svg.

Run in the repository's root: python docs/figures/estupinan_hermetic.py
"""

from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.patches import Arc, Circle, Ellipse, Rectangle

from vibroacoustics.loading import load_machine
from vibroacoustics.mechanisms.hermetic.pin import COORDINATES, crank_point, rod_motion
from vibroacoustics.mechanisms.hermetic.shaft import node_positions_m
from vibroacoustics.parameters.hermetic import HermeticCompressor

FIGURE = Path(__file__).with_suffix(".svg")
MACHINE = Path(__file__).parents[2] / "data" / "machines" / "estupinan_hermetic.toml"
CRANK_ANGLE_DEG = 55.0
PISTON_LENGTH_MM = 22.0  # Estupiñan & Santos, table 1
STEEL, LIGHT, OIL = "#5b6770", "#d5dade", "#c98a1b"


def main() -> None:
    mpl.rcParams.update({"svg.hashsalt": "estupinan", "font.size": 9, "svg.fonttype": "path"})
    machine = load_machine(MACHINE)
    assert isinstance(machine, HermeticCompressor)
    figure, (above, beside) = plt.subplots(1, 2, figsize=(10.0, 4.4), layout="constrained")
    _from_above(above, machine)
    _from_the_side(beside, machine)
    for axes in (above, beside):
        axes.set_aspect("equal")
        axes.set_axis_off()
    figure.savefig(FIGURE, metadata={"Date": None})


def _from_above(axes: Axes, machine: HermeticCompressor) -> None:
    """Slider-crank in the paper's X and Y; its Z points at the reader's back, down the shaft."""
    place = np.zeros(COORDINATES)
    place[-1] = np.deg2rad(CRANK_ANGLE_DEG)
    still = np.zeros(COORDINATES)
    pin = 1e3 * crank_point(place, still, machine.crank.radius_m, 0.0).position_m
    length, bore = 1e3 * machine.rod.length_m, 1e3 * machine.piston.diameter_m
    piston = float(rod_motion(length, pin, still[:3], still[:3]).piston_position_m)
    radius, bearing = 1e3 * machine.crank.radius_m, 1e3 * machine.bearing.radius_m
    end = length + radius + 6.0
    for side in (-1.0, 1.0):
        low = 0.5 * bore if side > 0.0 else -0.5 * bore - 4.0
        axes.add_patch(Rectangle((28.0, low), end - 28.0, 4.0, color=LIGHT, ec=STEEL))
    axes.add_patch(Rectangle((end, -0.5 * bore - 4.0), 4.0, bore + 8.0, color=LIGHT, ec=STEEL))
    axes.add_patch(Rectangle((piston - 6.0, -0.5 * bore), 12.0, bore, fc="white", ec=STEEL, lw=1.5))
    axes.add_patch(Circle((0.0, 0.0), bearing, fc="white", ec=OIL, lw=2.5))
    axes.add_patch(Circle((0.0, 0.0), radius, fill=False, ec=STEEL, ls=":"))
    axes.plot([0.0, pin[0]], [0.0, pin[1]], color=STEEL, lw=5, solid_capstyle="round")
    axes.plot([pin[0], piston], [pin[1], 0.0], color=STEEL, lw=3, solid_capstyle="round")
    axes.plot([0.0, pin[0], piston], [0.0, pin[1], 0.0], "o", color="white", mec=STEEL)
    axes.plot([-14.0, end + 10.0], [0.0, 0.0], color="black", lw=0.6, ls="-.")
    axes.add_patch(Arc((0.0, 0.0), 8.0, 8.0, theta1=0.0, theta2=CRANK_ANGLE_DEG))
    axes.add_patch(Arc((piston, 0.0), 22.0, 22.0, theta1=171.0, theta2=180.0))
    for words, at in {
        "θ": (5.0, 1.3), "α": (piston - 14.5, 0.4), "A": (pin[0] - 1.0, pin[1] + 2.2),
        "B": (piston + 1.5, 1.6), "$r_c$": (-2.6, 4.0), "$l$": (17.0, 5.4),
        "C": (-3.6, -3.6), "X": (end + 8.0, 1.2),
    }.items():  # fmt: skip
        axes.annotate(words, at)
    _dimension(axes, (0.0, -19.0), (piston, -19.0), "$x_B$")
    axes.plot([0.0, 0.0], [-20.0, 12.0], color="black", lw=0.6, ls="-.")
    axes.annotate("Y", (0.8, 11.0))
    axes.set_title("Along the shaft: crank, rod, piston")


def _from_the_side(axes: Axes, machine: HermeticCompressor) -> None:
    """Block on its springs in the shell; heights from the crank's centre."""
    nodes = -1e3 * node_positions_m(machine)
    half, pin = 1e3 * machine.bearing.radius_m, 1e3 * machine.crank.pin_offset_m
    radius, width = 1e3 * machine.crank.radius_m, 1e3 * machine.bearing.width_m
    lower = -1e3 * machine.shaft.bearing_distance_m
    shell, inside = machine.shell, machine.suspension
    assert inside is not None
    block = -1e3 * machine.crank_height_m
    centre = block - 1e3 * inside.height_m
    size = 1e3 * shell.outer_diameter_m, 1e3 * shell.height_m
    bottom = centre - 1e3 * shell.centre_of_mass_height_m
    axes.add_patch(Ellipse((0.0, bottom + 0.5 * size[1]), *size, fill=False, ec=STEEL, lw=2.0))
    axes.add_patch(Rectangle((-half, nodes[-1] - 8.0), 2.0 * half, -nodes[-1] + 8.0, color=LIGHT))
    axes.add_patch(Rectangle((radius - 5.0, 0.0), 10.0, pin + 8.0, color=STEEL))
    axes.add_patch(Rectangle((-half, 0.0), 2.0 * half + 6.0, 4.0, color=STEEL))
    for height in (0.0, lower):
        for side in (-half - 4.0, half):
            axes.add_patch(Rectangle((side, height - 0.5 * width), 4.0, width, color=OIL))
    axes.plot([0.0, 0.0], [nodes[-1], 0.0], "o-", color="black", lw=0.8, ms=4)
    return


def _dimension(
    axes: Axes, first: tuple[float, float], last: tuple[float, float], words: str
) -> None:
    axes.annotate("", first, last, arrowprops={"arrowstyle": "<->", "lw": 0.8})
    middle = 0.5 * np.add(first, last)
    axes.annotate(words, tuple(middle), ha="center", va="bottom", backgroundcolor="white")


if __name__ == "__main__":
    main()
