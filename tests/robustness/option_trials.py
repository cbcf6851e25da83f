"""Hostile values of every option of every command, run in this process and judged."""

import os
import re
import resource
import signal
import subprocess
from collections.abc import Iterator, Mapping
from contextlib import chdir, contextmanager
from pathlib import Path
from types import FrameType
from typing import Any, Final, NamedTuple, get_args, get_origin

import numpy as np
from command_lines import command_lines
from support import command_here

import vibroacoustics as va
from vibroacoustics.commands.command import COMMANDS

NUMBERS: Final = (
    "0", "1e-9", "1e-300", "1e12", "1e300", "-1", "nan", "inf", "-inf", "abc", "", "1,5", "5 mm",
    "-1e300", "5e-324", "1e-3", "0.5", "3", "17", "1e3", "1e5", "1e7", "1e9", "1e18", "1e400",
    "1_0", "９", "0x10", "1" + 400 * "0",
)  # fmt: skip
"""Extremes, values between them, and spellings of numbers and of none."""
TEXTS: Final = (
    "", " ", "x" * 10_000, "no such name", "a\nb\x1b[31m\x07", "\udc80", "\u202eabc", "none,none",
    "=", "a=b", "a=b=c", "front=front", ",", ":", "1:2", "*", "../..", "front",
)  # fmt: skip
"""Empty, very long, unknown, control characters, no UTF-8, duplicates, separators alone."""
PATHS: Final = (
    "", "missing", "missing/deep", "folder", "empty.csv", "empty.toml", "empty.nc", "empty.wav",
    "picture.csv", "picture.toml", "picture.nc", "picture.wav", "picture.py", "empty.py", "pipe",
    "/dev/full", "x" * 300, "x/" * 3000, "\udc80.csv", "a\nb\x1b[31m.toml", "text.toml",
    "text.csv", "text.nc", "picture.csv/below", "link",
)  # fmt: skip
"""In a folder of files of other kinds: see `write_strange`."""
NUMBERS_IN: Final = {
    "--orders": ("{}", "1,{}", "{},{}"),
    "--comb": ("{}", "1,{}"),
    "--tacholess-line": ("0:{},4:2900", "{}:2900,4:2900", "0:2900,{}:2900"),
    "--point": ("p={},0,0", "p=0,0,{}"),
    "--calibration": ("front={}",),
    "--absorption-area": ("{}",),
    "--reverberation-time": ("{}",),
    "--channels": ("{}",),
    "--specimens": ("{}",),
}
"""Texts that hold numbers."""
TACHO: Final = ("--speed-channel", "tacho")
RANGE: Final = ("--tacholess", "2000", "4000")
CALIBRATOR: Final = ("--calibrator", "front=calibrator.wav")
COMPANIONS: Final = {
    "--speed-channel": ((), ("--pulses", "2")),
    "--pulses": (TACHO,),
    "--index": (TACHO,),
    "--threshold": (TACHO,),
    "--edge": (TACHO,),
    "--tacholess": ((), ("--speed-channel", "front")),
    "--comb": ((*RANGE, "--speed-channel", "front"),),
    "--mains": ((*RANGE, "--speed-channel", "front"),),
    "--tacholess-line": (("--speed-channel", "front"),),
    "--tacholess-machine": (("--speed-channel", "front"),),
    "--calibrator-level": (CALIBRATOR,),
    "--calibrator-frequency": (CALIBRATOR,),
    "--volume": (("--reverberation-time", "1"),),
    "--reverberation-time": (("--volume", "100"),),
    "--paper": (("--pdf",),),
    "--tls-ca": (("--scheduler", "tls://127.0.0.1:1"),),
    "--tls-cert": (("--scheduler", "tls://127.0.0.1:1"),),
    "--tls-key": (("--scheduler", "tls://127.0.0.1:1"),),
}
"""Options without which another option is refused."""
SPEEDS: Final = {"--speed-channel", "--pulses", "--index", "--threshold", "--edge", "--tacholess",
                 "--comb", "--mains", "--tacholess-line", "--tacholess-machine"}  # fmt: skip
"""Options in place of `--rpm`."""
MOST_PROCESSOR_S: Final = 20.0
MOST_BYTES: Final = 1_500_000_000
MOST_CHARACTERS: Final = 700
CONTROL: Final = re.compile(r"[\x00-\x09\x0b-\x1f\x7f-\x9f\u202e\ud800-\udfff]")


