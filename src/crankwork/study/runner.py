"""The run of a study: chunks in threads, processes or a cluster, parts written, aggregates merged in order."""

from __future__ import annotations

import json
import multiprocessing
import os
import signal
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import (
    FIRST_COMPLETED,
    BrokenExecutor,
    CancelledError,
    Executor,
    Future,
    ProcessPoolExecutor,
    ThreadPoolExecutor,
    wait,
)
from pathlib import Path
from typing import Any, NamedTuple, Self, TypeVar

from crankwork import files
from crankwork.errors import CrankworkError, MissingExtraError, missing_extras
from crankwork.locale import ErrorMessage
from crankwork.study.chunks import StudyAggregate, empty_aggregate, part_of, prepared_study, read_part
from crankwork.study.study_file import Study

T = TypeVar("T")
R = TypeVar("R")
# largest number of pending chunks after the first missing one, and for each worker
_MAX_PENDING, _PENDING_PER_WORKER = 64, 2
# number of workers that a chunk may end before it is an error
_MAX_LOST_WORKERS = 4
# number of items from which processes are started, and the size of their batches
_MIN_ITEMS, _BATCH_SIZE = 200, 8
# timeout of a cluster
_TIMEOUT = "10s"


class ExecutionOptions(NamedTuple):
    """Workers on this machine, 0 for as many as processors, or the address of a cluster's scheduler."""

    workers: int = 0
    scheduler: str = ""


def run_study(
    study: Study,
    folder: str | Path,
    where: ExecutionOptions,
    *,
    resume: bool = False,
    progress: Callable[[int], None] | None = None,
) -> StudyAggregate:
    """Write every missing part into a folder and return the aggregate of all designs."""
    place = files.StudyFolder(folder, _written(study), resume=resume)
    try:
        return _Run(study, place, where, progress).run()
    finally:
        place.close()


def _written(study: Study) -> bytes:
    """Return the text that identifies a study in its folder."""
    return f"{json.dumps({**study.identity, 'chunk': prepared_study(study).points}, indent=1)}\n".encode()


class _Run:
    """One run of a study: pending chunks and finished ones."""

    def __init__(
        self, study: Study, place: files.StudyFolder, where: ExecutionOptions, progress: Callable[[int], None] | None
    ) -> None:
        self._study, self._place, self._where, self._progress = study, place, where, progress
        self._done = place.done()
        self._under_way: dict[Future[bytes], int] = {}
        self._ended: dict[int, int] = {}
        self._count = prepared_study(study).chunks
        missing = self._count - len(self._done)
        self._workers = max(min(where.workers or os.cpu_count() or 1, missing), 1)

    def run(self) -> StudyAggregate:
        """Return the aggregate, merged in the order of the chunks."""
        aggregate, following, prepared = empty_aggregate(self._study), 0, prepared_study(self._study)
        aggregate.alone = (prepared.reason, prepared.at_key) if prepared.reason else None
        with _Pool(self._study, self._where, self._workers) as pool:
            try:
                for chunk in range(self._count):
                    following = self._give(pool, chunk, max(following, chunk))
                    while chunk not in self._done:
                        self._take(pool)
                        following = self._give(pool, chunk, following)
                    aggregate.add(self._study, self._part(chunk))
                    if self._progress is not None:
                        self._progress(aggregate.designs)
            except BaseException:
                for future in self._under_way:
                    future.cancel()
                raise
        return aggregate

    def _give(self, pool: _Pool, first: int, following: int) -> int:
        """Submit chunks until enough are pending; return the number of the next one."""
        while len(self._under_way) < min(_MAX_PENDING, pool.workers * _PENDING_PER_WORKER) and following < min(
            self._count, first + _MAX_PENDING
        ):
            if following not in self._done:
                self._submit(pool, following)
            following += 1
        return following

    def _submit(self, pool: _Pool, chunk: int) -> None:
        try:
            future = pool.submit(part_of, self._study, chunk)
        except pool.broken:
            # a worker has ended since the last check
            self._give_again(pool, [chunk])
        else:
            self._under_way[future] = chunk

    def _take(self, pool: _Pool) -> None:
        """Wait for a chunk and write its part; submit again the chunks lost with a worker."""
        lost = []
        for future in wait(self._under_way, return_when=FIRST_COMPLETED).done:
            chunk = self._under_way.pop(future)
            try:
                data = future.result()
            except pool.broken:
                lost.append(chunk)
                continue
            self._place.write(chunk, data)
            self._done.add(chunk)
        if lost:
            self._give_again(pool, lost)

    def _give_again(self, pool: _Pool, lost: list[int]) -> None:
        """Submit chunks again that were lost with a worker."""
        if pool.breaks_whole:
            # all pending chunks are lost with the pool
            lost += self._under_way.values()
            self._under_way.clear()
            pool.renew()
        for chunk in lost:
            self._ended[chunk] = self._ended.get(chunk, 0) + 1
            if self._ended[chunk] > _MAX_LOST_WORKERS and len(lost) == 1:
                raise CrankworkError(ErrorMessage("study_worker", number=str(chunk), count=str(self._ended[chunk])))
            self._submit(pool, chunk)

    def _part(self, chunk: int) -> StudyAggregate:
        try:
            return read_part(self._study, chunk, self._place.read(chunk))
        except ValueError:
            raise CrankworkError(ErrorMessage("study_part", path=self._place.path(chunk))) from None


