"""Workers of dask.distributed: local ones on this machine, or those of a scheduler that is named.

What goes to a worker is a function of this package and JSON. A worker that dies loses nothing: its
piece goes to another. The pieces do not depend on the number of workers, so that neither do the
bits of the results.
"""

import logging
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, Final

import numpy as np

from ...base.arrays import Array
from ...base.errors import ParameterError
from ..evaluation import Evaluate, Evaluation, joined
from .piece import Builder, designs_to_json, evaluate_piece, evaluation_from_json

_DEATHS: Final = 20
"""Of workers with a piece, before its designs count as failed."""
_CONNECTION_S: Final = 10.0


@contextmanager
def opened_workers(number: int, scheduler: str | None = None) -> Iterator[Any]:
    """A client of workers.

    Parameters
    ----------
    number : of local workers, where no scheduler is named
    scheduler : address of a running scheduler, such as tcp://host:8786

    Raises
    ------
    ParameterError
        distributed is not installed, or the scheduler does not answer.
    """
    try:
        import dask
        import distributed
    except ImportError:
        raise ParameterError(
            "design: workers need distributed: pip install 'vibroacoustics[sweep]'"
        ) from None
    library: Any = distributed  # untyped in parts
    settings = {
        "distributed.scheduler.allowed-failures": _DEATHS,
        "distributed.comm.timeouts.connect": f"{_CONNECTION_S:g}s",
    }
    with dask.config.set(settings):
        if scheduler is not None:
            try:
                client = library.Client(scheduler, timeout=_CONNECTION_S)
            except (OSError, ValueError) as error:
                reason = str(error).splitlines()[0]
                raise ParameterError(f"scheduler {scheduler}: does not answer: {reason}") from None
            with client:
                yield client
            return
        with (
            library.LocalCluster(
                n_workers=number,
                threads_per_worker=1,
                host="127.0.0.1",
                dashboard_address=None,
                silence_logs=logging.CRITICAL,
            ) as cluster,
            library.Client(cluster) as client,
        ):
            yield client


def spread(
    client: Any, builder: Builder, task: bytes, piece: int, counts: tuple[int, int]
) -> Evaluate:
    """An evaluation by workers.

    Parameters
    ----------
    client : of `opened_workers`
    builder : function of a module that the workers have, which makes the evaluation
    task : JSON that it takes
    piece : designs a worker gets at a time
    counts : of objectives and of constraints, for pieces that no worker survives
    """

    def evaluate(designs: Array) -> Evaluation:
        parts = pieces(designs, piece)
        futures = [
            client.submit(evaluate_piece, builder, task, designs_to_json(part), pure=False)
            for part in parts
        ]
        asked = zip(futures, parts, strict=True)
        return joined([_result(future, len(part), counts) for future, part in asked])

    return evaluate


def in_pieces(evaluate: Evaluate, piece: int) -> Evaluate:
    """The same evaluation in this process, in the same pieces and so to the same bits."""
    return lambda designs: joined([evaluate(part) for part in pieces(designs, piece)])


def pieces(designs: Array, piece: int) -> list[Array]:
    """Designs in pieces, the last one shorter."""
    return [designs[start : start + piece] for start in range(0, len(designs), piece)]


def _result(future: Any, size: int, counts: tuple[int, int]) -> Evaluation:
    """Of a piece; where its workers died again and again, as failed."""
    from distributed import KilledWorker

    try:
        return evaluation_from_json(future.result())
    except KilledWorker:
        reason = f"{_DEATHS} workers died with it"
        objectives, constraints = (np.full((size, count), np.nan) for count in counts)
        return Evaluation(objectives, constraints, (reason,) * size)
