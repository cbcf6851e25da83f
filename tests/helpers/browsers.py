"""Browsers that open a page of the report: Chromium through its driver, Firefox through BiDi."""

import json
import os
import shutil
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
import websocket
from selenium.webdriver import Chrome
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service


def program(name: str, needed_in_ci: bool = True) -> str:
    """Path of a program; its absence is an error in CI, if needed there, and a skip elsewhere."""
    path = shutil.which(name)
    if path is None:
        if os.environ.get("CI") and needed_in_ci:
            pytest.fail(f"{name} is needed in CI")
        pytest.skip(f"{name} is not installed")
    return path


@contextmanager
def chromium() -> Iterator[Chrome]:
    """Headless, with its log, free to start sound."""
    options = Options()
    options.binary_location, driver = program("chromium"), program("chromedriver")
    for argument in (
        "--headless=new", "--no-sandbox", "--disable-dev-shm-usage",
        "--autoplay-policy=no-user-gesture-required",
    ):  # fmt: skip
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    chrome = Chrome(options=options, service=Service(driver))
    try:
        yield chrome
    finally:
        chrome.quit()


class Firefox:
    """A session of WebDriver BiDi, which Firefox speaks without a driver.

    Attributes
    ----------
    log : texts of the console
    """

    def __init__(self, address: str) -> None:
        self._socket = websocket.create_connection(f"{address}/session", suppress_origin=True)
        self._number = 0
        self.log: list[str] = []
        self._ask("session.new", capabilities={})
        (tab,) = self._ask("browsingContext.getTree")["contexts"]
        self._tab = tab["context"]
        self._ask("session.subscribe", events=["log.entryAdded"])

    def open(self, address: str, width: int, height: int = 844) -> None:
        size = {"width": width, "height": height}
        self._ask("browsingContext.setViewport", context=self._tab, viewport=size)
        self._ask("browsingContext.navigate", context=self._tab, url=address, wait="complete")

    def run(self, script: str) -> Any:
        """What a function's body returns, awaited, as JSON would have it."""
        given = self._ask(
            "script.callFunction",
            functionDeclaration=f"async () => JSON.stringify(await (async () => {{{script}}})())",
            awaitPromise=True,
            userActivation=True,  # free to start sound
            target={"context": self._tab},
        )
        assert given["type"] == "success", given
        return json.loads(given["result"].get("value", "null"))

    def press(self, key: str) -> None:
        """Press and release a key where the focus is."""
        steps = [{"type": kind, "value": key} for kind in ("keyDown", "keyUp")]
        keyboard = {"type": "key", "id": "keyboard", "actions": steps}
        self._ask("input.performActions", context=self._tab, actions=[keyboard])

    def _ask(self, method: str, **parameters: Any) -> dict[str, Any]:
        self._number += 1
        asked = {"id": self._number, "method": method, "params": parameters}
        self._socket.send(json.dumps(asked))
        while True:
            answer = json.loads(self._socket.recv())
            if answer.get("method") == "log.entryAdded":
                self.log.append(answer["params"]["text"])
            if answer.get("id") == self._number:
                assert answer["type"] == "success", answer
                return dict(answer["result"])


@contextmanager
def firefox(profile: Path) -> Iterator[Firefox]:
    """Headless, with a profile of its own."""
    command = [
        program("firefox-esr", needed_in_ci=False), "--headless", "--no-remote",
        "--profile", str(profile), "--remote-debugging-port", "0", "about:blank",
    ]  # fmt: skip
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    assert process.stderr is not None
    try:
        for line in process.stderr:
            if "WebDriver BiDi listening on" in line:
                yield Firefox(line.split()[-1])
                break
    finally:
        process.terminate()
        process.wait(20)
        process.stderr.close()
