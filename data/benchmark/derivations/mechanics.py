"""Forces of mechanisms: closed forms, loop closure with differences, Cramer's rule."""

from cmath import phase, rect
from collections.abc import Callable, Iterator
from itertools import product
from math import acos, cos, pi, radians, sin
from pathlib import Path

from .rows import Row, inputs, order

CLOSED = 1e-3
"""Share of a closed form: answers need four significant digits."""


def oldham_force(folder: Path) -> Iterator[Row]:
    """Force on the housing of a ring that moves by r cos(angle): m r w^2 cos(angle)."""
    given = inputs(folder)
    for name, radius in (("printed", "printed_orbit_radius"), ("derived", "derived_orbit_radius")):
        for speed in (given["slow_speed"], given["fast_speed"]):
            omega = 2.0 * pi * speed / 60.0
            peak = given["ring_mass"] * 1e-3 * given[radius] * omega**2
            at = f"{name} radius, {speed:g} rpm"
            words = "m r w^2; 0.1 % for four digits"
            yield Row(f"{at}: order 1 cosine", "N", peak, CLOSED * peak, words)
            yield Row(f"{at}: order 1 sine", "N", 0.0, CLOSED * peak, "zero; 0.1 % of order 1")
            yield Row(f"{at}: order 2 amplitude", "N", 0.0, CLOSED * peak, "zero; 0.1 % of order 1")


def counterweight_optimum(folder: Path) -> Iterator[Row]:
    """F cos(wt) is two counter-rotating halves; a weight on the shaft can cancel one."""
    given = inputs(folder)
    moment = given["ring_mass"] * given["orbit_radius"] * 1e-3
    words = "half the mass moment of the ring; 0.5 % where a search moves the peak by 0.5 %"
    yield Row("mass moment", "kg m", moment / 2.0, 0.005 * moment / 2.0, words)
    words = "opposite to the crank; arctan 0.5 % = 0.3 deg"
    yield Row("angle ahead of the crank pin", "deg", 180.0, 0.3, words)
    for speed in (given["slow_speed"], given["fast_speed"]):
        peak = moment * (2.0 * pi * speed / 60.0) ** 2 / 2.0
        words = "half the force of the ring; 0.5 % as the mass moment"
        yield Row(f"least peak force, {speed:g} rpm", "N", peak, 0.005 * peak, words)
    yield Row("change of the peak", "dB", -6.0206, 0.05, "20 lg 0.5; 0.5 % is 0.04 dB")


def minicrank_torque(folder: Path) -> Iterator[Row]:
    """Torque of the scroll's rotation, from circles that meet and differences of their angles."""
    given = inputs(folder)
    cases = (
        (-10.0, 0.0, 1500.0),
        (-100.0, 0.0, 1500.0),
        (-100.0, 0.0, 3000.0),
        (-50.0, 20.0, 1500.0),
    )
    for crank_um, scroll_um, speed in cases:
        scroll, minicrank = _links(given, crank_um, scroll_um)
        factor = given["scroll_inertia"] * (2.0 * pi * speed / 60.0) ** 2

        def torque(angle: float, scroll=scroll, factor=factor) -> float:
            return factor * _second(scroll, angle) * _first(scroll, angle)

        at = f"crank {crank_um:g} um, scroll {scroll_um:g} um, {speed:g} rpm"
        angles = [radians(0.01 * step) for step in range(-900, 901)]
        peak = max(abs(torque(angle)) for angle in angles)
        words = "loop closure, differences; 0.1 %"
        yield Row(f"{at}: largest torque", "N m", peak, CLOSED * peak, words)
        for degrees in (-3.0, 1.0, 2.0, 45.0, 200.0):
            angle = radians(degrees)
            value, slack = torque(angle), max(CLOSED * abs(torque(angle)), 1e-5 * peak)
            words = "loop closure, differences; 0.1 %, at least 1e-5 of the largest"
            yield Row(f"{at}: torque at {degrees:g} deg", "N m", value, slack, words)
        for name, course in (("scroll", scroll), ("mini-crank", minicrank)):
            value = course(radians(45.0))
            words = "loop closure; 0.1 %"
            yield Row(f"{at}: {name} angle at 45 deg", "rad", value, CLOSED * abs(value), words)


Course = Callable[[float], float]


def _links(given: dict[str, float], crank_um: float, scroll_um: float) -> tuple[Course, Course]:
    """Angles of scroll and mini-crank over the crank angle: two circles meet at the pin."""
    l1 = 1e-3 * given["crank"] + 1e-6 * crank_um
    l2 = 1e-3 * given["scroll"] + 1e-6 * scroll_um
    l3, l4 = 1e-3 * given["minicrank"], 1e-3 * given["bracket"]

    def pin(angle: float) -> tuple[complex, complex]:
        crank_pin = rect(l1, angle)
        span = l4 - crank_pin
        turn = acos((l2**2 + abs(span) ** 2 - l3**2) / (2.0 * l2 * abs(span)))
        return crank_pin, crank_pin + rect(l2, phase(span) + turn)

    def scroll(angle: float) -> float:
        crank_pin, end = pin(angle)
        return phase(end - crank_pin)

    def minicrank(angle: float) -> float:
        return phase(pin(angle)[1] - l4)

    return scroll, minicrank


