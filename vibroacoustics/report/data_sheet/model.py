"""What a data sheet holds, and the JSON schema of its file. Lengths and levels in SI and dB."""

from typing import Annotated, Any, Final, Literal

from pydantic import BaseModel, ConfigDict, Field

STATEMENT: Final = "predicted, not measured"
SCHEMA_VERSION: Final = "1"
Level = Annotated[float | None, Field(description="dB; null where there is none, never zero")]


class _Part(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


class Fact(_Part):
    """A value of the operating point or of the mounting."""

    name: str
    value: float | str
    unit: str = ""


class BandPower(_Part):
    """Sound power in a third of an octave, no weighting, re 1 pW."""

    band_hz: float
    modelled_db: Level
    """Of all modelled sources; null outside the model and where none sounds."""
    rest_db: Level
    """Of the baseline or the remainder beside the model."""
    total_db: Level
    """Of both."""


class SoundPower(_Part):
    """Sound power from the levels at the study's microphones."""

    microphones: tuple[str, ...]
    surface_m2: float
    """Mean over the microphones of the hemisphere or sphere through each."""
    determined: str
    """How, in words."""
    level_dba: Level
    """L_WA of model and rest: median of the weighted samples; nominal without samples."""
    modelled_dba: Level
    """L_WA of the model alone, the median likewise."""
    nominal_dba: Level
    """L_WA of the nominal values, from which the bands are."""
    uncertainty_k_db: Level
    """K of ISO 4871; null without samples, or where these do not differ."""
    uncertainty_words: str
    """Where K comes from."""
    model_range_hz: tuple[float, float]
    """Lowest and highest frequency of the bands that the model fills."""
    rest: Literal["baseline", "remainder", "none"]
    rest_words: str
    """What stands beside the model."""
    bands: tuple[BandPower, ...]

    @property
    def declared(self) -> tuple[int, int] | None:
        """L_WA and K in whole decibels whose sum is not below that of the exact ones (ISO 4871).

        K is at least 1 dB.
        """
        if self.level_dba is None or self.uncertainty_k_db is None:
            return None
        level = round(self.level_dba)
        limit = self.level_dba + self.uncertainty_k_db
        return level, max(-int(-limit // 1) - level, 1)


class Tone(_Part):
    """A prominent tone (ECMA-418-1), at the microphone at which it stands out most."""

    name: str
    frequency_hz: float
    microphone: str
    level_db: float
    """Sound pressure level there, re 20 µPa."""
    tone_to_noise_db: float
    prominence_db: Level
    """Prominence ratio; null without sound in the neighbouring bands."""


class Vibration(_Part):
    """Motion of a point of the housing in one direction, all orders together."""

    point: str
    direction: Literal["x", "y", "z"]
    displacement_peak_to_peak_m: float
    velocity_rms_m_per_s: float
    acceleration_rms_m_per_s2: float


class DataSheet(_Part):
    """What is predicted of an option at an operating point, as a maker's data sheet states it.

    Examples
    --------
    >>> results = va.open_results("results.nc")
    >>> sheet = va.data_sheet(results, "none")
    >>> sheet.statement
    'predicted, not measured'
    >>> [band.band_hz for band in sheet.sound_power.bands][:3]
    [100.0, 125.0, 160.0]
    """

    schema_version: Literal["1"] = "1"
    statement: Literal["predicted, not measured"] = STATEMENT
    title: str
    machine: str
    option: str
    speed_rpm: float
    operating: tuple[Fact, ...]
    mounting: tuple[Fact, ...]
    sound_power: SoundPower
    tones: tuple[Tone, ...]
    """Prominent ones at any microphone, rising in frequency."""
    tones_not_judged: int
    """Audible tones in whose critical band there is no noise at any microphone."""
    vibration: tuple[Vibration, ...]
    vibration_words: str
    """What the motion holds."""
    leaves_out: tuple[str, ...]
    """What the model leaves out, in its own words."""
    created_utc: str
    """When the results were made."""
    software_version: str
    parameters_sha256: str
    """Of all values of the study."""


def data_sheet_schema() -> dict[str, Any]:
    """Of the JSON file of a data sheet, draft 2020-12."""
    made = DataSheet.model_json_schema(mode="serialization")
    title = {"title": "Data sheet of vibroacoustics (predicted)"}
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **made, **title}
