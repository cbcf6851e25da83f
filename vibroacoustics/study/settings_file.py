"""Files of settings of the commands for measured functions, recordings and runs."""

from pathlib import Path
from typing import Any

from .reader import Reader
from .toml_files import leaves
from .wording import Model, validated


def settings_of(model: type[Model], path: Path, content: dict[str, Any]) -> Model:
    """Validate the content of a file of settings; refusals name the file and its own keys.

    Parameters
    ----------
    model : class of the settings
    path : file that gives the content
    content : content in the file's units
    """
    reader = Reader(path, dict.fromkeys(leaves(content), path))
    return validated(model, reader.to_si(content, ()), reader)
