"""Tests on every Python that pyproject.toml promises; a version that is not here is named.

    python tests/on_every_python.py [--newest] [--folder FOLDER OF THE ENVIRONMENTS] [3.12 …]

With the locked packages the light tests. With the newest ones, beside k-Wave without its pins, the
tests of the radiation as well. A table shows versions and outcomes. Interpreters are looked for on
the path and among pyenv's; each environment needs the package index once, the newest each time.
"""

import argparse
import json
import os
import re
import shutil
import subprocess
import sys
import tomllib
from collections import Counter
from pathlib import Path
from xml.etree import ElementTree

ROOT = Path(__file__).resolve().parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
LIGHT = [
    *(f"tests/units/{room}" for room in ("base", "study", "balancers", "orders", "recordings")),
    "tests/units/commands/test_recording_commands.py",
    "tests/units/scoring",
    "tests/house/test_features.py",
    "tests/house/test_doctests.py",
]
RADIATION = ["tests/units/radiation"]
SHOWN = (
    "numpy", "scipy", "h5py", "matplotlib", "xarray", "netCDF4", "numba", "pyuff", "nptdms",
    "asammdf", "soundfile", "openpyxl", "h5netcdf",
)  # fmt: skip
"""Packages whose versions the table has: what k-Wave or numba hold back, and readers of files."""
OUTCOMES = ("passed", "failed", "skipped")


def promised() -> list[str]:
    """Versions that `requires-python` allows, as 3.11."""
    first, end = map(int, re.findall(r"3\.(\d+)", PROJECT["requires-python"]))
    return [f"3.{minor}" for minor in range(first, end)]


def interpreter(version: str) -> Path | None:
    """A Python of a version that starts."""
    pyenv = Path(os.environ.get("PYENV_ROOT", Path.home() / ".pyenv")) / "versions"
    on_path = shutil.which(f"python{version}")
    for python in (on_path, *sorted(pyenv.glob(f"{version}.*/bin/python"))):
        if python and _runs([python, "--version"], capture_output=True):
            return Path(python)
    return None


def install_locked(install: list[object]) -> None:
    """Install the packages of the locks, then this one."""
    for lock, deps in (("-dev", []), ("-kwave", ["--no-deps"])):
        file = ROOT / f"requirements{lock}.lock"
        subprocess.run([*install, "--require-hashes", *deps, "-r", file], check=True)
    subprocess.run([*install, "--no-deps", "-e", ROOT], check=True)


def install_newest(install: list[object]) -> None:
    """Install k-Wave and this package without what they need, then the newest of what they need."""
    needed = PROJECT["dependencies"] + PROJECT["optional-dependencies"]["dev"]
    kwave = [one.partition(";")[0] for one in needed if one.startswith("k-wave-python")]
    subprocess.run([*install, "--no-deps", *kwave, "-e", ROOT], check=True)
    others = [one for one in needed if not one.startswith("k-wave-python")]
    subprocess.run([*install, *others], check=True)


def environment(version: str, python: Path, folder: Path, newest: bool) -> Path:
    """The Python of an environment with the packages; it is made where it is not there."""
    home = folder / f"python-{version}{'-newest' if newest else ''}"
    inner = home / "bin" / "python"
    if newest or not (home / "ready").exists():
        subprocess.run([python, "-m", "venv", "--clear", home], check=True)
        install = [inner, "-m", "pip", "install", "--quiet"]
        (install_newest if newest else install_locked)(install)
        (home / "ready").touch()
    return inner


def outcomes(python: Path, tests: list[object]) -> Counter[str]:
    """Number of tests that passed, failed and were skipped; a crash counts as a failure."""
    record = python.parents[1] / "tests.xml"
    record.unlink(missing_ok=True)
    command = [python, "-m", "pytest", "-q", "-n", "0"]
    options = ["-p", "no:cacheprovider", f"--junitxml={record}"]
    variables = {**os.environ, "PYTHONPATH": str(ROOT)}
    passed = _runs([*command, *options, *tests], cwd=ROOT, env=variables)
    if not record.exists():
        return Counter(failed=1)
    suite = ElementTree.parse(record).getroot().find("testsuite")  # noqa: S314 - pytest's own
    number = {name: int(suite.get(name)) for name in ("tests", "failures", "errors", "skipped")}
    failed = number["failures"] + number["errors"]
    skipped = number["skipped"]
    return Counter(
        passed=number["tests"] - failed - skipped,
        failed=failed or int(not passed),
        skipped=skipped,
    )


def versions(python: Path) -> list[str]:
    """Versions of Python and of the packages that are shown."""
    script = (
        "import importlib.metadata, json, platform; print(json.dumps([platform.python_version(), "
        f"*map(importlib.metadata.version, {SHOWN})]))"
    )
    found = subprocess.run([python, "-c", script], check=True, capture_output=True, text=True)
    return json.loads(found.stdout)


def _runs(command: list[object], **settings: object) -> bool:
    return subprocess.run(command, check=False, **settings).returncode == 0


def _row(cells: list[object]) -> str:
    return f"| {' | '.join(map(str, cells))} |"


def main() -> None:
    """Test each version; fails where one fails or is not here."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--newest", action="store_true", help="newest packages, and the radiation")
    parser.add_argument("--folder", type=Path, default=ROOT / ".venv-versions")
    parser.add_argument("versions", nargs="*", default=promised(), help="of Python; default: all")
    asked = parser.parse_args()
    rows, failing = [], False
    for version in asked.versions:
        python = interpreter(version)
        print(f"== Python {version}: {python or 'is not here'}", flush=True)
        if python is None:
            rows.append([version, *["is not here"] * (len(SHOWN) + len(OUTCOMES))])
            failing = True
            continue
        inner = environment(version, python, asked.folder.resolve(), asked.newest)
        count = outcomes(inner, [*LIGHT, "-m", "not slow and not long"])
        if asked.newest:
            count += outcomes(inner, RADIATION)
        rows.append([*versions(inner), *(count[name] for name in OUTCOMES)])
        failing |= count["failed"] > 0
    print(_row(["Python", *SHOWN, *OUTCOMES]), _row(["---"] * (1 + len(SHOWN) + 3)), sep="\n")
    print("\n".join(map(_row, rows)))
    sys.exit(failing)


if __name__ == "__main__":
    main()
