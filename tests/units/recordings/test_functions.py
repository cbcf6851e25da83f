"""Functions between nodes: UFF 58 and 58b, CSV, units, nodes and directions."""

from contextlib import suppress
from dataclasses import replace

import numpy as np
import pytest
import pyuff

import vibroacoustics as va
from vibroacoustics.recordings.remarks import RecordingWarning

FREQUENCY = 2.5 * np.arange(1, 42)
RNG = np.random.default_rng(5)
VALUES = 10.0 ** RNG.uniform(-9, 3, 41) * np.exp(2j * np.pi * RNG.random(41))
ONE = va.MeasuredFunction(
    "frequency response", FREQUENCY, VALUES, va.Node(11, "-z"), va.Node(3, "+x"), "m/s²", "N"
)
COHERENCE = va.MeasuredFunction(
    "coherence", FREQUENCY, np.full(41, 0.75 + 0j), ONE.response, ONE.reference, "1"
)
OTHERS = [
    va.MeasuredFunction("spectrum", FREQUENCY, VALUES, va.Node(101), None, "Pa"),
    va.MeasuredFunction(
        "auto spectrum", FREQUENCY, abs(VALUES) + 0j, va.Node(3, "+ry"), va.Node(3, "+ry"),
        "N", "N",
    ),
    va.MeasuredFunction(
        "auto spectrum", FREQUENCY, abs(VALUES) + 0j, va.Node(4, "+x"), va.Node(4, "+x"),
        "m/s²", "m/s²",
    ),
    va.MeasuredFunction(
        "cross spectrum", FREQUENCY, VALUES, va.Node(101), va.Node(3, "+x"), "Pa", "m/s"
    ),
]  # fmt: skip
FORMS = {"58b": {}, "58": {"text": True}}


def same(first, second, share):
    assert (first.kind, first.response, first.reference) == (
        second.kind, second.response, second.reference,
    )  # fmt: skip
    assert (first.response_unit, first.reference_unit) == (
        second.response_unit, second.reference_unit,
    )  # fmt: skip
    np.testing.assert_allclose(first.values, second.values, rtol=share, atol=0.0)
    np.testing.assert_allclose(first.frequency_hz, second.frequency_hz, rtol=1e-5)


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize(("single", "share"), [(False, 1e-12), (True, 1e-5)])
@pytest.mark.parametrize("uneven", [False, True])
def test_a_universal_file_gives_back_what_was_written(tmp_path, form, single, share, uneven):
    frequency = FREQUENCY**1.1 if uneven else FREQUENCY
    written = [replace(each, frequency_hz=frequency) for each in (ONE, COHERENCE, *OTHERS)]
    file = va.export_functions(written, tmp_path / "a.uff", single=single, **FORMS[form])
    for first, second in zip(written, va.read_functions(file), strict=True):
        same(first, second, share)


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize(("single", "share"), [(False, 1e-12), (True, 1e-5)])
@pytest.mark.parametrize("power", [1.0, 1.1])
def test_pyuff_reads_what_is_written(tmp_path, form, single, share, power):
    written = [replace(each, frequency_hz=FREQUENCY**power) for each in (ONE, COHERENCE)]
    file = va.export_functions(written, tmp_path / "a.uff", single=single, **FORMS[form])
    first, second = pyuff.UFF(str(file)).read_sets()
    np.testing.assert_allclose(first["data"], VALUES, rtol=share)
    np.testing.assert_allclose(first["x"], FREQUENCY**power, rtol=1e-5)
    assert (first["func_type"], second["func_type"]) == (4, 6)
    assert (first["rsp_node"], first["rsp_dir"], first["ref_node"], first["ref_dir"]) == (
        11, -3, 3, 1,
    )  # fmt: skip
    assert first["ordinate_axis_units_lab"].strip() == "m/s^2"
    assert first["orddenom_spec_data_type"] == 13


