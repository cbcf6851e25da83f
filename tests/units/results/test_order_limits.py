"""Limits of orders: read, held against recordings, studies and comparisons, told and drawn."""

import csv
import io

import numpy as np
import pytest
import xarray as xr
from support import tiny_run

from vibroacoustics import (
    Limit,
    NominalSpeed,
    OrderAnalysis,
    SpeedChannel,
    analyse_orders,
    check_limits,
    compare,
    label_recording,
    open_results,
    plot,
    read_limits,
)
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.report.limit_tables import limits_data, limits_words, order_limits_table
from vibroacoustics.report.tables import to_csv, to_text
from vibroacoustics.results.order_limits import NOT_CHECKED, with_limits
from vibroacoustics.results.storage import write_results

HEADER = "channel,order,limit,unit"
RATE_HZ = 1024.0


def steady(peak=1.0, names=("shell", "microphone")) -> xr.Dataset:
    """Orders 1 and 2 of 50 Hz, 1 and 0.1 of the peak (m/s²), and a 50th of them in Pa."""
    angle = 2.0 * np.pi * 50.0 * np.arange(4096) / RATE_HZ
    signal = peak * (np.cos(angle) + 0.1 * np.cos(2.0 * angle))
    made = label_recording([signal, 0.02 * signal], RATE_HZ, names, ["m/s²", "Pa"])
    return analyse_orders(made, OrderAnalysis(NominalSpeed(3000.0), (1.0, 2.0), maximum_order=4.0))


def limits_text(checked):
    return "\n".join([to_text(order_limits_table(checked)), *limits_words(checked)])


def run_up() -> xr.Dataset:
    time = np.arange(8192) / RATE_HZ
    rpm = 1200.0 + 200.0 * time
    signal = np.cos(2.0 * np.pi * (20.0 * time + 5.0 / 3.0 * time**2))
    made = label_recording([signal, rpm], RATE_HZ, ["shell", "speed"], ["m/s²", "rpm"])
    return analyse_orders(made, OrderAnalysis(SpeedChannel("speed"), (1.0,), 4.0))


def margin(checked: xr.Dataset, channel: str, order: float, name: str = "limit_margin") -> float:
    return float(checked[name].sel(channel=channel, order=order).isel(speed=0))


# --- the file ------------------------------------------------------------------------------------


def test_a_file_with_comments_speeds_and_a_byte_order_mark(tmp_path):
    file = tmp_path / "limits.csv"
    lines = [
        "# stand 2",
        "unit, channel,limit,order,speed_to_rpm,speed_from_rpm",
        "dB,*,60,1,,",
        "",
        'm/s²,"shell, left",0.5,2.5,3600,1200',
    ]
    file.write_bytes("\ufeff".encode() + "\r\n".join(lines).encode())
    first, second = read_limits(file)
    assert (first.channel, first.order, first.unit) == ("*", 1.0, "dB")
    assert (first.speed_from_rpm, first.speed_to_rpm) == (0.0, np.inf)
    assert (second.channel, second.order, second.limit) == ("shell, left", 2.5, 0.5)
    assert (second.speed_from_rpm, second.speed_to_rpm) == (1200.0, 3600.0)
    assert second.origin == f"{file}: line 5"


