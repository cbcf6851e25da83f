"""Draw the mechanism of docs/machines/slider_link.md: `python docs/figures/slider_link.py`."""

from pathlib import Path
from typing import Any, Final

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Arc, Circle, Ellipse, Rectangle

import vibroacoustics as va

HERE: Final = Path(__file__).parent
ANGLE: Final = np.deg2rad(55.0)
PART, DARK, TURNING, BLOCK = "#d5dde5", "#22303c", "#5b7f9f", "#eceff2"


def main() -> None:
    """Mechanism from above and block in its shell from the side, both to scale."""
    machine = va.load_machine(HERE.parents[1] / "data" / "machines" / "dagilis_slider_link.toml")
    plt.rcParams.update({"svg.hashsalt": "vibroacoustics", "font.size": 10})
    figure, panels = plt.subplots(
        1, 2, figsize=(12.0, 5.0), width_ratios=(1.0, 1.35), layout="tight"
    )
    from_above(panels[0], machine)
    from_the_side(panels[1], machine)
    for axes in panels:
        axes.set_aspect("equal")
        axes.axis("off")
    figure.savefig(HERE / "slider_link.svg", bbox_inches="tight", metadata={"Date": None})


def from_above(axes: Axes, machine: Any) -> None:
    """Crank, slider, link, piston and cylinder; the paper's y points down the page."""
    parts = machine.mechanism
    radius, bore, slider = (
        1e3 * value for value in (parts.crank_radius_m, parts.bore_m, parts.slider_diameter_m)
    )
    axis = 1e3 * parts.link_offset_m
    pin = radius * np.array([np.cos(ANGLE), -np.sin(ANGLE)])
    end = 1e3 * parts.piston_length_m + pin[0]
    mouth = end - 1e3 * parts.cylinder_length_m + radius * (1.0 - np.cos(ANGLE))
    head, reach = mouth + 1e3 * parts.cylinder_length_m + 1.5, radius + 0.5 * slider + 1.0
    box(axes, (pin[0] - 0.5 * slider - 4, -reach), (slider + 8, 2 * reach), PART)
    box(axes, (pin[0] - 0.5 * slider, -reach + 3), (slider, 2 * reach - 6), "white")
    box(axes, (pin[0] + 0.5 * slider, axis - 0.5 * bore), (end - pin[0] - 0.5 * slider, bore), PART)
    for side in (-1.0, 1.0):
        edge = axis + side * (0.5 * bore + 0.4)
        box(axes, (mouth, min(edge, edge + 4 * side)), (head - mouth, 4.0), "#9aa7b3")
    box(axes, (head, axis - 0.5 * bore - 4.4), (3.0, bore + 8.8), "#9aa7b3")
    axes.add_patch(Circle(tuple(pin), 0.5 * slider, fc="white", ec=DARK, lw=1.5))
    pin_radius = 1e3 * machine.bearings.crank_pin.radius_m
    axes.add_patch(Circle(tuple(pin), pin_radius, fc=TURNING, ec=DARK, alpha=0.75))
    axes.add_patch(Circle((0, 0), radius, fill=False, ec="grey", ls=":"))
    axes.plot([0, pin[0]], [0, pin[1]], color=DARK, lw=1.5)
    axes.plot([-13, 64], [0, 0], color="grey", lw=0.8, ls="-.")
    axes.plot([-13, 56], [axis, axis], color="grey", lw=0.8, ls="-.")
    axes.plot(0, 0, "o", color=DARK, ms=5)
    axes.add_patch(Arc((0, 0), 11, 11, theta1=-np.rad2deg(ANGLE), theta2=0, color=DARK))
    axes.annotate("", (75, 0), (65, 0), arrowprops=ARROW)
    axes.annotate("", (0, -37), (0, -27), arrowprops=ARROW)
    axes.annotate("", (end, axis + 6), (head + 15, axis + 6), arrowprops=ARROW)
    words = {
        (76, -1): "x",
        (-1, -41): "y",
        (7.0, -3.8): "φ",
        (-1.6, -5.5): "R",
        (-24, 26): "link, one with the piston",
        (28, -26): "slider on the crank pin",
        (29, 20): "cylinder",
        (31, -7): "piston",
        (head + 5, axis + 7.5): "gas force $F_g$",
        (-24, -1): "shaft",
        (62, 2): "e",
    }
    write(axes, words)
    axes.plot([pin[0] + 7.5, 27.5], [pin[1] - 7.5, -24.5], color=DARK, lw=0.7)
    axes.set(xlim=(-26, 84), ylim=(-43, 31), title="from above, z into the page")


