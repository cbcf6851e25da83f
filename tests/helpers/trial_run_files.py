"""Files of runs with trial weights, from a linear machine or from printed readings."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Final, NamedTuple

import numpy as np
from balancing_cases import Runs

from vibroacoustics.base.arrays import ComplexArray

RADIUS_MM: Final = 100.0
PEAK: Final = {"peak": 1.0, "peak to peak": 0.5, "rms": np.sqrt(2.0)}


class Convention(NamedTuple):
    """How a bench writes angles and amplitudes."""

    amplitudes: str = "peak"
    phases: str = "lag"
    angles: str = "against rotation"
    rotation: str = "counterclockwise"

    @property
    def sense(self) -> float:
        """One where angles count with the rotation."""
        with_rotation = self.angles in ("with rotation", self.rotation)
        return 1.0 if with_rotation else -1.0


def at(value: complex, sense: float = 1.0) -> str:
    """Reading as text, in 12 digits."""
    return f"{abs(value):.12g}@{sense * np.angle(value, deg=True):.12g}"


def file_text(
    runs: Mapping[str, tuple[ComplexArray, ComplexArray]],
    convention: Convention = Convention(),  # noqa: B008 - a tuple
    trial_weights: str = "removed",
    further: str = "",
    sensors: Sequence[str] = (),
    planes: Sequence[str] = (),
    speed: int = 1500,
    zero_deg: float = 0.0,
    plane_lines: str = "",
) -> str:
    """Text of a file: of each run weights that it adds, g at 100 mm, and readings.

    Readings are peaks that lead, weights angles with the rotation from the mark.
    """
    weights, readings = next(iter(runs.values()))
    planes = planes or [f"plane_{number}" for number in range(1, len(weights) + 1)]
    sensors = sensors or [f"sensor_{number}" for number in range(1, len(readings) + 1)]
    lines = [
        f'amplitudes = "{convention.amplitudes}"',
        f'phases = "{convention.phases}"',
        f'angles = "{convention.angles}"',
        f'rotation = "{convention.rotation}"',
        f'trial_weights = "{trial_weights}"',
        further,
    ]
    for plane in planes:
        lines += [f"[planes.{plane}]", f"radius_mm = {RADIUS_MM}", f"zero_deg = {zero_deg}"]
        lines += [plane_lines]
    for sensor in sensors:
        lines += [f"[sensors.{sensor}]", 'unit = "mm/s"']
    lead = 1.0 if convention.phases == "lead" else -1.0
    for name, (weights, readings) in runs.items():
        lines.append(f"[runs.{name}]")
        for plane, weight in zip(planes, weights, strict=True):
            if weight:
                angle = convention.sense * np.angle(weight, deg=True) - zero_deg
                lines.append(
                    f"weights.{plane} = {{ mass_g = {abs(weight):.12g}, angle_deg = {angle:.12g} }}"
                )
        values = ", ".join(
            f'{sensor} = "{at(value / PEAK[convention.amplitudes], lead)}"'
            for sensor, value in zip(sensors, readings, strict=True)
        )
        lines.append(f"readings.{speed} = {{ {values} }}")
    return "\n".join(lines) + "\n"


def of_printed(runs: Runs) -> dict[str, tuple[ComplexArray, ComplexArray]]:
    """Runs of a printed case: the first without weights, then one trial weight in each plane."""
    first, second = runs.trials
    added = np.array([[0.0, 0.0], [first, 0.0], [0.0, second]])
    return dict(zip(("first", "one", "two"), zip(added, runs.readings, strict=True), strict=True))


def written(folder: Path, text: str, name: str = "balancing.toml") -> Path:
    """File with a text."""
    path = folder / name
    path.write_text(text)
    return path
