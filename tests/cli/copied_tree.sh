#!/usr/bin/env bash
# copied_tree.sh EPICYCLIC SOURCE_DIR
#
# Two commands at once in a tree build one after the other. app/run in a tree that was copied with its build folder configures and builds anew, and says so; in its own tree, by a link
# to it too, it keeps what is built. By a cmake that only tells what it is asked for.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.bash"

mkdir bin
printf '#!/bin/sh\necho "$*" >>"%s/asked"\n' "$work" >bin/cmake
chmod +x bin/cmake

# prepare_build in tree $1; what cmake was asked for in `asked`, what is said in stderr.
build_in() {
  rm -f asked
  (PATH=$work/bin:$PATH && source "$1/app/prepare" && prepare_build release OFF epicyclic) 2>stderr || fail "$1: $(<stderr)"
}
# A tree with a build of the tree $2 in it.
make_tree() {
  mkdir -p "$1/app" "$1/build/release"
  cp "$2/app/prepare" "$1/app/"
  cp "$2/CMakePresets.json" "$1/"
  printf 'EPICYCLIC_TESTS:BOOL=OFF\nCMAKE_HOME_DIRECTORY:INTERNAL=%s\n' "$3" >"$1/build/release/CMakeCache.txt"
  touch "$1/build/release/object.o"
  sleep 0.01
  touch "$1/build/release/build.ninja"
}

source_dir=$(cd "$inputs/.." && pwd)
make_tree "$work/own tree" "$source_dir" "$work/own tree"
ln -s "$work/own tree" link
for tree in "$work/own tree" link; do
  build_in "$tree"
  ! grep -q -- '--preset' asked || fail "$tree is configured again: $(<asked)"
  [ -e "$work/own tree/build/release/object.o" ] || fail "$tree: what is built is not kept"
  [ ! -s stderr ] || fail "$tree: says $(<stderr)"
done

for home in "$work/own tree" "$work/tree that was moved away"; do
  rm -rf copy
  make_tree "$work/copy" "$source_dir" "$home"
  build_in "$work/copy"
  grep -q -- '--preset release' asked || fail "a copy of $home is not configured: $(<asked)"
  [ ! -e copy/build/release/object.o ] || fail "a copy of $home keeps objects of the other sources"
  grep -qF "is a build of $home" stderr || fail "a copy of $home: not told: $(<stderr)"
done

# Two commands at once build one after the other. What is started afterwards has no lock.
printf '#!/bin/sh\necho begin >>"%s/order"\nsleep 0.3\necho end >>"%s/order"\n' "$work" "$work" >bin/cmake
make_tree "$work/shared" "$source_dir" "$work/shared"
for number in 1 2; do
  (
    PATH=$work/bin:$PATH && source shared/app/prepare && prepare_build release OFF epicyclic
    exec bash -c 'ls -l /proc/$$/fd'
  ) >at_once.$number 2>&1 &
done
wait
[ "$(tr '\n' ' ' <order)" = 'begin end begin end ' ] || fail "two commands build at once: $(<order)"
[ "$(grep -l 'waiting for another command' at_once.? | wc -l)" = 1 ] || fail "it is not said that one of them waits: $(cat at_once.?)"
! grep -q 'prepare.lock' at_once.? || fail "the lock is kept: $(cat at_once.?)"
finish
