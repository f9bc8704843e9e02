"""A study as it runs: chunks given to threads, processes or a cluster, parts written, what is found merged in order."""

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
from crankwork.locale import Refusal
from crankwork.study.chunks import Reduced, nothing, opened, part_of, read_part
from crankwork.study.study_file import Study

T = TypeVar("T")
R = TypeVar("R")
# chunks that may be under way before the first that is missing, and for each worker
_AHEAD, _EACH = 64, 2
# how many workers a chunk may end before it is told
_PATIENCE = 4
# from how many things on processes are worth starting, and how many of them one takes at a time
_WORTH, _TOGETHER = 200, 8
# how long a cluster may take to answer
_WAITS = "10s"


class Where(NamedTuple):
    """What calculates: so many workers of this machine, as many as it has processors for 0, or a cluster."""

    workers: int = 0
    scheduler: str = ""


def run_study(
    study: Study,
    folder: str | Path,
    where: Where,
    *,
    resume: bool = False,
    told: Callable[[int], None] | None = None,
) -> Reduced:
    """Return what is found of all designs, after every part that is missing was written into a folder."""
    place = files.StudyFolder(folder, _written(study), resume=resume)
    try:
        return _Run(study, place, where, told).found()
    finally:
        place.close()


def _written(study: Study) -> bytes:
    """Return what names a study in its folder."""
    return f"{json.dumps({**study.identity, 'chunk': opened(study).points}, indent=1)}\n".encode()


class _Run:
    """One run of a study: what is under way, and what is done."""

    def __init__(
        self, study: Study, place: files.StudyFolder, where: Where, told: Callable[[int], None] | None
    ) -> None:
        self._study, self._place, self._where, self._told = study, place, where, told
        self._done = place.done()
        self._under_way: dict[Future[bytes], int] = {}
        self._ended: dict[int, int] = {}
        self._count = opened(study).chunks
        missing = self._count - len(self._done)
        self._workers = max(min(where.workers or os.cpu_count() or 1, missing), 1)

    def found(self) -> Reduced:
        """Return what is found, merged in the order of the chunks."""
        found, following, of = nothing(self._study), 0, opened(self._study)
        found.alone = (of.reason, of.at_key) if of.reason else None
        with _Pool(self._study, self._where, self._workers) as pool:
            try:
                for chunk in range(self._count):
                    following = self._give(pool, chunk, max(following, chunk))
                    while chunk not in self._done:
                        self._take(pool)
                        following = self._give(pool, chunk, following)
                    found.add(self._study, self._part(chunk))
                    if self._told is not None:
                        self._told(found.designs)
            except BaseException:
                for future in self._under_way:
                    future.cancel()
                raise
        return found

    def _give(self, pool: _Pool, first: int, following: int) -> int:
        """Give chunks away until enough are under way; return the number of the next one."""
        while len(self._under_way) < min(_AHEAD, pool.workers * _EACH) and following < min(self._count, first + _AHEAD):
            if following not in self._done:
                self._submit(pool, following)
            following += 1
        return following

    def _submit(self, pool: _Pool, chunk: int) -> None:
        try:
            future = pool.submit(part_of, self._study, chunk)
        except pool.broken:
            # a worker has ended since it was looked at last
            self._give_again(pool, [chunk])
        else:
            self._under_way[future] = chunk

    def _take(self, pool: _Pool) -> None:
        """Wait for a chunk and write its part; what went down with a worker is given away again."""
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
        """Give chunks away again that went down with a worker."""
        if pool.breaks_whole:
            # all that was under way is lost with the pool
            lost += self._under_way.values()
            self._under_way.clear()
            pool.renew()
        for chunk in lost:
            self._ended[chunk] = self._ended.get(chunk, 0) + 1
            if self._ended[chunk] > _PATIENCE and len(lost) == 1:
                raise CrankworkError(Refusal("study_worker", number=str(chunk), count=str(self._ended[chunk])))
            self._submit(pool, chunk)

    def _part(self, chunk: int) -> Reduced:
        try:
            return read_part(self._study, chunk, self._place.read(chunk))
        except ValueError:
            raise CrankworkError(Refusal("study_part", path=self._place.path(chunk))) from None


class _Pool:
    """What chunks are given to: threads where kernels run without the interpreter, processes, or a cluster."""

    def __init__(self, study: Study, where: Where, workers: int) -> None:
        self._where, self.workers = where, workers
        # a compiled calculation of sampled angles leaves the interpreter to others
        is_free = not opened(study).reason and study.angles is not None
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
        """How chunks are given away."""
        assert self._executor is not None  # noqa: S101 - entered
        return self._executor.submit

    def renew(self) -> None:
        """Take a new pool in the place of a broken one."""
        self._end()
        self._executor = self._new()

    def _new(self) -> Executor:
        if self._where.scheduler:
            return self._of_cluster()
        if self._by_threads:
            return ThreadPoolExecutor(self.workers)
        return _processes(self.workers)

    def _of_cluster(self) -> Executor:
        """Return the executor of a cluster, which gives a chunk to another worker where one has ended."""
        if extras := missing_extras({"distributed": "cluster"}):
            raise MissingExtraError(Refusal("extra_cluster"), *extras)
        import distributed  # noqa: PLC0415 - an optional part

        try:
            client: Any = distributed.Client
            self._client = client(self._where.scheduler, timeout=_WAITS, set_as_default=False)
        except (OSError, ValueError) as error:
            reason = getattr(error, "strerror", None) or type(error).__name__
            raise CrankworkError(Refusal("no_scheduler", address=self._where.scheduler, reason=reason)) from None
        self.workers = _AHEAD
        self.broken = (BrokenExecutor, CancelledError, distributed.KilledWorker)
        executor: Executor = self._client.get_executor(pure=False)
        return executor

    def _end(self) -> None:
        if self._where.scheduler:
            # what is under way there is given up with the connection
            self._client.close()
        elif self._executor is not None:
            self._executor.shutdown(cancel_futures=True)


def each(function: Callable[[T], R], of: Sequence[T], workers: int) -> Iterator[R]:
    """Yield what a function gives for each of some things in their order, in processes where these are many."""
    if workers == 1 or len(of) < _WORTH:
        yield from map(function, of)
        return
    pool = _processes(min(workers, len(of)))
    try:
        yield from pool.map(function, of, chunksize=_TOGETHER)
    finally:
        pool.shutdown(cancel_futures=True)


def _processes(count: int) -> ProcessPoolExecutor:
    """Return processes that are started fresh: a fork would inherit the lock of a folder."""
    return ProcessPoolExecutor(count, multiprocessing.get_context("spawn"), _start_worker)


def _start_worker() -> None:
    """Let a worker end with its parent, and leave Ctrl-C to it."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()
    if parent is not None:
        threading.Thread(target=_follow, args=(parent,), daemon=True).start()


def _follow(parent: multiprocessing.process.BaseProcess) -> None:
    parent.join()
    os._exit(1)
