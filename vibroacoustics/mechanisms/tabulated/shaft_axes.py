"""Directions of stroke and shaft of a machine by table, read from its file and written to it."""

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar, Final, Literal

from pydantic import Field

from ...base.parameters import Contradictions, Parameters
from ...mechanics.capabilities import CrankFrame

Axis = Literal["x", "y", "z", "-x", "-y", "-z"]
_UNIT: Final = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}


class ShaftAxes(Parameters):
    """Position of the shaft: crank angle counts from the stroke, positive about the shaft."""

    lines_to_add: ClassVar[str] = (
        'add the lines [shaft_axes], stroke = "x", shaft = "z" with the directions of this '
        "machine, each x, y, z, -x, -y or -z"
    )
    stroke: Axis
    shaft: Axis
    x_m: float = Field(default=0.0, ge=-2.0, le=2.0)
    y_m: float = Field(default=0.0, ge=-2.0, le=2.0)
    z_m: float = Field(default=0.0, ge=-2.0, le=2.0)
    """A point of the shaft, from the centre of mass at rest."""

    def contradictions(self) -> Contradictions:
        if self.stroke[-1] == self.shaft[-1]:
            yield f"stroke = {self.stroke}: must be across the shaft, {self.shaft}"

    @property
    def frame(self) -> CrankFrame:
        """Axes of stroke and shaft."""
        shaft, stroke = _vector(self.shaft), _vector(self.stroke)
        across = (
            shaft[1] * stroke[2] - shaft[2] * stroke[1],
            shaft[2] * stroke[0] - shaft[0] * stroke[2],
            shaft[0] * stroke[1] - shaft[1] * stroke[0],
        )
        return CrankFrame(stroke, across, shaft, (self.x_m, self.y_m, self.z_m))


def axes_lines(frame: Mapping[str, Any], source: str) -> list[str]:
    """Write the table `[shaft_axes]` of a machine file.

    Parameters
    ----------
    frame : `CrankFrame` by its names
    source : source of the position of the shaft

    Returns
    -------
    lines of TOML; where stroke or shaft is not along an axis, one remark that says so
    """
    stroke, shaft = _axis(frame["stroke"]), _axis(frame["shaft"])
    if stroke is None or shaft is None:
        return ["# stroke or shaft is not along an axis: [shaft_axes] cannot give it"]
    position = zip("xyz", frame["origin_m"], strict=True)
    return [
        "[shaft_axes]",
        f'stroke = "{stroke}"',
        f'shaft = "{shaft}"',
        *(
            f'{axis}_m = {{ value = {coordinate!r}, source = "{source}" }}'
            for axis, coordinate in position
            if coordinate
        ),
    ]


def _vector(axis: Axis) -> tuple[float, float, float]:
    x, y, z = _UNIT[axis[-1]]
    sign = -1.0 if axis[0] == "-" else 1.0
    return sign * x, sign * y, sign * z


def _axis(vector: Sequence[float]) -> str | None:
    """Name of an axis, None where the vector is along none."""
    for name, unit in _UNIT.items():
        for sign, prefix in ((1.0, ""), (-1.0, "-")):
            if tuple(vector) == tuple(sign * part for part in unit):
                return f"{prefix}{name}"
    return None
