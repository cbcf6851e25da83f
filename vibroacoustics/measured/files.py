"""Files that a file of settings names: errors in them, and their hashes."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from ..base.errors import VibroacousticsError
from ..base.parameters import Parameters
from ..base.plain_bytes import canonical_json, sha256
from ..results.provenance import software_attributes
from .settings import Measured


@contextmanager
def naming_settings(path: Path) -> Iterator[None]:
    """Put the file of settings before an error that names no file beside it."""
    try:
        yield
    except VibroacousticsError as error:
        folder, lines = str(path.parent), map(str, error.args)
        named = (line if line.startswith(folder) else f"{path}: {line}" for line in lines)
        raise type(error)(*named) from None


def attributes(
    command: str, path: Path, title: str, settings: Parameters, measured: Measured
) -> dict[str, Any]:
    """Return the provenance of a result of measured functions: settings, hashes of files,
    software."""
    parameters = canonical_json(settings.model_dump(mode="json"))
    named = (*measured.frequency_responses, *measured.operating)
    files = {name: sha256((path.parent / name).read_bytes()) for name in named}
    return {
        **software_attributes(f"{command} {path.name}"),
        "title": title,
        "parameters": parameters,
        "parameters_sha256": sha256(parameters.encode()),
        "measured_files": canonical_json(files),
        "draws": measured.draws,
    }