@pytest.mark.parametrize(
    ("binary", "single", "share"),
    [(1, False, 1e-12), (0, False, 5e-12), (0, True, 1e-5)],  # it writes 58 with twelve digits
)
@pytest.mark.parametrize("ends", ["", "\r"])
@pytest.mark.parametrize("even", [0, 1])
def test_what_pyuff_writes_is_read(tmp_path, binary, single, share, ends, even):
    file = by_pyuff(
        tmp_path, double=not single, binary=binary, abscissa_spacing=even,
        ord_data_type=5 if single else 6,
    )  # fmt: skip
    if not binary:
        lines = file.read_bytes().decode().splitlines()
        short = (line if line.strip() == "-1" else line.rstrip() for line in lines)
        file.write_bytes("".join(f"{line}{ends}\n" for line in short).encode())
    same(va.read_functions(file)[0], ONE, share)


def by_pyuff(folder, double=True, **other):
    file = folder / "b.unv"
    fields = {
        "binary": 0, "func_type": 4, "rsp_node": 11, "rsp_dir": -3, "ref_node": 3, "ref_dir": 1,
        "data": VALUES, "x": FREQUENCY, "id1": "hammer", "abscissa_spec_data_type": 18,
        "ordinate_spec_data_type": 12, "ordinate_axis_units_lab": "m/s^2",
        "orddenom_spec_data_type": 13, "orddenom_axis_units_lab": "N", "ord_data_type": 6,
        "abscissa_spacing": 1, "abscissa_min": FREQUENCY[0], "abscissa_inc": 2.5,
    }  # fmt: skip
    if file.exists():
        file.unlink()
    pyuff.UFF(str(file)).write_sets(
        [pyuff.prepare_58(**fields) | other], "add", force_double=double
    )
    return file


@pytest.mark.parametrize(
    ("other", "words"),
    [
        ({"ordinate_axis_units_lab": "bananas"}, "11-z/3+x: unit 'bananas' is unknown"),
        ({"ordinate_axis_units_lab": "m/s"}, "unit m/s is of velocity, the file says acceleration"),
        ({"ordinate_axis_units_lab": "NONE"}, "states acceleration (type 12) and no unit"),
        ({"orddenom_axis_units_lab": "V", "orddenom_spec_data_type": 0}, "is of voltage; allowed"),
        ({"rsp_dir": 9}, "response: direction 9: must be from -6 to 6"),
        ({"rsp_node": -1}, "node -1: must be 0 or above"),
        ({"abscissa_spec_data_type": 17}, "abscissa of type 17"),
        ({"func_type": 1}, "holds no function of type"),
    ],
)
def test_what_is_wrong_in_a_universal_file_is_one_line(tmp_path, other, words):
    file = by_pyuff(tmp_path, binary=1, **other)
    with pytest.raises(va.VibroacousticsError) as told:
        va.read_functions(file)
    assert words in str(told.value)
    assert str(file) in str(told.value)
    assert "\n" not in str(told.value)


@pytest.mark.parametrize(
    ("unit", "factor"), [("Pa²", 1.0), ("(mm/s)^2", 1e-6), ("Pa*mPa", 1e-3), ("m/s²*m/s²", 1.0)]
)
def test_units_of_mean_squares(tmp_path, unit, factor):
    (tmp_path / "a.csv").write_text(f"frequency [Hz],5 real [{unit}]\n10,1\n20,2\n")
    (read,) = va.read_functions(tmp_path / "a.csv")
    assert read.kind == "auto spectrum"
    np.testing.assert_allclose(read.values, np.array([1.0, 2.0]) * factor, rtol=1e-14)


def test_unit_of_an_auto_spectrum_counts_squared(tmp_path):
    """A universal file states the unit of the quantity: 1 of mm/s is 1e-6 m²/s²."""
    file = by_pyuff(
        tmp_path, func_type=2, data=abs(VALUES) + 0j, ordinate_spec_data_type=11,
        ordinate_axis_units_lab="mm/s",
    )  # fmt: skip
    (read,) = va.read_functions(file)
    assert (read.kind, read.response_unit, read.reference_unit) == ("auto spectrum", "m/s", "m/s")
    np.testing.assert_allclose(read.values, 1e-6 * abs(VALUES), rtol=1e-10)


