"""A made-up bench for blocked forces: a rigid machine with a known source on mounts on a panel.

Two interfaces are measured: the feet on the machine, above the mounts, and those of the panel,
below them. The blocked forces of either are known without any inversion.
"""

from dataclasses import dataclass

import numpy as np
from measured_bench import BODY, CORNERS, PANEL, STIFFNESS, noisy, panel

import vibroacoustics as va

SPEED_RPM = 1500.0
FREQUENCY = 25.0 * np.arange(1, 33)
OMEGA = 2.0 * np.pi * FREQUENCY
FURTHER = np.array(
    [(-0.3, -0.2), (0.25, 0.2), (0.05, -0.22), (-0.2, 0.17), (0.3, -0.1), (0.0, 0.0)]
)
"""Points of the panel beside its four feet."""
MACHINE, FEET, PLATE = (1, 2, 3, 4), (11, 12, 13, 14), (21, 22, 23, 24, 25, 26)
MICROPHONE = 101
NODES = [va.Node(number, "+z") for number in (*MACHINE, *FEET, *PLATE)] + [va.Node(MICROPHONE)]
FORCES = NODES[:8]


@dataclass(frozen=True)
class Bench:
    """Responses of points and microphone per force at the first eight points, and running."""

    frf: np.ndarray
    running: np.ndarray


def source():
    """Force along z and moments about x and y of the source, shape (frequency, 3)."""
    phases = np.exp(2j * np.pi * np.random.default_rng(3).random((FREQUENCY.size, 3)))
    return phases * [40.0, 3.0, 4.0] / np.arange(1, 33)[:, None] ** 0.5


def on_machine():
    """Motion of the machine's feet by its motion: along z, about x and y."""
    return np.column_stack([np.ones(4), CORNERS[:, 1], -CORNERS[:, 0]])


def bench():
    """Solved in 43 modal coordinates."""
    shapes, natural = panel(np.concatenate([CORNERS, FURTHER]))
    points = np.zeros((14, 43))
    points[:4, :3], points[4:, 3:] = on_machine(), shapes
    mass = np.array([*BODY, *[PANEL[3]] * natural.size])
    elastic = np.array([0.0, 0.0, 0.0, *natural**2 * (1.0 + 0.03j)]) * mass
    mounts = points[:4] - points[4:8]
    dynamic = np.einsum("fm,mn->fmn", elastic - OMEGA[:, None] ** 2 * mass, np.eye(43))
    solved = np.linalg.inv(dynamic + STIFFNESS * mounts.T @ mounts)
    rng = np.random.default_rng(8)
    sound = 0.01 * (rng.normal(size=(1, 43)) + 1j * rng.normal(size=(1, 43)))
    sound[:, :3] = 0.0
    load = np.zeros((FREQUENCY.size, 43, 1), complex)
    load[:, :3, 0] = source()
    seen = np.concatenate(
        [np.broadcast_to(points, (FREQUENCY.size, 14, 43)), -(OMEGA[:, None, None] ** 2) * sound],
        axis=1,
    )
    return Bench(seen @ solved @ points[:8].T, (seen @ solved @ load)[..., 0])


def below_the_mounts():
    """Forces of the mounts on a panel that does not move, shape (frequency, 4)."""
    body = np.diag(BODY) * -(OMEGA[:, None, None] ** 2)
    held = body + STIFFNESS * on_machine().T @ on_machine()
    motion = np.linalg.solve(held, source()[..., None])
    return (STIFFNESS * on_machine() @ motion)[..., 0]


HEAD = """
title = "In situ"

[measured]
frequency_responses = ["hammer.uff"]
operating = ["running.csv"]
relative_error_percent = {error}
draws = 50

[measured.points]
{points}
[measured.microphones]
front = {{ node = 101 }}

[blocked_forces]
"""
ABOVE = """
points = ["n1", "n2", "n3", "n4"]
responses = ["n1", "n2", "n3", "n4", "n11", "n12"]
validation = ["n13", "n14", "front"]
rigid_source = true
speed_rpm = 1500.0
""" + "".join(
    f"[blocked_forces.positions.n{number}]\nx_mm = {1e3 * x}\ny_mm = {1e3 * y}\nz_mm = -150.0\n"
    for number, (x, y) in zip(MACHINE, CORNERS, strict=True)
)  # fmt: skip
BELOW = """
points = ["n11", "n12", "n13", "n14"]
responses = ["n11", "n12", "n13", "n14", "n21", "n22", "n23", "n24"]
validation = ["n25", "n26", "front"]
"""


def write(folder, interface, share=0.0, number=0, unit="m/s²"):
    """Files of the bench, with noise, and the file for `blocked-forces`; returns the latter."""
    rng, made = np.random.default_rng(number), bench()
    frf, running = (noisy(values, share, rng) for values in (made.frf, made.running))
    quantity = ["m" if node.direction else "Pa" for node in NODES]
    responses = [
        va.MeasuredFunction("frequency response", FREQUENCY, frf[:, row, column], node, force,
                            quantity[row], "N")
        for row, node in enumerate(NODES) for column, force in enumerate(FORCES)
    ]  # fmt: skip
    spectra = [
        va.MeasuredFunction("spectrum", FREQUENCY, running[:, row], node, None, quantity[row])
        for row, node in enumerate(NODES)
    ]
    in_unit = [[f.with_response_in(unit) if f.response.direction else f for f in each]
               for each in (responses, spectra)]  # fmt: skip
    va.export_functions(in_unit[0], folder / "hammer.uff")
    va.export_functions(in_unit[1], folder / "running.csv")
    points = "".join(
        f'n{node.number} = {{ node = {node.number}, direction = "+z" }}\n' for node in NODES[:-1]
    )
    text = HEAD.format(error=100.0 * (share or 0.03), points=points) + interface
    (folder / "in_situ.toml").write_text(text)
    return folder / "in_situ.toml"