class _Pool:
    """Executor of chunks: threads if kernels release the interpreter, processes, or a cluster."""

    def __init__(self, study: Study, where: ExecutionOptions, workers: int) -> None:
        self._where, self.workers = where, workers
        # a compiled calculation with sampled angles releases the interpreter lock
        is_free = not prepared_study(study).reason and study.angles is not None
        self._by_threads = not where.scheduler and (is_free or workers == 1)
        self.breaks_whole = not self._by_threads and not where.scheduler
        self.broken: tuple[type[BaseException], ...] = (BrokenExecutor,)
        self._executor: Executor | None = None
        self._client: Any = None

    def __enter__(self) -> Self:
        self._executor = self._new()
        return self

    def __exit__(self, *_: object) -> None:
        self._end()

    @property
    def submit(self) -> Callable[..., Future[bytes]]:
        """Function that submits a chunk."""
        assert self._executor is not None  # noqa: S101 - entered
        return self._executor.submit

    def renew(self) -> None:
        """Replace a broken pool."""
        self._end()
        self._executor = self._new()

    def _new(self) -> Executor:
        if self._where.scheduler:
            return self._of_cluster()
        if self._by_threads:
            return ThreadPoolExecutor(self.workers)
        return _processes(self.workers)

    def _of_cluster(self) -> Executor:
        """Return the executor of a cluster, which retries a chunk on another worker."""
        if extras := missing_extras({"distributed": "cluster"}):
            raise MissingExtraError(ErrorMessage("extra_cluster"), *extras)
        import distributed  # noqa: PLC0415 - an optional part

        try:
            client: Any = distributed.Client
            self._client = client(self._where.scheduler, timeout=_TIMEOUT, set_as_default=False)
        except (OSError, ValueError) as error:
            reason = getattr(error, "strerror", None) or type(error).__name__
            raise CrankworkError(ErrorMessage("no_scheduler", address=self._where.scheduler, reason=reason)) from None
        self.workers = _MAX_PENDING
        self.broken = (BrokenExecutor, CancelledError, distributed.KilledWorker)
        executor: Executor = self._client.get_executor(pure=False)
        return executor

    def _end(self) -> None:
        if self._where.scheduler:
            # closing the connection cancels pending chunks
            self._client.close()
        elif self._executor is not None:
            self._executor.shutdown(cancel_futures=True)


def each(function: Callable[[T], R], items: Sequence[T], workers: int) -> Iterator[R]:
    """Yield the results of a function for items in their order, in processes if there are many items."""
    if workers == 1 or len(items) < _MIN_ITEMS:
        yield from map(function, items)
        return
    pool = _processes(min(workers, len(items)))
    try:
        yield from pool.map(function, items, chunksize=_BATCH_SIZE)
    finally:
        pool.shutdown(cancel_futures=True)


def _processes(count: int) -> ProcessPoolExecutor:
    """Return a pool of spawned processes: a fork would inherit the lock of a folder."""
    return ProcessPoolExecutor(count, multiprocessing.get_context("spawn"), _start_worker)


def _start_worker() -> None:
    """Make a worker end with its parent and ignore Ctrl-C."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()
    if parent is not None:
        threading.Thread(target=_follow, args=(parent,), daemon=True).start()


def _follow(parent: multiprocessing.process.BaseProcess) -> None:
    parent.join()
    os._exit(1)