BAD_FILES = {
    "empty": (b"# nothing\n\n", ["limits.csv: is empty"]),
    "header only": (HEADER.encode(), ["has no rows under its head"]),
    "no unit": (b"channel,order,limit\nshell,1,1\n", ["unit is missing", "found: channel,"]),
    "unknown column": (b"channel,order,limit,unit,peak\n", ["peak: unknown column", "may have"]),
    "column twice": (b"channel,order,limit,unit,unit\n", ["column unit and unit is there twice"]),
    "no text": (b"chan\0nel", ["limits.csv: cannot be read: is no text"]),
    "too large": (b"#" * 1_000_001, ["limits.csv: cannot be read: larger than 1000000 bytes"]),
    "quote": (b'channel,order,limit,unit\n"shell,1,1,N\n', ["line 2: cannot be split"]),
}  # fmt: skip
BAD_LINES = {
    "shell,1,1": ["3 cells, the head has 4"],
    ",1,1,N": ["channel = ''", "must be a channel's name, or *"],
    "shell,x,1,N": ["order = x: must be a finite number"],
    "shell,0,1,N": ["order = 0: must be a number above 0"],
    "shell,inf,1,N": ["order = inf: must be a finite number"],
    "shell,1,,N": ["limit = nothing: must be a finite number"],
    "shell,1,0,N": ["limit = 0: must be a number above 0, in N"],
    "shell,1,nan,dB": ["limit = nan: must be a finite number"],
    "shell,1,1,K": ["unit = 'K': must be one of dB (re 20 µPa), Pa"],
    "shell,1,1,dB(A)": ["unit = 'dB(A)': must be one of dB (re 20 µPa), Pa"],
}


@pytest.mark.parametrize("name", BAD_FILES)
def test_bad_files(name, tmp_path):
    content, words = BAD_FILES[name]
    (tmp_path / "limits.csv").write_bytes(content)
    with pytest.raises(ParameterError) as refusal:
        read_limits(tmp_path / "limits.csv")
    assert all(word in str(refusal.value) for word in words), refusal.value


@pytest.mark.parametrize("line", BAD_LINES)
def test_bad_lines(line, tmp_path):
    (tmp_path / "limits.csv").write_text(f"# of the stand\n{HEADER}\n{line}\n", encoding="utf-8")
    with pytest.raises(ParameterError) as refusal:
        read_limits(tmp_path / "limits.csv")
    for word in ("limits.csv: line 3: ", *BAD_LINES[line]):
        assert word in str(refusal.value)


@pytest.mark.parametrize(
    ("speeds", "words"),
    [
        ("-1,", "speed_from_rpm = -1: must be a number of rpm, at least 0"),
        ("3000,2000", "speed_to_rpm = 2000: must be at least speed_from_rpm, 3000 rpm"),
        (",nan", "speed_to_rpm = nan: must be a finite number"),
    ],
)
def test_bad_speeds(speeds, words, tmp_path):
    text = f"{HEADER},speed_from_rpm,speed_to_rpm\nshell,1,1,N,{speeds}\n"
    (tmp_path / "limits.csv").write_text(text)
    with pytest.raises(ParameterError, match=f"line 2: {words}"):
        read_limits(tmp_path / "limits.csv")


def test_missing_file(tmp_path):
    with pytest.raises(ParameterError, match=r"none\.csv: no such file"):
        read_limits(tmp_path / "none.csv")


# --- recordings ----------------------------------------------------------------------------------


def test_margins_of_a_recording():
    """A peak of 1 is an RMS of 1/√2: 3.01 dB below 1, 3.01 dB above 1/2."""
    limits = [Limit("shell", 1.0, 1.0, "m/s²"), Limit("shell", 2.0, 50.0, "mm/s²")]
    checked = check_limits(steady(), limits)
    assert checked["limit_margin"].dims == ("channel", "speed", "order")
    assert margin(checked, "shell", 1.0) == pytest.approx(3.0103, abs=1e-3)
    assert margin(checked, "shell", 2.0) == pytest.approx(-3.0103, abs=1e-3)
    assert checked["order_limit"].sel(channel="shell", order=2.0).item() == pytest.approx(0.05)
    assert checked["within_limit"].dtype == bool
    assert checked["within_limit"].sel(channel="shell").values.tolist() == [[True, False]]
    assert np.isnan(checked["limit_margin"].sel(channel="microphone")).all()
    assert checked["within_limit"].sel(channel="microphone").all()


def test_margins_in_decibel():
    """0.02/√2 Pa are 56.99 dB re 20 µPa."""
    checked = check_limits(steady(), [Limit("*", 1.0, 56.0, "dB")])
    assert margin(checked, "microphone", 1.0) == pytest.approx(-0.9897, abs=1e-3)
    assert np.isnan(margin(checked, "shell", 1.0))


