"""Draws comparison.png from the results of `make run`: what each option does to the 1x line."""

import sys
from pathlib import Path

import matplotlib.pyplot as plt

import vibroacoustics as va

ROOT = Path(__file__).parents[2]


def main() -> None:
    """The file of results may be named."""
    default = ROOT / "reports" / "copeland_thesis" / "results.nc"
    results = va.open_results(sys.argv[1] if sys.argv[1:] else default)
    change = results["change_1x"].sel(receiver="front_1m").drop_sel(option="none")
    figure, axes = plt.subplots(figsize=(8.0, 3.6), layout="constrained")
    for number, speed in enumerate(change["speed"].values):
        place = [row + 0.38 * (number - 0.5) for row in range(change.sizes["option"])]
        bars = axes.barh(place, change.sel(speed=speed), 0.36, label=f"{speed:.0f} rpm")
        axes.bar_label(bars, fmt="%+.1f", padding=3, fontsize=8)
    axes.set_yticks(range(change.sizes["option"]), change["option"].values)
    axes.invert_yaxis()
    axes.axvline(0.0, color="k", linewidth=0.8)
    axes.margins(x=0.12)
    axes.set(
        title="Copeland scroll: what each balancer buys at one metre",
        xlabel="change of the 1× line, dB",
    )
    axes.legend(loc="lower right")
    figure.savefig(ROOT / "docs" / "figures" / "comparison.png", dpi=110)


if __name__ == "__main__":
    main()