FEW_NUMBERS: Final = ("1e-300", "1e300", "nan")
FEW_TEXTS: Final = ("a\nb\x1b[31m\x07" + "x" * 10_000,)
TABLES: Final = ("blocked-forces", "check-functions", "hammer", "predict")
"""Commands that read a table from a file of any name."""
FEW_PATHS: Final = ("x" * 300,)
QUICKEST: Final = ("export", "map", "track", "replay", "sound-power", "datasheet", "listen", "new")
"""Commands in which an option that several have is tried where each is tried once."""


class Trial(NamedTuple):
    """A command line with one hostile value.

    Attributes
    ----------
    command, option : names; an argument has its name in place of that of an option
    value : hostile value
    words : all words
    """

    command: str
    option: str
    value: str
    words: list[str]


class Option(NamedTuple):
    """An option of a command: its name, its types, and how many values it takes."""

    name: str
    kinds: frozenset[type]
    count: int
    is_argument: bool


class Overdue(BaseException):
    """A trial takes more processor time than is allowed."""


def options_of(command: str) -> Iterator[Option]:
    """Options and arguments of a command that take a value."""
    for parameter in COMMANDS[command].typed().__signature__.parameters.values():  # type: ignore[attr-defined]
        hint, words = parameter.annotation.__origin__, parameter.annotation.__metadata__[0]
        kinds = frozenset(_types(hint))
        declared = getattr(words, "param_decls", None) or ()
        is_argument = type(words).__name__ == "ArgumentInfo"
        name = next(iter(declared), "") or f"--{parameter.name.replace('_', '-')}"
        count = 4 if parameter.name == "box" else 2 if parameter.name == "tacholess" else 1
        if kinds != {bool}:
            yield Option(parameter.name if is_argument else name, kinds, count, is_argument)


def _types(hint: Any) -> Iterator[type]:
    if get_origin(hint) is None:
        if hint not in (type(None), ...):
            yield hint
        return
    for part in get_args(hint):
        yield from _types(part)


def trials(
    folder: Path, lines: Mapping[str, list[str]], tried: set[str] | None = None
) -> Iterator[Trial]:
    """All trials of command lines; with a set, a few of each option that it does not name yet."""
    names = lines if tried is None else dict.fromkeys((*QUICKEST, *lines))
    for command in names:
        for option in options_of(command):
            if tried is not None and option.name in tried:
                continue
            bases = list(_bases(folder, lines[command], option))
            if tried is not None:
                tried.add(option.name)
                bases = bases[:1]
            for base in bases:
                for value in _values(option, tried is not None):
                    yield Trial(command, option.name, value, _with(base, option, value))


def _values(option: Option, are_few: bool) -> Iterator[str]:
    numbers = FEW_NUMBERS if are_few else NUMBERS
    if option.kinds & {float, int}:
        yield from numbers
    if str in option.kinds:
        yield from FEW_TEXTS if are_few else TEXTS
        for form in NUMBERS_IN.get(option.name, ())[: 1 if are_few else None]:
            yield from (form.format(number, number) for number in numbers)
    if Path in option.kinds or option.name in ("--calibrator", "--absorption-area"):
        yield from FEW_PATHS if are_few else PATHS


def _bases(folder: Path, words: list[str], option: Option) -> Iterator[list[str]]:
    """Command lines that the option is added to: a steady recording, a run-up and silence."""
    run_up = [word.replace("recording.csv", "run_up.csv") for word in words]
    if option.name in SPEEDS:
        words = run_up = _without(run_up, "--rpm")
    if option.name == "--box":
        words = _without(words, "--hemisphere")
    tone = str(folder / "inputs" / "calibrator.wav")
    for further in COMPANIONS.get(option.name, ((),)):
        yield [*words, *(word.replace("calibrator.wav", tone) for word in further)]
    if option.kinds & {float, int} and "--rpm" in words:
        yield [*_without(run_up, "--rpm"), *TACHO]
        yield [word.replace("recording.csv", "silent.csv") for word in words]


def _without(words: list[str], option: str) -> list[str]:
    """Words without an option and its value."""
    at = words.index(option)
    return [*words[:at], *words[at + 2 :]]


def _with(base: list[str], option: Option, value: str) -> list[str]:
    """Words with a value of an option, or in place of an argument."""
    if not option.is_argument:
        others = ["1"] * (option.count - 1)
        return [*base, option.name, *others, value] if others else [*base, f"{option.name}={value}"]
    at = 2 if option.name == "others" else 1
    behind = base[at + 1 :] if at < len(base) and not base[at].startswith("--") else base[at:]
    return [*base[:at], *behind, "--", *base[1:at], value]


def remove(folder: Path) -> None:
    """Remove a folder of any depth; Python's own function recurses."""
    subprocess.run(["rm", "-rf", "--", str(folder)], check=True)


