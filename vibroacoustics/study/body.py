"""The shape that radiates, where it is not the shell's cylinder."""

from typing import Annotated, Literal

from pydantic import Field

from ..base.parameters import Parameters


class ShellBody(Parameters):
    """The shell of the machine, as its parameters describe it."""

    kind: Literal["shell"] = "shell"


class BoxBody(Parameters):
    """Rectangular block about the shell's axis, from the height of the shell's bottom."""

    kind: Literal["box"]
    length_m: float = Field(gt=0.01, le=3.0)
    """Length along x."""
    width_m: float = Field(gt=0.01, le=3.0)
    """Width along y."""
    height_m: float = Field(gt=0.01, le=3.0)


class SphereBody(Parameters):
    """Sphere on the shell's axis, its lowest point at the height of the shell's bottom."""

    kind: Literal["sphere"]
    diameter_m: float = Field(gt=0.01, le=3.0)


class MeshBody(Parameters):
    """Closed triangle mesh; x and y as the machine's, z from the shell's bottom."""

    kind: Literal["mesh"]
    file: str = Field(min_length=1)
    """STL file; in a study relative to the study's folder."""
    file_unit_m: float = Field(default=1e-3, gt=0.0, le=1.0)
    """Length of the file's unit."""
    patterns: dict[str, str] = Field(default_factory=dict)
    """CSV files of surface velocities by name: a number or a vector for each face or vertex."""


RadiatingBody = Annotated[ShellBody | BoxBody | SphereBody | MeshBody, Field(discriminator="kind")]
