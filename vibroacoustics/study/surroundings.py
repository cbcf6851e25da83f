"""Surroundings of the machine: floor or ground, walls, a cabinet, a barrier."""

from typing import Final, Literal

from pydantic import Field

from ..base.parameters import Contradictions, Parameters

WallSide = Literal["-x", "+x", "-y", "+y"]
PanelSide = Literal["-x", "+x", "-y", "+y", "top"]
GroundName = Literal[
    "snow", "moss", "loose_soil", "pasture", "lawn", "gravel_road", "asphalt", "water"
]
FLOW_RESISTIVITY_PA_S_PER_M2: Final[dict[GroundName, float]] = {
    "snow": 12.5e3,
    "moss": 31.5e3,
    "loose_soil": 80e3,
    "pasture": 200e3,
    "lawn": 500e3,
    "gravel_road": 2e6,
    "asphalt": 20e6,
    "water": 200e6,
}
"""Directive (EU) 2015/996, Table 2.5.a, classes A to H, which are those of Nordtest ACOU 104:
very soft, snow or moss-like; soft forest floor, thick moss; uncompacted, loose ground, turf;
normal uncompacted ground, forest floor, pasture; compacted field, lawn, park; compacted dense
ground, gravel road, car park; hard, most asphalt and concrete; very hard and dense, water."""


class Wall(Parameters):
    """An upright wall of the room, large against the wavelength."""

    distance_m: float = Field(gt=0.0, le=5.0)
    """Distance from the shell's axis."""
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
    """Depth along x, centred on the shell's axis."""
    width_m: float = Field(gt=0.0, le=3.0)
    """Width along y, centred on the shell's axis."""
    height_m: float = Field(gt=0.0, le=3.0)
    panel_thickness_m: float = Field(default=0.018, ge=0.003, le=0.1)
    open_sides: tuple[PanelSide, ...] = ()
    openings: dict[PanelSide, Opening] = Field(default_factory=dict)


class Ground(Parameters):
    """Porous ground, in place of a hard floor on the way to the microphones."""

    material: GroundName | None = None
    flow_resistivity_pa_s_per_m2: float | None = Field(default=None, ge=1e3, le=1e9)
    """Effective, of a ground that is none of those by name."""

    def contradictions(self) -> Contradictions:
        if (self.material is None) == (self.flow_resistivity_pa_s_per_m2 is None):
            yield "material, flow_resistivity_kpa_s_per_m2: give one of them"

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
    """Distance from the shell's axis."""
    height_m: float = Field(ge=0.3, le=10.0)
    """Height above the floor."""


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

    def contradictions(self) -> Contradictions:
        if self.is_outdoors:
            yield from self._outdoors()
        for axis in "xy":
            if {f"-{axis}", f"+{axis}"} <= set(self.walls):
                yield f"walls: -{axis} and +{axis} face each other: at most one wall an axis"
        if self.cabinet is not None and not self.floor:
            yield "cabinet: stands on the floor, floor = true is needed"

    def _outdoors(self) -> Contradictions:
        if not self.floor:
            yield "ground, barrier: lie and stand on the floor, floor = true is needed"
        if len(self.walls) > 1:
            yield "walls: beside ground or a barrier at most one"
        if self.barrier is not None and self.barrier.side in self.walls:
            yield f"barrier.side = {self.barrier.side}: a wall is there"
