"""Runs Python files one after the other, each in its folder; prints what became of them as JSON.

One process for all, commands of pages included, saves the seconds of imports, and keeps what pages
register out of the tests.
"""

import json
import os
import runpy
import subprocess
import sys
import time
import traceback
import warnings
from contextlib import chdir
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "helpers"))

import pytest
from pictures import draw_nothing
from support import command_here

COMMAND = [sys.executable, "-m", "vibroacoustics"]
run_process = subprocess.run


def run_here(words, *, cwd=".", check=False, **rest):
    """In place of `subprocess.run`: our own commands in this process."""
    if words[:3] != COMMAND:
        return run_process(words, cwd=cwd, check=check, **rest)
    with chdir(cwd):
        done = command_here(*words[3:])
    if check:
        done.check_returncode()
    return done


def outcome(page: Path) -> dict[str, object]:
    """Seconds, number of figures, and the error if there was one."""
    import matplotlib.pyplot as plt
    from matplotlib.figure import Figure

    os.chdir(page.parent)
    start, error, names = time.perf_counter(), "", {}
    try:
        names = runpy.run_path(str(page), run_name="__main__")
    except Exception:
        error = traceback.format_exc()
    drawn = [each for each in names.values() if isinstance(each, Figure)]
    figures = len(plt.get_fignums()) or len(drawn)
    plt.close("all")
    return {"seconds": time.perf_counter() - start, "figures": figures, "error": error}


def main() -> None:
    """Pages are the arguments; what they print goes to stderr."""
    warnings.simplefilter("error")
    warnings.filterwarnings("ignore", category=ResourceWarning)
    pages = [Path(word).resolve() for word in sys.argv[1:]]
    sys.path.insert(0, str(pages[0].parent))
    printed, sys.stdout = sys.stdout, sys.stderr
    subprocess.run = run_here
    with pytest.MonkeyPatch.context() as patch:  # the site shows the pictures: `make docs`
        draw_nothing(patch)
        outcomes = {page.name: outcome(page) for page in pages}
    print(json.dumps(outcomes), file=printed)


if __name__ == "__main__":
    main()
