"""The exception of the package, and imports that may be missing."""

from __future__ import annotations

import importlib
from typing import Any


class ResultError(Exception):
    """A folder cannot be read, or does not contain what was requested.

    The message names the folder or file, the reason and, if there is one, the remedy.
    """


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