def from_the_side(axes: Axes, machine: Any) -> None:
    """Block on its springs in the shell; heights from the block's centre of mass."""
    inside, heights, shell = machine.suspension, machine.heights, machine.shell
    shaft = -1e3 * machine.centre_of_mass_offset_m
    top = 1e3 * heights.piston_axis_m
    upper = top - 1e3 * heights.upper_bearing_m
    lower = upper - 1e3 * heights.bearing_distance_m
    bottom = -1e3 * (inside.height_m + shell.centre_of_mass_height_m)
    height, width = 1e3 * shell.height_m, 1e3 * shell.outer_diameter_m
    dome = 1e3 * shell.dome_height_m
    for end, theta in ((bottom + dome, 180), (bottom + height - dome, 0)):
        axes.add_patch(
            Arc((shaft, end), width, 2 * dome, theta1=theta, theta2=theta + 180, lw=2.5, color=DARK)
        )
    for side in (-1, 1):
        sides = [shaft + side * width / 2] * 2
        axes.plot(sides, [bottom + dome, bottom + height - dome], color=DARK, lw=2.5)
    box(axes, (shaft - 48, -48), (96, 40), BLOCK)  # stator
    box(axes, (shaft - 40, -8), (80, 58), BLOCK)  # cylinder block
    box(axes, (shaft + 22, top - 17), (38, 34), BLOCK)
    journal = 2e3 * machine.bearings.upper.radius_m
    box(axes, (shaft - journal / 2, -52), (journal, upper + 10 + 52), TURNING)
    box(axes, (shaft - 26, -46), (52, 36), "#a9bccd")  # rotor
    web = 1e3 * machine.counterweights.upper_height_m
    box(axes, (shaft - 22, web - 3), (36, 6), TURNING)
    pin = shaft + 1e3 * machine.mechanism.crank_radius_m
    box(axes, (pin - 8, top - 9), (16, 18), TURNING)
    box(axes, (pin - 13, top - 11), (26, 22), PART, alpha=0.6)
    box(axes, (pin + 13, top - 12), (33, 24), PART)
    for middle, bearing in ((upper, machine.bearings.upper), (lower, machine.bearings.lower)):
        long = 1e3 * bearing.length_m
        for side in (-1, 1):
            place = (shaft + side * journal / 2 - (4 if side < 0 else 0), middle - long / 2)
            box(axes, place, (4, long), "#c9a24b")
    box(axes, (shaft - 26, 1e3 * machine.counterweights.lower_height_m - 4), (18, 8), TURNING)
    grip = 1e3 * inside.springs_height_m
    half = 0.5e3 * inside.springs.pitch_m
    for side in (-1, 1):
        coil(axes, shaft + side * half, bottom + 4, grip)
        foot = shaft + side * 0.5e3 * machine.mounts.pitch_m
        box(axes, (foot - 9, bottom - 1e3 * shell.floor_clearance_m), (18, 22), "#77716a")
    floor = bottom - 1e3 * shell.floor_clearance_m
    axes.plot([-125, 115], [floor, floor], color=DARK, lw=1)
    axes.plot([shaft, shaft], [floor, 105], color="grey", lw=0.8, ls="-.")
    tube = inside.discharge_tube
    if tube is not None:
        axes.plot(1e3 * np.array(tube.x_m), 1e3 * np.array(tube.z_m), color="#b5532d", lw=2)
    axes.add_patch(Ellipse((0, 0), 5, 5, fc="white", ec=DARK, lw=1.5, zorder=9))
    axes.annotate("", (shaft, 120), (shaft, 100), arrowprops=ARROW)
    words = {
        (4, 2): "$G_c$",
        (-175, 62): "shell",
        (-175, web - 2): "counterweight",
        (-175, upper - 14): "upper bearing",
        (-175, lower - 2): "lower bearing",
        (-175, -31): "rotor in the stator",
        (-175, -68): "internal spring",
        (-175, -98): "grommet",
        (92, 66): "cylinder",
        (92, 30): "discharge tube",
        (shaft + 4, 112): "z",
    }
    write(axes, words)
    for start, end in (
        ((-150, 64), (shaft - width / 2, 64)), ((-113, web), (shaft - 20, web)),
        ((-113, upper - 12), (shaft - 12, upper - 4)), ((-113, lower), (shaft - 12, lower)),
        ((-93, -29), (shaft - 24, -29)), ((-107, -66), (shaft - half - 5, -66)),
        ((-134, -96), (shaft - 74, -96)), ((91, 68), (60, 68)),
        ((91, 32), (73, -8)),
    ):  # fmt: skip
        axes.plot(*np.transpose([start, end]), color=DARK, lw=0.7)
    axes.set(xlim=(-178, 150), ylim=(floor - 4, 122), title="from the side, z up")


ARROW: Final = {"arrowstyle": "->", "lw": 1.5, "color": DARK}


def box(
    axes: Axes,
    corner: tuple[float, float],
    size: tuple[float, float],
    colour: str,
    alpha: float = 1.0,
) -> None:
    axes.add_patch(Rectangle(corner, *size, fc=colour, ec=DARK, lw=1.0, alpha=alpha))


def coil(axes: Axes, x: float, low: float, high: float) -> None:
    """A coil spring between two heights."""
    height = np.linspace(low, high, 15)
    axes.plot(x + 5.0 * np.resize([-1.0, 1.0], height.size), height, color=DARK, lw=1.5)


def write(axes: Axes, words: dict[tuple[float, float], str]) -> None:
    for place, word in words.items():
        axes.text(*place, word, color=DARK, zorder=10)


if __name__ == "__main__":
    main()
