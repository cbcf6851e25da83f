"""Browsers that the tests of the report share: each is started once."""

from collections.abc import Iterator

import pytest
from browsers import Firefox, chromium, firefox
from selenium.webdriver import Chrome


@pytest.fixture(scope="session")
def browser() -> Iterator[Chrome]:
    with chromium() as chrome:
        yield chrome


@pytest.fixture(scope="session")
def fox(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Firefox]:
    with firefox(tmp_path_factory.mktemp("profile")) as session:
        yield session
