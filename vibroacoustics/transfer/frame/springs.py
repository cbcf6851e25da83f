"""Springs between the bodies of the frame."""

from typing import Final

import numpy as np

from ...base.arrays import Array
from ...machine.frame import Face, Frame
from ...mechanics.bushings import Bushing

FACE_SPRINGS: Final = 8
"""Points that stand for an annular face; its tilting stiffness is exact from three on."""


def springs_of(frame: Frame) -> tuple[Bushing, ...]:
    """Bolts, thrust face, tips where they close, and the keys."""
    springs = [*_bolts(frame), *_face(frame, "thrust", frame.thrust_face, "bearing_housing")]
    if frame.axially_compliant:
        springs += _face(frame, "tip", frame.tips, "fixed_scroll")
    return (*springs, _keys(frame))


def _bolts(frame: Frame) -> list[Bushing]:
    bolts = frame.bolts
    lateral, axial = bolts.lateral_stiffness_n_per_m, bolts.axial_stiffness_n_per_m
    if frame.axially_compliant:
        axial = bolts.guide_stiffness_n_per_m
    stiffness = np.diag([lateral, lateral, axial, 0.0, 0.0, 0.0])
    points = _ring(bolts.number, bolts.radius_m, bolts.height_m, bolts.first_angle_rad)
    loss = frame.joint_loss_factor_ratio
    return [
        Bushing(
            f"bolt_{n}", "fixed_scroll", "bearing_housing", point, stiffness, loss_factor_ratio=loss
        )
        for n, point in enumerate(points, 1)
    ]


def _face(frame: Frame, name: str, face: Face, other: str) -> list[Bushing]:
    """Springs along z between the orbiting scroll and another body."""
    stiffness = np.zeros((6, 6))
    stiffness[2, 2] = face.stiffness_n_per_m / FACE_SPRINGS
    points = _ring(FACE_SPRINGS, face.radius_m, face.height_m, 0.0)
    loss = frame.joint_loss_factor_ratio
    return [
        Bushing(f"{name}_{n}", "orbiting_scroll", other, point, stiffness, loss_factor_ratio=loss)
        for n, point in enumerate(points, 1)
    ]


def _keys(frame: Frame) -> Bushing:
    """Keys that keep the orbiting scroll from turning: four in two parts of slots in series."""
    stiffness = np.zeros((6, 6))
    stiffness[5, 5] = frame.keys_stiffness_n_per_m * frame.keys_radius_m**2
    point = np.array([0.0, 0.0, frame.orbiting_scroll.height_m])
    standing = frame.keys_on.replace("-", "_")
    loss = frame.joint_loss_factor_ratio
    return Bushing("keys", "orbiting_scroll", standing, point, stiffness, loss_factor_ratio=loss)


def _ring(number: int, radius_m: float, height_m: float, first_angle: float) -> Array:
    """Points spread evenly around the axis, shape (number, 3)."""
    angle = first_angle + 2.0 * np.pi * np.arange(number) / number
    height = np.full(number, height_m)
    return np.stack([radius_m * np.cos(angle), radius_m * np.sin(angle), height], axis=1)
