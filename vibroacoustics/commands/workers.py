"""Options of the processes that compute: local ones, or those of a running scheduler."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from ..base.processes import ParallelMap

    Opener = Callable[[], AbstractContextManager[ParallelMap]]


@dataclass(frozen=True)
class Cluster:
    """Options of a scheduler, as the command line has them."""

    scheduler: Annotated[
        str | None, "Address, tls://HOST:PORT, of a running scheduler of dask.distributed."
    ] = None
    tls_ca: Annotated[Path | None, "Certificate of the scheduler's own authority, .pem."] = None
    tls_cert: Annotated[Path | None, "Your certificate, signed by this authority, .pem."] = None
    tls_key: Annotated[Path | None, "Private key of your certificate, .pem."] = None
    insecure: Annotated[
        bool, "Use a scheduler without TLS: whoever reaches it may run code as its users."
    ] = False

    def opener(self, plugins: Sequence[Path] | None) -> "Opener | None":
        """Return what opens the workers of the scheduler; None where there is none."""
        from ..base.errors import ParameterError
        from ..design.workers.scheduler import SchedulerAccess, opened_scheduler
        from ..design.workers.study_task import requirement

        tls = (self.tls_ca, self.tls_cert, self.tls_key, self.insecure)
        if self.scheduler is not None:
            access = SchedulerAccess(self.scheduler, *tls)
            return partial(opened_scheduler, access, requirement(plugins or ()))
        if any(tls):
            raise ParameterError("--tls-ca, --tls-cert, --tls-key, --insecure: need --scheduler")
        return None

    @contextmanager
    def distributing(self, plugins: Sequence[Path] | None) -> Iterator[None]:
        """Let the workers of the scheduler, where there is one, compute parts of a study."""
        from ..base.processes import distributing

        opened = self.opener(plugins)
        if opened is None:
            yield
            return
        with opened() as parallel_map, distributing(parallel_map):
            yield


@dataclass(frozen=True)
class Workers(Cluster):
    """Options of local processes and of a scheduler, as the command line has them."""

    workers: Annotated[
        int, typer.Option(min=0, max=1000, help="Local processes that compute; 0: this one alone.")
    ] = 0

    def opener(self, plugins: Sequence[Path] | None) -> "Opener | None":
        """Return what opens the workers; None where this process computes."""
        from ..base.errors import ParameterError
        from ..design.workers.study_task import local_workers

        if self.scheduler is not None and self.workers:
            raise ParameterError("--workers contradicts --scheduler: remove one of both")
        local = partial(local_workers, self.workers) if self.workers else None
        return super().opener(plugins) or local
