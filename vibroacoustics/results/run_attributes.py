"""Parameters and words of a run as a report reads them: their keys and JSON types.

Further keys are free: machines, options and sources have their own.
"""

from typing import Annotated, Any, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator

from ..base.vocabulary import LARGEST, LARGEST_LEVEL_DB

Level = Annotated[float, Field(ge=-LARGEST_LEVEL_DB, le=LARGEST_LEVEL_DB)]
Number = Annotated[float, Field(ge=-LARGEST, le=LARGEST)]
Positive = Annotated[float, Field(gt=1.0 / LARGEST, le=LARGEST)]

Vector = Annotated[list[Number], Field(min_length=3, max_length=3)]
ProfilePoint = Annotated[list[Number], Field(min_length=2, max_length=2)]
ProfilePoints = Annotated[list[ProfilePoint], Field(min_length=3)]


class Part(BaseModel):
    """A JSON object with these keys at least."""

    model_config = ConfigDict(strict=True, allow_inf_nan=False)


class SpectralShare(Part):
    below_hz: Number


class Noise(Part):
    level_dba: Level
    speed_rpm: Number
    distance_m: Number
    deviation_db: Number = 2.0
    spectral_share: SpectralShare | None = None


class UnmodelledNoise(Part):
    speed_growth_db: Number | None = None
    flat_lowest_db: Number | None = None
    flat_highest_db: Number | None = None
    near_level_db: Number | None = None
    near_deviation_db: Number | None = None


class Erratum(Part):
    item: str
    printed: str
    finding: str


class RigidBody(Part):
    mass_kg: Positive
    inertia_xx_kg_m2: Positive
    inertia_yy_kg_m2: Positive
    inertia_zz_kg_m2: Positive


class Mounts(Part):
    pitch_m: Number


class Suspension(Part):
    block: RigidBody
    springs: Mounts
    springs_height_m: Number
    height_m: Number


class Shell(Part):
    outer_diameter_m: Positive | None = None
    height_m: Positive | None = None
    dome_height_m: Number
    profile_m: ProfilePoints | None = None
    centre_of_mass_height_m: Number
    floor_clearance_m: Number

    @model_validator(mode="after")
    def _has_a_size(self) -> Self:
        if self.profile_m is None and (self.outer_diameter_m is None or self.height_m is None):
            raise ValueError("must have outer_diameter_m and height_m, or profile_m")
        return self


class Foot(Part):
    x_m: Number
    y_m: Number
    height_m: Number | None = None


class Stopping(Part):
    shift_rad: Number
    shift_duration_s: Number
    gas_share_ratio: Number


class RedesignedMachine(Part):
    suspension: Suspension | None = None


class Machine(RedesignedMachine):
    name: str
    overall_noise: Noise | None = None
    remainder: UnmodelledNoise = UnmodelledNoise()
    errata: list[Erratum]
    housing: RigidBody
    stopping: Stopping | None = None
    shell: Shell | None = None
    mounts: Mounts | None = None
    feet: dict[str, Foot | None] | None = None


class Option(Part):
    kind: str
    machine: RedesignedMachine | None = None


class Position(Part):
    x_m: Number
    y_m: Number
    height_m: Number


class Record(Part):
    field: str
    value: str
    unit: str
    lowest: Number | None
    highest: Number | None
    source: str
    file: str
    example: bool = False


class SampledRange(Part):
    table: str
    field: str
    independent_of: list[str] = []


class HeldRange(Part):
    table: str
    field: str
    reason: str
    lowest: Number
    highest: Number


class PublishedScores(Part):
    source: str


class Measurable(Part):
    level_db: Positive
    force_ratio: Positive
    quietest_line_db: Level
    samples_ratio: Number


class Scoring(Part):
    random_weightings: int
    published: PublishedScores | None = None
    measurable: Measurable | None = None


class PublishedForce(Part):
    part: str
    speed_rpm: Number
    force_1x_n: Number
    deviation_n: Number
    proportional_to: str
    source: str


class MeasuredSpectrum(Part):
    microphone: str
    speed_rpm: Number
    deviation_db: Number


class Evidence(Part):
    forces: list[PublishedForce] = []
    spectrum: MeasuredSpectrum | None = None


class ShellBody(Part):
    kind: Literal["shell", "mesh"]


class BoxBody(Part):
    kind: Literal["box"]
    length_m: Positive
    width_m: Positive
    height_m: Positive


class SphereBody(Part):
    kind: Literal["sphere"]
    diameter_m: Positive


class Wall(Part):
    distance_m: Positive


class Surroundings(Part):
    walls: dict[Literal["-x", "+x", "-y", "+y"], Wall] = {}


class Radiation(Part):
    maximum_frequency_hz: Number | None = None
    body: Annotated[ShellBody | BoxBody | SphereBody, Field(discriminator="kind")] | None = None
    surroundings: Surroundings | str | None = None


class Parameters(Part):
    """Attribute `parameters`."""

    title: str
    source_file: str
    catalogue_receiver: str
    machine: Machine
    options: dict[str, Option]
    receivers: dict[str, Position]
    records: list[Record]
    ranges: list[SampledRange] | None = None
    held_ranges: list[HeldRange] = []
    scoring: Scoring
    radiation: Radiation
    evidence: Evidence = Evidence()


class Words(Part):
    """Attribute `words`."""

    axes: str
    orders: str
    leaves_out: list[str]
    labels: dict[str, str]
    shell_bends: bool
    units: dict[str, str] = {}
    source_figures: list[str]
    priors: dict[str, str] = {}
    sources: dict[str, str]
    sentences: dict[str, list[str]]


class Frame(Part):
    stroke: Vector
    shaft: Vector
    origin_m: Vector


class Plugin(Part):
    file: str


JSON_ATTRIBUTES: dict[str, Any] = {
    "plugins": dict[str, Plugin],
    "package_versions": dict[str, str],
    "radiation": dict[str, Any],
    "crank_frames": dict[str, Frame],
    "left_out": list[str],
}
"""Further attributes, where they are there."""
