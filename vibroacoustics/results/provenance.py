"""Where a result comes from: software, versions, parameters, time."""

import subprocess
from dataclasses import asdict
from datetime import UTC, datetime
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any, Final

import xarray as xr

from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.hashing import canonical_json, sha256
from ..base.registry import plugins
from ..recordings.reader import READERS
