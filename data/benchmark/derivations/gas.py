"""Gas forces in a scroll, from involutes and polytropes."""

from collections.abc import Iterator
from math import pi, radians
from pathlib import Path

from .rows import Row, inputs, order

STEPS = 7200


def scroll_gas(folder: Path) -> Iterator[Row]:
    """F_t = 2 r_b h sum of step times contact angle; the work of a revolution in closed form."""
    given = inputs(folder)
    for name in ("appendix", "heating"):
        case = {key: given[f"{name}_{key}"] for key in ("suction", "discharge", "index")}
        course = [_tangential(given, case, 2.0 * pi * (row + 0.5) / STEPS) for row in range(STEPS)]
        radius = pi * given["base_radius"] * 1e-3 - given["thickness"] * 1e-3
        torque = [force * radius for force in course]
        at = f"{case['suction']:g} to {case['discharge']:g} bar"
        mean = _work(given, case) / (2.0 * pi)
        words = "closed form of the work; 0.2 % for steps of half a degree"
        yield Row(
            f"{at}: work per revolution", "J", 2.0 * pi * mean, 0.002 * 2.0 * pi * mean, words
        )
        yield Row(f"{at}: mean torque", "N m", mean, 0.002 * mean, words)
        force = mean / radius
        yield Row(f"{at}: mean tangential force", "N", force, 0.002 * force, words)
        radial = 2.0 * given["base_radius"] * given["height"] * 1e-6
        radial *= (case["discharge"] - case["suction"]) * 1e5
        yield Row(f"{at}: radial force", "N", radial, 0.001 * radial, "2 r_b h (p_d - p_s); 0.1 %")
        slack = (max(torque) - min(torque)) / 720.0
        for number in (1, 2, 3, 4):
            value = abs(order(torque, number))
            words = "midpoints of 0.05 deg; the step at the opening over 720 samples"
            yield Row(f"{at}: torque order {number}", "N m", value, slack, words)


def _tangential(given: dict[str, float], case: dict[str, float], angle: float) -> float:
    """Sum over the contacts of one flank, from the outermost inwards, N."""
    width = 2.0 * given["base_radius"] * given["height"] * 1e-6
    end, total = 2.0 * pi * given["turns"], 0.0
    since = angle
    outer = case["suction"]
    while since < _opening(given) + 2.0 * pi:
        inner = _pressure(given, case, since)
        total += width * (inner - outer) * 1e5 * (end - pi / 2.0 - since)
        outer, since = inner, since + 2.0 * pi
    return total


def _opening(given: dict[str, float]) -> float:
    """Crank angle from the closing of a pocket to its opening, rad."""
    return 2.0 * pi * given["turns"] - 3.0 * pi - radians(given["start_angle"])


def _pressure(given: dict[str, float], case: dict[str, float], since: float) -> float:
    """Pressure of a pocket at a crank angle since it has closed, bar."""
    if since >= _opening(given):
        return case["discharge"]
    first = 2.0 * pi * given["turns"] - 1.5 * pi
    return case["suction"] * (first / (first - since)) ** case["index"]


def _work(given: dict[str, float], case: dict[str, float]) -> float:
    """n/(n-1) p_s V (e^(n-1) - 1) + (p_d - p_s e^n) V/e: closed integral of V dp, J."""
    n, first = case["index"], 2.0 * pi * given["turns"] - 1.5 * pi
    ratio = first / (first - _opening(given))
    radius = pi * given["base_radius"] - given["thickness"]
    volume = 4.0 * pi * given["base_radius"] * radius * given["height"] * 1e-9 * first
    suction, discharge = case["suction"] * 1e5, case["discharge"] * 1e5
    compressed = n / (n - 1.0) * suction * volume * (ratio ** (n - 1.0) - 1.0)
    return compressed + (discharge - suction * ratio**n) * volume / ratio
