"""Time of a slider of the report's page: 5 speeds, 10 microphones, 40 orders, headless Chromium.

python benchmarks/live_page.py
"""

import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from browsers import chromium
from live_pages import largest_study, open_page, page_of, vectors_of_a_box

import vibroacoustics as va
from vibroacoustics.report.live.assets import live_script, live_style, unpacking_script
from vibroacoustics.report.live.data import live_data
from vibroacoustics.report.live.numbers import packed

LONGEST_MS = 16.0
LONGEST_RETUNE_MS = 50.0
EVENTS = """const [name, done] = arguments, panel = vibroacoustics.panel, slider = panel.at(name);
const times = [];
const move = async () => {
  if (times.length === 60) return done(times);
  slider.value = Number(slider.min) + (times.length / 60) * (slider.max - slider.min);
  const start = performance.now();
  slider.dispatchEvent(new Event("input"));
  await Promise.resolve();
  document.body.getBoundingClientRect();
  times.push(performance.now() - start);
  setTimeout(move, 5);
};
panel.hear("B");
setTimeout(move, 300);"""


def main() -> None:
    """Print times of slider events and the size of the page's part."""
    results = va.run(largest_study(), radiation=lambda study, *_: (vectors_of_a_box(study), False))
    sizes = {name: results.sizes[name] for name in ("speed", "receiver", "order", "option")}
    parts = {
        "numbers": len(live_data(results)),
        "scripts": len(unpacking_script()) + len(packed(live_script().encode())),
        "style": len(live_style()),
    }
    print(sizes, parts, f"all {sum(parts.values()) / 1e3:.0f} kB")
    with tempfile.TemporaryDirectory() as folder, chromium() as browser:
        page = Path(folder) / "page.html"
        page.write_bytes(page_of(results))
        open_page(browser, page)
        lines = browser.execute_script(
            "return vibroacoustics.panel.page.cases.map((one) => one.frequency.length)"
        )
        print(f"lines by speed {lines}")
        for slider in ("moment", "lateral"):
            times = sorted(browser.execute_async_script(EVENTS, slider))
            least, median, longest = times[0], times[len(times) // 2], times[-1]
            print(
                f"{slider}: least {least:.1f} ms, median {median:.1f} ms, longest {longest:.1f} ms "
                f"(asked: at most {LONGEST_MS:g} ms)"
            )
            retuned = median + 5.0 + 10.0  # ahead of the audio clock, and the fade
            print(f"  sound retuned in {retuned:.1f} ms (asked: at most {LONGEST_RETUNE_MS:g} ms)")
            assert median <= LONGEST_MS
            assert retuned <= LONGEST_RETUNE_MS


if __name__ == "__main__":
    main()
