"""Modes of a structure from universal files: what was written comes back, the rest is refused."""

import numpy as np
import pytest
import pyuff

from vibroacoustics.base.errors import ParameterError, StorageError
from vibroacoustics.recordings import read_modes
from vibroacoustics.transfer.shell_modes.sampled import SampledMode

RNG = np.random.default_rng(55)
NUMBERS = np.array([3, 7, 8, 21, 40])
NODES = np.round(RNG.uniform(-0.2, 0.2, (5, 3)), 6)
SHAPES = RNG.standard_normal((2, 5, 3))
FREQUENCIES = [835.4, 1030.75]
MASSES = [1.715, 1.471]
SIX_DIGITS = 5e-6
"""E13.5: half of the last digit, relative."""


def mode_set(number, **changes):
    values = {
        "model_type": 1,
        "id1": "shell",
        "analysis_type": 2,
        "data_ch": 2,
        "spec_data_type": 8,
        "data_type": 2,
        "n_data_per_node": 3,
        "load_case": 1,
        "mode_n": number + 1,
        "freq": FREQUENCIES[number],
        "modal_m": MASSES[number],
        "modal_damp_vis": 0.005,
        "modal_damp_his": 0.0,
        "node_nums": NUMBERS,
    } | {f"r{axis + 1}": SHAPES[number, :, axis] for axis in range(3)}
    return pyuff.prepare_55(**(values | changes))


def node_set(kind=15, numbers=NUMBERS, system=0):
    count = len(numbers)
    parts = {"node_nums": numbers, "x": NODES[:count, 0], "y": NODES[:count, 1],
             "z": NODES[:count, 2], "def_cs": np.zeros(count, int), "color": np.ones(count, int),
             "disp_cs": np.full(count, 0) + system * (np.arange(count) == 1)}  # fmt: skip
    return (pyuff.prepare_15 if kind == 15 else pyuff.prepare_2411)(**parts)


def unit_set(length, force):
    return pyuff.prepare_164(
        units_code=9, units_description="own", temp_mode=1, length=length, force=force,
        temp=1.0, temp_offset=273.15,
    )  # fmt: skip


def write(folder, *sets):
    path = folder / "modes.uff"
    pyuff.UFF(str(path)).write_sets(list(sets), "overwrite")
    return path


@pytest.mark.parametrize("kind", [15, 2411])
def test_round_trip(tmp_path, kind):
    path = write(tmp_path, node_set(kind), mode_set(0), mode_set(1))
    found = read_modes(path, file_unit_m=1e-3)
    assert found.frequency_hz == pytest.approx(FREQUENCIES, rel=SIX_DIGITS)
    assert found.modal_mass_kg == pytest.approx(MASSES, rel=SIX_DIGITS)
    assert found.viscous_damping_ratio.tolist() == [0.005, 0.005]
    np.testing.assert_allclose(found.nodes_m, 1e-3 * NODES, rtol=SIX_DIGITS)
    np.testing.assert_allclose(found.shape, SHAPES, rtol=SIX_DIGITS)
    assert len(found.source_sha256) == 64


def test_units_of_the_file(tmp_path):
    """Dataset 164 states units per SI unit: mm and N, hence tonnes."""
    found = read_modes(write(tmp_path, unit_set(1e3, 1.0), node_set(), mode_set(0)))
    np.testing.assert_allclose(found.nodes_m, 1e-3 * NODES, rtol=SIX_DIGITS)
    assert found.modal_mass_kg == pytest.approx([1e3 * MASSES[0]], rel=SIX_DIGITS)


def test_nodes_are_found_by_their_numbers(tmp_path):
    turned = node_set() | {"node_nums": NUMBERS[::-1]}
    found = read_modes(write(tmp_path, turned, mode_set(0)), file_unit_m=1.0)
    np.testing.assert_allclose(found.nodes_m, NODES[::-1], rtol=SIX_DIGITS)


def test_measured_mode_moves_its_nodes(tmp_path):
    found = read_modes(write(tmp_path, node_set(), mode_set(0)), file_unit_m=1.0)
    mode = SampledMode(
        "measured", found.frequency_hz[0], found.modal_mass_kg[0], found.nodes_m, found.shape[0]
    )
    np.testing.assert_allclose(mode.velocity(found.nodes_m), found.shape[0], atol=1e-9)


@pytest.mark.parametrize(
    ("sets", "unit", "words"),
    [
        ([node_set()], 1.0, "holds no normal mode"),
        ([mode_set(0)], 1.0, "states no place of node 3 and 4 more"),
        ([node_set(numbers=NUMBERS[:4]), mode_set(0)], 1.0, "no place of node 40 and 0 more"),
        ([node_set(), mode_set(0)], None, r"states no unit of length \(dataset 164\)"),
        ([unit_set(1.0, 1.0), node_set(), mode_set(0)], 1.0, "the file states its unit"),
        ([node_set(), mode_set(0, modal_m=0.0)], 1.0, "mode 1: modal mass 0: must be above zero"),
        ([node_set(), mode_set(0, freq=-3.0)], 1.0, "mode 1: frequency -3"),
        ([node_set(), mode_set(0, spec_data_type=12)], 1.0, "specific data type 12"),
        ([node_set(), mode_set(0, r1=SHAPES[0, :, 0] + 1j)], 1.0, "mode 1: is complex"),
        ([node_set(), mode_set(0, r1=np.full(5, np.nan))], 1.0, "not finite"),
        ([node_set(), mode_set(0), mode_set(1, node_nums=NUMBERS[::-1])], 1.0, "mode 2: has other"),
        ([node_set(system=4), mode_set(0)], 1.0, "several coordinate systems"),
    ],
)
def test_unusable_files(tmp_path, sets, unit, words):
    with pytest.raises(ParameterError, match=words):
        read_modes(write(tmp_path, *sets), file_unit_m=unit)


def test_files_that_are_none(tmp_path):
    with pytest.raises(StorageError, match="no such file"):
        read_modes(tmp_path / "a.uff")
    with pytest.raises(ParameterError, match=r"format '\.csv' is unknown; known are \.uff, \.unv"):
        read_modes(tmp_path / "a.csv")


def test_damaged_files_are_refused_or_read_in_full(tmp_path):
    """Cut anywhere: an error of ours, or all nodes of whole modes."""
    path = write(tmp_path, node_set(), mode_set(0), mode_set(1))
    content = path.read_bytes()
    for cut in range(100, len(content), len(content) // 6):
        path.write_bytes(content[:cut])
        try:
            found = read_modes(path, file_unit_m=1.0)
        except (ParameterError, StorageError):
            continue
        assert 1 <= len(found.shape) < 3
        np.testing.assert_allclose(found.shape, SHAPES[: len(found.shape)], rtol=SIX_DIGITS)
