"""Draws the pictures of over_speed.md: the scroll's sources at 61 speeds, rough radiation."""

import sys
from pathlib import Path

import numpy as np

import vibroacoustics as va

ROOT = Path(__file__).parents[2]
GALLERY = ROOT / "docs" / "gallery"
SPEEDS = np.arange(1500.0, 4501.0, 50.0).tolist()
VERBS = ("source_levels_over_speed", "campbell", "speed_frequency_map")


def main() -> None:
    """Two sources, few samples: a minute or two."""
    sys.path.insert(0, str(GALLERY))
    from rough_radiation import rough_radiation

    study = va.load_study(GALLERY / "studies" / "sources.toml")
    values = {
        "operation.speed_rpm": SPEEDS,
        "operation.supply_frequency_hz": None,
        "operation.point": "ari",
        "machine.gas.opening_law": "inertia",
        "options.damping": None,
        "sources.keys": None,
    }
    results = va.run(study.replace(values), radiation=rough_radiation)
    for verb in VERBS:
        figure = getattr(va.plot, verb)(results)
        figure.savefig(ROOT / "docs" / "figures" / f"{verb}.png", dpi=100)


if __name__ == "__main__":
    main()
