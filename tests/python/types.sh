#!/usr/bin/env bash
# types.sh SOURCE_DIR
#
# Types and documentation of the Python package, by mypy and pydocstyle. Skipped (77) without either.
set -euo pipefail
cd "$1/app/python"
command -v mypy >/dev/null && command -v pydocstyle >/dev/null || { echo "skipped: no mypy, or no pydocstyle"; exit 77; }
mypy --strict --python-version 3.11 --ignore-missing-imports --cache-dir /dev/null epicyclic
pydocstyle --convention=numpy epicyclic
