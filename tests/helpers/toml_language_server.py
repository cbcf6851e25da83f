"""What a language server of TOML marks in a file by the project's schemas."""

import re
import subprocess
import sys
from pathlib import Path

from support import ROOT

SCHEMAS = ROOT / "data" / "schemas"
PROGRAM = Path(sys.executable).with_name("taplo")


def marked_lines(kind: str, files: list[Path]) -> dict[Path, set[int]]:
    """Lines with an error, from 1, of each file that has one.

    Parameters
    ----------
    kind : `study` or `machine`
    files : of that kind
    """
    schema = (SCHEMAS / f"{kind}.json").as_uri()
    command = [PROGRAM, "lint", "--colors", "never", "--schema", schema, *files]
    done = subprocess.run(command, capture_output=True, text=True, cwd=ROOT, check=False)
    marks: dict[Path, set[int]] = {}
    for file, line in re.findall(r"┌─ (.+):(\d+):\d+$", done.stderr, re.MULTILINE):
        marks.setdefault(Path(file), set()).add(int(line))
    assert bool(marks) == bool(done.returncode), done.stderr
    return marks