def test_the_lowest_of_several_limits_counts():
    limits = [Limit("*", 1.0, 0.3, "m/s²"), Limit("shell", 1.0, 0.2, "m/s²"),
              Limit("shell", 1.0, 0.5, "m/s²")]  # fmt: skip
    checked = check_limits(steady(), limits)
    assert checked["order_limit"].sel(channel="shell", order=1.0).item() == 0.2


def test_limits_between_speeds():
    limits = [Limit("shell", 1.0, 1.0, "m/s²", 1500.0, 2000.0), Limit("shell", 7.0, 1.0, "m/s²")]
    checked = check_limits(run_up(), limits)
    limited = checked["speed"].values[np.isfinite(checked["order_limit"].squeeze())]
    assert limited.tolist() == [1500.0, 1600.0, 1700.0, 1800.0, 1900.0, 2000.0]
    assert checked.attrs[NOT_CHECKED] == "limit (order 7 of shell)"


def test_speeds_count_to_the_nearest_rpm():
    orders = steady().assign_coords(speed=[2999.6])
    checked = check_limits(orders, [Limit("shell", 1.0, 1.0, "m/s²", 3000.0, 3000.0)])
    assert np.isfinite(margin(checked, "shell", 1.0))


@pytest.mark.parametrize(
    ("limit", "words"),
    [
        (Limit("shel", 1.0, 1.0, "m/s²"), "channel = 'shel', in m/s²: must be one of shell [m/s²]"),
        (Limit("shell", 1.0, 60.0, "dB"), "unit = 'dB': channel 'shell' is in m/s²; must be a"),
        (Limit("microphone", 1.0, 1.0, "N"), "channel 'microphone' is in Pa; must be dB (re 20"),
        (Limit("*", 1.0, 1.0, "N"), "channel = '*', in N: must be one of shell"),
        (Limit("shell", 3.0, 1.0, "m/s²"), "no limit is for these orders: limit (order 3 of"),
    ],
)  # fmt: skip
def test_limits_that_are_refused(limit, words):
    with pytest.raises(ParameterError) as refusal:
        check_limits(steady(), [limit])
    assert words in str(refusal.value)


def test_verdicts_are_kept_in_a_file(tmp_path):
    """Truth values too."""
    kept = with_limits(steady(), [Limit("shell", 1.0, 0.5, "m/s²")])
    read = open_results(write_results(kept, tmp_path / "orders.nc"))
    xr.testing.assert_identical(read["within_limit"], kept["within_limit"])
    assert not read["within_limit"].all()


# --- studies and comparisons ---------------------------------------------------------------------


def test_margins_of_a_study():
    study = tiny_run()
    limits = [Limit("force x", 1.0, 10.0, "N")]
    for option in ("none", "counterweight-half"):
        force = study["force_order"].sum("source").sel(option=option, axis="x", order=1)
        expected = 20.0 * np.log10(10.0 * np.sqrt(2.0) / abs(force.item()))
        assert margin(check_limits(study, limits, option), "force x", 1.0) == pytest.approx(
            expected
        )
    with pytest.raises(ParameterError, match="option 'half': is none of"):
        check_limits(study, limits, "half")


def test_both_results_of_a_comparison_are_checked():
    """B has twice the vibration of A; the limit may name either one's channel."""
    pairs = {"shell": "ring"}
    compared = compare(steady(), steady(2.0, ("ring", "left")), pairs)
    for name in ("shell", "ring"):
        checked = check_limits(compared, [Limit(name, 1.0, 1.0, "m/s²")])
        assert margin(checked, "shell", 1.0) == pytest.approx(3.0103, abs=1e-3)
        assert margin(checked, "shell", 1.0, "compared_limit_margin") == pytest.approx(
            -3.01, abs=1e-2
        )
        assert checked["compared_within_limit"].values.ravel().tolist() == [False, True]
        assert checked["within_limit"].all()
    text = limits_text(checked)
    assert (
        "1 of 2 orders exceeds its limit, the worst by 3.0 dB: order 1 of ring at 3000 rpm in B."
        in text
    )
    without = compared.drop_vars("compared_order_rms")
    with pytest.raises(ParameterError, match="hold no RMS; compare the two results again"):
        check_limits(without, [Limit("shell", 1.0, 1.0, "m/s²")])


