"""Processes of this machine that apply a function to many items: a pool that survives its workers.

Workers are `WorkerProcess`es: nothing listens, and they end with this process.
"""

from collections.abc import Callable, Generator, Iterable, Iterator
from contextlib import closing, contextmanager
from contextvars import ContextVar
from multiprocessing import connection
from typing import Any, Final, Generic, NoReturn, Self, TypeAlias

from .errors import SolverError
from .threads import processors
from .worker_process import DONE, FAILED, Item, Result, Task, WorkerProcess, can_fork

_MOST_DEATHS: Final = 2
"""Workers that end at an item before it is given up."""
_FURTHER_IDLE_DEATHS: Final = 3
"""Workers, beyond the number of the pool, that may end without an item between two results."""
_AHEAD: Final = 4
"""Items per worker that may be finished before the one whose result is due."""
ParallelMap: TypeAlias = Callable[
    [Callable[[Any], Any], Iterable[Any], Callable[[Any, str], Any]], Iterator[Any]
]
"""Takes a function, items and the result of an item that is lost; `ProcessPool.in_order` is one."""
_PARALLEL_MAP: Final = ContextVar[ParallelMap | None]("_PARALLEL_MAP", default=None)


class ProcessPool:
    """Processes that apply a function of a module to items, one item each at a time.

    A worker that is killed is replaced and its item is given to another one. Processes start when
    items need them, and end with the context. An item's function runs with SIGINT blocked, so that
    Ctrl-C reaches this process alone. A pool does one map at a time; its workers have no pools.

    Parameters
    ----------
    number : number of processes, at least 1
    inherited : function of any kind that forked workers know, where `can_fork`; without it
        workers are started afresh

    Examples
    --------
    A script needs the usual guard `if __name__ == "__main__":`.

    >>> with ProcessPool(2) as pool:  # doctest: +SKIP
    ...     list(pool.in_order(math.sqrt, [1.0, 4.0]))
    [1.0, 2.0]
    """

    def __init__(self, number: int, inherited: Callable[[Any], Any] | None = None) -> None:
        self._number = number
        self._inherited = inherited
        self._workers: list[WorkerProcess] = []
        self._idle_deaths = 0

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._end(self._workers)

    def in_order(
        self,
        function: Callable[[Item], Result],
        items: Iterable[Item],
        on_loss: Callable[[Item, str], Result] | None = None,
    ) -> Iterator[Result]:
        """Apply a function; the results are in the order of the items.

        Memory holds a few items and results per worker: `items` may be a long generator.

        Parameters
        ----------
        function : the inherited one, or one of a module, not a lambda; functools.partial of one
            is allowed
        items : anything that pickle takes
        on_loss : result of an item that ended two workers, from the item and how the second one
            ended; an error by default
        """
        results: dict[int, Result] = {}
        due = 0
        with closing(self._finished(function, items, on_loss, _AHEAD * self._number)) as finished:
            for index, result in finished:
                results[index] = result
                while due in results:
                    yield results.pop(due)
                    due += 1

    def as_completed(
        self,
        function: Callable[[Item], Result],
        items: Iterable[Item],
        on_loss: Callable[[Item, str], Result] | None = None,
    ) -> Iterator[tuple[int, Result]]:
        """Apply a function like `in_order`; gives index and result when an item is finished."""
        return self._finished(function, items, on_loss, None)

    def _finished(
        self,
        function: Callable[[Item], Result],
        items: Iterable[Item],
        on_loss: Callable[[Item, str], Result] | None,
        ahead: int | None,
    ) -> Generator[tuple[int, Result], None, None]:
        if self._busy():
            raise RuntimeError("a pool of processes does one map at a time")
        tasks = _Tasks(items, self._number, ahead)
        results: list[tuple[int, Result]] = []
        try:
            while True:
                tasks.fill()
                self._give(function, tasks)  # before the results are used: no worker waits
                yield from results
                if not tasks.unfinished:
                    return
                results = list(self._receive(tasks, on_loss or _refuse))
        finally:
            self._end(self._busy())

    def _busy(self) -> list["WorkerProcess"]:
        return [worker for worker in self._workers if worker.task]

    def _give(self, function: Callable[[Item], Result], tasks: "_Tasks[Item]") -> None:
        """Give waiting tasks to idle workers; start workers where there are fewer than tasks."""
        assigned = {worker.task for worker in self._workers}
        waiting = [task for task in tasks.unfinished.values() if task not in assigned]
        idle = [worker for worker in self._workers if worker.ready and not worker.task]
        for worker, task in zip(idle, waiting, strict=False):
            worker.take(None if function is self._inherited else function, task)
        while len(self._workers) < len(tasks.unfinished):
            ends = [worker.connection for worker in self._workers]
            self._workers.append(WorkerProcess(self._inherited, ends))

    def _receive(
        self, tasks: "_Tasks[Item]", on_loss: Callable[[Item, str], Result]
    ) -> Iterator[tuple[int, Result]]:
        """Wait for messages of workers; gives what they finished."""
        workers = {worker.connection: worker for worker in self._workers}
        for source in connection.wait(list(workers)):
            worker = workers[source]
            task = worker.task
            try:
                kind, content = worker.receive()
            except (EOFError, OSError):
                reason = self._dead(worker)
                if task is not None and task.deaths == _MOST_DEATHS:
                    yield tasks.finish(task), on_loss(task.item, reason)
                continue
            if kind == FAILED:
                raise content
            if kind == DONE and task is not None:
                self._idle_deaths = 0
                yield tasks.finish(task), content

    def _dead(self, worker: "WorkerProcess") -> str:
        """Remove a worker that ended by itself; gives how."""
        self._end([worker])
        if worker.task and worker.begun:
            worker.task.deaths += 1
            return worker.reason
        self._idle_deaths += 1
        if self._idle_deaths > self._number + _FURTHER_IDLE_DEATHS:
            raise SolverError(f"worker processes end before they begin to work: {worker.reason}")
        return worker.reason

    def _end(self, workers: list["WorkerProcess"]) -> None:
        workers = list(workers)
        for worker in workers:
            worker.close()
        for worker in workers:
            worker.join()
            self._workers.remove(worker)


