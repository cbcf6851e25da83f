"""Processor time of the radiation of a shell on the floor: cut cells against boundary elements.

And what boundary elements cost against highest frequency, patterns and microphones. Seconds of the
processors, so that other work on the machine changes little.

    python benchmarks/radiation_methods.py [--quick]
"""

import time
from collections.abc import Callable
from typing import Final

import numpy as np
from quick import parser

from vibroacoustics.base.revolution import capped_cylinder
from vibroacoustics.base.vocabulary import RIGID_BODY_DOFS
from vibroacoustics.radiation.arrangements import hemisphere_positions
from vibroacoustics.radiation.bodies import turned
from vibroacoustics.radiation.exact import Mirror
from vibroacoustics.radiation.machine_side import MachineSide, near_fields
from vibroacoustics.radiation.patterns import Pattern, rigid_body
from vibroacoustics.radiation.revolution.side import RevolutionSide
from vibroacoustics.radiation.scene import Scene
from vibroacoustics.radiation.task import Microphones

RADIUS_M, BOTTOM_M, TOP_M, FLOOR_M = 0.0825, -0.19, 0.227, -0.21
STEP_HZ: Final = 25.0
RIGID: Final = [rigid_body(dof) for dof in RIGID_BODY_DOFS]


def microphones(number: int) -> np.ndarray:
    """Points of hemispheres of 1 m and more about the foot of the axis, (point, 3)."""
    ten = hemisphere_positions(1.0)
    radii = 1.0 + 0.1 * np.arange(-(-number // 10))
    points = np.concatenate([radius * ten for radius in radii])[:number]
    return points + np.array([0.0, 0.0, FLOOR_M])


def bulges(number: int) -> list[Pattern]:
    """The rigid motions and bulges of the side: waves around and half waves along the axis."""
    waves = [(n, m) for n in range(9) for m in range(1, 7)][: max(0, number - len(RIGID))]
    return [*RIGID, *(_bulge(*wave) for wave in waves)][:number]


def _bulge(around: int, along: int) -> Pattern:
    def velocity(at):
        share = (at.position[:, 2] - BOTTOM_M) / (TOP_M - BOTTOM_M)
        angle = np.arctan2(at.position[:, 1], at.position[:, 0])
        size = np.cos(around * angle) * np.sin(along * np.pi * share)
        outward = at.position * np.array([1.0, 1.0, 0.0])
        return size[:, None] * outward / RADIUS_M

    return Pattern(f"{around} {along}", velocity)


def by_elements(highest_hz: float, patterns: list[Pattern], points: np.ndarray) -> np.ndarray:
    """Pressures (microphone, pattern, frequency)."""
    profile = capped_cylinder(RADIUS_M, BOTTOM_M, TOP_M)
    side = RevolutionSide(profile, patterns, highest_hz, FLOOR_M)
    sampled = side.spectrum(points, _table_hz(highest_hz))
    return np.moveaxis(sampled.pressure, 0, -1)


def by_cells(
    highest_hz: float, patterns: list[Pattern], points: np.ndarray, spacing_m: float
) -> np.ndarray:
    """The same by cut cells on two grids, the finer one of a spacing."""
    body = turned(capped_cylinder(RADIUS_M, BOTTOM_M, TOP_M))
    scene = Scene(body, (), (Mirror(2, -1, FLOOR_M),))
    near = near_fields(scene, spacing_m, highest_hz)
    side = MachineSide(scene, near, patterns, _table_hz(highest_hz), [Microphones(points)])
    return side.closed[0].pressure


def _table_hz(highest_hz: float) -> np.ndarray:
    return np.arange(STEP_HZ, highest_hz + 1.0, STEP_HZ)


def timed(compute: Callable[[], np.ndarray]) -> tuple[float, np.ndarray]:
    """Seconds of the processors, and the result."""
    begin = time.process_time()
    result = compute()
    return time.process_time() - begin, result


def compare(highest_hz: float, spacings_m: list[float]) -> None:
    """Both methods in turn, and how far they are apart."""
    points = microphones(10)
    seconds, elements = timed(lambda: by_elements(highest_hz, RIGID, points))
    print(f"6 motions, 10 microphones, to {highest_hz:g} Hz: boundary elements {seconds:.1f} s")
    for spacing_m in spacings_m:
        other, cells = timed(lambda s=spacing_m: by_cells(highest_hz, RIGID, points, s))
        gaps = []
        for number in (0, 2, 4):
            power = [np.mean(np.abs(one[:, number]) ** 2, axis=0) for one in (cells, elements)]
            gaps.append(10.0 * np.log10(power[0] / power[1]))
        print(
            f"  cut cells of {1e3 * spacing_m:g} mm: {other:.1f} s, {other / seconds:.1f} times as "
            f"much; tx, tz, ry in the mean over the microphones within {np.abs(gaps).max():.3f} dB",
            flush=True,
        )


def scale(what: str, cases: dict[str, tuple[float, int, int]]) -> None:
    """Boundary elements at several sizes: highest frequency, patterns, microphones."""
    print(f"boundary elements against {what}:")
    first = 0.0
    for name, (highest_hz, patterns, points) in cases.items():
        seconds, _ = timed(
            lambda h=highest_hz, p=patterns, m=points: by_elements(h, bulges(p), microphones(m))
        )
        first = first or seconds
        print(f"  {name}: {seconds:.1f} s, {seconds / first:.1f} times the first", flush=True)


def main() -> None:
    options = parser(__doc__)
    options.add_argument("--spacings-mm", type=float, nargs="+", default=[12.0, 8.0])
    options.add_argument("--highest-hz", type=float, nargs="+", default=[1e3, 2e3, 4e3, 1e4])
    arguments = options.parse_args()
    if arguments.quick:
        compare(100.0, [0.04])
        scale("frequency", {"100 Hz": (100.0, 6, 1), "200 Hz": (200.0, 7, 2)})
        return
    by_elements(100.0, RIGID, microphones(1))  # compile
    by_cells(100.0, RIGID, microphones(1), 0.03)
    compare(2000.0, [1e-3 * spacing for spacing in arguments.spacings_mm])
    scale("frequency", {f"{hertz:g} Hz": (hertz, 6, 10) for hertz in arguments.highest_hz})
    scale("patterns", {f"{number}": (2000.0, number, 10) for number in (6, 20, 53)})
    scale("microphones", {f"{number}": (2000.0, 6, number) for number in (1, 10, 100)})


if __name__ == "__main__":
    main()
