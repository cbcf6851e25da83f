"""All that a file lacks is asked for at once; channels get other names; unreadable formats."""

import numpy as np
import pytest
import scipy.io
from scipy.io import wavfile
from support import assert_refused, command_here
from trade_files import SIGNALS, xlsx

from vibroacoustics.base.errors import ParameterError, StorageError
from vibroacoustics.recordings import open_recording, read_recording
from vibroacoustics.recordings.asked import ADVICE
from vibroacoustics.recordings.reader import readers_by_suffix


def plain_mat(path):
    scipy.io.savemat(path, {"front": SIGNALS[0], "rear": SIGNALS[1]})
    return path


@pytest.mark.parametrize("read", [read_recording, open_recording])
def test_rate_and_units_in_one_message(tmp_path, read):
    with pytest.raises(ParameterError) as caught:
        read(plain_mat(tmp_path / "a.mat"))
    message = str(caught.value)
    assert "give sample_rate_hz, or save" in message
    assert "states no unit for 'front', 'rear'" in message
    assert len(message.splitlines()) == 1
    table = tmp_path / "a.csv"
    table.write_text("front,rear [Pa]\n1,2\n3,4\n")
    with pytest.raises(ParameterError, match=r"give sample_rate_hz; .*no unit for 'front'"):
        read(table)
    with pytest.raises(ParameterError, match=r"'time \[s\]': add one or give sample_rate_hz$"):
        read(xlsx(tmp_path / "a.xlsx", ""))


def test_unit_and_calibration_in_one_message(tmp_path):
    wavfile.write(tmp_path / "a.wav", 1000, np.zeros((100, 2), dtype=np.int16))
    with pytest.raises(ParameterError, match=r"calibration.* the file states no unit for"):
        read_recording(tmp_path / "a.wav")


@pytest.mark.parametrize("command", [("orders",), ("map",), ("track", "--bandwidth", 3)])
def test_rate_unit_and_speed_in_one_message(tmp_path, command):
    name, *options = command
    done = command_here(name, plain_mat(tmp_path / "a.mat"), *options)
    assert_refused(done, "give --sample-rate", '--unit "front=Pa"')
    assert_refused(done, "speed: give one of --speed-channel")
    assert_refused(command_here(name, tmp_path / "absent.mat", *options), "speed: give one of")


def test_new_names(tmp_path):
    file = xlsx(tmp_path / "a.xlsx")
    names = {"foot": "motor foot", "microphone": "foot"}
    read = read_recording(file, names=names)
    assert read["channel"].values.tolist() == ["foot", "motor foot"]
    assert read["channel_unit"].values.tolist() == ["Pa", "m/s²"]
    blocks = open_recording(file, names=names, calibration={"foot": 2.0})
    assert list(blocks.channels) == ["foot", "motor foot"]
    np.testing.assert_allclose(blocks.read(["motor foot"], 3, 9)[0], 2.0 * SIGNALS[1, 3:9])
    part = read_recording(file, names={"foot": "x"}, channels=["foot"])
    assert part["channel"].values.tolist() == ["x"]
    for wrong, words in [
        ({"none": "x"}, "names: no channel 'none' among 'microphone', 'foot'"),
        ({"foot": "microphone"}, "names: 'microphone': must be unique"),
        ({"foot": ""}, "names: '': must be unique, not empty"),
    ]:
        for open_file in (read_recording, open_recording):
            with pytest.raises(ParameterError, match=words):
                open_file(file, names=wrong)


def test_formats_that_cannot_be_read_say_what_to_export(tmp_path):
    assert not ADVICE.keys() & readers_by_suffix().keys()
    for suffix, words in ADVICE.items():
        (tmp_path / f"a{suffix}").write_bytes(b"x")
        with pytest.raises(ParameterError) as caught:
            read_recording(tmp_path / f"a{suffix}")
        assert words in str(caught.value)
    with pytest.raises(ParameterError, match=r"'.hdf' is unknown \(ArtemiS .* export UFF"):
        read_recording(tmp_path / "a.hdf")


def test_mdf_without_its_package_says_what_to_install(tmp_path, monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "asammdf", None)
    (tmp_path / "a.mf4").write_bytes(b"MDF     4.10    ")
    with pytest.raises(StorageError, match=r"needs asammdf: pip install vibroacoustics\[mdf\]"):
        read_recording(tmp_path / "a.mf4")
