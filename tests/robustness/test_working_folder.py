"""No process of the package imports a module of the working folder: all kinds of helpers."""

import json
import os
import subprocess
import sys
import textwrap
import time
from importlib.metadata import packages_distributions
from pathlib import Path

import pytest
from command_lines import command_lines
from support import ROOT, TINY

PROGRAM = Path(sys.executable).parent / "vibroacoustics"
MARKER = """
import posix
file = posix.open({file!r}, posix.O_WRONLY | posix.O_APPEND | posix.O_CREAT)
posix.write(file, b"{name}\\n")
posix.close(file)
"""
NAMES = {*sys.stdlib_module_names, *packages_distributions(), "sitecustomize", "usercustomize"}

STARTS = {
    "worker started afresh": """
        from vibroacoustics.base.processes import ProcessPool
        import math
        with ProcessPool(2) as pool:
            assert list(pool.in_order(math.sqrt, [1.0, 4.0])) == [1.0, 2.0]
    """,
    "copied worker": """
        from vibroacoustics.base.processes import ProcessPool
        with ProcessPool(2, inherited=lambda number: number + 1) as pool:
            assert list(pool.in_order(pool._inherited, [1, 2])) == [2, 3]
    """,
    "reader of recordings": """
        import vibroacoustics as va
        recording = va.label_recording([[0.0, 0.5, 0.0]], 1000.0, ["front"], ["Pa"])
        va.read_recording(va.export_recording(recording, {folder!r} + "/front.csv"))
    """,
    "browser": """
        from vibroacoustics.commands.printing import printer
        printer(True, None).printed(b"<!doctype html><html><head></head><body>one</body></html>")
    """,
    "git": """
        from vibroacoustics.results.provenance import git_revision
        git_revision()
    """,
    "process that a library starts": """
        import subprocess, sys
        from vibroacoustics.base.process_start import omit_working_folder
        omit_working_folder()
        subprocess.run([sys.executable, "-c", "import json"], check=True)
    """,
}


@pytest.fixture(scope="module")
def markers(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder with a module of every name that a process may import; each leaves its name."""
    folder = tmp_path_factory.mktemp("markers")
    file = str(folder.parent / f"{folder.name}.txt")
    for name in NAMES:
        if name.isidentifier():
            (folder / f"{name}.py").write_text(MARKER.format(file=file, name=name))
    return folder


def imported(folder: Path) -> list[str]:
    """Names that markers have left; they are forgotten."""
    file = folder.with_suffix(".txt")
    names = file.read_text().splitlines() if file.exists() else []
    file.unlink(missing_ok=True)
    return names


def run_in(
    folder: Path, command: list[str], cache: Path, **variables: str
) -> subprocess.CompletedProcess[str]:
    environment = {**os.environ, "XDG_CACHE_HOME": str(cache), **variables}
    return subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, text=True, check=False,
        timeout=600,
    )  # fmt: skip


def test_markers_are_seen(markers: Path, tmp_path: Path) -> None:
    run_in(markers, [sys.executable, "-c", "import json"], tmp_path)
    assert "json" in imported(markers)


@pytest.mark.parametrize("kind", STARTS)
def test_helper_process_imports_no_module_of_the_working_folder(
    kind: str, markers: Path, tmp_path: Path
) -> None:
    script = tmp_path / "script.py"
    body = textwrap.dedent(STARTS[kind]).replace("{folder!r}", repr(str(tmp_path)))
    script.write_text(f"if __name__ == '__main__':\n{textwrap.indent(body, '    ')}")
    done = run_in(markers, [sys.executable, str(script)], tmp_path)
    assert (done.returncode, imported(markers)) == (0, []), done.stderr


def test_run_imports_no_module_of_the_working_folder(markers: Path, tmp_path: Path) -> None:
    words = ["run", str(TINY), "--out", str(tmp_path / "out"), "--coarse"]
    done = run_in(markers, [str(PROGRAM), *words], tmp_path)
    assert (done.returncode, imported(markers)) == (0, []), done.stderr


@pytest.mark.long
def test_no_command_imports_a_module_of_the_working_folder(markers: Path, tmp_path: Path) -> None:
    """Every command, with its page as PDF and with two workers where it has them."""
    for name, words in command_lines(tmp_path).items():
        text = run_in(tmp_path, [str(PROGRAM), name, "-h"], tmp_path).stdout
        further = ["--pdf"] if "--pdf" in text else []
        further += ["--workers", "2"] if "--workers" in text and "--workers" not in words else []
        done = run_in(markers, [str(PROGRAM), *words, *further], tmp_path)
        assert (name, imported(markers)) == (name, [])
        assert done.returncode in (0, 1, 3), f"{words}: {done.stderr}"


@pytest.mark.long
def test_scheduler_and_its_workers_import_no_module_of_the_working_folder(
    markers: Path, tmp_path: Path
) -> None:
    """They are started as the page says: with PYTHONSAFEPATH, from this folder."""
    pytest.importorskip("distributed")
    assert "PYTHONSAFEPATH=1 dask worker" in (ROOT / "docs" / "designs.md").read_text()
    program = str(PROGRAM.with_name("dask"))
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    environment = {**os.environ, "PYTHONSAFEPATH": "1", "XDG_CACHE_HOME": str(tmp_path)}
    address = tmp_path / "scheduler.json"
    services = [
        [program, "scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard",
         "--dashboard-address", "127.0.0.1:0", "--scheduler-file", str(address)],
        [program, "worker", "--scheduler-file", str(address), "--nthreads", "1",
         "--host", "127.0.0.1", "--no-dashboard", "--dashboard-address", "127.0.0.1:0",
         "--local-directory", str(tmp_path)],
    ]  # fmt: skip
    started = [subprocess.Popen(each, cwd=markers, env=environment, **quiet) for each in services]
    try:
        for _ in range(600):
            if address.exists() and address.read_text().endswith("}"):
                break
            time.sleep(0.1)
        where = json.loads(address.read_text())["address"]
        words = ["run", str(TINY), "--out", str(tmp_path / "out"), "--no-cache"]
        words += ["--scheduler", where, "--insecure"]
        done = run_in(markers, [str(PROGRAM), *words], tmp_path)
        assert (done.returncode, imported(markers)) == (0, []), done.stderr
    finally:
        for service in started:
            service.terminate()
            service.wait(30)
