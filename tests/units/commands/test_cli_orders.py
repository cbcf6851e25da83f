"""`orders` and `compare` as a user meets them: files, tables, one-line errors."""

import csv
from pathlib import Path

import numpy as np
import pytest
from support import ROOT, assert_refused, command, command_here, tiny_run, without_warnings

from vibroacoustics import label_recording, open_results
from vibroacoustics.commands import printing
from vibroacoustics.recordings import csv_bytes, wav_bytes
from vibroacoustics.results import storage
from vibroacoustics.results.storage import write_results

MOTOR = ROOT / "data" / "recordings" / "electric_motor_vibration.uff"
RATE_HZ = 3200.0
ANGLE = 1.0 + 2.0 * np.pi * 2900.0 / 60.0 * np.arange(6400) / RATE_HZ
TACHO = np.where(ANGLE % (2.0 * np.pi) < 0.6, 5.0, 0.0)
FORCE = 0.3 * np.cos(ANGLE + 0.2) + 0.1 * np.cos(2.0 * ANGLE)
RECORDING = label_recording(
    [FORCE, 0.02 * FORCE, TACHO],
    RATE_HZ,
    ["shell", "microphone 1", "tacho"],
    ["m/s²", "Pa", "V"],
)


@pytest.fixture(scope="module")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Path:
    file = tmp_path_factory.mktemp("recording") / "machine.csv"
    file.write_bytes(csv_bytes(RECORDING))
    return file


@pytest.fixture(scope="module")
def analysed(recording: Path) -> Path:
    """Folder of an analysis with everything that can be drawn."""
    out = recording.parent / "out"
    outcome = command_here("orders", recording, "--speed-channel", "tacho", "--map", "--out", out)
    assert outcome.returncode == 0, outcome.stderr
    assert outcome.stderr == ""
    assert f": {out / 'orders.nc'}\n" in outcome.stdout
    assert "speed: tacho tacho, 1 pulse a revolution" in outcome.stdout
    assert "crank angle zero: pulse of tacho" in outcome.stdout
    assert "microphone 1" in outcome.stdout
    return out


