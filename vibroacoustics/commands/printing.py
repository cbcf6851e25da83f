"""Pages as PDF, by a browser without a window. It reads one file and nothing else."""

import os
import shutil
from collections.abc import Mapping
from pathlib import Path
from subprocess import TimeoutExpired
from tempfile import TemporaryDirectory
from typing import Final, NamedTuple

from ..base.errors import ParameterError, StorageError
from ..base.folder import Content
from ..base.process_start import run_program

BROWSERS: Final = (
    "chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome",
    "microsoft-edge", "microsoft-edge-stable", "msedge",
)  # fmt: skip
"""Programs that print without a window, as they are called on PATH."""
_LONGEST_S: Final = 300.0
_OPTIONS: Final = (
    "--headless", "--disable-gpu", "--disable-dev-shm-usage", "--disable-extensions",
    "--disable-background-networking", "--no-first-run", "--no-pdf-header-footer",
    "--generate-pdf-document-outline",
    "--host-resolver-rules=MAP * ~NOTFOUND",
)  # fmt: skip


class Printer(NamedTuple):
    """A browser, the size of the sheets, and whether what is folded is omitted."""

    browser: str
    paper: str
    brief: bool = False

    def pages(self, files: Mapping[str, Content]) -> dict[str, bytes]:
        """A PDF for each HTML page among files, named like it."""
        return {
            f"{name.removesuffix('.html')}.pdf": self.printed(content)
            for name, content in files.items()
            if name.endswith(".html") and isinstance(content, bytes)
        }

    def printed(self, page: bytes) -> bytes:
        """One page."""
        from ..report.html import for_paper

        with TemporaryDirectory(prefix="vibroacoustics_", ignore_cleanup_errors=True) as folder:
            source, target = Path(folder) / "page.html", Path(folder) / "page.pdf"
            source.write_bytes(for_paper(page, self.paper, self.brief))
            message = self._print(source, target)
            if not target.is_file() or not target.read_bytes().startswith(b"%PDF"):
                raise StorageError(f"--pdf: {self.browser} printed nothing{message}")
            return target.read_bytes()

    def _print(self, source: Path, target: Path) -> str:
        """Print, and what the browser said last."""
        command = [
            self.browser,
            *_OPTIONS,
            *(["--no-sandbox"] if hasattr(os, "geteuid") and os.geteuid() == 0 else []),
            f"--user-data-dir={source.parent / 'profile'}",
            f"--print-to-pdf={target}",
            source.as_uri(),
        ]
        try:
            # Its exit code is 0 whatever happens; the file shows it.
            done = run_program(command, source.parent, _LONGEST_S)
        except TimeoutExpired:
            return f" within {_LONGEST_S:g} s"
        except OSError as error:
            return f": {error.strerror}"
        lines = done.stderr.decode(errors="replace").strip().splitlines()
        return f": {lines[-1]}" if lines else ""


def printer(wanted: bool, paper: str | None, brief: bool = False) -> Printer | None:
    """Find a printer before anything is computed or written; None where no PDF is wanted.

    Raises
    ------
    ParameterError
        There is no such paper, or no browser that prints.
    """
    if not wanted:
        for option, is_given in (("--paper", paper is not None), ("--brief", brief)):
            if is_given:
                raise ParameterError(f"{option}: is an option of the PDF; give --pdf as well")
        return None
    from ..report.html import PAPERS

    name = (paper or "a4").lower()
    if name not in PAPERS:
        raise ParameterError(f"--paper {paper}: must be {' or '.join(PAPERS)}")
    browser = next(filter(None, map(shutil.which, BROWSERS)), None)
    if browser is None:
        raise ParameterError(
            "--pdf: needs a browser that prints without a window; on PATH is none of "
            f"{', '.join(BROWSERS)}"
        )
    return Printer(browser, name, brief)
