// Tests that draw are skipped, and said to be, where gnuplot is missing.
#pragma once

#include <gtest/gtest.h>

#include "io/gnuplot.hpp"
#include "temporary_folder.hpp"

namespace epicyclic::io::test {

inline bool have_gnuplot() {
  const TemporaryFolder folder;
  put_file(folder / "empty.gp", "\n");
  return run_gnuplot(folder / "empty.gp").drawn();
}

}  // namespace epicyclic::io::test

#define EPICYCLIC_NEEDS_GNUPLOT() \
  if (!epicyclic::io::test::have_gnuplot()) GTEST_SKIP() << "gnuplot is not installed"
