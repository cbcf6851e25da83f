"""What stands around the machine: floor or ground, walls, a cabinet, a barrier."""

from typing import Literal, Self

from pydantic import Field, model_validator

from ..base.parameters import Parameters
from .grounds import FLOW_RESISTIVITY_PA_S_PER_M2, GroundName

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


class Ground(Parameters):
    """Porous ground, in place of a hard floor on the way to the microphones."""

    material: GroundName | None = None
    flow_resistivity_pa_s_per_m2: float | None = Field(default=None, ge=1e3, le=1e9)
    """Effective, of a ground that is none of those by name."""

    @model_validator(mode="after")
    def _one(self) -> Self:
        if (self.material is None) == (self.flow_resistivity_pa_s_per_m2 is None):
            raise ValueError("material, flow_resistivity_kpa_s_per_m2: give one of them")
        return self

    @property
    def resistivity_pa_s_per_m2(self) -> float:
        """Given, or that of the material."""
        if self.material is not None:
            return FLOW_RESISTIVITY_PA_S_PER_M2[self.material]
        assert self.flow_resistivity_pa_s_per_m2 is not None  # noqa: S101 - one of both is given
        return self.flow_resistivity_pa_s_per_m2


class Barrier(Parameters):
    """A thin upright screen on the ground, without ends."""

    side: WallSide
    distance_m: float = Field(gt=0.0, le=20.0)
    """From the shell's axis."""
    height_m: float = Field(ge=0.3, le=10.0)
    """Above the floor."""


class Surroundings(Parameters):
    """A hard floor, ground or none, upright walls, a cabinet, a barrier."""

    floor: bool = True
    walls: dict[WallSide, Wall] = Field(default_factory=dict)
    cabinet: Cabinet | None = None
    ground: Ground | None = None
    barrier: Barrier | None = None

    @property
    def is_outdoors(self) -> bool:
        """Whether sound goes over ground or a barrier."""
        return self.ground is not None or self.barrier is not None

    @model_validator(mode="after")
    def _outdoors(self) -> Self:
        if not self.is_outdoors:
            return self
        if not self.floor:
            raise ValueError("ground, barrier: lie and stand on the floor, floor = true is needed")
        if len(self.walls) > 1:
            raise ValueError("walls: beside ground or a barrier at most one")
        if self.barrier is not None and self.barrier.side in self.walls:
            raise ValueError(f"barrier.side = {self.barrier.side}: a wall is there")
        return self

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
