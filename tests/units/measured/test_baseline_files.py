"""What files a baseline may come from, what is read from each, and what is wrong with one."""

import numpy as np
import pytest
from support import ROOT, made_up_radiation

import vibroacoustics as va
from vibroacoustics.levels.measured_points import BASELINE_BANDS, measured_points
from vibroacoustics.results.storage import write_results

RPM = 930.0
SHAFT_HZ = RPM / 60.0
TONES_DB = {1: 66.0, 2: 60.0, 3: 63.0}
FLOOR_DB = 30.0
"""Of each line of noise."""
BANDWIDTH = 1.5
"""Noise bandwidth of the Hann window, lines."""


@pytest.fixture(scope="module")
def study():
    asked = {"operation.speed_rpm": [RPM], "operation.maximum_order": 4}
    return va.load_study(ROOT / "pipelines" / "reciprocating_table.toml").replace(asked)


def baseline(study, folder, files, **keys):
    """The baseline of files by name and content."""
    for name, content in files.items():
        if isinstance(content, str):
            (folder / name).write_text(content)
    names = [str(folder / name) for name in files]
    return study.replace({"measured.baseline": {"file": names, **keys}})


def power(level_db):
    return 10.0 ** (np.asarray(level_db) / 10.0)


def spectrum():
    """Mean squares re (20 µPa)² of a Hann-windowed spectrum: tones between lines, and noise."""
    frequency = np.arange(0.0, 400.0, 0.25)
    square = np.full(frequency.size, power(FLOOR_DB))
    for order, level in TONES_DB.items():
        off = (frequency - order * SHAFT_HZ) / 0.25 + 1e-6  # not 0/0 a line off
        square += power(level) * (np.sinc(off) / (1.0 - off**2)) ** 2
    return frequency, square


def check_spectrum(found):
    (orders,), (bands,) = found.orders, found.third_octaves
    levels = dict(zip(orders.order, orders.level_db, strict=True))
    for order, level in TONES_DB.items():
        assert levels[order] == pytest.approx(level, abs=0.02)
    assert levels[7.0] < FLOOR_DB - 20.0  # nothing there but noise
    assert orders.phase_rad[0] is None
    third = dict(zip(bands.band_hz, bands.level_db, strict=True))
    assert bands.without_orders
    for band in (31.5, 100.0, 250.0):
        lines = band * (10.0**0.05 - 10.0**-0.05) / 0.25 / BANDWIDTH
        assert third[band] == pytest.approx(FLOOR_DB + 10.0 * np.log10(lines), abs=0.15)


def test_a_narrow_band_is_taken_apart(tmp_path, study):
    rows = [
        f"front_1m,{RPM},{hertz},{10.0 * np.log10(square)}"
        for hertz, square in zip(*spectrum(), strict=True)
    ]
    text = "\n".join(["microphone,speed_rpm,frequency_hz,level_db", *rows])
    check_spectrum(baseline(study, tmp_path, {"spectrum.csv": text}).measured.baseline)


@pytest.mark.parametrize("name", ["spectrum.uff", "running.csv"])
@pytest.mark.parametrize("kind", ["spectrum", "auto spectrum"])
def test_functions_of_frequency_are_taken_apart(tmp_path, study, name, kind):
    frequency, square = spectrum()
    auto = kind == "auto spectrum"
    values = (4e-10 * square if auto else 2e-5 * np.sqrt(2.0 * square)).astype(complex)
    node = va.Node(101)
    function = va.MeasuredFunction(
        kind, frequency, values, node, node if auto else None, "Pa", "Pa" if auto else ""
    )
    va.export_functions([function], tmp_path / name)
    keys = {"microphones": {"side_1m": {"node": 101}}, "recorded_speed_rpm": RPM}
    found = baseline(study, tmp_path, {name: None}, **keys).measured.baseline
    assert found.measured_at == ("side_1m",)
    check_spectrum(found)


