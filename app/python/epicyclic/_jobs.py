"""Commands of the program at work: waiting, messages, progress, Ctrl-C, and the folder that they leave."""

from __future__ import annotations

import json
import logging
import os
import shutil
import sys
import tempfile
import warnings
import weakref
from pathlib import Path
from typing import Any, Callable, Dict, Iterator, List, Optional, Sequence, Tuple, Union

from ._errors import OutputError, core, repr_of
from ._results import Result
from ._results import open as open_folder

#: Receives the name of the present part, numbers of finished and of all units (None: not known), and of failed ones.
ProgressFunction = Callable[[str, int, Optional[int], int], None]

_log = logging.getLogger("epicyclic")

#: Seconds between two checks of signals, messages and progress.
_INTERVAL = 0.05

_STOPPED = 75


def own_threads() -> int:
    """Count the cores that this process may use, as the command does."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


class Job:
    """A command with its input in a file and its folder.

    Parameters
    ----------
    command
        Name, such as ``"sweep"``.
    document
        The study; None for that of ``origins``.
    out
        Folder; None for a temporary one.
    threads
        Number of threads; None for all cores.
    progress
        A function, True for a bar by tqdm, or for a line on stderr if tqdm is not installed.
    origins, grow, against
        Folders for the options of that name; ``origins`` are those of ``--from``.
    rows
        Points that are taken as they are computed; after as many the command stops.
    sets
        Texts for ``--set``: a JSON pointer, ``=`` and a JSON value.
    part
        Number of a part, from 1, and of all parts: the share of the points to compute. None: all, with the results.
    """

    def __init__(
        self,
        command: str,
        document: Optional[Dict[str, Any]],
        out: Union[None, str, Path],
        threads: Optional[int],
        progress: Union[None, bool, ProgressFunction] = None,
        origins: Sequence[str] = (),
        grow: Union[None, str, Path] = None,
        against: Union[None, str, Path] = None,
        rows: int = 0,
        sets: Sequence[str] = (),
        part: Optional[Tuple[int, int]] = None,
    ) -> None:
        count = own_threads() if threads is None else threads
        if not isinstance(count, int) or isinstance(count, bool) or not 1 <= count <= 4096:
            raise ValueError(f"threads is {repr_of(threads)}, must be an integer from 1 to 4096")
        module = core()
        self._show = _shown(progress)
        self._scratch = Path(tempfile.mkdtemp(prefix="epicyclic-"))
        self._remove = weakref.finalize(self, shutil.rmtree, self._scratch, ignore_errors=True)
        self._temporary = out is None
        self.folder = self._scratch / command if out is None else Path(out)
        self._words: List[str] = []
        study = "" if document is None else str(self._scratch / "input.json")
        if study:
            Path(study).write_text(json.dumps(document, indent=2) + "\n", encoding="utf-8")
        self._core = module.Job(
            command, study, str(self.folder), count, list(sets), [str(o) for o in origins], str(grow or ""),
            str(against or ""), rows, *(part or (0, 0)),
        )

    def __del__(self) -> None:
        """Stop a command that nobody waits for."""
        if hasattr(self, "_core"):
            self._core.stop()

    def rows(self) -> Iterator[Dict[str, Any]]:
        """Yield the points as they are computed, to the end of the command."""
        try:
            over = False
            while not over:
                over = self._core.wait(_INTERVAL)
                self._deliver()
                yield from self._core.rows()
        except BaseException:
            self._abandon()
            raise

    def wait(self) -> Result:
        """Wait for the end, and open the folder."""
        for _ in self.rows():
            pass
        return self._finished()

    def wait_for_part(self) -> None:
        """Wait for the end of a part, which leaves a journal and no results."""
        for _ in self.rows():
            pass
        if self._core.result() != 0:
            raise OutputError("\n".join(self._words))

    def _finished(self) -> Result:
        code = self._core.result()
        if code not in (0, 1):
            words = "\n".join(self._words) or f"the command ended with code {code}"
            if code == _STOPPED:
                raise KeyboardInterrupt(words)
            raise OutputError(words)
        result = open_folder(self.folder)
        if self._temporary:
            self._remove.detach()
            weakref.finalize(result, shutil.rmtree, self._scratch, ignore_errors=True)
        return result

    def _abandon(self) -> None:
        """Stop as by Ctrl-C of the command, and wait until the folder is in order."""
        self._core.stop()
        while True:
            try:
                while not self._core.wait(_INTERVAL):
                    pass
                break
            except KeyboardInterrupt:
                continue
        self._deliver(show=False)

    def _deliver(self, show: bool = True) -> None:
        words, _, cautions = self._core.messages()
        for text in cautions:
            warnings.warn(text.strip().removeprefix("warning: "), stacklevel=_stack_level())
        for text in words:
            line = text.strip()
            if line.startswith("warning: "):
                warnings.warn(line.removeprefix("warning: "), stacklevel=_stack_level())
            elif line:
                self._words.append(line)
                _log.info("%s", line)
        state: Optional[Tuple[str, int, Optional[int], int]] = self._core.progress()
        if state is not None and show and self._show is not None:
            self._show(*state)


def _stack_level() -> int:
    """Return the level of the caller outside of this package, for warnings."""
    level = 1
    frame = sys._getframe(1)
    here = os.path.dirname(os.path.abspath(__file__))
    while frame is not None and os.path.dirname(os.path.abspath(frame.f_code.co_filename)) == here:
        level += 1
        if frame.f_back is None:
            break
        frame = frame.f_back
    return level


def _shown(progress: Union[None, bool, ProgressFunction]) -> Optional[ProgressFunction]:
    if progress is None or progress is False:
        return None
    if progress is True:
        return _Bar()
    if not callable(progress):
        raise TypeError(f"progress is {repr_of(progress)}, must be a function, True or None")
    return progress


class _Bar:
    """Bars by tqdm, one for each part; without tqdm a line on stderr."""

    def __init__(self) -> None:
        self._bar: Any = None
        self._label = ""
        try:
            from tqdm.auto import tqdm

            self._tqdm: Any = tqdm
        except ImportError:
            self._tqdm = None

    def __call__(self, label: str, done: int, total: Optional[int], failed: int) -> None:
        if self._tqdm is None:
            end = "\n" if done == total else ""
            print(f"\r{label} {done}/{'?' if total is None else total}", end=end, file=sys.stderr, flush=True)
            return
        if self._bar is None or label != self._label:
            if self._bar is not None:
                self._bar.close()
            self._bar = self._tqdm(desc=label, total=total)
            self._label = label
        self._bar.update(done - self._bar.n)
        if done == total:
            self._bar.close()
            self._bar = None
