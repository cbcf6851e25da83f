"""Workers of a scheduler of dask.distributed, reached by TLS, and functions as bytes for them."""

import asyncio
import warnings
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache, lru_cache
from io import BytesIO
from itertools import islice
from pathlib import Path
from typing import Any, Final

from ...base.errors import ParameterError
from ...base.linear_algebra import one_thread_of_linear_algebra
from ...base.processes import ParallelMap
from ...base.worker_process import Item, Result
from .study_task import meet

_CACHED = type(cache(lambda: None))


def travelling(function: Callable[[Any], Any]) -> bytes:
    """Return a function with all that it knows; caches travel empty."""
    from cloudpickle import Pickler

    class Travelling(Pickler):  # type: ignore[misc]
        """Pickler that also takes caches of functions that no module holds."""

        def reducer_override(self, thing: Any) -> Any:
            """Return how something is made again."""
            if isinstance(thing, _CACHED) and "<locals>" in getattr(
                thing, "__qualname__", "<locals>"
            ):
                return _cached, (thing.__wrapped__, thing.cache_parameters()["maxsize"])
            return super().reducer_override(thing)

    content = BytesIO()
    Travelling(content).dump(function)
    return content.getvalue()


def apply(required: bytes, content: bytes, item: Any) -> Any:
    """Apply a function to an item on a worker.

    Parameters
    ----------
    required : requirement of the worker, from `requirement`
    content : bytes of the function, from `travelling`
    item : item of any kind
    """
    meet(required)
    with one_thread_of_linear_algebra():
        return _arrived(content)(item)


@lru_cache(maxsize=2)
def _arrived(content: bytes) -> Callable[[Any], Any]:
    import pickle

    function: Callable[[Any], Any] = pickle.loads(content)  # noqa: S301 - of who may run code here
    return function


def _cached(function: Callable[..., Any], most: int | None) -> Any:
    return lru_cache(maxsize=most)(function)


_CONNECTION_S: Final = 10.0
_AHEAD: Final = 4
"""Items per thread of the workers that are sent ahead of the one whose result is due."""
_TLS: Final = "--tls-ca, --tls-cert and --tls-key"


@dataclass(frozen=True)
class SchedulerAccess:
    """A running scheduler and how it is reached; contradictions are refused.

    Attributes
    ----------
    address : such as tls://host:8786; tcp://host:8786 without TLS
    tls_ca : certificate of the authority that signed those of scheduler and workers, PEM
    tls_cert : certificate of this client, PEM
    tls_key : private key of this client, PEM
    insecure : TLS is not used
    """

    address: str
    tls_ca: Path | None = None
    tls_cert: Path | None = None
    tls_key: Path | None = None
    insecure: bool = False

    def __post_init__(self) -> None:
        head = f"--scheduler {self.address}"
        files = {"--tls-ca": self.tls_ca, "--tls-cert": self.tls_cert, "--tls-key": self.tls_key}
        missing = [option for option, path in files.items() if path is None]
        if self.insecure and len(missing) < len(files):
            raise ParameterError(f"{head}: --insecure contradicts {_TLS}: remove one of both")
        if self.insecure and self.address.startswith("tls:"):
            raise ParameterError(f"{head}: --insecure contradicts tls://: give {_TLS} instead")
        if not self.insecure and missing:
            raise ParameterError(
                f"{head}: {', '.join(missing)} missing: give {_TLS}, or --insecure in a network "
                "whose every user may run code as you"
            )
        if not self.insecure and not self.address.startswith("tls://"):
            raise ParameterError(f"{head}: must begin with tls:// where TLS is used")
        for option, path in files.items():
            if path is not None and not path.is_file():
                raise ParameterError(f"{option} {path}: is not a file")


@contextmanager
def opened_scheduler(
    access: SchedulerAccess, required: bytes, longest_s: float = _CONNECTION_S
) -> Iterator[ParallelMap]:
    """Connect with a running scheduler; gives the map of its workers.

    Parameters
    ----------
    access : access to the scheduler
    required : requirement of the workers, from `requirement`
    longest_s : longest time in which the scheduler answers, s

    Raises
    ------
    ParameterError
        distributed is not installed, the TLS files cannot be used, or nothing answers.
    """
    try:
        import dask
        import distributed
    except ImportError:
        raise ParameterError(
            "--scheduler: needs distributed: pip install 'vibroacoustics[scheduler]'"
        ) from None
    library: Any = distributed  # untyped in parts
    with dask.config.set({"distributed.comm.timeouts.connect": f"{longest_s:g}s"}):
        security = None if access.insecure else _security(library, access)
        client = _connected(library, access.address, security, longest_s)
        with client:
            yield _map_of(client, required)


def _connected(library: Any, address: str, security: Any, longest_s: float) -> Any:
    """Client of a scheduler that has answered: a client by itself waits without end."""
    arguments = {} if security is None else security.get_connection_args("client")

    async def answer() -> Any:
        comm = await library.comm.connect(address, **arguments)
        try:
            return await library.core.send_recv(comm, op="identity")
        finally:
            comm.abort()

    try:
        identity = asyncio.run(asyncio.wait_for(answer(), longest_s))
        if not isinstance(identity, dict) or identity.get("type") != "Scheduler":
            raise OSError("it is no scheduler of dask.distributed")
        return library.Client(address, timeout=longest_s, security=security)
    except TimeoutError:
        reason = f"no answer within {longest_s:g} s"
    except Exception as error:  # whatever the library makes of what is not its own protocol
        reason = (str(error).splitlines() or [type(error).__name__])[0]
    raise ParameterError(f"scheduler {address}: no connection: {reason}")


def _security(library: Any, access: SchedulerAccess) -> Any:
    """Settings of TLS, whose files have been read once."""
    security = library.Security(
        require_encryption=True,
        tls_ca_file=str(access.tls_ca),
        tls_client_cert=str(access.tls_cert),
        tls_client_key=str(access.tls_key),
    )
    try:
        security.get_connection_args("client")
    except OSError as error:
        raise ParameterError(f"{_TLS}: cannot be used: {error}") from None
    return security


def _map_of(client: Any, required: bytes) -> ParallelMap:
    """Map whose items the workers of a client's scheduler compute."""
    from distributed import KilledWorker

    def parallel_map(
        function: Callable[[Item], Result],
        items: Iterable[Item],
        on_loss: Callable[[Item, str], Result],
    ) -> Iterator[Result]:
        # A task, for the scheduler has it computed again where a worker that held it is gone.
        with warnings.catch_warnings():
            warnings.filterwarnings("ignore", "Sending large graph")
            content = client.submit(bytes, travelling(function), pure=False)
        waiting: deque[tuple[Any, Item]] = deque()
        coming = iter(items)
        while True:
            free = max(_AHEAD * sum(client.nthreads().values()), 1) - len(waiting)
            for item in islice(coming, max(free, 0)):
                waiting.append((client.submit(apply, required, content, item, pure=False), item))
            if not waiting:
                return
            future, item = waiting.popleft()
            try:
                result = future.result()
            except KilledWorker as error:
                result = on_loss(item, f"{error.allowed_failures + 1} in turn")
            yield result

    return parallel_map
