"""Forms of CSV: every reader of tables reads all of them alike, or refuses what may be wrong."""

import csv
import io
from contextlib import suppress
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
from csv_forms import FORMS, PLAIN, Form
from hypothesis import given
from hypothesis import strategies as st

import vibroacoustics as va
from vibroacoustics.base.column_file import read_columns
from vibroacoustics.base.csv_form import decoded
from vibroacoustics.machine.feet import MountStiffness
from vibroacoustics.measured.baselines import tables
from vibroacoustics.mechanisms.tabulated.csv_layout import read_csv
from vibroacoustics.mechanisms.tabulated.spectra import COMPONENTS
from vibroacoustics.recordings.readers import csv_table
from vibroacoustics.recordings.recorded import Request
from vibroacoustics.study.evidence_files import FORCES
from vibroacoustics.study.evidence_files import _rows as published_forces

RPM = 2900.25
PEAKS = np.array([[1234.5, -0.25, 12.0, 3.125, 0.0, 2345678.75], [0.5, 1e3, 7.0, 0.0, 1.5, -20.0]])
FORCE_COLUMNS = [
    ("speed_rpm", "Speed", "rpm"),
    ("order", "Order", ""),
    ("source", "Source", ""),
    *(
        column
        for name in COMPONENTS
        for column in (
            (f"{name}_{'n' if name[0] == 'f' else 'nm'}", name.capitalize(),
             "N" if name[0] == "f" else "Nm"),
            (f"{name}_phase_deg", f"{name.capitalize()} phase", "deg"),
        )
    ),
]  # fmt: skip


def forces(path, form):
    """Peaks of two orders."""
    rows = [
        [RPM, float(order), "crank, journal",
         *(x for peak in peaks for x in (abs(peak), 0.0 if peak >= 0.0 else 180.0))]
        for order, peaks in enumerate(PEAKS, 1)
    ]  # fmt: skip
    path.write_bytes(form.written(FORCE_COLUMNS, rows))
    spectra = read_csv(path)
    assert (spectra.speed_rpm, spectra.sources) == ((RPM,), ("crank, journal",))
    return spectra.orders[0, 0, :, 1:].T, PEAKS


def baseline(path, form):
    """Levels of third octaves."""
    columns = [("microphone", "Microphone", ""), ("speed_rpm", "Speed", "rpm"),
               ("band_hz", "Band", "Hz"), ("level_db", "Level", "dB")]  # fmt: skip
    levels = {1000.0: 61.25, 1250.0: -3.5, 10000.0: 1234.5}
    rows = [["Prüfstand", RPM, band, level] for band, level in levels.items()]
    path.write_bytes(form.written(columns, rows))
    (read,) = tables.read(SimpleNamespace(path=path)).third_octaves
    assert (read["microphone"], read["speed_rpm"]) == ("Prüfstand", RPM)
    return [read["band_hz"], read["level_db"]], [list(levels), list(levels.values())]


def limits(path, form):
    """Limits of orders and of bands in one file, with blank cells."""
    columns = [("channel", "Channel", ""), ("order", "Order", ""), ("band_hz", "Band", "Hz"),
               ("limit", "Limit", ""), ("unit", "Unit", "")]  # fmt: skip
    rows = [["*", 1.5, "", 1234.5, "m/s²"], ["front", "", 1000.0, -2.25, "dB"]]
    path.write_bytes(form.written(columns, rows))
    (order,), (figure,) = va.read_figure_limits(path)
    assert (order.channel, order.unit, figure.channel) == ("*", "m/s²", "front")
    read = [order.order, order.limit, figure.band_hz, figure.limit]
    return read, [1.5, 1234.5, 1000.0, -2.25]


