"""Only regular files of a limited size are read."""

import os
from pathlib import Path

import pytest

from vibroacoustics.base.errors import ParameterError, PluginError, StorageError
from vibroacoustics.base.plugin_file import load_plugin
from vibroacoustics.base.regular_file import read_bytes, read_text
from vibroacoustics.radiation.bodies import read_mesh
from vibroacoustics.radiation.scene import _read_velocities
from vibroacoustics.results.hashed import read_checked, stored_hash
from vibroacoustics.results.limits_file import read_limits
from vibroacoustics.study.evidence_files import read_published_table
from vibroacoustics.study.toml_files import read_toml

READERS = {
    "study": (read_toml, ParameterError),
    "scores": (read_published_table, ParameterError),
    "limits": (read_limits, ParameterError),
    "results": (read_checked, StorageError),
    "plugin": (load_plugin, PluginError),
    "mesh": (lambda path: read_mesh(path, 1.0), ParameterError),
    "pattern": (lambda path: _read_velocities("a", path), ParameterError),
}


@pytest.fixture
def pipe(tmp_path) -> Path:
    """A pipe that nobody writes to."""
    path = tmp_path / "pipe.py"
    os.mkfifo(path)
    return path


@pytest.mark.parametrize("name", READERS)
def test_pipe_is_refused(pipe, name):
    read, refusal = READERS[name]
    with pytest.raises(refusal, match="regular file"):
        read(pipe)


@pytest.mark.parametrize("name", READERS)
def test_device_is_refused(name):
    read, refusal = READERS[name]
    with pytest.raises(refusal, match=r"/dev/zero: .*regular file"):
        read(Path("/dev/zero"))


def test_hash_of_a_pipe(pipe):
    assert stored_hash(pipe) is None


def test_cap(tmp_path):
    path = tmp_path / "file"
    path.write_bytes(b"12345")
    assert read_bytes(path, 5) == b"12345"
    with pytest.raises(OSError, match="larger than 4 bytes"):
        read_bytes(path, 4)


def test_byte_order_mark(tmp_path):
    path = tmp_path / "file"
    path.write_text("a = 1", encoding="utf-8-sig")
    assert read_text(path, 100) == "a = 1"
    assert read_toml(path) == {"a": 1}
