"""What every parameter object has in common."""

from pydantic import BaseModel, ConfigDict


class Parameters(BaseModel):
    """A frozen, strictly validated set of parameters in SI units.

    Unknown keys, wrong types, NaN and infinity are refused. Field names carry the SI unit;
    files may use any unit that `vibroacoustics.units` knows, as the suffix of the key.
    """

    model_config = ConfigDict(
        frozen=True, strict=True, extra="forbid", allow_inf_nan=False, validate_default=True
    )