# --- what is written -----------------------------------------------------------------------------


def test_table_sentence_and_csv():
    limits = [Limit("shell", 1.0, 0.5, "m/s²"), Limit("*", 1.0, 57.0, "dB"),
              Limit("shell", 9.0, 1.0, "m/s²", origin="limits.csv: line 4")]  # fmt: skip
    checked = check_limits(steady(), limits)
    lines = limits_text(checked).splitlines()
    rows = {line.split()[0]: line.split() for line in lines[3:5]}
    assert rows["shell"][1:] == ["1", "3000", "0.7071", "0.5", "m/s²", "-3.0", "exceeds"]
    assert rows["microphone"][1:] == ["1", "3000", "57.0", "57.0", "dB", "0.0"]
    assert lines[-2].startswith("1 of 2 orders exceeds its limit, the worst by 3.0 dB: order 1 of")
    assert lines[-1].endswith("limits.csv: line 4 (order 9 of shell)")
    table = list(csv.DictReader(io.StringIO(to_csv(limits_data(checked)).decode())))
    assert [row["within"] for row in table] == ["no", "yes"]
    assert float(table[1]["value"]) == pytest.approx(56.9897, abs=1e-3)
    assert "result" not in table[0]


def test_sentence_where_all_is_within():
    checked = check_limits(steady(), [Limit("shell", 1.0, 1.0, "m/s²")])
    assert "None of 1 orders exceeds its limit; the least margin is 3.0 dB" in limits_text(checked)


def test_the_worst_speed_is_told():
    limits = [Limit("shell", 1.0, 1.0, "m/s²"), Limit("shell", 1.0, 0.5, "m/s²", 2000.0, 2000.0)]
    (row,) = [line for line in limits_text(check_limits(run_up(), limits)).splitlines()
              if line.startswith("shell")]  # fmt: skip
    assert row.split()[2] == "2000"


# --- what is drawn -------------------------------------------------------------------------------


def labels(figure) -> list[str]:
    return [text.get_text() for legend in figure.legends for text in legend.get_texts()]


def test_figures_show_limits():
    orders = run_up()
    everywhere = with_limits(orders, [Limit("shell", 1.0, 5.0, "m/s²")])
    above = with_limits(orders, [Limit("shell", 1.0, 5.0, "m/s²", 1500.0)])
    for drawn, in_spectrum in ((everywhere, True), (above, False), (orders, False)):
        spectrum, over_speed = plot.order_spectrum(drawn), plot.orders_over_speed(drawn)
        assert ("limit in an order's band" in labels(spectrum)) == in_spectrum
        assert ("limits" in labels(over_speed)) == ("order_limit" in drawn)
    limits = plot.orders_over_speed(above).axes[0].lines[1]
    at = np.isfinite(limits.get_ydata())
    assert limits.get_xdata()[at].min() == pytest.approx(1450.0, abs=30.0)
    np.testing.assert_array_equal(limits.get_ydata()[at], 5.0)
    assert plot.orders_over_speed(above).axes[0].get_ylim()[1] > 5.0


def test_compared_orders_show_limits_as_peaks():
    compared = with_limits(compare(steady(), steady()), [Limit("shell", 1.0, 1.0, "m/s²")])
    figure = plot.compared_orders(compared, "shell")
    assert "limit, as a peak" in labels(figure)
    drawn = np.concatenate([line.get_ydata() for line in figure.axes[0].lines])
    assert np.isclose(drawn, np.sqrt(2.0)).any()
    assert "limit, as a peak" not in labels(plot.compared_orders(compared, "microphone"))
