"""Settings of the sound field besides the microphones: sound power, map, directivity."""

from math import ceil, pi
from typing import Annotated, Final, Literal

from pydantic import Field

from ..base.parameters import Contradictions, Parameters

HEMISPHERES: Final = ("iso3744-hemisphere-10", "iso3744-hemisphere-20")
MINIMUM_BACKGROUND_MARGIN_DB: Final = 6.0
"""Margin below which a measurement does not qualify (ISO 3744:2010, 8.2.3)."""
MAXIMUM_POINTS: Final = 20_000
"""Most points of a map or a directivity; each is one point of the Green's function."""

Coordinate = Annotated[float, Field(ge=-20.0, le=20.0)]


class SoundPowerSettings(Parameters):
    """A measurement of the sound power level over a hard floor."""

    arrangement: Literal[
        "iso3744-hemisphere-10", "iso3744-hemisphere-20", "iso3744-box", "en12102-box"
    ] = "iso3744-hemisphere-10"
    radius_m: float = Field(default=1.0, ge=1.0, le=16.0)
    """Radius of the hemisphere (7.2.3: not below 1 m, nor below twice the source's extent)."""
    distance_m: float = Field(default=1.0, ge=0.25, le=16.0)
    """Distance from the machine's reference box to the measurement box (7.2.4)."""
    background_margin_db: float | None = Field(
        default=None, ge=MINIMUM_BACKGROUND_MARGIN_DB, le=100.0
    )
    """Level over the background of the test stand that is compared with; none is no background."""
    absorption_area_m2: float | None = Field(default=None, gt=0.0, le=1e6)
    """Absorption area of that test stand's room; none is an ideal hemi-anechoic room."""

    def contradictions(self) -> Contradictions:
        stated = self.model_fields_set
        unused = "distance_m" if self.arrangement in HEMISPHERES else "radius_m"
        if unused in stated:
            yield (
                f"{unused.removesuffix('_m')}_mm: has no meaning for arrangement = "
                f"{self.arrangement}"
            )
        if self.arrangement == "en12102-box" and self.distance_m != 1.0:
            yield (
                f"distance_mm = {1e3 * self.distance_m:g} mm: is 1000 mm for arrangement = "
                f"{self.arrangement}"
            )


class MapSettings(Parameters):
    """Levels on a plane. Heights count from the floor, x and y from the machine's axis."""

    normal: Literal["x", "y", "z"] = "y"
    """Axis that the plane is perpendicular to."""
    coordinate_m: Coordinate = 0.0
    """Place of the plane on that axis."""
    horizontal_m: tuple[Coordinate, Coordinate] = (-1.5, 1.5)
    """Ends of the map's horizontal side: along x, or along y where the normal is x."""
    vertical_m: tuple[Coordinate, Coordinate] = (0.0, 2.0)
    """Ends of its vertical side: the height, or along y where the normal is z."""
    spacing_m: float = Field(default=0.05, ge=0.005, le=1.0)
    """Largest distance of neighbouring points."""

    def contradictions(self) -> Contradictions:
        for name in ("horizontal_m", "vertical_m"):
            low, high = getattr(self, name)
            if high - low < self.spacing_m:
                yield (
                    f"{name.removesuffix('_m')}_mm = [{1e3 * low:g}, {1e3 * high:g}] mm: must "
                    f"rise by at least spacing_mm = {1e3 * self.spacing_m:g} mm"
                )
        points = (self.sizes[0] + 1) * (self.sizes[1] + 1)
        if points > MAXIMUM_POINTS:
            yield (
                f"spacing_mm = {1e3 * self.spacing_m:g} mm: gives {points} points; allowed up to "
                f"{MAXIMUM_POINTS}"
            )

    @property
    def sizes(self) -> tuple[int, int]:
        """Numbers of intervals (horizontal, vertical) that are no wider than the spacing."""
        spans = (self.horizontal_m, self.vertical_m)
        across, up = (ceil((high - low) / self.spacing_m - 1e-9) for low, high in spans)
        return across, up


class DirectivitySettings(Parameters):
    """Levels on a sphere about the machine; above a floor on the upper half of it."""

    radius_m: float = Field(default=10.0, ge=0.5, le=100.0)
    step_rad: float = Field(default=pi / 18.0, ge=pi / 180.0, le=pi / 4.0)
    """Step of both angles; a quarter turn is a whole number of it."""

    def contradictions(self) -> Contradictions:
        steps = pi / 2.0 / self.step_rad
        if abs(steps - round(steps)) > 1e-6:
            yield f"step_deg = {self.step_rad * 180.0 / pi:g} °: must divide 90 ° evenly"
