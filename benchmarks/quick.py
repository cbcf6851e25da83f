"""What the benchmarks share: their quick form, and refusals where something is not installed.

With `--quick` a benchmark takes a small study and few repetitions, so that a test runs it in
seconds; its figures then mean nothing.
"""

import argparse
import shutil
import sys
from importlib.util import find_spec
from pathlib import Path
from typing import Final

ROOT: Final = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests" / "helpers"))


def parser(document: str | None) -> argparse.ArgumentParser:
    """Return a parser of options with `--quick`."""
    made = argparse.ArgumentParser(
        description=document, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    made.add_argument("--quick", action="store_true", help="small numbers, in seconds")
    return made


def require(modules: tuple[str, ...] = (), programs: tuple[str, ...] = ()) -> None:
    """Leave with one line and exit code 2 where a module or program is not installed."""
    missing = [name for name in modules if find_spec(name) is None]
    missing += [name for name in programs if shutil.which(name) is None]
    if missing:
        print(f"{Path(sys.argv[0]).name}: not installed: {', '.join(missing)}", file=sys.stderr)
        raise SystemExit(2)