def test_a_missing_unit_is_given_by_quantity(tmp_path):
    file = by_pyuff(tmp_path, binary=1, ordinate_axis_units_lab="NONE")
    (read,) = va.read_functions(file, units={"acceleration": "g"})
    np.testing.assert_allclose(read.values, 9.80665 * VALUES, rtol=1e-12)
    with pytest.raises(va.ParameterError, match="acceleration = 'mm': is no quantity with"):
        va.read_functions(file, units={"acceleration": "mm"})


def test_a_ratio_in_one_label_and_other_units(tmp_path):
    file = by_pyuff(
        tmp_path, binary=1, ordinate_axis_units_lab="(mm/s)/kN", ordinate_spec_data_type=11,
        orddenom_axis_units_lab="NONE", orddenom_spec_data_type=0,
    )  # fmt: skip
    (read,) = va.read_functions(file)
    assert (read.response_unit, read.reference_unit) == ("m/s", "N")
    np.testing.assert_allclose(read.values, 1e-6 * VALUES, rtol=1e-12)


def test_a_truncated_file_is_one_line(tmp_path):
    content = by_pyuff(tmp_path, binary=1).read_bytes()
    (tmp_path / "c.uff").write_bytes(content[:-300])
    with pytest.raises(va.StorageError, match=r"truncated|fewer"):
        va.read_functions(tmp_path / "c.uff")


def test_a_table_gives_back_what_was_written(tmp_path):
    file = va.export_functions([ONE, COHERENCE, *OTHERS], tmp_path / "a.csv")
    for first, second in zip([ONE, COHERENCE, *OTHERS], va.read_functions(file), strict=True):
        same(first, second, 1e-15)


def test_amplitude_and_phase_with_decimal_commas(tmp_path):
    (tmp_path / "a.csv").write_text(
        "frequency [Hz];1+z/2+z amplitude [mm/s²/N];1+z/2+z phase [°]\n10,5;2,0;90\n11,5;3;-90\n"
    )
    (read,) = va.read_functions(tmp_path / "a.csv")
    np.testing.assert_allclose(read.values, [2e-3j, -3e-3j], atol=1e-18)
    np.testing.assert_array_equal(read.frequency_hz, [10.5, 11.5])


@pytest.mark.parametrize(
    ("head", "words"),
    [
        ("frequency [Hz],1+w/2+z real [m/N]", "must be NODE/NODE PART"),
        ("frequency [Hz],1+z/2+z real [m/kg]", "unit 'm/kg': must be a response by a reference"),
        ("frequency [Hz],1+z/2+z real [m]", "unit 'm': must be a response by"),
        ("frequency [Hz],1+z/2+z amplitude [m/N]", "has amplitude alone"),
        ("frequency [Hz],1+z real [V]", "unit 'V' is of voltage"),
        ("frequency [Hz],1+z/2+z real", "states no unit"),
        ("frequency [Hz],1+z/2+z coherence [%]", "coherence has the unit '%'"),
        ("time [s],1+z/2+z real [m/N]", "must be 'frequency [Hz]'"),
    ],
)
def test_what_is_wrong_in_a_table_is_one_line(tmp_path, head, words):
    (tmp_path / "a.csv").write_text(f"{head}\n10,1\n20,2\n")
    with pytest.raises(va.ParameterError) as told:
        va.read_functions(tmp_path / "a.csv")
    assert words in str(told.value)
    assert "\n" not in str(told.value)


