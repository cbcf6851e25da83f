"""Content of a data sheet, and the JSON schema of its file. Lengths and levels in SI and dB."""

from typing import Annotated, Any, Final, Literal

from pydantic import BaseModel, ConfigDict, Field

STATEMENT: Final = "predicted, not measured"
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
    """All modelled sources; null outside the model and where no source sounds."""
    modelled_below_db: Level
    """Upper limit in a band of the model in which no source sounds; else null."""
    unmodelled_db: Level
    """Unmodelled noise, or what the model does not explain of the baseline."""
    total_db: Level
    """The machine."""


class SoundPower(_Part):
    """Sound power from the levels at the study's microphones."""

    microphones: tuple[str, ...]
    surface_m2: float
    """Mean over the microphones of the hemisphere or sphere through each."""
    determined: str
    """Method in words."""
    level_dba: Level
    """L_WA of the machine: median of the weighted samples; nominal without samples."""
    modelled_dba: Level
    """L_WA of the modelled sources, the median likewise."""
    nominal_dba: Level
    """L_WA with the nominal values."""
    uncertainty_k_db: Level
    """K_WA of ISO 4871; null without samples, or where these do not differ."""
    model_spread_db: Level
    """Part of the model: 95 % quantile of the weighted samples less L_WA; null as K_WA."""
    measurement_deviation_db: float
    """Standard deviation of a measurement by ISO 3744, grade 2, that K_WA holds."""
    batch_deviation_db: float | None
    """Assumed standard deviation of the machines of a batch; null for a single machine."""
    uncertainty_words: str
    """Parts of K_WA."""
    prior: str
    """Prior of the unmodelled noise."""
    model_range_hz: tuple[float, float]
    """Lowest and highest frequency of the model; it covers the last band in part."""
    unmodelled_kind: Literal["baseline", "unmodelled noise", "none"]
    unmodelled_words: str
    """Part of the machine's level besides the model."""
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
    """A prominent tone (ECMA-418-1), at the microphone with the largest excess."""

    name: str
    frequency_hz: float
    microphone: str
    level_db: float
    """Sound pressure level there, re 20 µPa."""
    excess_db: float
    """Excess over the criterion of tone-to-noise or prominence ratio; median of the weighted
    samples."""
    excess_low_db: Level
    """Lower end of its 80 % interval; null where the tone is not audible there."""
    excess_high_db: float
    """Upper end of its 80 % interval."""
    probability: float
    """Share of the weighted samples in which the tone is audible and prominent; over 0.5."""


class RatedWindow(_Part):
    """Rating level at a window of the study."""

    window: str
    rating_level_dba: float
    rating_level_low_dba: float
    """Lower end of the 80 % interval."""
    rating_level_high_dba: float
    """Upper end of the 80 % interval."""
    adjustment_db: float
    """Adjustment for tones, median."""
    limit_dba: float
    limit_probability: float
    """Share of the weighted samples that meet the limit."""


class Vibration(_Part):
    """Motion of a point of the housing in one direction, all orders together."""

    point: str
    direction: Literal["x", "y", "z"]
    displacement_peak_to_peak_m: float
    velocity_rms_m_per_s: float
    acceleration_rms_m_per_s2: float


class DataSheet(_Part):
    """Prediction for an option at an operating point, in the form of a maker's data sheet.

    Examples
    --------
    >>> results = va.open_results("results.nc")
    >>> sheet = va.data_sheet(results, "none")
    >>> sheet.statement
    'predicted, not measured'
    >>> [band.band_hz for band in sheet.sound_power.bands][:3]
    [100.0, 125.0, 160.0]
    """

    schema_version: Literal["2"] = "2"
    statement: Literal["predicted, not measured"] = STATEMENT
    example: str = ""
    """Number of values that are still those of a template; empty where none is."""
    title: str
    machine: str
    option: str
    speed_rpm: float
    operating: tuple[Fact, ...]
    mounting: tuple[Fact, ...]
    sound_power: SoundPower
    tones: tuple[Tone, ...]
    """Prominent ones at any microphone, rising in frequency."""
    any_tone_probability: float
    """Share of the weighted samples with some prominent tone, at the microphone with the most."""
    tones_not_judged: int
    """Audible tones in whose critical band there is no noise at any microphone."""
    audibility_db: float
    """Largest decisive audibility of the tones at any microphone (ISO/PAS 20065), -10 to 60."""
    tonal_adjustment_db: float
    """Adjustment for it (ISO 1996-2, table J.1)."""
    windows: tuple[RatedWindow, ...] = ()
    """Rating levels at the windows of the study."""
    vibration: tuple[Vibration, ...]
    vibration_words: str
    """Content of the motion."""
    leaves_out: tuple[str, ...]
    """Effects that the model neglects."""
    not_available: tuple[str, ...]
    """Values that a declaration by ISO 4871 states and a prediction does not have."""
    created_utc: str
    """Time at which the results were made."""
    software_version: str
    parameters_sha256: str
    """Hash of all values of the study."""


def data_sheet_schema() -> dict[str, Any]:
    """Return the schema of the JSON file of a data sheet, draft 2020-12."""
    made = DataSheet.model_json_schema(mode="serialization")
    title = {"title": "Data sheet of vibroacoustics (predicted)"}
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **made, **title}
