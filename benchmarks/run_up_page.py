"""Page of a 60 s run-up with sound: bytes, opening and cursor in headless Chromium and Firefox.

    python benchmarks/run_up_page.py [--quick]

The largest page that is usual: 16 channels at 51.2 kHz, map and sound of one.
"""

import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from quick import parser, require

require(("selenium", "websocket"), ("chromium", "chromedriver", "firefox"))

from browsers import chromium, firefox
from large_recording import SPEEDS_HZ, write_recording

MOST_MB, LONGEST_OPENING_S, LONGEST_CURSOR_MS = 5.0, 1.0, 16.0
READY = "while (!window.vibroacoustics) await new Promise((done) => setTimeout(done, 2));"
OPENED = f"{READY} return performance.now();"
CURSOR = """const {plot} = vibroacoustics.panel.map;
const {width, height} = plot.over.getBoundingClientRect();
document.querySelector(".run-up").scrollIntoView();
const times = [];
for (let k = 0; k < 300; k++) {
  const start = performance.now();
  plot.setCursor({left: (k * 37) % width, top: (k * 23) % height});
  document.body.getBoundingClientRect();
  times.push(performance.now() - start);
  await new Promise((done) => setTimeout(done, 5));
}
times.sort((one, other) => one - other);
return [times[150], times[285], times[299]];"""


def measured(
    name: str, run: Callable[[str], Any], open_page: Callable[[], None], times: int = 3
) -> None:
    """Print how long a browser takes to open the page, some times, and to move the cursor."""
    openings = []
    for _ in range(times):
        open_page()
        openings.append(run(OPENED) / 1e3)
    median, most, longest = run(CURSOR)
    print(
        f"{name}: opens in {', '.join(f'{each:.2f}' for each in openings)} s (at most "
        f"{LONGEST_OPENING_S:g} s); cursor median {median:.1f} ms, 95 % {most:.1f} ms, longest "
        f"{longest:.1f} ms (at most {LONGEST_CURSOR_MS:g} ms)",
        flush=True,
    )


def main() -> None:
    """Print size and times; quickly, of a short recording in Chromium alone."""
    quick = parser(__doc__).parse_args().quick
    with tempfile.TemporaryDirectory() as folder:
        file, page = Path(folder) / "run_up.h5", Path(folder) / "out" / "orders.html"
        write_recording(file, *SPEEDS_HZ["run-up"], quick)
        command = [sys.executable, "-m", "vibroacoustics", "orders", str(file)]
        command += ["--speed-channel", "tacho", "--out", str(page.parent)]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        print(f"page: {page.stat().st_size / 1e6:.2f} MB (at most {MOST_MB:g} MB)", flush=True)
        with chromium() as browser:

            def run(script: str) -> Any:
                body = f"const done = arguments[0]; (async () => {{{script}}})().then(done)"
                return browser.execute_async_script(body)

            measured("Chromium", run, lambda: browser.get(page.as_uri()), 1 if quick else 3)
            print(f"  console: {browser.get_log('browser')}")
        if quick:
            return
        with firefox(Path(folder)) as fox:
            time.sleep(1.0)
            measured("Firefox", fox.run, lambda: fox.open(page.as_uri(), 1280))
            print(f"  console: {fox.log}")


if __name__ == "__main__":
    main()
