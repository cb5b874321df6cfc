"""One drawing of a character in, a rigged, textured, animated 3D model out.

    import skel
    hero = skel.rig("hero.png")
    hero.save("hero.glb")
"""

import os
import sys
import time
from collections import deque
from concurrent.futures import Future, ThreadPoolExecutor
from typing import Any, Callable, Deque, Iterable, Iterator, Literal, Optional, Union, overload

from ._core import (
    CLASSES,
    Candidates,
    Character,
    Clip,
    Drawing,
    Error,
    Evaluation,
    Film,
    InputError,
    Joint,
    LabelledCharacter,
    LabelledSet,
    Mesh,
    Net,
    OutputError,
    Pose,
    Training,
    UnavailableError,
    UsageError,
    builtin_clips,
    candidates,
    evaluate,
    load,
    rig,
    train,
)
from ._core import __version__ as __version__

__all__ = [
    "CLASSES", "Candidates", "Character", "Clip", "Drawing", "Error", "Evaluation", "Film", "InputError", "Joint",
    "LabelledCharacter", "LabelledSet", "Mesh", "Net", "OutputError", "Pose", "Training", "UnavailableError", "UsageError",
    "builtin_clips", "candidates", "evaluate", "load", "rig", "rig_many", "train",
]

Progress = Union[bool, Callable[[int], None]]
_Paths = Iterable[Union[str, "os.PathLike[str]"]]


class _Counter:
    """A line on stderr, if that is a terminal: how many are done."""

    def __init__(self) -> None:
        self.visible, self.start, self.last = sys.stderr.isatty(), time.monotonic(), 0.0

    def __call__(self, done: int) -> None:
        now = time.monotonic()
        if self.visible and now - self.start > 1 and now - self.last > 0.1:
            self.last = now
            print(f"\rrigged {done}, {done / (now - self.start):.1f} a second ", end="", file=sys.stderr, flush=True)

    def end(self) -> None:
        if self.last:
            print(file=sys.stderr)


@overload
def rig_many(
    paths: _Paths, *, jobs: int = ..., progress: Progress = ..., errors: Literal["raise"] = ..., **options: Any
) -> Iterator[Drawing]: ...
@overload
def rig_many(
    paths: _Paths, *, jobs: int = ..., progress: Progress = ..., errors: Literal["return"], **options: Any
) -> Iterator[Union[Drawing, Error]]: ...
def rig_many(
    paths: _Paths,
    *,
    jobs: int = 0,
    progress: Progress = True,
    errors: Literal["raise", "return"] = "raise",
    **options: Any,
) -> Iterator[Union[Drawing, Error]]:
    """Rigs many drawings on several cores and yields them in their order.

    jobs: at a time; 0: one a core. progress: a line on a terminal, or what is called with the number done. errors: "raise" the
    first, or "return" an Error in the place of a drawing that cannot be rigged. options: of rig(). Few drawings more than are at
    work are held in memory, however many come. Ctrl+C ends it after those at work.
    """
    if isinstance(paths, (str, bytes, os.PathLike)):
        raise UsageError("paths: must be a list of paths, not a single one; rig() takes that")
    if not 0 <= jobs <= 1024:
        raise UsageError("jobs: must be from 0 to 1024")
    if errors not in ("raise", "return"):
        raise UsageError(f'errors: "{errors}" is none of raise, return')
    return _rigged(paths, jobs or os.cpu_count() or 1, progress, errors == "raise", options)


def _rigged(
    paths: _Paths, workers: int, progress: Progress, raises: bool, options: Any
) -> Iterator[Union[Drawing, Error]]:
    counter = _Counter()
    tell: Optional[Callable[[int], None]] = progress if callable(progress) else counter if progress else None

    def work(path: Union[str, "os.PathLike[str]"]) -> Union[Drawing, Error]:
        try:
            return rig(os.fspath(path), **options)
        except Error as error:
            return error

    waiting: Deque["Future[Union[Drawing, Error]]"] = deque()
    done = 0
    pool = ThreadPoolExecutor(workers)
    try:
        coming = iter(paths)
        more = True
        while more or waiting:
            while more and len(waiting) < 2 * workers:
                try:
                    waiting.append(pool.submit(work, next(coming)))
                except StopIteration:
                    more = False
            if not waiting:
                break
            result = waiting.popleft().result()
            done += 1
            if tell:
                tell(done)
            if raises and isinstance(result, Error):
                raise result
            yield result
    finally:
        for future in waiting:
            future.cancel()
        pool.shutdown(wait=True)
        counter.end()
