#!/usr/bin/env bash
# Called by conda build.
set -euo pipefail
cmake ${CMAKE_ARGS:-} -G Ninja -S . -B build/conda -D CMAKE_BUILD_TYPE=Release -D EPICYCLIC_BATCHES=ON \
  -D EPICYCLIC_TESTS=OFF -D EPICYCLIC_MPI=OFF -D EPICYCLIC_CLAIMS=ON -D CMAKE_COMPILE_WARNING_AS_ERROR=OFF \
  -D CMAKE_INSTALL_PREFIX="$PREFIX"
cmake --build build/conda
cmake --install build/conda
