"""Readers as things that others can add to; what a third party's does, tests/third_party."""

import re
import shutil

import pytest
from support import ROOT

from vibroacoustics.base.errors import ParameterError, PluginError
from vibroacoustics.base.plugin_file import load_plugin
from vibroacoustics.base.registry import register
from vibroacoustics.recordings import read_recording
from vibroacoustics.recordings.reader import Reader, readers_by_suffix


def nothing(request):
    """Never called."""
    raise NotImplementedError


def test_a_suffix_that_is_taken_is_refused():
    register(Reader("better", (".wav",), "WAV", nothing))
    with pytest.raises(PluginError, match=r"reader better: files .wav are read by wav already"):
        readers_by_suffix()


def test_a_name_that_is_built_in_is_refused():
    with pytest.raises(PluginError, match="reader wav: is built in"):
        register(Reader("wav", (".wave",), "WAV", nothing))


@pytest.mark.parametrize("suffixes", [".mine", (), ("mine",), (".Mine",)])
def test_malformed_suffixes_are_refused(suffixes):
    with pytest.raises(PluginError, match="reader mine: suffix"):
        Reader("mine", suffixes, "mine", nothing)


@pytest.mark.usefixtures("own_process")
def test_a_reader_of_this_session_alone_is_refused(tmp_path):
    register(Reader("mine", (".mine",), "mine", nothing))
    (tmp_path / "a.mine").write_bytes(b"x")
    with pytest.raises(ParameterError, match="put it into a file for load_plugin, or install it"):
        read_recording(tmp_path / "a.mine")


def test_a_reader_from_a_file_reads_in_a_process_of_its_own(tmp_path):
    """Its channel is named after the process: that of this test has labelled arrays."""
    load_plugin(shutil.copy(ROOT / "tests" / "third_party" / "reading_process.py", tmp_path))
    (tmp_path / "ones.process").write_bytes(bytes([1, 1, 1, 1]))
    recording = read_recording(tmp_path / "ones.process")
    assert recording["channel"].values.tolist() == ["process that reads"]


def test_every_format_is_on_its_page():
    page = (ROOT / "docs" / "recordings.md").read_text(encoding="utf-8")
    listed = set(re.findall(r"`(\.\w+)`", "".join(re.findall(r"(?m)^\| `\..*?\|", page))))
    assert listed == set(readers_by_suffix())