def _first(course: Course, angle: float, step: float = 5e-4) -> float:
    """First derivative by differences of fourth order."""
    near, far = (course(angle + n * step) - course(angle - n * step) for n in (1, 2))
    return (8.0 * near - far) / (12.0 * step)


def _second(course: Course, angle: float, step: float = 5e-4) -> float:
    """Second derivative by differences of fourth order."""
    near, far = (course(angle + n * step) + course(angle - n * step) for n in (1, 2))
    return (16.0 * near - far - 30.0 * course(angle)) / (12.0 * step**2)


def slider_link_invariants(folder: Path) -> Iterator[Row]:
    """Contact forces by Cramer's rule, and the force that the change of momentum needs."""
    given = inputs(folder)
    for degrees in (40.0, 160.0, 250.0):
        forces = _contacts(given, radians(degrees))
        slack = CLOSED * max(map(abs, forces))
        for name, force in zip(("front", "rear", "link"), forces, strict=True):
            words = "Cramer's rule, all eight signs tried; 0.1 % of the largest"
            yield Row(f"contact force {name} at {degrees:g} deg", "N", force, slack, words)
    samples = [2.0 * pi * row / 360 for row in range(360)]
    courses = [[_momentum_rate(given, angle)[part] for angle in samples] for part in range(3)]
    for name, course, unit in zip(("x", "y", "z"), courses, ("N", "N", "N m"), strict=True):
        what = "moment" if unit == "N m" else "force"
        first = order(course, 1)
        words = "change of momentum by differences; 0.1 % of order 1"
        slack = CLOSED * abs(first)
        yield Row(f"{what} {name}: order 1 cosine", unit, first.real, slack, words)
        yield Row(f"{what} {name}: order 1 sine", unit, -first.imag, slack, words)
        second = "zero: no part has a second harmonic; 0.1 % of order 1"
        yield Row(f"{what} {name}: order 2 amplitude", unit, 0.0, slack, second)


def _contacts(given: dict[str, float], angle: float) -> list[float]:
    """Forces whose signs are those that their friction was given."""
    radius, omega = given["crank_radius"] * 1e-3, 2.0 * pi * given["speed"] / 60.0
    inertia = -given["piston_mass"] * radius * omega**2 * cos(angle)
    right = [given["gas_force"] + inertia, 0.0, inertia * given["piston_mass_offset"] * 1e-3]
    for signs in product((1.0, -1.0), repeat=3):
        matrix = _matrix(given, angle, signs)
        whole = _determinant(matrix)
        forces = [_determinant(_with_column(matrix, c, right)) / whole for c in range(3)]
        if all(force * sign >= 0.0 for force, sign in zip(forces, signs, strict=True)):
            return forces
    raise ArithmeticError("no signs agree")


def _matrix(given: dict[str, float], angle: float, signs: tuple[float, ...]) -> list[list[float]]:
    front, rear, link = signs
    cylinder = given["cylinder_friction"] * (1.0 if sin(angle) >= 0.0 else -1.0)
    pair = given["link_friction"] * (1.0 if cos(angle) >= 0.0 else -1.0)
    radius, length = given["crank_radius"] * 1e-3, given["piston_length"] * 1e-3
    engaged = given["cylinder_length"] * 1e-3 - radius * (1.0 - cos(angle))
    tilt = -0.5 * cylinder * given["bore"] * 1e-3
    arm = given["link_offset"] * 1e-3 + radius * sin(angle)
    return [
        [cylinder * front, cylinder * rear, 1.0],
        [1.0, 1.0, pair * link],
        [tilt - length, tilt - (length - engaged), arm],
    ]


def _determinant(m: list[list[float]]) -> float:
    return (
        m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1])
        - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
        + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0])
    )


def _with_column(matrix: list[list[float]], column: int, right: list[float]) -> list[list[float]]:
    return [
        [right[row] if c == column else value for c, value in enumerate(values)]
        for row, values in enumerate(matrix)
    ]


def _momentum_rate(given: dict[str, float], angle: float) -> list[float]:
    """Minus the rate of momentum along x and y and of its moment about the shaft."""
    omega = 2.0 * pi * given["speed"] / 60.0
    rate = []
    for part in range(3):
        step = 1e-3
        change = _momentum(given, angle + step)[part] - _momentum(given, angle - step)[part]
        rate.append(-omega * change / (2.0 * step) * step / sin(step))  # exact for order 1
    return rate


def _momentum(given: dict[str, float], angle: float) -> list[float]:
    radius, omega = given["crank_radius"] * 1e-3, 2.0 * pi * given["speed"] / 60.0
    height = -(given["link_offset"] - given["piston_mass_offset"]) * 1e-3
    offset = -given["crankshaft_mass_offset"] * 1e-3
    across, along = cos(angle), -sin(angle)
    bodies = [  # mass, x, y, velocity x and y
        (given["piston_mass"], radius * cos(angle), height, radius * omega * along, 0.0),
        *(
            (mass, r * cos(angle), r * sin(angle), r * omega * along, r * omega * across)
            for mass, r in ((given["slider_mass"], radius), (given["crankshaft_mass"], offset))
        ),
    ]
    return [
        sum(m * vx for m, _, _, vx, _ in bodies),
        sum(m * vy for m, _, _, _, vy in bodies),
        sum(m * (x * vy - y * vx) for m, x, y, vx, vy in bodies),
    ]
