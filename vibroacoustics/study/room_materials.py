"""Covers of walls and furniture of a room: absorption by octave, and the package's library."""

import tomllib
from functools import cache
from importlib import resources
from pathlib import Path
from typing import Annotated, Any, Final

from pydantic import BeforeValidator, Field, WithJsonSchema

from ..base.parameters import Parameters

OCTAVES_HZ: Final = (125.0, 250.0, 500.0, 1000.0, 2000.0, 4000.0)
Ratio = Annotated[float, Field(ge=0.0, le=1.0)]


class Covering(Parameters):
    """Random-incidence absorption at the octaves from 125 Hz to 4 kHz."""

    absorption_ratio: tuple[Ratio, Ratio, Ratio, Ratio, Ratio, Ratio]
    name: str = ""
    """Name in the library."""
    source: str = ""


@cache
def library() -> dict[str, Covering]:
    """Materials that the package comes with, by name."""
    package = resources.files(__package__.partition(".")[0])
    packed = package / "shipped"
    folder = packed if packed.is_dir() else Path(str(package)).parent
    text = (folder / "data" / "rooms" / "materials.toml").read_text(encoding="utf-8")
    return {
        name: Covering(
            name=name, absorption_ratio=tuple(table["absorption_ratio"]), source=table["source"]
        )
        for name, table in tomllib.loads(text).items()
    }


def _by_name(value: Any) -> Any:
    """A covering for a name of the library; anything else as it is."""
    if isinstance(value, dict) and isinstance(ratios := value.get("absorption_ratio"), list):
        return {**value, "absorption_ratio": tuple(ratios)}  # strict beyond this function
    if not isinstance(value, str):
        return value
    if value not in library():
        raise ValueError(
            f"{value} is no material of the library; allowed {', '.join(library())}, "
            "or a table with absorption_ratio"
        )
    return library()[value]


_SCHEMA: Final = {
    "anyOf": [
        {"type": "string", "description": "Name in data/rooms/materials.toml"},
        {
            "type": "object",
            "description": "Random-incidence absorption at the octaves from 125 Hz to 4 kHz",
            "properties": {
                "absorption_ratio": {
                    "type": "array",
                    "items": {"type": "number", "minimum": 0.0, "maximum": 1.0},
                    "minItems": 6,
                    "maxItems": 6,
                },
                "source": {"type": "string"},
            },
        },
    ]
}
Material = Annotated[Covering, BeforeValidator(_by_name), WithJsonSchema(_SCHEMA)]
"""Material: in files a name of the library, or a table of absorption by octave."""