def test_orders_writes_everything(analysed: Path) -> None:
    assert {path.name for path in analysed.iterdir()} == {
        "orders.nc",
        "orders.html",
        "files.json",
        "orders.csv",
        "orders_conditions.csv",
        "levels.csv",
        "vibration.csv",
        "spectrum_1_shell.svg",
        "spectrum_2_microphone_1.svg",
        "map_1_shell.svg",
        "map_2_microphone_1.svg",
    }
    results = open_results(analysed / "orders.nc")  # the hash fits
    peak = abs(results["channel_order"].sel(channel="shell").squeeze().values)
    np.testing.assert_allclose(peak[:2], [0.3, 0.1], rtol=1e-3)
    with (analysed / "orders.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 2 * 2  # orders 1 and 2; no other stands out
    assert (rows[0]["channel"], rows[0]["unit"], rows[0]["order"]) == ("shell", "m/s²", "1")
    assert float(rows[0]["amplitude_peak"]) == pytest.approx(0.3, rel=1e-3)
    assert float(rows[0]["frequency_hz"]) == pytest.approx(2900.0 / 60.0, rel=1e-4)
    with (analysed / "levels.csv").open() as file:
        levels = {row["weighting"]: row for row in csv.DictReader(file)}
    assert set(levels) == {"Z", "A", "C"}
    mean_square = 0.5 * 0.02**2 * (0.3**2 + 0.1**2)
    # 96.67 revolutions: the part beyond whole ones puts less than 0.1 dB on the mean square
    level = 10.0 * np.log10(mean_square) - 20.0 * np.log10(20e-6)
    assert float(levels["Z"]["leq_db"]) == pytest.approx(level, abs=0.1)


def test_page_of_the_orders(analysed: Path) -> None:
    page = (analysed / "orders.html").read_text(encoding="utf-8")
    assert page.count("data:image/svg+xml;base64,") == len(list(analysed.glob("*.svg")))
    for words in ("microphone 1", "speed: tacho tacho", "Orders are multiples of the shaft"):
        assert words in page
    assert "balancing" not in page
    assert "<script" not in page


def test_pictures_are_whole(analysed: Path) -> None:
    for path in analysed.glob("*.svg"):
        assert path.read_text("utf-8").endswith("</svg>\n"), path.name


def test_wav_with_units_and_calibration(tmp_path: Path) -> None:
    (tmp_path / "a.wav").write_bytes(wav_bytes(RECORDING))
    outcome = command_here(
        "orders", tmp_path / "a.wav", "--speed-channel", "channel 3", "--out", tmp_path / "out",
        "--channels", "channel 1,channel 3", "--unit", "channel 1=m/s²", "--unit", "channel 3=V",
        "--calibration", "channel 1=2", "--orders", "2,1",
    )  # fmt: skip
    assert outcome.returncode == 0, outcome.stderr
    results = open_results(tmp_path / "out" / "orders.nc")
    peak = abs(results["channel_order"].squeeze().values)
    np.testing.assert_allclose(peak, [0.6, 0.2], rtol=1e-3)
    assert results["calibration_factor"].item() == 2.0


def test_a_real_recording_without_a_tacho(tmp_path: Path) -> None:
    """Vibration of a motor whose speed is not known: the warning says how little is known."""
    outcome = command_here("orders", MOTOR, "--tacholess", 500, 6000, "--out", tmp_path)
    assert outcome.returncode == 0, outcome.stderr
    (line,) = outcome.stderr.splitlines()
    assert line.startswith("warning: the speed found, ")
    assert " rpm, is uncertain: confidence 0." in line
    assert " rpm is the next best; name the mains frequency, give the comb" in line
    assert "crank angle zero: none" in outcome.stdout
    results = open_results(tmp_path / "orders.nc")
    assert results.attrs["source_file"] == MOTOR.name
    assert np.all(np.isfinite(results["channel_order_rms"]))


def test_compare_study_with_recording(analysed: Path, tmp_path: Path) -> None:
    study = write_results(tiny_run(), tmp_path / "study" / "results.nc")
    outcome = command_here(
        "compare", study, analysed / "orders.nc", "--pair", "acceleration tx=shell",
        "--option", "counterweight-half", "--out", tmp_path / "out",
    )  # fmt: skip
    assert outcome.returncode == 0, outcome.stderr
    assert outcome.stderr == ""
    assert "A: Tiny study for tests" in outcome.stdout
    assert "B: machine.csv; crank angle zero: pulse of tacho" in outcome.stdout
    assert {path.name for path in (tmp_path / "out").iterdir()} == {
        "compared_orders.nc",
        "files.json",
        "compared_orders.csv",
        "compared_conditions.csv",
        "compared.html",
        "compared_1_acceleration_tx.svg",
        "compared_differences.svg",
    }
    compared = open_results(tmp_path / "out" / "compared_orders.nc")
    assert abs(compared["compared_order"].sel(order=1).item()) == pytest.approx(0.3, rel=1e-3)
    assert compared.attrs["option"] == "counterweight-half"


def test_compare_with_itself_beside_it(analysed: Path, tmp_path: Path) -> None:
    """Without --out the comparison goes beside the second result; --tacho-angle is in degrees."""
    copy = storage.write_results(open_results(analysed / "orders.nc"), tmp_path / "orders.nc")
    outcome = command_here("compare", analysed / "orders.nc", copy, "--tacho-angle", 30)
    assert outcome.returncode == 0, outcome.stderr
    compared = open_results(tmp_path / "compared_orders.nc")
    phase = np.degrees(compared["order_phase_difference"].sel(channel="shell", order=[1, 2]))
    np.testing.assert_allclose(phase.squeeze(), [-30.0, -60.0], atol=1e-9)


def test_orders_on_paper(recording: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """With --pdf the page is printed beside itself."""
    browser = printing.Printer("", "a4")
    monkeypatch.setattr(printing, "printer", lambda *_: browser)
    monkeypatch.setattr(printing.Printer, "printed", lambda *_: b"%PDF")
    out = tmp_path / "out"
    outcome = command_here("orders", recording, "--speed-channel", "tacho", "--out", out, "--pdf")
    assert outcome.returncode == 0, outcome.stderr
    assert f"pdf: {out / 'orders.pdf'}" in outcome.stdout
    assert (out / "orders.pdf").read_bytes() == b"%PDF"


def test_orders_and_comparison_with_limits(recording: Path, tmp_path: Path) -> None:
    """Broken limits are reported with exit code 1; without limits their file is removed."""
    limits, out = tmp_path / "limits.csv", tmp_path / "out"
    limits.write_text("channel,order,limit,unit\nshell,1,0.2,m/s²\n*,2,40,dB\n", encoding="utf-8")
    to = ("orders", recording, "--speed-channel", "tacho", "--out", out)
    outcome = command_here(*to, "--limits", limits)
    assert outcome.returncode == 1, outcome.stderr
    assert "1 of 2 orders exceeds its limit, the worst by 0.5 dB: order 1 of sh" in outcome.stdout
    assert (out / "orders_limits.csv").is_file()
    with (out / "orders_limits.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert [(row["channel"], row["within"]) for row in rows] == [
        ("shell", "no"),
        ("microphone 1", "yes"),
    ]
    assert not open_results(out / "orders.nc")["within_limit"].all()
    orders = out / "orders.nc"
    outcome = command_here("compare", orders, orders, "--limits", limits)
    assert outcome.returncode == 1, outcome.stderr
    assert outcome.stderr == ""
    assert "2 of 4 orders exceed their limits" in outcome.stdout
    broken = [line for line in outcome.stdout.splitlines() if line.startswith("broken: ")]
    assert [line.split(" at ")[0] for line in broken] == ["broken: order 1 of shell"] * 2
    assert (out / "compared_orders_limits.csv").is_file()
    assert command_here(*to).returncode == 0
    assert not (out / "orders_limits.csv").exists()


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("shell,1,x,N", "limits.csv: line 2: limit = x: must be a finite number"),
        ("shell,1,60,dB", "limits.csv: line 2: unit = 'dB': channel 'shell' is in m/s²"),
        ("shel,1,1,N", "limits.csv: line 2: channel = 'shel', in N: must be one of shell"),
    ],
)
def test_limits_that_are_refused(line: str, words: str, recording: Path, tmp_path: Path) -> None:
    limits = tmp_path / "limits.csv"
    limits.write_text(f"channel,order,limit,unit\n{line}\n", encoding="utf-8")
    to = ("--speed-channel", "tacho", "--out", tmp_path / "out", "--limits", limits)
    assert_refused(command_here("orders", recording, *to), words)
    assert not (tmp_path / "out").exists()


