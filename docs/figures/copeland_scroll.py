"""Draw docs/machines/copeland_scroll.md: `python docs/figures/copeland_scroll.py`."""

from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Annulus, Circle, Polygon, Rectangle

import vibroacoustics as va

HERE = Path(__file__).parent
ANGLE = np.deg2rad(50.0)
PART, RING, DARK, GAS = "#d5dde5", "#5b7f9f", "#22303c", "#d55e00"
ARROW = {"arrowstyle": "->", "lw": 2}


def main() -> None:
    """Wraps in contact and ring with its keys at one crank angle, to scale, from above."""
    study = va.load_study(HERE.parents[1] / "pipelines" / "copeland_sources.toml")
    machine = study.machine
    orbit = 1e3 * machine.wraps.orbit_radius_m
    centre = orbit * np.array([np.cos(ANGLE), np.sin(ANGLE)])
    plt.rcParams.update({"svg.hashsalt": "vibroacoustics", "font.size": 11})
    figure, panels = plt.subplots(1, 2, figsize=(9.6, 5.0))
    draw_wraps(panels[0], machine.wraps, centre)
    draw_ring(panels[1], 1e3 * machine.keys.radius_m, centre)
    for axes in panels:
        axes.set(aspect="equal")
        axes.axis("off")
    figure.savefig(HERE / "copeland_scroll.svg", bbox_inches="tight", metadata={"Date": None})


def wrap_outline(wraps: Any) -> np.ndarray:
    """Both flanks of a wrap, involutes that begin half a thickness apart, mm."""
    roll = np.linspace(wraps.start_angle_rad, wraps.end_angle_rad, 250)
    half = 0.5 * wraps.thickness_m / wraps.base_radius_m
    sides = []
    for shift in (half, -half):
        along = np.stack([np.sin(roll), -np.cos(roll)]) * (roll + shift)
        sides.append((np.stack([np.cos(roll), np.sin(roll)]) + along).T)
    return 1e3 * wraps.base_radius_m * np.concatenate([sides[0], sides[1][::-1]])


def draw_wraps(axes: Axes, wraps: Any, centre: np.ndarray) -> None:
    outline = wrap_outline(wraps)
    axes.add_patch(Polygon(-outline, fc="white", ec=DARK, label="fixed scroll"))
    axes.add_patch(Polygon(outline + centre, fc=PART, ec=DARK, label="orbiting scroll"))
    tangent = np.array([-np.sin(ANGLE), np.cos(ANGLE)])
    middle = 0.5 * centre
    for way, name in ((-22.0 * tangent, "$F_t$"), (-13.0 * centre / np.hypot(*centre), "$F_r$")):
        axes.annotate("", middle + way, middle, arrowprops={**ARROW, "color": GAS})
        axes.text(
            *(middle + 1.17 * way), name, color=GAS, ha="center", va="center",
            bbox={"fc": "white", "ec": "none", "pad": 0.5},
        )  # fmt: skip
    axes.set_title("Wraps: orbiting scroll grey,\nfixed scroll white", fontsize=11)
    axes.autoscale_view()


def draw_ring(axes: Axes, radius: float, centre: np.ndarray) -> None:
    """The ring slides along x in the housing; the scroll slides along y in the ring."""
    ring = np.array([centre[0], 0.0])
    axes.add_patch(Annulus((ring[0], ring[1]), radius + 8.0, 16.0, fc=PART, ec=DARK))
    axes.add_patch(Circle((centre[0], centre[1]), 22.0, fill=False, ec=DARK, ls="--"))
    for side in (-1.0, 1.0):
        at = ring + np.array([side * radius, 0.0])
        axes.add_patch(Rectangle((side * radius - 12.0, -6.0), 24.0, 12.0, fill=False, ec=DARK))
        axes.add_patch(Rectangle((at[0] - 6.0, -5.0), 12.0, 10.0, fc=RING, ec=DARK))
        at = ring + np.array([0.0, side * radius])
        slot = (centre[0] - 6.0, centre[1] + side * radius - 12.0)
        axes.add_patch(Rectangle(slot, 12.0, 24.0, fill=False, ec=DARK, ls="--"))
        axes.add_patch(Rectangle((at[0] - 5.0, at[1] - 6.0), 10.0, 12.0, fc=RING, ec=DARK))
    axes.plot(0, 0, "+", color=DARK, ms=12)
    axes.plot(*centre, "o", color=DARK, ms=4)
    axes.annotate("", (30, 0), (0, 0), arrowprops={**ARROW, "lw": 1, "ls": ":"})
    axes.text(32, 0, "x", va="center", color=DARK)
    axes.text(0, 12, "$M_z$", ha="center", color=GAS)
    axes.annotate(
        "", (13, -4), (-13, -4),
        arrowprops={**ARROW, "color": GAS, "connectionstyle": "arc3,rad=0.7"},
    )  # fmt: skip
    words = {
        (74, 12): "key in the slot\nof the housing",
        (10, 72): "key in the slot of the scroll",
        (-40, -90): "ring, m = 72.7 g, moves\nas r cos θ along x",
    }
    for place, word in words.items():
        axes.text(*place, word, color=DARK)
    axes.set_title("Oldham ring with four keys\n(dashed: slots and hub of the scroll)", fontsize=11)
    axes.set(xlim=(-75, 125), ylim=(-95, 85))


if __name__ == "__main__":
    main()
