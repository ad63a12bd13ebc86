"""Exceptions of the package, and imports that may be missing."""

from __future__ import annotations

import importlib
import re
import reprlib
from typing import Any, Iterable, NamedTuple, Tuple


class ResultError(Exception):
    """A folder cannot be read, or does not contain what was requested.

    The message names the folder or file, the reason and, if there is one, the remedy.
    """


class Problem(NamedTuple):
    """An error in an input, and its place.

    Attributes
    ----------
    file
        Name of the file; empty for values that Python gave.
    line
        From 1; 0 if there is none.
    pointer
        JSON pointer of the value, such as ``"/study/points"``.
    message
        What is wrong.
    suggestion
        What was probably meant, or empty.
    """

    file: str
    line: int
    pointer: str
    message: str
    suggestion: str = ""

    def text(self) -> str:
        """Return all of it in one line."""
        place = f"{self.file}:{self.line}" if self.file and self.line else self.file
        return ": ".join(part for part in (place, self.pointer, self.message) if part)


def repr_of(value: Any) -> str:
    """Return a value for a message, shortened: lists in lists may be deep, and arrays large."""
    return reprlib.repr(value)


def word_of(value: Any) -> str:
    """Return a word for a message; what is no text as ``repr_of`` shows it."""
    return value if isinstance(value, str) else repr_of(value)


_MEANT = re.compile(r"; did you mean (?:one of: )?(.*)\?$")


class InputError(ValueError):
    """An input is wrong. All its errors are in ``problems``.

    Parameters
    ----------
    message
        Text of the exception.
    problems
        Tuples of file, line, pointer and message.
    """

    def __init__(self, message: str, problems: Iterable[Tuple[Any, ...]] = ()) -> None:
        super().__init__(message, [tuple(p) for p in problems])
        self.problems: Tuple[Problem, ...] = tuple(_problem(*tuple(p)[:4]) for p in problems)

    def __str__(self) -> str:
        """Return the message."""
        return str(self.args[0])


def _problem(file: str, line: int, pointer: str, message: str) -> Problem:
    meant = _MEANT.search(message)
    return Problem(file, line, pointer, message, meant.group(1).replace("'", "") if meant else "")


class OutputError(OSError):
    """A folder cannot be used or written: it holds another study, is in use, or the disk is full."""


class NumericalError(ArithmeticError):
    """A computation has no result: a trajectory diverges, or Newton's method finds no orbit."""


def needed(module: str, purpose: str) -> Any:
    """Import a module that only some methods need.

    Parameters
    ----------
    module
        Name of the module, such as ``"pandas"``.
    purpose
        What needs it, for the message.

    Raises
    ------
    ResultError
        If the module is not installed.
    """
    try:
        return importlib.import_module(module)
    except ImportError as error:
        package = module.split(".")[0]
        raise ResultError(
            f"{purpose} needs {package}, which is not installed (Debian: apt install python3-{package})"
        ) from error


def core() -> Any:
    """Import the module that computes.

    Raises
    ------
    ImportError
        If the package was installed without it: then it only reads results.
    """
    try:
        return importlib.import_module("epicyclic._core")
    except ModuleNotFoundError as error:
        raise ImportError(
            "computing needs the module epicyclic._core, which a build with -D EPICYCLIC_PYTHON=ON makes "
            "(Debian: pybind11-dev, python3-dev); the package python3-epicyclic has it; without it results can be read"
        ) from error