# --- what is refused -----------------------------------------------------------------------------


def table(*rows: str) -> bytes:
    return "\n".join(["time [s],force [N],tacho [V]", *rows, ""]).encode()


def with_tacho(samples) -> bytes:
    made = label_recording([FORCE, samples], RATE_HZ, ["force", "tacho"], ["N", "V"])
    return csv_bytes(made)


def with_speed(speed_rpm) -> bytes:
    made = label_recording([FORCE, speed_rpm], RATE_HZ, ["force", "tacho"], ["N", "rpm"])
    return csv_bytes(made)


def wave_claiming_10_gb() -> bytes:
    """RF64 whose long sizes claim 10 GB of samples."""
    head = b"RF64" + (2**32 - 1).to_bytes(4, "little") + b"WAVE"
    size = 10 * 2**30
    sizes = b"".join(n.to_bytes(8, "little") for n in (size + 64, size, size // 8))
    form = b"fmt \x10\0\0\0\x03\0\x01\0" + (1000).to_bytes(4, "little")
    form += (8000).to_bytes(4, "little") + b"\x08\0\x40\0"
    data = b"data" + (2**32 - 1).to_bytes(4, "little") + bytes(800)
    return head + b"ds64\x1c\0\0\0" + sizes + bytes(4) + form + data


BAD_RECORDINGS = {
    "empty.csv": (b"", ["is empty"]),
    "truncated.wav": (wav_bytes(RECORDING)[:30], ["truncated or was never finished"]),
    "truncated.uff": (MOTOR.read_bytes()[:3000], []),
    "nan.csv": (table("0,1,0", "1,nan,5", "2,3,0"), ["channel 'force'", "sample 2", "nan"]),
    "back.csv": (table("0,1,0", "2,2,5", "1,3,0"), ["time does not grow from sample 2 (2 s)"]),
    "twice.csv": (table("0,1,0", "1,2,5", "1,3,0"), ["time does not grow"]),
    "no_pulses.csv": (with_tacho(np.zeros(6400)), ["no pulses", "constant at 0"]),
    "two_pulses.csv": (with_tacho(TACHO * (np.arange(6400) < 150)), ["pulses", "at least 3"]),
    "noise.csv": (
        with_tacho(np.random.default_rng(4).standard_normal(6400)), ["do not follow each other"],
    ),
    "stopped.csv": (with_speed(np.zeros(6400)), ["speed: falls to 0 rpm"]),
    "stops.csv": (with_speed(np.linspace(1000.0, -1000.0, 6400)), ["without a stop"]),
    "unit.csv": (b"time [s],force [K],tacho [Z]\n0,1,0\n1,2,5\n", ["unit 'K' is unknown"]),
    "no_unit.csv": (b"time [s],force,tacho [V]\n0,1,0\n1,2,5\n", ["states no unit for 'force'"]),
    "10_gb.wav": (wave_claiming_10_gb(), ["10_gb.wav: "]),
    "unknown.mp3": (b"x", ["format '.mp3' is unknown"]),
}  # fmt: skip


@pytest.mark.parametrize("name", BAD_RECORDINGS)
def test_bad_recordings(name: str, tmp_path: Path) -> None:
    """One clear line that names the file, exit code 2, no traceback, nothing written."""
    content, words = BAD_RECORDINGS[name]
    file = tmp_path / name
    file.write_bytes(content)
    outcome = command_here("orders", file, "--speed-channel", "tacho", "--out", tmp_path / "out")
    assert_refused(without_warnings(outcome), name, *words)  # a dead tacho has one
    assert outcome.stdout == ""
    assert list(tmp_path.iterdir()) == [file]


@pytest.mark.long
def test_a_refusal_is_no_traceback(tmp_path: Path) -> None:
    """In a process of its own; the other refusals are the same `main` in this one."""
    empty = tmp_path / "empty.csv"
    empty.write_bytes(b"")
    assert_refused(command("orders", empty, "--rpm", 2900, cache=tmp_path), "empty.csv: is empty")


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ([], ["give one of --speed-channel CHANNEL, --rpm NUMBER, --tacholess LOWEST"]),
        (["--speed-channel", "tacho", "--rpm", 2900], ["give one of --speed"]),
        (["--tacholess", 1000, 4000, "--rpm", 2900], ["give one of --speed"]),
        (["--rpm", 0], ["--rpm = 0 rpm"]),
        (["--rpm", "inf"], ["--rpm = inf rpm"]),
        (["--rpm", 2900, "--index", "tacho"], ["--threshold, --edge: belong to a tacho"]),
        (["--rpm", 2900, "--pulses", 60], ["--index, --pulses, --threshold"]),
        (["--rpm", 2900, "--threshold", 1], ["--threshold, --edge: belong to a tacho"]),
        (["--rpm", 2900, "--edge", "rising"], ["--threshold, --edge: belong to a tacho"]),
        (
            ["--speed-channel", "tacho", "--edge", "up"],
            ["--edge 'up': must be one of rising, falling"],
        ),
        (
            ["--speed-channel", "tacho", "--threshold", "nan"],
            ["--threshold = nan: must be -1e+12 to 1e+12"],
        ),
        (["--tacholess", 4000, 1000], ["--tacholess, lowest = 4000 rpm: must be below"]),
        (["--tacholess", 1000, 4000], ["name the channel to find it in, one of shell"]),
        (["--speed-channel", "tach"], ["machine.csv: speed: no channel 'tach'; there are shell"]),
        (["--speed-channel", "tacho", "--pulses", 0], ["--pulses = 0"]),
        (["--rpm", 2900, "--orders", "1,x"], ["--orders: 'x' is no number"]),
        (["--rpm", 2900, "--orders", "1,1"], ["--orders = (1.0, 1.0)"]),
        (["--rpm", 2900, "--orders", "-1"], ["--orders = -1"]),
        (["--rpm", 2900, "--orders", "1e6"], ["--orders = 1e+06: must be 0.001 to 10000"]),
        (["--rpm", 2900, "--maximum-order", 100], ["--maximum-order = 100", "at most 29.79"]),
        (["--rpm", 2900, "--resolution", "nan"], ["--resolution = nan"]),
        (["--rpm", 2900, "--resolution", 0.001], ["needs blocks of 1500 revolutions"]),
        (["--rpm", 2900, "--speed-step", 0], ["--speed-step = 0 rpm"]),
        (["--rpm", 2900, "--unit", "shell"], ["--unit 'shell': must be NAME=VALUE"]),
        (["--rpm", 2900, "--unit", "shel=N"], ["--unit: no channel 'shel'"]),
        (["--rpm", 2900, "--calibration", "shell=x"], ["--calibration: 'x' is no number"]),
        (["--rpm", 2900, "--channels", "a,b"], ["channel 'a': not in the file"]),
        (["--rpm", 2900, "--from", -1], ["--from = -1 s: must be 0 to 1e+09 s"]),
        (["--rpm", 2900, "--from", 2, "--to", 1], ["--to = 1 s: must lie behind --from = 2 s"]),
        (["--rpm", 2900, "--from", 1e6], ["--from = 1e+06 s", "holds no samples"]),
        (["--rpm", 2900, "--sample-rate", 0], ["--sample-rate = 0 Hz"]),
    ],
)
def test_bad_options(
    options: list[object], words: list[str], recording: Path, tmp_path: Path
) -> None:
    outcome = command_here("orders", recording, *options, "--out", tmp_path / "out")
    assert_refused(outcome, *words)
    assert not (tmp_path / "out").exists()


