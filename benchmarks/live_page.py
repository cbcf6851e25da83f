"""Time of a slider of the report's page: 5 speeds, 10 microphones, 40 orders, headless Chromium.

python benchmarks/live_page.py [--quick]
"""

import tempfile
from pathlib import Path

from quick import parser, require

require(("selenium", "websocket"), ("chromium", "chromedriver"))

from browsers import chromium
from live_pages import largest_study, open_page, page_of, thesis_study, vectors_of_a_box
from selenium.webdriver import Chrome
from support import made_up_transfer_vectors

import vibroacoustics as va
from vibroacoustics.live.section import live_data
from vibroacoustics.report.live.assets import live_script, live_style, packed, unpacking_script

COUNT, QUICK_COUNT = 120, 4
"""Events of a slider."""
LONGEST_MS = 16.0
LONGEST_RETUNE_MS = 50.0
EVENTS = """const [name, count, done] = arguments, panel = vibroacoustics.panel;
const slider = name ? panel.at(name) : document.createElement("input");
if (!name) Object.assign(slider, { type: "range", min: 0, max: 60 });
const times = [], tuned = [], voice = () => panel.player.voices.B;
let start = 0;
const move = async () => {
  if (times.length === count) return done([times, tuned]);
  const tune = voice().retune;
  voice().retune = (...given) => {
    tune.apply(voice(), given);
    tuned.push(performance.now() - start);
    delete voice().retune;
  };
  slider.value = Number(slider.min) + (times.length / count) * (slider.max - slider.min);
  start = performance.now();
  slider.dispatchEvent(new Event("input"));
  await Promise.resolve();
  document.body.getBoundingClientRect();
  times.push(performance.now() - start);
  setTimeout(move, 30);
};
panel.hear("B");
setTimeout(move, 300);"""
ONE_EVENT = """const [name, share, done] = arguments;
if (name) {
  const slider = vibroacoustics.panel.at(name);
  slider.value = Number(slider.min) + share * (slider.max - slider.min);
  slider.dispatchEvent(new Event("input"));
}
setTimeout(done, 40);"""
AHEAD_AND_FADE_MS = 15.0
"""Ahead of the audio clock, and until the new wave sounds alone."""


def cpu_s(browser: Chrome) -> float:
    """Processor time of the page's main thread so far."""
    metrics = browser.execute_cdp_cmd("Performance.getMetrics", {})["metrics"]
    return float(next(one["value"] for one in metrics if one["name"] == "TaskDuration"))


def timed(browser: Chrome, slider: str, count: int) -> list[float]:
    """Print times of a slider, or of events that nothing listens to; then its times of retuning."""
    times, tuned = browser.execute_async_script(EVENTS, slider, count)
    times.sort()
    shares = [number / (count // 2) for number in range(count // 2)]
    cpu_ms = sorted(cpu_of_one(browser, slider, share) for share in shares)
    name = slider or "no slider"
    print(
        f"{name}: least {times[0]:.1f} ms, median {times[len(times) // 2]:.1f} ms, "
        f"longest {times[-1]:.1f} ms (asked: at most {LONGEST_MS:g} ms)\n"
        "  processor time of the main thread with drawing, sound and asking for it: "
        f"median {cpu_ms[len(cpu_ms) // 2]:.1f} ms, longest {cpu_ms[-1]:.1f} ms"
    )
    assert count < COUNT or times[len(times) // 2] <= LONGEST_MS
    return sorted(tuned)


def cpu_of_one(browser: Chrome, slider: str, share: float) -> float:
    """Processor time of one event, which the load of the machine does not lengthen, ms."""
    before = cpu_s(browser)
    browser.execute_async_script(ONE_EVENT, slider, share)
    return 1e3 * (cpu_s(browser) - before)


def main() -> None:
    """Print times of slider events and the size of the page's part."""
    quick = parser(__doc__).parse_args().quick
    study, count = (thesis_study({}), QUICK_COUNT) if quick else (largest_study(), COUNT)
    vectors = made_up_transfer_vectors if quick else vectors_of_a_box
    results = va.run(study, radiation=lambda study, *_: (vectors(study), False))
    sizes = {name: results.sizes[name] for name in ("speed", "receiver", "order", "option")}
    parts = {
        "numbers": len(live_data(results)),
        "scripts": len(unpacking_script()) + len(packed(live_script().encode())),
        "style": len(live_style()),
    }
    print(sizes, parts, f"all {sum(parts.values()) / 1e3:.0f} kB")
    with tempfile.TemporaryDirectory() as folder, chromium() as browser:
        browser.execute_cdp_cmd("Performance.enable", {"timeDomain": "threadTicks"})
        page = Path(folder) / "page.html"
        page.write_bytes(page_of(results))
        open_page(browser, page)
        lines = browser.execute_script(
            "return vibroacoustics.panel.page.cases.map((one) => one.frequency.length)"
        )
        print(f"lines by speed {lines}")
        browser.execute_script(
            "document.querySelector('details:has(#live)').open = true;"
            "vibroacoustics.panel.at('says').scrollIntoView()"
        )
        timed(browser, "", count)
        for slider in ("moment",) if quick else ("moment", "lateral"):
            tuned = timed(browser, slider, count)
            median, longest = (
                one + AHEAD_AND_FADE_MS for one in (tuned[len(tuned) // 2], tuned[-1])
            )
            print(
                f"  sound retuned: median {median:.0f} ms, longest {longest:.0f} ms "
                f"(asked: at most {LONGEST_RETUNE_MS:g} ms)"
            )
            assert quick or median <= LONGEST_RETUNE_MS


if __name__ == "__main__":
    main()
