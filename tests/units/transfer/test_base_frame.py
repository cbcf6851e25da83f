"""Machines on one frame against one large matrix that is assembled here, and its limits."""

import numpy as np
import pytest

from vibroacoustics.machine.feet import Mounts
from vibroacoustics.machine.housing import Housing
from vibroacoustics.machine.suspension import BLOCK, Suspension
from vibroacoustics.mechanics.bushings import RigidBody
from vibroacoustics.mechanics.ports import HOUSING
from vibroacoustics.transfer.base_frame import FRAME, MachinesOnFrame, Standing
from vibroacoustics.transfer.feet import Stand
from vibroacoustics.transfer.machine import MachineOnMounts

HERTZ = np.array([3.0, 11.7, 48.0, 48.0 + 1.0 / 3.0, 290.0])
FOOT_M = -0.19
CENTRE_M = np.array([0.1, -0.05, 0.06])
FRAME_MOUNTS = Mounts(
    pitch_m=0.9, lateral_stiffness_n_per_m=6e4, vertical_stiffness_n_per_m=1.1e5,
    loss_factor_ratio=0.12,
)  # fmt: skip
PITCH_AND_SIGNS = [(x, y) for x in (1.0, -1.0) for y in (1.0, -1.0)]


def housing(factor: float) -> Housing:
    return Housing(
        mass_kg=30.0 * factor, inertia_xx_kg_m2=0.5 * factor, inertia_yy_kg_m2=0.7 * factor,
        inertia_zz_kg_m2=0.3 * factor,
    )  # fmt: skip


def mounts(factor: float) -> Mounts:
    return Mounts(
        pitch_m=0.19, lateral_stiffness_n_per_m=2e4 * factor,
        vertical_stiffness_n_per_m=5e4 * factor, loss_factor_ratio=0.1 * factor,
    )  # fmt: skip


SUSPENSION = Suspension(
    block=housing(0.4), height_m=0.02, springs=mounts(0.5), springs_height_m=-0.05
)


def turn(angle: float) -> np.ndarray:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def machines() -> dict[str, Standing]:
    """Four of different size, angle and height; the last has a block on springs."""
    made = {}
    for number in range(4):
        suspension = SUSPENSION if number == 3 else None
        factor = 1.0 + 0.3 * number
        body = MachineOnMounts(housing(factor), mounts(factor), FOOT_M, suspension)
        origin = np.array([0.35 * (-1) ** number, 0.3 * (number - 1.5), 0.3 + 0.02 * number])
        made[f"m{number}"] = Standing(body, origin, turn(0.4 * number))
    return made


def on_frame(mass_kg: float = 40.0, frame_mounts: Mounts = FRAME_MOUNTS) -> MachinesOnFrame:
    inertia = np.diag([4.0, 5.0, 8.0]) * mass_kg / 40.0
    frame = RigidBody(FRAME, mass_kg, inertia, CENTRE_M)
    return MachinesOnFrame(frame, Stand(frame_mounts, -CENTRE_M[2]), machines())


def cross(r: np.ndarray) -> np.ndarray:
    """Displacement of a point at r by a small rotation: -[r]x."""
    return -np.array([[0.0, -r[2], r[1]], [r[2], 0.0, -r[0]], [-r[1], r[0], 0.0]])


def large_matrix(hertz: float) -> tuple[np.ndarray, list[str]]:
    """Dynamic stiffness of all bodies, written out spring by spring, and names of the bodies."""
    names, centres, mass, springs = [FRAME], {FRAME: CENTRE_M}, [], []
    mass.append(np.diag([40.0] * 3 + [4.0, 5.0, 8.0]))

    def four(table, ends, middle, height, turned):
        for x, y in PITCH_AND_SIGNS:
            corner = np.array([0.5 * table.pitch_m * x, 0.5 * table.pitch_m * y, height])
            k = np.diag([table.lateral_stiffness_n_per_m] * 2 + [table.vertical_stiffness_n_per_m])
            springs.append((ends, middle + turned @ corner, k * (1 + 1j * table.loss_factor_ratio)))

    def body(name, size, centre, turned):
        names.append(name)
        centres[name] = centre
        moments = np.diag([size.inertia_xx_kg_m2, size.inertia_yy_kg_m2, size.inertia_zz_kg_m2])
        matrix = np.zeros((6, 6))
        matrix[:3, :3] = size.mass_kg * np.eye(3)
        matrix[3:, 3:] = turned @ moments @ turned.T
        mass.append(matrix)

    four(FRAME_MOUNTS, (FRAME, None), CENTRE_M, -CENTRE_M[2], np.eye(3))
    for name, machine in machines().items():
        origin, turned, on = machine.origin_m, machine.turn, machine.body
        body(f"{name}/housing", on.housing, origin, turned)
        four(on.mounts, (f"{name}/housing", FRAME), origin, FOOT_M, turned)
        if on.suspension is not None:
            centre = origin + np.array([0.0, 0.0, on.suspension.height_m])
            body(f"{name}/block", on.suspension.block, centre, turned)
            ends = f"{name}/block", f"{name}/housing"
            four(on.suspension.springs, ends, centre, on.suspension.springs_height_m, turned)
    dynamic = np.zeros((6 * len(names), 6 * len(names)), dtype=complex)
    for row, matrix in enumerate(mass):
        at = slice(6 * row, 6 * row + 6)
        dynamic[at, at] -= (2 * np.pi * hertz) ** 2 * matrix
    for ends, point, k in springs:
        stretch = np.zeros((3, len(dynamic)))
        for sign, end in zip((1.0, -1.0), ends, strict=True):
            if end is not None:
                at = 6 * names.index(end)
                stretch[:, at : at + 3] = sign * np.eye(3)
                stretch[:, at + 3 : at + 6] = sign * cross(point - centres[end])
        dynamic += stretch.T @ k @ stretch
    return dynamic, names