def recording(path, form):
    """Samples of two channels; heads are always with brackets."""
    form = form if form.head else replace(form, head=PLAIN.head)
    columns = [("", "time", "s"), ("", "a", "m/s²"), ("", "b", "Pa")]
    rows = [[0.0, 1.0, -0.5], [0.5, 1234.5, 2.0], [1.0, -7.25, 1e6]]
    path.write_bytes(form.written(columns, rows))
    read = csv_table.read(Request(path))
    assert (read.names, read.units, read.sample_rate_hz) == (["a", "b"], ["m/s²", "Pa"], 2.0)
    return read.samples, np.array(rows).T[1:]


def functions(path, form):
    """A frequency response by real and imaginary part; heads are always with brackets."""
    form = form if form.head else replace(form, head=PLAIN.head)
    form = form if form.head != "{name} / {unit}" else replace(form, head="{name} ({unit})")
    form = replace(form, has_unit_row=False)
    columns = [("", "frequency", "Hz"), ("", "12+z/3+z real", "m/s²/N"),
               ("", "12+z/3+z imaginary", "m/s²/N")]  # fmt: skip
    if "(" in form.head:  # round brackets may belong to a name
        form = replace(form, head=PLAIN.head)
    rows = [[10.5, 1.0, -0.5], [1000.5, 1234.5, 2.0]]
    path.write_bytes(form.written(columns, rows))
    (read,) = va.read_functions(path)
    expected = np.array(rows)
    return [read.frequency_hz, read.values], [expected[:, 0], expected[:, 1:] @ [1.0, 1.0j]]


def mounts(path, form):
    """Stiffness over frequency, in N/mm."""
    columns = [
        ("frequency_hz", "Frequency", "Hz"),
        ("lateral_n_per_mm", "Lateral", "N/mm"),
        ("vertical_n_per_mm", "Vertical", "N/mm"),
        ("loss_factor", "Loss factor", ""),
    ]
    rows = [[10.5, 1234.5, 100.0, 0.125], [1000.5, 2000.0, 1e6, 0.25]]
    path.write_bytes(form.written(columns, rows))
    read = MountStiffness.read(path, {})
    return list(read.values()), np.array(rows).T * [[1.0], [1e3], [1e3], [1.0]]


def evidence(path, form):
    """Published forces."""
    columns = [("part", "Part", ""), ("speed_rpm", "Speed", "rpm"),
               ("force_1x_n", "Force 1x", "N"), ("deviation_n", "Deviation", "N"),
               ("source", "Source", "")]  # fmt: skip
    path.write_bytes(form.written(columns, [["ring", RPM, 1234.5, 0.5, "table 3, page 7"]]))
    (read,) = published_forces(path)
    assert (read["part"], read["source"]) == ("ring", "table 3, page 7")
    return [read[name] for name in FORCES.numbers], [RPM, 1234.5, 0.5]


READERS = [forces, baseline, limits, recording, functions, mounts, evidence]


@pytest.mark.parametrize("reader", READERS, ids=lambda reader: reader.__name__)
@pytest.mark.parametrize("name", FORMS)
def test_all_forms_are_read_alike(tmp_path, reader, name):
    read, expected = reader(tmp_path / "table.csv", FORMS[name])
    np.testing.assert_allclose(read, expected, rtol=1e-12, atol=1e-9)


COLUMNS = [("speed_rpm", "Speed", "rpm"), ("crank_angle_deg", "Angle", "deg"),
           ("fx_kn", "Fx", "kN")]  # fmt: skip
NAMES = ("speed_rpm", "crank_angle_rad", "fx_n")
FACTORS = (1.0, np.pi / 180.0, 1e3)


def by_pandas(content: bytes, form: Form):
    """Numbers by another reader, which is told the form."""
    skipped = len([line for line in form.above if line.strip() and not line.startswith("#")])
    table = pd.read_csv(
        io.BytesIO(content), sep=form.separator, decimal=form.decimal, encoding=form.encoding,
        thousands=form.thousands or None, comment="#", skiprows=skipped, skipinitialspace=True,
        engine="c" if f"{form.thousands}-".isascii() else "python",
    )  # fmt: skip
    if form.has_unit_row:
        table = table[1:].apply(lambda column: column.map(_plain(form)))
    return table.dropna(axis=1, how="all").dropna().to_numpy(dtype=float)


