"""Tables of several machines in one study: where each stands, its speed, the frame under them."""

from collections.abc import Iterator, Mapping
from itertools import combinations
from typing import Annotated

from pydantic import Field

from ..base.parameters import Parameters
from ..base.vocabulary import COORDINATES, REFERENCE_OPTION, VARIABLES
from ..machine.feet import Feet, Mounts
from ..machine.housing import Housing

_Metres = Annotated[float, Field(ge=-20.0, le=20.0)]


class StudyMachine(Parameters):
    """One of several machines: its file, position, speed and option."""

    file: str = Field(default="", max_length=1000)
    """Study or machine file; this study's machine where none is given."""
    position_m: tuple[_Metres, _Metres]
    """x and y of its axis on the floor, in the axes of the common receivers."""
    angle_rad: float = Field(default=0.0, ge=-6.3, le=6.3)
    """Angle from the common x axis to the machine's, about the vertical."""
    speed_rpm: float = Field(ge=60.0, le=60000.0)
    option: str = REFERENCE_OPTION
    """Among the options of its study."""


class BaseFrame(Parameters):
    """Rigid frame on mounts of its own, on which all machines stand."""

    body: Housing
    """Mass and moments of inertia of the frame without machines, along the common axes."""
    position_m: tuple[_Metres, _Metres]
    """x and y of its centre of mass, in the axes of the common receivers."""
    height_m: float = Field(ge=0.0, le=3.0)
    """Height of its centre of mass above the floor."""
    top_height_m: float = Field(ge=0.0, le=0.4)
    """Height above the floor, of the surface on which the mounts of the machines stand."""
    mounts: Mounts
    """Mounts between frame and floor, four in a square about its centre of mass."""
    feet: Feet | None = None
    """Feet from its centre of mass, in place of the square."""


def machines_problems(
    machines: Mapping[str, StudyMachine],
    base_frame: BaseFrame | None,
    common_receivers: Mapping[str, object],
    receivers: Mapping[str, object],
) -> Iterator[str]:
    """Give what is wrong between the tables of several machines, a line each.

    Parameters
    ----------
    machines : by name
    base_frame : under all of them; None where each stands on the floor
    common_receivers : by name, about the origin of the positions
    receivers : by name, about each machine
    """
    if not machines:
        for name, table in (("base_frame", base_frame), ("common_receivers", common_receivers)):
            if table:
                yield f"{name}: needs the tables machines.NAME"
        return
    if len(machines) == 1:
        yield f"machines.{next(iter(machines))}: is the only one; give at least two"
    for name in machines:
        if set(name) & set("/:") or name in COORDINATES or name in VARIABLES:
            yield f"machines.{name}: rename it; no / or :, and no name of a variable of results"
    if not common_receivers:
        yield "common_receivers: is missing; give microphones about the origin of the positions"
    for (name, machine), (other_name, other) in combinations(machines.items(), 2):
        if machine.position_m == other.position_m:
            x_mm, y_mm = (1e3 * metres for metres in other.position_m)
            yield (
                f"machines.{other_name}.position_mm = [{x_mm:g}, {y_mm:g}] mm: is the position of "
                f"machines.{name}"
            )
    for name in common_receivers:
        if name in receivers:
            yield f"common_receivers.{name}: is the name of a receiver of each machine; rename it"
