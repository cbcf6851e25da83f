"""Sound of point and ring sources in free space."""

from cmath import exp
from collections.abc import Iterator
from math import cos, pi, sqrt
from pathlib import Path

from .rows import Row, inputs

POINTS = {"side": (1.0, 0.0), "above": (0.6, 0.8), "below": (0.8, -0.6)}
"""Radius and height of the microphones, at the azimuth zero, m."""
FREQUENCIES = (100.0, 1000.0, 4000.0, 10000.0)


def point_and_ring_sources(folder: Path) -> Iterator[Row]:
    """p = sum of exp(-jkr)/(4 pi r): closed form of a point, fine sum of a ring."""
    given = inputs(folder)
    for frequency in FREQUENCIES:
        k = 2.0 * pi * frequency / given["speed_of_sound"]
        for name, (radius, height) in POINTS.items():
            for source in ("point", "ring order 0", "ring order 1", "ring order 2"):
                number = int(source[-1]) if source != "point" else 0
                ring = given["ring_radius"] if source != "point" else 0.0
                value = _ring(radius, height - given["source_height"], ring, k, number)
                if source == "point":
                    value /= 2.0 * pi
                for part, number_ in (("real", value.real), ("imaginary", value.imag)):
                    key = f"{source} at {name}, {frequency:g} Hz: {part}"
                    words = "sum over the ring; 0.1 dB is 1.2 % of the magnitude"
                    yield Row(key, "Pa", number_, 0.012 * abs(value), words)


def _ring(
    radius: float, height: float, ring: float, k: float, number: int, parts: int = 720
) -> complex:
    """Integral of cos(n a) exp(-jkr)/(4 pi r) over the angle: the trapezium rule is exact here."""
    total = 0j
    for row in range(parts):
        angle = 2.0 * pi * row / parts
        distance = sqrt(radius**2 + ring**2 - 2.0 * radius * ring * cos(angle) + height**2)
        total += cos(number * angle) * exp(-1j * k * distance) / (4.0 * pi * distance)
    return total * 2.0 * pi / parts