def write_strange(folder: Path) -> None:
    """Write files of other kinds, and the recordings that the trials need."""
    remove(folder)
    (folder / "folder").mkdir(parents=True)
    for suffix in ("csv", "toml", "nc", "wav", "py"):
        (folder / f"empty.{suffix}").write_bytes(b"")
        (folder / f"picture.{suffix}").write_bytes(b"\x89PNG\r\n\x1a\n" + bytes(range(256)) * 4)
        (folder / f"text.{suffix}").write_text("a = 1\n")
    os.mkfifo(folder / "pipe")
    (folder / "link").symlink_to("link")


def write_recordings(folder: Path) -> None:
    """Write a run-up with tacho and speed, silence, and the recording of a calibrator."""
    time_s = np.arange(4 * 8000) / 8000.0
    rpm = 2000.0 + 400.0 * time_s
    angle = 2.0 * np.pi * np.cumsum(rpm / 60.0) / 8000.0
    noise = 0.01 * np.random.default_rng(1).standard_normal(time_s.size)
    front = noise + np.cos(angle) + 0.5 * np.cos(2.0 * angle)
    tacho = (np.cos(angle) > 0.9).astype(float)
    label = va.label_recording
    run_up = label([front, tacho, rpm], 8000.0, ["front", "tacho", "speed"], ["Pa", "V", "rpm"])
    va.export_recording(run_up, folder / "run_up.csv")
    silent = label([0.0 * time_s, tacho, rpm], 8000.0, ["front", "tacho", "speed"],
                   ["Pa", "V", "rpm"])  # fmt: skip
    va.export_recording(silent, folder / "silent.csv")
    tone = label([np.sqrt(2.0) * np.cos(2000.0 * np.pi * time_s)], 8000.0, ["front"], ["Pa"])
    va.export_recording(tone, folder / "calibrator.wav")


def prepared(folder: Path) -> dict[str, list[str]]:
    """Write all files; returns the command lines."""
    lines = command_lines(folder)
    if not (folder / "inputs" / "run_up.csv").exists():
        write_recordings(folder / "inputs")
    return lines


def fault(folder: Path, trial: Trial) -> str:
    """What is wrong with the outcome of a trial; nothing where it is as it should be."""
    strange = folder / "strange"
    write_strange(strange)
    remove(folder / "out")
    try:
        with chdir(strange), _bounded():
            outcome = command_here(*trial.words)
    except Overdue:
        return f"takes more than {MOST_PROCESSOR_S:g} s"
    except BaseException as error:
        if isinstance(error, KeyboardInterrupt):
            raise
        last = error.__traceback__
        while last is not None and last.tb_next is not None:
            last = last.tb_next
        place = "" if last is None else f"{last.tb_frame.f_code.co_filename}:{last.tb_lineno}"
        return f"traceback: {type(error).__name__}: {str(error)[:100]} {place[-60:]}"
    # All refusals of a table are printed, whatever the name of the file.
    is_table = trial.value.endswith((".toml", ".csv")) or trial.command in TABLES
    return _judged(outcome.returncode, outcome.stdout, outcome.stderr, is_table)


def _judged(code: int, output: str, errors: str, is_table: bool) -> str:
    """What is wrong with exit code and messages."""
    lines = errors.splitlines()
    count = sum(line.startswith("error: ") for line in lines)
    longest = max(map(len, lines), default=0)
    wrong = {
        f"exit code {code}": code not in range(4),
        "traceback": "Traceback" in output + errors,
        f"{count} error lines": (count > 0) != (code == 2) or (count > 1 and not is_table),
        "words of Python": "not enough memory" in errors or "Errno" in errors,
        f"line of {longest} characters": longest > MOST_CHARACTERS,
        "control characters": bool(CONTROL.search(errors)),
    }
    return "".join(f"{words}: {errors[:200]!r}" for words, is_so in wrong.items() if is_so)


@contextmanager
def _bounded() -> Iterator[None]:
    """Limit processor time and memory."""

    def overdue(number: int, _: FrameType | None) -> None:
        raise Overdue

    status = Path("/proc/self/statm").read_text().split()
    present = int(status[0]) * resource.getpagesize()
    before = resource.getrlimit(resource.RLIMIT_AS)
    handler = signal.signal(signal.SIGPROF, overdue)
    resource.setrlimit(resource.RLIMIT_AS, (present + MOST_BYTES, before[1]))
    signal.setitimer(signal.ITIMER_PROF, MOST_PROCESSOR_S)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        resource.setrlimit(resource.RLIMIT_AS, before)
        signal.signal(signal.SIGPROF, handler)
