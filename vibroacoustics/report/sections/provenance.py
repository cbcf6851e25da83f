"""Provenance of the results: software, versions, hashes, time."""

import json
from typing import Any, Final

import xarray as xr

from ...base.registry import register
from ...results.stored_study import parameters
from ..blocks import Block, Text
from ..tables import DataTable, Table, columns_of
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
SHOWN: Final = 8


def _blocks(results: xr.Dataset) -> list[Block]:
    rows = tuple(_rows(results))[:SHOWN]
    table = Table("Provenance", ("Item", "Value"), rows, frozenset({0, 1}))
    return [table, Text("Settings and versions of packages are in provenance.csv.", "note")]


def _data(results: xr.Dataset) -> dict[str, DataTable]:
    return {"provenance.csv": columns_of(("item", "value"), _rows(results))}


def _rows(results: xr.Dataset) -> list[tuple[str, str]]:
    """All that is needed to make the results again."""
    radiation = json.loads(results.attrs.get("radiation") or "{}")
    packages = json.loads(results.attrs.get("package_versions", "{}"))
    rows = {
        "Study file": parameters(results)["source_file"],
        **{label: str(results.attrs.get(key, "")) for key, label in _ATTRIBUTES.items()},
        "Radiation method": _settings(radiation),
        "Radiation settings": _settings(parameters(results)["radiation"]),
        **{f"{name} version": version for name, version in sorted(packages.items())},
    }
    return [(label, text or NOT_STATED) for label, text in rows.items()]


def _settings(settings: dict[str, Any]) -> str:
    return "; ".join(f"{name}: {value}" for name, value in sorted(settings.items()))


register(Section("provenance", "Provenance", _blocks, position=120.0, tables=_data))