def _plain(form):
    def number(cell):
        text = str(cell).replace(form.thousands or "\0", "")
        return float(text.replace(form.decimal, "."))

    return number


@pytest.mark.parametrize("name", FORMS)
def test_numbers_are_those_of_another_reader(tmp_path, name):
    form = FORMS[name]
    rows = [[2900.5, 0.5, -1234.25], [3600.0, 12.0, 0.125], [1e5, 359.75, 20.0]]
    content = form.written(COLUMNS, rows)
    (tmp_path / "a.csv").write_bytes(content)
    numbers = read_columns(tmp_path / "a.csv", NAMES).numbers
    read = np.stack([numbers[name] / factor for name, factor in zip(NAMES, FACTORS, strict=True)])
    np.testing.assert_allclose(read.T, by_pandas(content, form), rtol=1e-14)
    np.testing.assert_allclose(read.T, rows, rtol=1e-14)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "latin-1", "utf-16", "utf-16-le"])
def test_text_is_decoded(encoding):
    assert decoded("Prüfung: 3 µm, 5 °C, m/s²".encode(encoding)) == "Prüfung: 3 µm, 5 °C, m/s²"


HEAD = "speed_rpm;crank_angle_deg;fx_n\n"
REFUSED = {
    "foreign names": ("Drehzahl [rpm];Kurbelwinkel [deg];Fx [N]\n1;2;3\n",
                      "Drehzahl [rpm]: unknown column; speed_rpm, crank_angle_rad are missing; "
                      "columns found: Drehzahl [rpm], Kurbelwinkel [deg], Fx [N]"),
    "no unit": ("Speed [rpm];Angle;Fx [N]\n1;2;3\n", "Angle: states no unit: must be ° or rad"),
    "unit of another quantity": ("Speed [rpm];Angle [deg];Fx [mm]\n1;2;3\n",
                                 "Fx [mm]: unit mm: must be kN or N, as in fx_n"),
    "unknown unit": ("Speed [rpm];Angle [deg];Fx (lbf)\n1;2;3\n", "unit lbf: must be kN or N"),
    "unknown unit below": ("Speed;Angle;Fx\nrpm;deg;lbf\n1;2;3\n", "Fx: unit lbf: must be kN or N"),
    "two units": ("Speed [rpm];Angle [deg];Fx [N]\nrpm;deg;kN\n1;2;3\n",
                  "Fx [N]: unit kN: the head states another one"),
    "small and large letters": ("Speed [rpm];Angle [deg];Fx_MM\n1;2;3\n", "Fx_MM: unit MM"),
    "twice": ("fx_n;Fx [N];speed_rpm;crank_angle_deg\n1;2;3;4\n",
              "column fx_n and Fx [N] is there twice"),
    "two decimal signs": (HEAD + "1;2,5;3.5\n", "fx_n = 3.5 and 2,5: have no common decimal sign"),
    "point or thousands": (HEAD + "1;2;1.234\n",
                           "line 2: fx_n = 1.234: may be 1.234 or 1234; write 1.2340 or 1234"),
    "comma or thousands": (HEAD.replace(";", "\t") + "1\t2\t1,234\n", "may be 1.234 or 1234"),
    "quoted comma or thousands": (HEAD.replace(";", ",") + '1,2,"1,234"\n', "may be 1.234 or 1234"),
    "decimal commas between commas": (HEAD.replace(";", ",") + "1,2,3,5\n",
                                      "line 2: 4 cells, the head has 3; with decimal commas, "
                                      "separate cells by semicolons"),
    "too few cells": (HEAD + "1;2\n", "line 2: 2 cells, the head has 3"),
    "column without a name": ("speed_rpm;;crank_angle_deg;fx_n\n1;7;2;3\n",
                              "line 2: 7: its column has no name"),
    "no number": (HEAD + "1;2;3 N\n", "line 2: fx_n = 3 N: must be a finite number"),
    "underscore": (HEAD + "1;2;3_0\n", "fx_n = 3_0: must be a finite number"),
    "nothing": (HEAD + "1;;3\n", "line 2: crank_angle_deg = nothing: must be a finite number"),
    "wrong groups": (HEAD + "1;2;12.34.567,5\n", "have no common decimal sign"),
    "no rows": (HEAD, "has no rows under its head"),
    "blanks alone": ("\n ;;\n# nothing\n", "is empty"),
    "open quote": (HEAD + '"1;2;3\n', "line 2: cannot be split"),
    "binary": ("speed\0", "is no text"),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_what_is_refused_names_what_was_found(tmp_path, name):
    content, words = REFUSED[name]
    (tmp_path / "a.csv").write_text(content, encoding="utf-8")
    with pytest.raises(va.ParameterError) as refusal:
        read_columns(tmp_path / "a.csv", NAMES)
    assert str(refusal.value).startswith(f"{tmp_path / 'a.csv'}: ")
    assert words in str(refusal.value)


MOST = st.floats(-1e7, 1e7).map(lambda value: round(value, 3))
SHORT = st.integers(-2_000_000, 2_000_000).map(float)
THOUSANDTHS = st.integers(1000, 999_999).map(lambda value: value / 1000.0)
THOUSANDS = st.integers(1, 999).map(lambda value: 1000.0 * value)
NUMBER = st.one_of(MOST, SHORT, THOUSANDTHS, THOUSANDS)
SIGNS = st.sampled_from(
    [
        (separator, decimal, thousands)
        for separator in ",;\t|"
        for decimal, others in ((".", ("", ",", "'", "\u00a0")), (",", ("", ".", "\u202f")))
        for thousands in others
        # the documented reading of two pairs of signs: see docs/csv.md
        if (separator, thousands) not in ((",", "."), (";", ","))
    ]
)


TABLES = st.lists(st.tuples(NUMBER, NUMBER), min_size=1, max_size=4)
SETTLED = (0.5, 12.25)
"""Numbers that no sign between thousands can be in, so that every table with them is read."""


def check_never_wrong(read, rows):
    """Read a table back exactly, or see it refused; with `SETTLED` it is read."""
    with suppress(va.VibroacousticsError):
        np.testing.assert_array_equal(read(rows), rows)
    np.testing.assert_array_equal(read([*rows, SETTLED]), [*rows, SETTLED])


@given(signs=SIGNS, rows=TABLES, quoting=st.sampled_from([csv.QUOTE_MINIMAL, csv.QUOTE_ALL]))
def test_no_number_is_ever_read_wrong(tmp_path_factory, signs, rows, quoting):
    """What a program of any country writes is read back exactly, or refused."""
    path = tmp_path_factory.getbasetemp() / "columns.csv"

    def read(rows):
        path.write_bytes(Form(*signs, quoting=quoting).written(COLUMNS[::2], rows))
        numbers = read_columns(path, NAMES[::2]).numbers
        return np.array([numbers["speed_rpm"], numbers["fx_n"] / 1e3]).T.round(6)

    check_never_wrong(read, rows)


@given(signs=SIGNS, rows=TABLES)
def test_no_sample_is_ever_read_wrong(tmp_path_factory, signs, rows):
    path = tmp_path_factory.getbasetemp() / "recording.csv"

    def read(rows):
        path.write_bytes(Form(*signs).written([("", "a", "Pa"), ("", "b", "N")], rows))
        return np.array(csv_table.read(Request(path, sample_rate_hz=10.0)).samples).T

    check_never_wrong(read, rows)


@pytest.mark.parametrize("number", ["0.125", "1000.125", "1.5", "1.2340", "1.234e3"])
def test_numbers_that_no_thousands_are_in_settle_the_form(tmp_path, number):
    (tmp_path / "a.csv").write_text(f"{HEAD}1;2;{number}\n")
    assert read_columns(tmp_path / "a.csv", NAMES).numbers["fx_n"].tolist() == [float(number)]