class _Tasks(Generic[Item]):
    """Unfinished tasks: at most as many as there are workers, so that memory is bounded.

    Parameters
    ----------
    items : are taken when workers are free for them
    number : number of workers
    ahead : largest difference of the indices of two unfinished tasks; None: any
    """

    def __init__(self, items: Iterable[Item], number: int, ahead: int | None) -> None:
        self._tasks = (Task(index, item) for index, item in enumerate(items))
        self._number, self._ahead = number, ahead
        self._taken = 0
        self.unfinished: dict[int, Task[Item]] = {}

    def fill(self) -> None:
        """Take items until there is a task for every worker."""
        while len(self.unfinished) < self._number and not self._far_ahead():
            task = next(self._tasks, None)
            if task is None:
                return
            self.unfinished[task.index] = task
            self._taken += 1

    def finish(self, task: Task[Item]) -> int:
        """Forget a task; gives its index."""
        del self.unfinished[task.index]
        return task.index

    def _far_ahead(self) -> bool:
        first = min(self.unfinished, default=self._taken)
        return self._ahead is not None and self._taken - first >= self._ahead


@contextmanager
def distributing(parallel_map: ParallelMap) -> Iterator[None]:
    """Let workers of another kind apply what `distributed` is given.

    Parameters
    ----------
    parallel_map : takes a function, items and the result of an item that is lost
    """
    before = _PARALLEL_MAP.set(parallel_map)
    try:
        yield
    finally:
        _PARALLEL_MAP.reset(before)


def distributed(
    function: Callable[[Item], Result],
    items: Iterable[Item],
    otherwise: Callable[[Callable[[Item], Result], Iterable[Item]], Iterable[Result]],
    on_loss: Callable[[Item, str], Result] | None = None,
) -> Iterator[Result]:
    """Apply a function by the workers of `distributing`; the results are in the order of the items.

    Parameters
    ----------
    function : function of any kind; what it changes may be lost
    items : arguments that pickle takes, as it does the results
    otherwise : applies the function where there are no such workers
    on_loss : result of an item that ended two workers; see `ProcessPool.in_order`
    """
    parallel_map = _PARALLEL_MAP.get()
    if parallel_map is None:
        yield from otherwise(function, items)
    else:
        yield from parallel_map(function, items, on_loss or _refuse)


def side_by_side(
    function: Callable[[Item], Result],
    items: Iterable[Item],
    otherwise: Callable[[Callable[[Item], Result], Iterable[Item]], Iterable[Result]] = map,
    on_loss: Callable[[Item, str], Result] | None = None,
) -> Iterator[Result]:
    """Apply a function to items in parallel; the results are in the order of the items.

    Workers of `distributing` apply it, else copies of this process.

    Parameters
    ----------
    function : function of any kind; what it changes in a copy is lost
    items : arguments; pickle must take the results
    otherwise : applies the function with one processor, or where processes cannot be copied
    on_loss : result of an item that ended two workers; see `ProcessPool.in_order`
    """

    def here(function: Callable[[Item], Result], items: Iterable[Item]) -> Iterator[Result]:
        if processors() == 1 or not can_fork():
            yield from otherwise(function, items)
            return
        with ProcessPool(processors(), inherited=function) as pool:
            yield from pool.in_order(function, items, on_loss)

    return distributed(function, items, here, on_loss)


def _refuse(_: object, reason: str) -> NoReturn:
    """Report an item that ended two workers."""
    raise SolverError(
        f"two worker processes ended at the same item ({reason}): "
        "if memory ran out, use fewer workers"
    )
