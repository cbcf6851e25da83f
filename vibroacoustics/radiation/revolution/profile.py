"""Meridians that radiate: where they have edges, what of them stands on a floor, coarser ones."""

from typing import Final

import numpy as np

from ...base.revolution import Curve, Line, Profile, sphere
from ...machine.shell import Shell
from ...study.body import RadiatingBody, ShellBody, SphereBody
from ..arrays import Array

_EDGE_RAD: Final = 0.35
"""Two curves that meet at more than this angle meet at an edge; elements that do not shrink
towards a smaller one err by 4e-6 to 4 kHz, 4e-5 at 10 kHz."""
_ON_AXIS_M: Final = 1e-9
_OUTWARD: Final[Array] = np.array([1.0, 0.0])


def edges(profile: Profile) -> list[tuple[bool, bool]]:
    """Whether each curve begins and ends at an edge; tips on the axis are edges, too."""
    ends = [_end_tangents(curve) for curve in profile.curves]
    before = [_start_of(profile.curves[0]), *(end for _, end in ends[:-1])]
    after = [*(start for start, _ in ends[1:]), -_OUTWARD]
    return [
        (_turns(previous, start), _turns(end, following))
        for (start, end), previous, following in zip(ends, before, after, strict=True)
    ]


def _start_of(curve: Curve) -> Array:
    """Direction in which the meridian comes to its start: on the axis, or mirrored in a floor."""
    if curve(np.zeros(1))[0, 0] <= _ON_AXIS_M:
        return _OUTWARD
    return np.asarray(_end_tangents(curve)[0] * np.array([-1.0, 1.0]))


def _end_tangents(curve: Curve) -> Array:
    slope = curve.slope(np.array([0.0, 1.0]))
    return np.asarray(slope / np.linalg.norm(slope, axis=1)[:, None])


def _turns(first: Array, second: Array) -> bool:
    return bool(np.arccos(np.clip(first @ second, -1.0, 1.0)) > _EDGE_RAD)


def above_floor(profile: Profile, floor_z_m: float | None) -> Profile:
    """The profile without curves that lie on the floor: what stands on it radiates nothing."""
    if floor_z_m is None:
        return profile
    samples = np.linspace(0.0, 1.0, 5)
    kept = [c for c in profile.curves if np.ptp([floor_z_m, *c(samples)[:, 1]]) > 1e-9]
    return Profile(tuple(kept))


def with_fewer_points(profile: Profile, longest_m: float) -> Profile:
    """The profile with one line for two that meet at no edge and are no longer than a length.

    Such lines follow a curve of the body: what they leave of it open shows in the difference.
    """
    curves: list[Curve] = []
    joined = False
    for curve, (starts_at_edge, _) in zip(profile.curves, edges(profile), strict=True):
        last = curves[-1] if curves else None
        if (
            not joined
            and not starts_at_edge
            and isinstance(last, Line)
            and isinstance(curve, Line)
            and max(_length_m(last), _length_m(curve)) <= longest_m
        ):
            curves[-1], joined = Line(last.start, curve.end), True
        else:
            curves.append(curve)
            joined = False
    return Profile(tuple(curves))


def _length_m(line: Line) -> float:
    return float(np.hypot(*np.subtract(line.end, line.start)))


def body_profile(shell: Shell, body: RadiatingBody) -> Profile | None:
    """Meridian of a study's body about the machine's centre of mass; none if it has none."""
    if isinstance(body, SphereBody):
        return sphere(body.diameter_m / 2.0, body.diameter_m / 2.0 - shell.centre_of_mass_height_m)
    return shell.profile if isinstance(body, ShellBody) else None
