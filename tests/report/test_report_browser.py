"""The report in headless Chromium, at desktop and phone width."""

from pathlib import Path

import pytest
from selenium.webdriver import Chrome
from selenium.webdriver.common.by import By
from test_report import make_results

from vibroacoustics.report import render

pytestmark = pytest.mark.slow

HEADINGS = (
    "Summary",
    "Forces and options",
    "Comparison",
    "Orders",
    "Force over a revolution",
    "Mounts",
    "Radiation and levels",
    "Scores",
    "Checks of the software",
    "Assumptions",
    "Provenance",
)
WIDTHS = {"desktop": 1280, "phone": 390}


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    facts = {"a-balancer-with-quite-a-long-name": {"hanging_multiplier": 3.0}}
    factors = {"none": 1.0, "a-balancer-with-quite-a-long-name": 1.8, "halved": 0.5}
    path = tmp_path_factory.mktemp("report") / "report.html"
    path.write_bytes(render(make_results(factors, facts=facts))["report.html"])
    return path


@pytest.fixture(params=WIDTHS)
def opened(request: pytest.FixtureRequest, browser: Chrome, page: Path) -> Chrome:
    """The browser with the page open at one of the widths."""
    phone = request.param == "phone"
    metrics = {
        "width": WIDTHS[request.param],
        "height": 844,
        "deviceScaleFactor": 2 if phone else 1,
        "mobile": phone,
    }
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", metrics)
    browser.get(page.as_uri())
    return browser


def test_nothing_is_logged(opened: Chrome) -> None:
    assert opened.get_log("browser") == []


def test_the_page_does_not_scroll_sideways(opened: Chrome) -> None:
    for details in opened.find_elements(By.TAG_NAME, "summary"):
        details.click()
    assert not opened.find_elements(By.CSS_SELECTOR, "details:not([open])")
    width, window = opened.execute_script(
        "return [document.documentElement.scrollWidth, window.innerWidth]"
    )
    assert window in WIDTHS.values()
    assert width <= window


def test_every_figure_is_decoded(opened: Chrome) -> None:
    widths = opened.execute_script("return [...document.images].map(image => image.naturalWidth)")
    assert len(widths) >= 8
    assert all(width > 0 for width in widths)


def test_every_section_has_its_heading(opened: Chrome) -> None:
    found = [heading.text for heading in opened.find_elements(By.TAG_NAME, "h2")]
    assert found == [*HEADINGS, "Claims and their conditions"]
    assert len(opened.find_elements(By.TAG_NAME, "h1")) == 1


def test_first_screen_shows_every_option_and_folds_the_rest(opened: Chrome) -> None:
    parts, rows = (
        table.find_elements(By.CSS_SELECTOR, "tbody tr")
        for table in opened.find_elements(By.CSS_SELECTOR, "#verdict .intervals")
    )
    assert [row.text.split()[0] for row in parts] == [
        "published",
        "machine",
        "unmodelled",
        "moving",
    ]
    assert len(rows) == 3
    assert all(row.is_displayed() for row in [*parts, *rows])
    assert all("no change" in row.text for row in rows)
    lights = opened.find_elements(By.CSS_SELECTOR, "#verdict .lights tbody tr")
    assert [row.is_displayed() for row in lights] == [False, False]
    bottom = opened.execute_script(
        "return arguments[0].getBoundingClientRect().bottom + window.scrollY", rows[-1]
    )
    assert bottom < 1200.0
    shown = [part.is_displayed() for part in opened.find_elements(By.CSS_SELECTOR, ".part > div")]
    assert shown == [False] * len(HEADINGS)
    opened.find_element(By.CSS_SELECTOR, "#verdict details summary").click()
    assert "+80" in lights[0].text


def test_a_link_opens_its_section(opened: Chrome) -> None:
    opened.get(f"{opened.current_url.partition('#')[0]}#assumptions")
    assert opened.find_element(By.ID, "assumptions").is_displayed()


def test_all_text_can_be_read(opened: Chrome) -> None:
    smallest = opened.execute_script(
        "return Math.min(...[...document.querySelectorAll('p, li, td, th, dd, figcaption, .tag')]"
        ".map(element => parseFloat(getComputedStyle(element).fontSize)))"
    )
    assert smallest >= 12.0


def _open(browser: Chrome, section: str) -> None:
    """Unfold a section."""
    browser.execute_script(
        "document.getElementById(arguments[0]).closest('details').open = true", section
    )


def test_the_name_of_a_row_stays_in_view(opened: Chrome) -> None:
    _open(opened, "comparison")
    cell = opened.find_element(By.CSS_SELECTOR, "#comparison tbody th")
    scroll = opened.find_element(By.CSS_SELECTOR, "#comparison .scroll")
    opened.execute_script("arguments[0].scrollLeft = 200", scroll)
    left = opened.execute_script(
        "return arguments[0].getBoundingClientRect().left", cell
    ) - opened.execute_script("return arguments[0].getBoundingClientRect().left", scroll)
    assert 0.0 <= left <= 5.0
