"""Time of a slider of the report's page: 5 speeds, 10 microphones, 40 orders, headless Chromium.

python benchmarks/live_page.py
"""

import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

from browsers import chromium
from live_pages import GAIN, open_page, page_of
from support import PIPELINES, made_up_transfer_vectors

import vibroacoustics as va
from vibroacoustics.report.live.assets import live_scripts, live_style
from vibroacoustics.report.live.data import live_data

LONGEST_MS = 16.0
LONGEST_RETUNE_MS = 50.0
SPEEDS, MICROPHONES, ORDERS = 5, 10, 40
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


def study() -> va.Study:
    """The reciprocating machine, whose crank speed varies: every order is loaded."""
    around = {
        f"receivers.m{number}": {"x_mm": 1500.0, "y_mm": 100.0 * number, "height_mm": 500.0}
        for number in range(MICROPHONES - 3)
    }
    changed = {
        "operation.speed_rpm": [600.0 + 50.0 * number for number in range(SPEEDS)],
        "operation.maximum_order": ORDERS,
        "radiation.maximum_frequency_hz": 1000.0,
        **around,
    }
    return va.load_study(PIPELINES / "mayekawa_wbhe.toml").replace(changed)


def main() -> None:
    """Print times of slider events and the size of the page's part."""
    results = va.run(
        study(), radiation=lambda study, *_: (made_up_transfer_vectors(study, GAIN), False)
    )
    sizes = {name: results.sizes[name] for name in ("speed", "receiver", "order", "option")}
    parts = {
        "numbers": len(live_data(results)),
        "uPlot": len(live_scripts()[0]),
        "script": len(live_scripts()[1]),
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
