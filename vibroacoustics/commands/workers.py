"""Options that say which processes compute designs."""

from collections.abc import Callable
from contextlib import AbstractContextManager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from ..design.workers.spread import ParallelMap

    Opener = Callable[[], AbstractContextManager[ParallelMap]]


@dataclass(frozen=True)
class Workers:
    """Options of local processes and of a scheduler, as the command line has them."""

    workers: Annotated[
        int, typer.Option(min=0, max=1000, help="Local processes that compute; 0: this one alone.")
    ] = 0
    scheduler: Annotated[
        str | None,
        "Address, tls://HOST:PORT, of a running scheduler of dask.distributed.",
    ] = None
    tls_ca: Annotated[
        Path | None,
        "Certificate of the scheduler's own authority, .pem.",
    ] = None
    tls_cert: Annotated[
        Path | None,
        "Your certificate, signed by this authority, .pem.",
    ] = None
    tls_key: Annotated[Path | None, "Private key of your certificate, .pem."] = None
    insecure: Annotated[
        bool,
        "Use a scheduler without TLS: whoever reaches it may run code as its users.",
    ] = False

    def opener(self) -> "Opener | None":
        """Return what opens the workers; None where this process computes."""
        from ..base.errors import ParameterError
        from ..design.workers.scheduler import SchedulerAccess, opened_scheduler
        from ..design.workers.spread import local_workers

        tls = (self.tls_ca, self.tls_cert, self.tls_key, self.insecure)
        if self.scheduler is not None:
            if self.workers:
                raise ParameterError("--workers contradicts --scheduler: remove one of both")
            return partial(opened_scheduler, SchedulerAccess(self.scheduler, *tls))
        if any(tls):
            raise ParameterError("--tls-ca, --tls-cert, --tls-key, --insecure: need --scheduler")
        return partial(local_workers, self.workers) if self.workers else None
