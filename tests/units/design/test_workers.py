"""Workers beside this process: the same bits, none lost when they die, and no network unasked."""

import json
import socket
import sys
import time
from contextlib import suppress
from inspect import signature
from pathlib import Path
from threading import Thread
from typing import Any

import numpy as np
import pytest
from certificates import certified, needs_openssl
from design_work import builder
from support import TINY

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.commands import cli
from vibroacoustics.design.evaluation import Evaluation, joined
from vibroacoustics.design.workers import scheduler
from vibroacoustics.design.workers.scheduler import SchedulerAccess, opened_scheduler
from vibroacoustics.design.workers.study_task import local_workers, requirement, spread

PIECE = 8
DESIGNS = np.random.default_rng(2).normal(size=(400, 3))
OBJECTIVES, CONSTRAINTS = 2, 1


def task_of(folder: Path, deaths: dict[int, int]) -> bytes:
    """Task whose pieces kill their workers: pieces by number, and how often."""
    first = {str(DESIGNS[number * PIECE, 0]): times for number, times in deaths.items()}
    return json.dumps({"folder": str(folder), "deaths": first}).encode()


def spread_over(parallel_map: Any, task: bytes) -> Evaluation:
    stream = spread(parallel_map, builder, task, (OBJECTIVES, CONSTRAINTS))
    return joined(list(stream(np.split(DESIGNS, len(DESIGNS) // PIECE))))


def serially(task: bytes) -> Evaluation:
    """By this process."""
    return joined(list(map(builder(task), np.split(DESIGNS, len(DESIGNS) // PIECE))))


def same(first: Evaluation, second: Evaluation) -> None:
    """Every bit and every reason."""
    assert first.objectives.tobytes() == second.objectives.tobytes()
    assert first.constraints.tobytes() == second.constraints.tobytes()
    assert first.failures == second.failures


def test_two_workers_equal_serial_though_some_are_killed(tmp_path: Path) -> None:
    """Of 50 pieces one kills its worker once, and one as often as it is tried."""
    serial = serially(task_of(tmp_path, {}))
    assert "too far" in serial.failures
    with local_workers(2) as parallel_map:
        same(spread_over(parallel_map, task_of(tmp_path, {7: 1})), serial)
        evaluation = spread_over(parallel_map, task_of(tmp_path, {30: 9}))
    lost = slice(30 * PIECE, 31 * PIECE)
    assert set(evaluation.failures[lost]) == {"its workers ended: SIGKILL"}
    assert np.isnan(evaluation.objectives[lost]).all()
    kept = np.delete(np.arange(400), np.arange(lost.start, lost.stop))
    assert evaluation.objectives[kept].tobytes() == serial.objectives[kept].tobytes()


TLS = {"tls_ca": Path("ca.pem"), "tls_cert": Path("cert.pem"), "tls_key": Path("key.pem")}
LINES = {
    "--tls-ca, --tls-cert, --tls-key missing: give": ("tcp://h:1", {}),
    "--tls-ca, --tls-cert, --tls-key missing: give --tls": ("tls://h:1", {}),
    "--tls-key missing: give --tls-ca": ("tls://h:1", {**TLS, "tls_key": None}),
    "--insecure contradicts --tls-ca": ("tls://h:1", {**TLS, "insecure": True}),
    "--insecure contradicts tls://": ("tls://h:1", {"insecure": True}),
    "must begin with tls:// where TLS is used": ("tcp://h:1", TLS),
    "--tls-ca ca.pem: is not a file": ("tls://h:1", TLS),
}


@pytest.mark.parametrize("line", LINES)
def test_access_without_tls_or_with_contradictions_is_refused(line: str) -> None:
    address, options = LINES[line]
    with pytest.raises(ParameterError, match=line):
        SchedulerAccess(address, **options)


@pytest.mark.parametrize("command", ["optimise", "sweep"])
@pytest.mark.parametrize(
    ("options", "line"),
    [
        (["--scheduler", "tcp://127.0.0.1:9"], "--scheduler tcp://127.0.0.1:9: --tls-ca, "),
        (["--insecure"], "--tls-ca, --tls-cert, --tls-key, --insecure: need --scheduler"),
        (["--workers", "2", "--scheduler", "a", "--insecure"], "--workers contradicts --scheduler"),
    ],
)
def test_commands_refuse_in_one_line(
    command: str,
    options: list[str],
    line: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    out = tmp_path / "out"
    words = ["vibroacoustics", command, str(TINY), "--out", str(out), *options]
    monkeypatch.setattr(sys, "argv", words)
    with pytest.raises(SystemExit) as ended:
        cli.main()
    errors = capsys.readouterr().err
    assert (ended.value.code, errors.count("\n")) == (2, 1)
    assert errors.startswith(f"error: {line}")
    assert not out.exists()


def refused_scheduler(port: int, longest_s: float) -> str:
    """Message of the refusal of what listens, or nothing, at a port of this computer."""
    access = SchedulerAccess(f"tcp://127.0.0.1:{port}", insecure=True)
    with (
        pytest.raises(ParameterError, match=rf"^scheduler {access.address}: no conn") as caught,
        opened_scheduler(access, requirement([]), longest_s),
    ):
        pass
    assert "\n" not in str(caught.value)
    return str(caught.value)


def test_scheduler_that_does_not_answer_is_one_line() -> None:
    refused_scheduler(9, 0.5)


@pytest.mark.parametrize("answer", [b"", bytes(64), b"HTTP/1.1 400 Bad Request\r\n\r\n", None])
def test_port_that_is_no_scheduler_is_one_line(answer: bytes | None) -> None:
    """It is silent, sends bytes of other protocols, or closes."""
    kept: list[socket.socket] = []

    def serve() -> None:
        with suppress(OSError):  # closed
            while True:
                kept.append(listening.accept()[0])
                kept[-1].sendall(answer or b"")
                if answer is None:
                    kept[-1].close()

    with socket.create_server(("127.0.0.1", 0)) as listening:
        Thread(target=serve, daemon=True).start()
        start = time.monotonic()
        line = refused_scheduler(listening.getsockname()[1], 1.0)
        listening.shutdown(socket.SHUT_RDWR)
    for each in kept:
        each.close()
    assert time.monotonic() - start < 30.0  # it would wait without end
    assert answer or answer is None or "no answer within 1 s" in line


def test_the_longest_time_of_a_connection_is_ten_seconds() -> None:
    assert signature(opened_scheduler).parameters["longest_s"].default == 10.0


@needs_openssl
def test_scheduler_by_tls(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The same bits; certificates of another authority do not open it, nor does a wrong file."""
    from distributed import LocalCluster, Security

    good, other = certified(tmp_path / "good"), certified(tmp_path / "other")
    roles = {
        f"tls_{role}_{part}": str(good[f"tls_{part}"])
        for role in ("scheduler", "worker", "client")
        for part in ("cert", "key")
    }
    security = Security(require_encryption=True, tls_ca_file=str(good["tls_ca"]), **roles)
    task = task_of(tmp_path, {})
    serial = serially(task)
    with LocalCluster(
        n_workers=1, threads_per_worker=1, processes=False, protocol="tls", security=security,
        host="127.0.0.1", dashboard_address=None,
    ) as cluster:  # fmt: skip
        address = cluster.scheduler_address
        assert address.startswith("tls://127.0.0.1")
        with opened_scheduler(SchedulerAccess(address, **good), requirement([])) as parallel_map:
            same(spread_over(parallel_map, task), serial)
        monkeypatch.setattr(scheduler, "_CONNECTION_S", 1.0)
        wrong = [other, {**other, "tls_ca": good["tls_ca"]}, {**good, "tls_ca": other["tls_ca"]}]
        for files in wrong:
            with (
                pytest.raises(ParameterError, match=f"scheduler {address}: no connection"),
                opened_scheduler(SchedulerAccess(address, **files), requirement([])),
            ):
                pass
    swapped = {**good, "tls_cert": good["tls_key"]}
    with (
        pytest.raises(ParameterError, match="--tls-key: cannot be used"),
        opened_scheduler(SchedulerAccess(address, **swapped), requirement([])),
    ):
        pass
