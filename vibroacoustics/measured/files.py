"""Files that a file of settings names: errors in them, and their hashes."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

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


def without_bands(results: xr.Dataset, faults: Sequence[str]) -> xr.Dataset:
    """Return results with their accepted faults, whose errors leave no band: its limits are NaN.

    Parameters
    ----------
    results : with limits whose names end in `_low` and `_high`
    faults : a line for each fault that was accepted
    """
    limits = [str(name) for name in results if str(name).endswith(("_low", "_high"))]
    open_bands = {name: results[name].copy() for name in limits if faults}
    for band in open_bands.values():
        band[...] = np.nan
    return results.assign(open_bands).assign_attrs(faults="\n".join(faults))


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