def test_folder_that_cannot_be_written(recording: Path, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    out = tmp_path / "file" / "out"
    outcome = command_here("orders", recording, "--speed-channel", "tacho", "--out", out)
    assert_refused(outcome, "file/out", "cannot be written")


def test_comparisons_that_are_refused(analysed: Path, tmp_path: Path) -> None:
    orders = analysed / "orders.nc"
    out = ("--out", tmp_path / "out")
    assert_refused(
        command_here("compare", orders, orders, "--pair", "shell", *out),
        "--pair 'shell': must be NAME=VALUE",
    )
    assert_refused(
        command_here("compare", orders, orders, "--pair", "shell=microphone 1", *out),
        "pair shell=microphone 1: units differ, m/s² and Pa",
    )
    assert_refused(
        command_here("compare", orders, tmp_path / "none.nc", *out),
        "none.nc: no such file",
    )
    damaged = tmp_path / "orders.nc"
    damaged.write_bytes(orders.read_bytes()[:-1])
    assert_refused(command_here("compare", orders, damaged, *out), "has no hash")
    assert not (tmp_path / "out").exists()


def test_orders_are_no_run(analysed: Path) -> None:
    """`report` and `score` want results of `run`."""
    for name in ("report", "score"):
        outcome = command_here(name, analysed / "orders.nc")
        assert_refused(outcome, "orders.nc: holds no run")


def test_comb_and_mains_belong_to_tacholess(recording: Path, tmp_path: Path) -> None:
    outcome = command_here("orders", recording, "--rpm", 2900, "--comb", "1,2", "--out", tmp_path)
    assert_refused(outcome, "--comb, --mains: belong to --tacholess LOWEST HIGHEST")


def test_comb_and_bands_that_are_none(recording: Path, tmp_path: Path) -> None:
    speed = ("--speed-channel", "shell", "--tacholess", 2000, 4000)
    outcome = command_here("orders", recording, *speed, "--comb", "1,x", "--out", tmp_path)
    assert_refused(outcome, "--comb: 'x' is no number")
    outcome = command_here("orders", recording, *speed, "--bands", "x", "--out", tmp_path)
    assert_refused(outcome, "--bands 'x': must be one of sums, filters")


def test_comb_and_mains_of_the_user(recording: Path, tmp_path: Path) -> None:
    outcome = command_here(
        "orders", recording, "--speed-channel", "shell", "--tacholess", 2000, 4000, "--comb", "1,2",
        "--mains", 50, "--bands", "filters", "--out", tmp_path,
    )  # fmt: skip
    assert (
        "within 2000 to 4000 rpm, without mains of 50 Hz; lines at 2 of 2 orders" in outcome.stdout
    )
    assert "third octaves in levels.csv by IEC 61260-1 filters" in outcome.stdout
