"""Where the results come from: software, versions, hashes, time."""

import json
from typing import Any, Final

import xarray as xr

from ...base.registry import register
from ...results.stored_study import parameters
from ..blocks import Block
from ..tables import Table
from . import Section

_ATTRIBUTES: Final = {
    "created_utc": "Results computed (UTC)",
    "software_version": "vibroacoustics version",
    "git_revision": "git revision",
    "schema_version": "Schema version",
    "parameters_sha256": "SHA-256 of the parameters",
    "random_seed": "Random seed",
    "transfer_vectors": "Transfer vectors",
    "phasor_convention": "Phasor convention",
}

NOT_STATED: Final = "not stated"


def _blocks(results: xr.Dataset) -> list[Block]:
    """Everything that is needed to make the results again."""
    rows = [("Study file", parameters(results)["source_file"] or NOT_STATED)]
    rows += [
        (label, str(results.attrs.get(key, "")) or NOT_STATED) for key, label in _ATTRIBUTES.items()
    ]
    radiation = json.loads(results.attrs.get("radiation") or "{}")
    rows += [("Radiation method", _settings(radiation) or NOT_STATED)]
    rows += [("Radiation settings", _settings(parameters(results)["radiation"]))]
    rows += [(f"{name} version", version) for name, version in sorted(_packages(results).items())]
    return [Table("Provenance", ("Item", "Value"), tuple(rows), frozenset({0, 1}))]


def _packages(results: xr.Dataset) -> dict[str, str]:
    return dict(json.loads(results.attrs.get("package_versions", "{}")))


def _settings(settings: dict[str, Any]) -> str:
    return "; ".join(f"{name}: {value}" for name, value in sorted(settings.items()))


register(Section("provenance", "Provenance", _blocks, position=120.0))