def test_a_map_over_speed_and_frequency_is_taken_apart(tmp_path, study):
    time = np.arange(40 * 1024) / 1024.0
    tone = np.sqrt(2.0) * 2e-5 * 10.0 ** (70.0 / 20.0) * np.cos(2.0 * np.pi * SHAFT_HZ * time)
    noise = 1e-3 * np.random.default_rng(4).standard_normal(time.size)
    recording = va.label_recording([tone + noise], 1024.0, ["mic 7"], ["Pa"])
    mapped = va.speed_frequency_map(recording, va.NominalSpeed(RPM), resolution_hz=0.5)
    write_results(mapped, tmp_path / "map.nc")
    named = {"microphones": {"front_1m": {"channel": "mic 7"}}}
    found = baseline(study, tmp_path, {"map.nc": None}, **named).measured.baseline
    (orders,), (bands,) = found.orders, found.third_octaves
    assert orders.level_db[0] == pytest.approx(70.0, abs=0.02)
    third = dict(zip(bands.band_hz, bands.level_db, strict=True))
    width = 200.0 * (10.0**0.05 - 10.0**-0.05)
    white = 10.0 * np.log10(1e-6 / 512.0 * width / 4e-10)
    assert third[200.0] == pytest.approx(white, abs=3.0 * 4.34 / np.sqrt(width * 40.0))


@pytest.mark.parametrize("resolution", [0.25, 0.1])
def test_orders_of_a_coarse_spectrum_do_not_count_twice(tmp_path, study, resolution):
    """Six lines an order do not tell a tone from the next one; they are taken off the band."""
    time = np.arange(60 * 1024) / 1024.0
    tone = 0.02 * np.cos(4.0 * np.pi * SHAFT_HZ * time)
    noise = 1e-2 * np.random.default_rng(4).standard_normal(time.size)
    recording = va.label_recording([tone + noise], 1024.0, ["front_1m"], ["Pa"])
    settings = va.OrderAnalysis(va.NominalSpeed(RPM), (1.0, 2.0, 3.0), 12.0, resolution)
    write_results(va.analyse_orders(recording, settings), tmp_path / "orders.nc")
    found = baseline(study, tmp_path, {"orders.nc": None}).measured.baseline
    point = measured_points(found, ["front_1m"], [RPM])["front_1m", RPM]
    for middle, truth in ((31.5, 2e-4 + 1e-4 / 512.0 * 7.3), (200.0, 1e-4 / 512.0 * 46.0)):
        band = [each.nominal_hz for each in BASELINE_BANDS].index(middle)
        square = point.unmodelled[point.band == band].item()
        if middle < 100.0:
            square += 0.5 * abs(point.peak[1]) ** 2
        assert 10.0 * np.log10(square / truth) == pytest.approx(0.0, abs=0.2)
    names = [BASELINE_BANDS[number].nominal_hz for number in point.band]
    assert names[-1] == 400.0  # above order 12 by the recording's own third octaves


THIRDS = "microphone,speed_rpm,band_hz,level_db\n" + "\n".join(
    f"front_1m,930,{band},{level}"
    for band, level in ((16, 66.1), (31.5, 60.2), (50, 64.0), (63, 50.0), (100, 45.0))
)
ORDERS = "microphone,speed_rpm,order,level_db,phase_deg\n" + "\n".join(
    f"front_1m,930,{order},{level},{20 * order}" for order, level in TONES_DB.items()
)