def loads(name: str) -> dict:
    random = np.random.default_rng(len(name) + int(name[1:]))
    of_housing, of_block = (
        random.standard_normal((6, HERTZ.size)) + 1j * random.standard_normal((6, HERTZ.size))
        for _ in range(2)
    )
    return {HOUSING: of_housing} | ({BLOCK: of_block} if name == "m3" else {})


@pytest.mark.parametrize("name", ["m0", "m1", "m2", "m3"])
def test_four_machines_are_one_large_assembly(name):
    frame, given = on_frame(), loads(name)
    motion = frame.motion(name, given, HERTZ)
    velocity = frame.housing_velocity(motion, HERTZ)
    turned = np.kron(np.eye(2), frame.machines[name].turn)
    for line, hertz in enumerate(HERTZ):
        dynamic, names = large_matrix(hertz)
        assert names == [body.name for body in frame.isolation.bodies]
        force = np.zeros(len(dynamic), dtype=complex)
        for port, load in given.items():
            at = 6 * names.index(f"{name}/{port.name}")
            force[at : at + 6] = turned @ load[:, line]
        expected = np.linalg.solve(dynamic, force)
        error = np.abs(motion[line].ravel() - expected).max() / np.abs(expected).max()
        assert error < 1e-9
        for other, machine in frame.machines.items():
            at = 6 * names.index(f"{other}/housing")
            along = np.kron(np.eye(2), machine.turn).T @ expected[at : at + 6]
            along *= 2j * np.pi * hertz
            assert np.abs(velocity[other][line] - along).max() < 1e-9 * np.abs(along).max()
        feet = frame.floor_force(motion, HERTZ)[line]
        rest_n = (2 * np.pi * hertz) ** 2 * sum(
            body.mass_kg * expected[6 * row : 6 * row + 3]
            for row, body in enumerate(frame.isolation.bodies)
        )
        total = force.reshape(-1, 6)[:, :3].sum(axis=0) + rest_n
        size = np.abs(force).max() + np.abs(rest_n).max()
        assert np.abs(feet.sum(axis=0) - total).max() < 1e-9 * size


@pytest.mark.parametrize("name", ["m0", "m3"])
def test_a_frame_of_no_motion_leaves_each_machine_alone(name):
    """The frame's share of the motion falls as one over its mass: 1e-12 of 4e13 kg."""
    frame, given = on_frame(mass_kg=4e13), loads(name)
    velocity = frame.housing_velocity(frame.motion(name, given, HERTZ), HERTZ)
    body = frame.machines[name].body
    alone = sum(body.response(load.T, HERTZ, port).velocity for port, load in given.items())
    assert np.abs(velocity[name] - alone).max() < 1e-9 * np.abs(alone).max()
    for other in set(frame.machines) - {name}:
        assert np.abs(velocity[other]).max() < 1e-9 * np.abs(alone).max()


def test_stiff_mounts_of_the_frame_are_the_floor():
    stiff = FRAME_MOUNTS.model_copy(
        update={"lateral_stiffness_n_per_m": 1e15, "vertical_stiffness_n_per_m": 1e15}
    )
    frame, given = on_frame(frame_mounts=stiff), loads("m1")
    velocity = frame.housing_velocity(frame.motion("m1", given, HERTZ), HERTZ)["m1"]
    alone = frame.machines["m1"].body.response(given[HOUSING].T, HERTZ).velocity
    assert np.abs(velocity - alone).max() < 1e-7 * np.abs(alone).max()
