"""Draw the mechanism of docs/machines/reciprocating.md: `python docs/figures/reciprocating.py`."""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Arc, Circle, Rectangle

import vibroacoustics as va

HERE = Path(__file__).parent
ANGLE = np.deg2rad(50.0)
PART, DARK = "#d5dde5", "#22303c"


def main() -> None:
    """Slider-crank at one crank angle, to scale, cylinder upright."""
    machine = va.load_machine(HERE.parents[1] / "data" / "machines" / "mayekawa_wbhe.toml")
    part = machine.piston_and_rod
    bore = 1e3 * part.bore_m
    radius = 2e9 * part.displacement_m3 / (np.pi * bore**2)
    pin = radius * np.array([np.sin(ANGLE), np.cos(ANGLE)])
    piston = pin[1] + np.sqrt((radius / part.crank_to_rod_ratio) ** 2 - pin[0] ** 2)
    plt.rcParams.update({"svg.hashsalt": "vibroacoustics", "font.size": 11})
    figure, axes = plt.subplots(figsize=(4.6, 6.6))
    top = 420.0
    axes.add_patch(Rectangle((-bore / 2, piston - 30), bore, 80, fc=PART, ec=DARK))
    for side in (-1, 1):
        axes.plot([side * bore / 2] * 2, [215, top], color=DARK, lw=3)
    axes.plot([-bore / 2, bore / 2], [top, top], color=DARK, lw=3)
    axes.plot([pin[0], 0], [pin[1], piston], color=DARK, lw=7, solid_capstyle="round")
    axes.plot([0, pin[0]], [0, pin[1]], color="#5b7f9f", lw=9, solid_capstyle="round")
    axes.add_patch(Circle((0, 0), radius, fill=False, ec="grey", ls=":"))
    for place in ((0, 0), tuple(pin), (0, piston)):
        axes.add_patch(Circle(place, 7, fc="white", ec=DARK, zorder=5))
    axes.plot([0, 0], [-80, top + 25], color="grey", lw=0.8, ls="-.")
    axes.add_patch(Arc((0, 0), 66, 66, theta1=90 - np.rad2deg(ANGLE), theta2=90, color=DARK))
    turn = np.arctan2(pin[0], piston - pin[1])
    axes.add_patch(
        Arc((0, piston), 170, 170, theta1=270, theta2=270 + np.rad2deg(turn), color=DARK)
    )
    words = {
        (8, 40): "θ",
        (-24, piston - 100): "φ",
        (34, 4): "r",
        (pin[0] * 0.5 + 12, 0.5 * (pin[1] + piston)): "l",
        (10, piston + 62): "P",
        (bore / 2 + 8, piston): "piston, gas force P,\npin force T",
        (pin[0] + 12, pin[1] - 6): "crank pin S",
        (-88, -22): "journal Q",
        (bore / 2 + 8, 390): "cylinder wall:\nfriction f, force T_y",
        (-14, top + 32): "x",
    }
    for place, word in words.items():
        axes.text(*place, word, color=DARK)
    axes.annotate("", (0, piston + 52), (0, top - 12), arrowprops={"arrowstyle": "->", "lw": 2})
    axes.set(xlim=(-130, 210), ylim=(-90, top + 50), aspect="equal")
    axes.axis("off")
    figure.savefig(HERE / "reciprocating.svg", bbox_inches="tight", metadata={"Date": None})


if __name__ == "__main__":
    main()