def test_orders_and_third_octaves_together_do_not_count_twice(tmp_path, study):
    """Without an option the level is that of the third octaves; phases need the tacho's angle."""
    both = {"thirds.csv": THIRDS, "orders.csv": ORDERS}
    loud = baseline(study, tmp_path, {"thirds.csv": THIRDS})
    apart = baseline(study, tmp_path, both)
    phased = baseline(study, tmp_path, both, tacho_angle_deg=10.0)
    at = {"option": "none", "receiver": "front_1m", "speed": RPM}
    runs = [va.run(each, radiation=made_up_radiation) for each in (loud, apart, phased)]
    bands = [run["baseline_band_level"].sel(at).dropna("baseline_band").values for run in runs]
    np.testing.assert_allclose(bands[2], [66.1, 60.2, 64.0, 50.0, 45.0], atol=1e-9)
    modelled = runs[1]["baseline_order_share"].sel(receiver="front_1m", speed=RPM).values
    quiet = modelled < 1.0
    assert not quiet.all()  # the made-up model is louder at 1x, where energies leave nothing
    np.testing.assert_allclose(bands[1][1:], [60.2, 64.0, 50.0, 45.0], atol=1e-9)
    np.testing.assert_allclose(bands[0][1:], [60.2, 64.0, 50.0, 45.0], atol=1e-9)
    assert runs[1]["baseline_order_phase"].sel(receiver="front_1m").max() == 0.0
    assert runs[2]["baseline_order_phase"].sel(receiver="front_1m").min() == 1.0


def test_orders_change_as_peaks_with_a_tacho_and_as_energies_without(tmp_path, study):
    """M - P0 + P1 at the crank angle of the study, against numbers of the same run."""
    angle = 35.0
    phased = baseline(study, tmp_path, {"orders.csv": ORDERS}, tacho_angle_deg=angle)
    plain = baseline(study, tmp_path, {"orders.csv": ORDERS})
    for asked, by_phase in ((phased, True), (plain, False)):
        run = va.run(asked, radiation=made_up_radiation).sel(receiver="front_1m", speed=RPM)
        lines = run["pressure_line"].sum("sound_source").isel(line=slice(1, 4))
        lines = lines.transpose("option", "line")
        for option in ("counterweight-full", "lanchester"):
            before, after = lines.sel(option="none").values, lines.sel(option=option).values
            order = np.arange(1, 4)
            size = np.sqrt(2.0) * 2e-5 * 10.0 ** (np.array([*TONES_DB.values()]) / 20.0)
            peak = size * np.exp(1j * order * np.radians(20.0 - angle))
            square = 0.5 * np.abs(peak - before + after) ** 2
            if not by_phase:
                left = np.maximum(0.5 * size**2 - 0.5 * np.abs(before) ** 2, 0.0)
                square = left + 0.5 * np.abs(after) ** 2
            level = 10.0 * np.log10(square / 4e-10)
            found = run["baseline_order_level"].sel(option=option).values
            np.testing.assert_allclose(found, level, atol=1e-9)
            line = run["order_level"].sel(option=option, weighting="Z", order=[1, 2, 3]).values
            np.testing.assert_allclose(line, level, atol=1e-9)
        assert run["level_total"].sel(option="none") > 70.0  # the catalogue's remainder stands


SPEEDS = "microphone,speed_rpm,order,level_db,phase_deg\n" + "\n".join(
    f"front_1m,{rpm},1,{level},{phase}"
    for rpm, level, phase in ((900, 60, 170), (940, 64, -150), (1000, 50, ""))
)


def test_between_speeds_level_and_phase_go_straight(tmp_path, study):
    """From 170° on to -150° by way of 180°; without phase where one end has none."""
    keys = {"tacho_angle_deg": 0.0}
    found = baseline(study, tmp_path, {"speeds.csv": SPEEDS}, **keys).measured.baseline
    points = measured_points(found, ["front_1m"], [890.0, 920.0, 940.0, 970.0, 1100.0])
    assert {speed for _, speed in points} == {890.0, 920.0, 940.0, 970.0}
    middle = points["front_1m", 920.0].peak[0]
    assert 20.0 * np.log10(abs(middle) / np.sqrt(2.0) / 2e-5) == pytest.approx(62.0)
    assert np.degrees(np.angle(middle)) % 360.0 == pytest.approx(190.0)
    assert points["front_1m", 940.0].has_phase[0]
    assert not points["front_1m", 970.0].has_phase[0]


