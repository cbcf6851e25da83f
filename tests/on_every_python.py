"""Light tests on every Python that pyproject.toml promises; a version that is not here is named.

    python tests/on_every_python.py [FOLDER OF THE ENVIRONMENTS]

Interpreters are looked for on the path and among pyenv's. Each gets an environment of its own with
the locked packages, which needs the package index once.
"""

import os
import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
LIGHT = [
    *(f"tests/units/{room}" for room in ("base", "study", "balancers", "orders", "recordings")),
    "tests/units/commands/test_recording_commands.py",
    "tests/units/scoring",
    "tests/house/test_features.py",
    "tests/house/test_doctests.py",
]


def promised() -> list[str]:
    """Versions that `requires-python` allows, as 3.11."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    first, end = map(int, re.findall(r"3\.(\d+)", project["requires-python"]))
    return [f"3.{minor}" for minor in range(first, end)]


def interpreter(version: str) -> Path | None:
    """A Python of a version that starts."""
    pyenv = Path(os.environ.get("PYENV_ROOT", Path.home() / ".pyenv")) / "versions"
    on_path = shutil.which(f"python{version}")
    for python in (on_path, *sorted(pyenv.glob(f"{version}.*/bin/python"))):
        if python and _runs([python, "--version"], capture_output=True):
            return Path(python)
    return None


def tested(version: str, python: Path, folder: Path) -> bool:
    """Whether the light tests pass."""
    home = folder / f"python-{version}"
    inner = home / "bin" / "python"
    if not (home / "ready").exists():
        subprocess.run([python, "-m", "venv", "--clear", home], check=True)
        install = [inner, "-m", "pip", "install", "--quiet"]
        locked = ["--require-hashes", "-r", ROOT / "requirements-dev.lock"]
        subprocess.run([*install, *locked], check=True)
        subprocess.run([*install, "--no-deps", "-e", ROOT], check=True)
        (home / "ready").touch()
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    command = [inner, "-m", "pytest", "-q", "-n", "0", "-m", "not slow", "-p", "no:cacheprovider"]
    return _runs([*command, *LIGHT], cwd=ROOT, env=environment)


def _runs(command: list[object], **settings: object) -> bool:
    return subprocess.run(command, check=False, **settings).returncode == 0


def main() -> None:
    """Test each version; fails where one fails or is not here."""
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / ".venv-versions").resolve()
    outcomes = {}
    for version in promised():
        python = interpreter(version)
        print(f"== Python {version}: {python or 'is not here'}", flush=True)
        if python is None:
            outcomes[version] = "is not here"
        else:
            outcomes[version] = "passed" if tested(version, python, folder) else "failed"
    print("\n".join(f"Python {version}: {outcome}" for version, outcome in outcomes.items()))
    sys.exit(set(outcomes.values()) != {"passed"})


if __name__ == "__main__":
    main()
