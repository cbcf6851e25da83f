"""Provenance of a result: software, versions, parameters, time."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import asdict
from datetime import UTC, datetime
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from subprocess import SubprocessError
from typing import TYPE_CHECKING, Any, Final

from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.errors import VibroacousticsError
from ..base.plain_bytes import canonical_json, sha256
from ..base.process_start import run_program
from ..base.registry import plugins
from ..recordings.reader import READERS

if TYPE_CHECKING:
    from ..study.order_analysis import OrderAnalysis
    from ..study.study import Study

SCHEMA_VERSION: Final = "3"
RECORDING_SCHEMA_VERSION: Final = "1"
"""Version of the schema of orders of a recording and of compared orders."""
NOT_INSTALLED: Final = "not installed"
PACKAGES: Final = (
    "numpy",
    "scipy",
    "pyfftw",
    "xarray",
    "netCDF4",
    "h5py",
    "k-wave-python",
    "pydantic",
    "pyuff",
)


def attributes(study: "Study") -> dict[str, Any]:
    """Global attributes of a result: everything that is needed to make it again."""
    parameters = canonical_json(study.parameters())
    return {
        **software_attributes(f"run {study.source_file}"),
        "title": study.title,
        "references": "see the sources in the attribute parameters",
        "parameters": parameters,
        "parameters_sha256": sha256(parameters.encode()),
        "random_seed": study.scoring.seed,
    }


def radiation_attributes(
    study: "Study", radiated: Mapping[str, Any], was_cached: bool
) -> dict[str, Any]:
    """Return these attributes, and where the transfer vectors come from."""
    return {
        **attributes(study),
        "reference_pressure_pa": REFERENCE_PRESSURE_PA,
        "transfer_vectors": "from the cache" if was_cached else "computed in this run",
        "radiation": canonical_json(dict(radiated)),
    }


def recording_attributes(recording: Mapping[str, Any], settings: "OrderAnalysis") -> dict[str, Any]:
    """Global attributes of the orders of a recording: its file and the settings."""
    parameters = asdict(settings) | {"orders": [float(order) for order in settings.orders or ()]}
    return {**of_recording(recording, "orders"), "analysis": canonical_json(parameters)}


def of_recording(recording: Mapping[str, Any], what: str) -> dict[str, Any]:
    """Global attributes of what is computed from a recording: `what` in words, lower case."""
    name = recording_name(recording)
    kept = (
        "source_sha256", "part_sha256", "part_start_s", "start_time", "sample_rate_hz",
        "reading_remarks", "speed_file", "speed_file_sha256",
    )  # fmt: skip
    return {
        **software_attributes(f"{what} of {name}", RECORDING_SCHEMA_VERSION),
        "title": f"{what[0].upper()}{what[1:]} of {name}",
        "source_file": name,
        **{key: recording[key] for key in kept if key in recording},
    }


@contextmanager
def naming(recording: Mapping[str, Any]) -> Iterator[None]:
    """Put the file of a recording with these attributes before what goes wrong with it."""
    try:
        yield
    except VibroacousticsError as error:
        raise type(error)(f"{recording_name(recording)}: {error}") from None


def recording_name(recording: Mapping[str, Any]) -> str:
    """File of a recording, or `recording` where it is from none."""
    return str(recording.get("source_file", "recording"))


def software_attributes(command: str, schema_version: str = SCHEMA_VERSION) -> dict[str, Any]:
    """Global attributes of any result: what made it, and when."""
    return {
        "Conventions": "CF-1.11",
        "history": f"{_now()} vibroacoustics {software_version()}: {command}",
        "source": f"vibroacoustics {software_version()}",
        "schema_version": schema_version,
        "software_version": software_version(),
        "git_revision": git_revision(),
        "plugins": canonical_json(plugins()),
        "package_versions": canonical_json(package_versions()),
        "created_utc": _now(),
        "phasor_convention": "x(t) = Re{X exp(+j w t)}, X is a complex peak",
    }


@cache
def software_version() -> str:
    """Version of this package."""
    return version("vibroacoustics")


def package_versions() -> dict[str, str]:
    """Installed versions of the packages that make the numbers, those of readers among them."""
    further = (reader.package for reader in READERS.values() if reader.package)
    return {name: _version(name) for name in (*PACKAGES, *further)}


def is_missing(package: str) -> bool:
    """Whether a package, of a name that is not empty, is not installed."""
    return bool(package) and _version(package) == NOT_INSTALLED


@cache
def git_revision() -> str:
    """Revision of the source tree, or `unknown` where this file is not tracked by one."""
    try:
        _git("ls-files", "--error-unmatch", Path(__file__).name)
        return _git("describe", "--always", "--dirty", "--abbrev=12")
    except (OSError, SubprocessError):
        return "unknown"


def _git(*arguments: str) -> str:
    done = run_program(["git", *arguments], Path(__file__).resolve().parent, timeout_s=5.0)
    done.check_returncode()
    return done.stdout.decode().strip()


@cache
def _version(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return NOT_INSTALLED


def _now() -> str:
    return datetime.now(UTC).strftime("%Y-%m-%dT%H:%M:%SZ")