HEAD = "microphone,speed_rpm,order,level_db\n"
WRONG = [
    ({"a.csv": "microphone,rpm\n"}, {}, "a.csv: rpm: unknown column; speed_rpm, band_hz, level"),
    ({"a.csv": HEAD + "front_1m,930,1,60\nfront_1m,930,1,6"}, {}, "order 1 is there twice"),
    ({"a.csv": HEAD + "front_1m,930,0,60"}, {}, "order = 0: must be above 0"),
    ({"a.csv": HEAD + "front_1m,930,1,60", "b.csv": HEAD + "front_1m,930,1,60"}, {},
     "front_1m: 930 rpm is there twice"),
    ({"a.csv": HEAD + "front_1m,930,1,60\nfront_1m,990,2,60"}, {}, "has other orders at another"),
    ({"a.xls": ""}, {}, "a.xls: must be one of .csv, .nc, .txt, .uff, .unv"),
    ({"a.csv": HEAD + "front_1m,930,1,60"}, {"tolerance_db": 0.0},
     "measured.baseline.tolerance_db = 0.0 dB: out of range; allowed from 0.1 to 10 dB"),
    ({"a.csv": HEAD + "front_1m,930,1,60"}, {"recorded_speed_rpm": [900]},
     "recorded_speed_rpm: 1 values, 0 files state no speed"),
    ({"a.csv": HEAD + "front_1m,930,1,60"}, {"microphones": {"side_1m": {"node": 1}}},
     "microphone side_1m: the files hold nothing of it"),
    ({"a.csv": "frequency [Hz],5 real [Pa],5 imaginary [Pa]\n1,1,1\n2,1,1\n3,1,1"}, {},
     "measured.baseline.microphones.front_1m = { node = 1 }; the file has spectrum 5"),
    ({"a.csv": "frequency [Hz],5 real [Pa]\n1,1\n2,1\n3,1"},
     {"microphones": {"front_1m": {"node": 5}}}, "states no speed: recorded_speed_rpm is missing"),
    ({"a.csv": "microphone,speed_rpm,frequency_hz,level_db\nfront_1m,930,1,6\nfront_1m,930,2,6\n"
      "front_1m,930,4,6"}, {}, "front_1m, 930 rpm: frequencies must be even and rise"),
    ({"a.csv": HEAD + "front_1m,930,1,60"}, {"third_octaves": []}, "unknown key"),
    ({"none.nc": None}, {}, "none.nc"),
]  # fmt: skip


@pytest.mark.parametrize(("files", "keys", "words"), WRONG)
def test_what_is_wrong_is_one_line(tmp_path, study, files, keys, words):
    with pytest.raises(va.ParameterError) as told:
        baseline(study, tmp_path, files, **keys)
    assert words in str(told.value)
    assert "\n" not in str(told.value)


def test_a_recording_without_a_microphone_of_the_study_is_refused(tmp_path, study):
    time = np.arange(4096) / 1024.0
    recording = va.label_recording(
        [np.cos(97.0 * time)] * 2, 1024.0, ["a", "front_1m"], ["Pa", "V"]
    )
    settings = va.OrderAnalysis(va.NominalSpeed(RPM), (1.0,), maximum_order=4.0)
    write_results(va.analyse_orders(recording, settings), tmp_path / "orders.nc")
    with pytest.raises(va.ParameterError, match=r"called as a receiver: .* there are a \[Pa\], fr"):
        baseline(study, tmp_path, {"orders.nc": None})
    named = {"microphones": {"front_1m": {"channel": "front_1m"}}}
    with pytest.raises(va.ParameterError, match="channel front_1m: is no channel in Pa"):
        baseline(study, tmp_path, {"orders.nc": None}, **named)
