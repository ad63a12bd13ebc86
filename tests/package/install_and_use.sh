#!/usr/bin/env bash
# install_and_use.sh BUILD_DIR PACKAGE_DIR GENERATOR CXX CXX_FLAGS
#
# Installs BUILD_DIR into a temporary prefix, then configures, builds and runs the program in PACKAGE_DIR against it,
# with the generator, compiler and flags of the build (a library built with a sanitizer needs a program built with it).
set -euo pipefail

build_dir=$1
package_dir=$2
generator=$3
cxx=$4
cxx_flags=$5

temporary=$(mktemp -d)
trap 'rm -rf "$temporary"' EXIT

cmake --install "$build_dir" --prefix "$temporary/prefix" >"$temporary/log"
for file in share/epicyclic/input.schema.json share/epicyclic/octave/+epicyclic/open.m \
  share/bash-completion/completions/epicyclic share/zsh/site-functions/_epicyclic \
  share/fish/vendor_completions.d/epicyclic.fish lib/python3/dist-packages/epicyclic/__init__.py; do
  [ -s "$temporary/prefix/$file" ] || { echo "FAILED: $file is not installed"; exit 1; }
done
[ "$(ls "$temporary"/prefix/share/man/man1/epicyclic-* | wc -l)" -ge 18 ] || { echo "FAILED: man pages"; exit 1; }
# The installed program finds its inputs below its own prefix.
(cd "$temporary" && prefix/bin/epicyclic check tang2020_speed --no-time) 2>&1 | tee "$temporary/log"
grep -q "^input: .*/prefix/share/epicyclic/inputs/tang2020_speed.json$" "$temporary/log" || { echo "FAILED: no input"; exit 1; }
cmake -G "$generator" -S "$package_dir" -B "$temporary/build" -D CMAKE_PREFIX_PATH="$temporary/prefix" \
  -D CMAKE_CXX_COMPILER="$cxx" -D CMAKE_CXX_FLAGS="$cxx_flags" -D CMAKE_FIND_USE_PACKAGE_REGISTRY=OFF
cmake --build "$temporary/build"
"$temporary/build/outside_program"
"$temporary/build/branches"
# Matrices that the library made are freed by a program for wider registers, which Eigen aligns otherwise by itself.
if grep -qw avx2 /proc/cpuinfo; then
  cmake -S "$package_dir" -B "$temporary/build" -D CMAKE_CXX_FLAGS="$cxx_flags -mavx2"
  cmake --build "$temporary/build"
  "$temporary/build/branches"
fi
# The module for Python, if it was built.
for module in "$build_dir"/python/epicyclic/_core*.so; do
  [ -e "$module" ] || continue
  PYTHONPATH=$temporary/prefix/lib/python3/dist-packages /usr/bin/python3 -c 'import epicyclic._core' ||
    { echo "FAILED: the installed module does not load"; exit 1; }
done
