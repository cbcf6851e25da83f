"""Systems and limits that the package refuses: a line, exit code 2, before anything heavy loads."""

import json
import re
import subprocess
import sys
from pathlib import Path

import pytest
from support import TINY

WITHOUT_LOCKS = """
import sys
sys.modules["fcntl"] = None  # as on Windows
sys.argv = ["vibroacoustics", "doctor", "--json"]
from vibroacoustics.__main__ import main
main()
"""
LIMITED = "ulimit -v {kilobytes}; exec {python} -m vibroacoustics {words}"


def test_a_system_without_locks_is_refused() -> None:
    outcome = subprocess.run(
        [sys.executable, "-c", WITHOUT_LOCKS], capture_output=True, text=True, check=False
    )
    assert outcome.returncode == 2
    assert outcome.stderr.startswith("error: vibroacoustics runs on Linux and macOS; on Windows")
    assert outcome.stderr.count("\n") == 1
    envelope = json.loads(outcome.stdout)
    assert envelope["command"] == "doctor"
    assert [f"error: {each['message']}\n" for each in envelope["errors"]] == [outcome.stderr]


@pytest.mark.parametrize(
    ("gigabytes", "refused"),
    [(0.6, True), (1.0, True), pytest.param(0.8, True, marks=pytest.mark.long),
     pytest.param(1.2, False, marks=pytest.mark.long)],
)  # fmt: skip
def test_a_limit_of_memory_gives_a_result_or_a_line(
    tmp_path: Path, gigabytes: float, refused: bool
) -> None:
    words = f"run {TINY} --out {tmp_path / 'out'}"
    line = LIMITED.format(kilobytes=int(1e6 * gigabytes), python=sys.executable, words=words)
    outcome = subprocess.run(
        ["sh", "-c", line], capture_output=True, text=True, check=False, timeout=60
    )
    said = [one for one in outcome.stderr.splitlines() if not one.startswith("progress: ")]
    assert outcome.returncode == (2 if refused else 0), outcome.stderr
    assert len(said) == refused
    if refused:
        assert "memory of a process is limited to" in said[0]
        assert "GB at least" in said[0]
    assert (tmp_path / "out" / "results.nc").exists() is not refused


def test_only_one_module_imports_what_windows_lacks() -> None:
    package = Path(sys.modules["support"].__file__ or "").resolve().parents[2] / "vibroacoustics"
    lacking = re.compile(r"(?m)^\s*import (fcntl|resource)$|SIGALRM")
    found = {path.name for path in package.rglob("*.py") if lacking.search(path.read_text("utf-8"))}
    assert found == {"posix.py"}


def test_nothing_imports_a_package_named_tests() -> None:
    """A dependency installs a folder of that name beside the packages."""
    root = Path(__file__).parents[2]
    for folder in ("vibroacoustics", "tests", "benchmarks", "docs"):
        for path in (root / folder).rglob("*.py"):
            text = path.read_text(encoding="utf-8")
            assert not any(
                line.lstrip().startswith(("import tests", "from tests"))
                for line in text.splitlines()
            ), path
