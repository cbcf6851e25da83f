"""Check of this installation: its parts, and whether it can do the main job. No network."""

import os
import platform
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import psutil

from ..base.errors import StorageError, VibroacousticsError
from ..orders import order_spectrum
from ..recordings.reader import READERS, needed
from ..results import cache, hashed, manifest, provenance
from . import outputs


def findings(results: Path | None = None) -> Iterator[str]:
    """One line per finding; of a folder with results too, if one is given."""
    yield f"vibroacoustics {provenance.software_version()} ({provenance.git_revision()})"
    yield f"python {platform.python_version()} on {platform.system()} {platform.machine()}"
    for name, version in provenance.package_versions().items():
        yield f"{name} {version}"
    memory = psutil.virtual_memory()
    yield f"memory: {memory.available / 2**30:.1f} of {memory.total / 2**30:.1f} GiB available"
    yield f"cores: {psutil.cpu_count()}"
    yield f"fft: {_fft()}"
    yield f"k-wave: {_kwave()}"
    yield from (f"recordings: {line}" for line in _recordings())
    yield f"cache: {_cache()}"
    if results is not None:
        yield from _results(results)


def _fft() -> str:
    """Error of the order spectrum of a known tone."""
    angle = 2.0 * np.pi * np.arange(256) / 256
    error = abs(order_spectrum(np.cos(3.0 * angle), 10)[3] - 1.0)
    return f"error of a unit tone {error:.0e}"


def _kwave() -> str:
    """Whether k-Wave's solver loads, without running its package's import-time download."""
    from ..radiation import device, kwave

    try:
        kwave.check_kwave()
    except VibroacousticsError as error:
        return f"not usable: {error}"
    trouble = device.device_trouble()
    return f"solver loads, without a network; {trouble or device.engine_name()}"


def _recordings() -> Iterator[str]:
    """The formats that can be read, and what each other one needs."""
    readable = []
    for reader in READERS.values():
        if provenance.is_missing(reader.package):
            yield f"{reader.words}: {needed(reader, reader.package)}"
        else:
            readable.append(f"{reader.words} ({' '.join(reader.suffixes)})")
    yield f"{', '.join(readable)} can be read"


def _cache() -> str:
    try:
        files, limit = cache.contents()
    except StorageError as error:
        return f"not used: {error}"
    folder, size = cache.folder(), sum(file.size_bytes for file in files)
    return f"{folder}, {len(files)} results, {size / 1e6:.1f} MB of at most {limit / 1e6:g} MB"


def _results(folder: Path) -> Iterator[str]:
    """Whether datasets are whole, and the files beside them are theirs."""
    if not os.path.isdir(folder):  # which raises nothing, whatever the name
        yield f"results: {folder}: is no folder"
        return
    older = outputs.older_files(folder)
    yield from (f"results: {line}" for line in older)
    datasets = sorted(folder.glob("*.nc"))
    if not datasets:
        yield f"results: {folder}: none"
    for path in datasets:
        try:
            hashed.read_checked(path)
        except StorageError as error:
            yield f"results: {error}"
        else:
            yield f"results: {path}: fits its hash"
    if not older:
        yield f"results: {folder}: {len(manifest.listed(folder))} files that belong together"
