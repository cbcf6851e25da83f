"""Hooks of pytest that collect claims, write them down and move their references.

--evidence           write evidence.json from the claims of the tests that run
--shifted-claims F   move the references of the claims that file F names, one a line
"""

from pathlib import Path
from typing import Any

import pytest
from evidence import MADE, SETTINGS
from evidence_files import write

from vibroacoustics.results.claims import Claim, claims

PROPERTY = "claim"


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the two options."""
    group = parser.getgroup("evidence")
    group.addoption("--evidence", action="store_true", help="write evidence.json")
    group.addoption("--shifted-claims", metavar="FILE", help="claims whose references are moved")


def pytest_configure(config: pytest.Config) -> None:
    """Read the options, in every worker."""
    SETTINGS.writes = config.getoption("--evidence")
    if file := config.getoption("--shifted-claims"):
        SETTINGS.shifted = frozenset(Path(file).read_text(encoding="utf-8").splitlines())


@pytest.hookimpl(wrapper=True)
def pytest_runtest_call(item: pytest.Item) -> Any:
    """Fail a test that makes fewer claims than are committed of it, and hand its claims on."""
    MADE.clear()
    outcome = yield
    item.user_properties += [(PROPERTY, vars(row)) for row in MADE]
    if not SETTINGS.writes:
        missing = COMMITTED.get(item.nodeid, frozenset()) - {row.what for row in MADE}
        assert not missing, f"claims of evidence.json that this test makes no more: {missing}"
    return outcome


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Note what is collected, the long tests too."""
    IDS.update(item.nodeid for item in items)


def pytest_runtest_logreport(report: pytest.TestReport) -> None:
    """Take the claims of a test that passed, from whichever worker."""
    if report.when == "call" and report.passed:
        PASSED.add(report.nodeid)
        COLLECTED.extend(Claim(**row) for name, row in report.user_properties if name == PROPERTY)


def pytest_sessionfinish(session: pytest.Session) -> None:
    """Write the file, in the process that has the claims of all workers."""
    if SETTINGS.writes and not hasattr(session.config, "workerinput"):
        write(COLLECTED, PASSED)


COLLECTED: list[Claim] = []
PASSED: set[str] = set()
IDS: set[str] = set()
COMMITTED = {
    test: frozenset(row.what for row in claims() if row.test == test)
    for test in {row.test for row in claims()}
}
