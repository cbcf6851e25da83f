"""Takes first_screen.png from the report of `make run`: its first screen in Chromium."""

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from PIL import Image

ROOT = Path(__file__).parents[2]
OPTIONS = ("--headless=new", "--no-sandbox", "--hide-scrollbars", "--window-size=1280,800")
COLOURS = 64


def main() -> None:
    """The file of the report may be named."""
    default = ROOT / "reports" / "copeland_sources" / "report.html"
    report = Path(sys.argv[1] if sys.argv[1:] else default).resolve()
    chromium = shutil.which("chromium") or sys.exit("chromium is not installed")
    with tempfile.TemporaryDirectory() as folder:
        taken = Path(folder) / "screen.png"
        command = [chromium, *OPTIONS, f"--screenshot={taken}", report.as_uri()]
        subprocess.run(command, check=True, capture_output=True)
        picture = Image.open(taken).convert("RGB").quantize(COLOURS)
        picture.save(ROOT / "docs" / "figures" / "first_screen.png", optimize=True)


if __name__ == "__main__":
    main()
