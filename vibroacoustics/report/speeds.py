"""What a section says where it shows some of many speeds."""

import xarray as xr

from .blocks import Text
from .shown_speeds import few_speeds_words


def chosen_speeds(results: xr.Dataset, file: str) -> list[Text]:
    """A note that says how many speeds are shown, and which file holds all; none where all are."""
    words = few_speeds_words(results, file)
    return [Text(words, "note")] if words else []
