"""What stands around the machine: floor, walls, a cabinet."""

from typing import Literal

from pydantic import Field, model_validator

from ..base.parameters import Parameters

WallSide = Literal["-x", "+x", "-y", "+y"]
PanelSide = Literal["-x", "+x", "-y", "+y", "top"]


class Wall(Parameters):
    """An upright wall of the room, large against the wavelength."""

    distance_m: float = Field(gt=0.0, le=5.0)
    """From the shell's axis."""
    absorption_ratio: float = Field(default=0.0, ge=0.0, le=1.0)
    """Absorbed share of the energy, the same at every angle and frequency; 0 is hard."""


class Opening(Parameters):
    """A rectangular hole in a panel of the cabinet."""

    along_m: float = 0.0
    """Middle of the hole along the panel, from the shell's axis; along x in the lid."""
    up_m: float
    """Middle of the hole above the floor; along y in the lid."""
    width_m: float = Field(gt=0.0, le=5.0)
    height_m: float = Field(gt=0.0, le=5.0)


class Cabinet(Parameters):
    """Hard panels around the machine, standing on the floor; inside dimensions."""

    depth_m: float = Field(gt=0.0, le=3.0)
    """Along x, centred on the shell's axis."""
    width_m: float = Field(gt=0.0, le=3.0)
    """Along y, centred on the shell's axis."""
    height_m: float = Field(gt=0.0, le=3.0)
    panel_thickness_m: float = Field(default=0.018, ge=0.003, le=0.1)
    open_sides: tuple[PanelSide, ...] = ()
    openings: dict[PanelSide, Opening] = Field(default_factory=dict)


class Surroundings(Parameters):
    """A hard floor or none, upright walls, and a cabinet."""

    floor: bool = True
    walls: dict[WallSide, Wall] = Field(default_factory=dict)
    cabinet: Cabinet | None = None

    @model_validator(mode="after")
    def _possible(self) -> "Surroundings":
        for axis in "xy":
            if {f"-{axis}", f"+{axis}"} <= set(self.walls):
                raise ValueError(
                    f"walls: -{axis} and +{axis} face each other: at most one wall an axis"
                )
        if self.cabinet is not None and not self.floor:
            raise ValueError("cabinet: stands on the floor, floor = true is needed")
        return self