def test_accelerance_mobility_and_receptance_are_turned_into_one_another():
    receptance = ONE.with_response_in("m")
    omega = 2.0 * np.pi * FREQUENCY
    np.testing.assert_allclose(receptance.values, -VALUES / omega**2, rtol=1e-12)
    mobility = receptance.with_response_in("m/s")
    np.testing.assert_allclose(mobility.values, VALUES / (1j * omega), rtol=1e-12)
    np.testing.assert_allclose(mobility.with_response_in("m/s²").values, VALUES, rtol=1e-12)
    for wrong in (OTHERS[0], COHERENCE, OTHERS[2]):
        with pytest.raises(va.ParameterError, match=r"turned into"):
            wrong.with_response_in("m")


def test_a_function_is_refused_that_cannot_be():
    for other in ({"values": VALUES * np.nan}, {"frequency_hz": -FREQUENCY}, {"values": VALUES[:3]},
                  {"kind": "wavelet"}, {"reference": None}):  # fmt: skip
        with pytest.raises(va.ParameterError):
            replace(ONE, **other)
    with pytest.raises(va.ParameterError, match=r"direction '.w': must be one of"):
        va.Node(3, "+w")


@pytest.mark.parametrize(
    ("name", "form"), [("a.uff", {}), ("a.uff", {"text": True}), ("a.csv", {})]
)
def test_a_damaged_file_is_read_or_refused(tmp_path, name, form):
    file = va.export_functions([ONE, COHERENCE], tmp_path / name, **form)
    content, rng = file.read_bytes(), np.random.default_rng(6)
    for _ in range(40):
        damaged = bytearray(content[: rng.integers(1, 2 * len(content))])
        for at in rng.integers(0, len(damaged), 3):
            damaged[at] = rng.integers(256)
        file.write_bytes(damaged)
        with suppress(va.VibroacousticsError):
            va.read_functions(file)


# --- lines -1 that are not in pairs --------------------------------------------------------------


def three_functions(folder, form):
    """A file of three functions as its lines, with the numbers of the lines -1."""
    three = [replace(ONE, response=va.Node(number, "-z")) for number in (11, 12, 13)]
    file = va.export_functions(three, folder / "three.uff", **form)
    lines = file.read_bytes().splitlines(keepends=True)
    return file, lines, [at for at, line in enumerate(lines) if line.strip() == b"-1"]


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("where", ["before all", "between", "at the end", "blank line behind"])
def test_a_line_too_many_loses_no_function_and_is_reported(tmp_path, form, where):
    file, lines, marks = three_functions(tmp_path, FORMS[form])
    at = {"before all": marks[0], "at the end": len(lines)}.get(where, marks[2])
    extra = [lines[marks[0]], b"\n"] if where == "blank line behind" else [lines[marks[0]]]
    file.write_bytes(b"".join([*lines[:at], *extra, *lines[at:]]))
    with pytest.warns(RecordingWarning, match="a line -1 without its pair") as told:
        found = va.read_functions(file)
    assert [function.response.number for function in found] == [11, 12, 13]
    number = {"before all": "before all datasets", "at the end": r"after dataset number 3 (58)"}
    assert number.get(where, "after dataset number 1 (58)") in str(told[0].message)
    assert len(told) == 1


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("missing", [1, 2, 3, 4])
def test_a_missing_line_loses_no_function_and_is_reported(tmp_path, form, missing):
    """The end of a dataset, or the begin of the next one."""
    file, lines, marks = three_functions(tmp_path, FORMS[form])
    at = marks[missing]
    file.write_bytes(b"".join([*lines[:at], *lines[at + 1 :]]))
    with pytest.warns(RecordingWarning, match="a line -1 without its pair"):
        found = va.read_functions(file)
    assert [function.response.number for function in found] == [11, 12, 13]


def test_a_line_within_the_values_of_a_text_loses_no_other_function(tmp_path):
    file, lines, marks = three_functions(tmp_path, FORMS["58"])
    at = marks[0] + 16
    file.write_bytes(b"".join([*lines[:at], lines[marks[0]], *lines[at:]]))
    with (
        pytest.raises(va.StorageError, match=r"function 1, .*truncated"),
        pytest.warns(RecordingWarning, match=r"after dataset number 1 \(58\) there is a line -1"),
    ):
        va.read_functions(file)
