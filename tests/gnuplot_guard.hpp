// Tests that draw are skipped, and said to be, where gnuplot is missing; others have no use for the time it takes.
#pragma once

#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "figures/gnuplot.hpp"
#include "temporary_folder.hpp"

namespace epicyclic::test {

inline bool have_gnuplot() {
  const TemporaryFolder folder;
  put_file(folder / "empty.gp", "\n");
  return figures::run_gnuplot(folder / "empty.gp").drawn();
}

/// While it lives no gnuplot is found: figures are not drawn, what they would be drawn from is written all the same.
class WithoutGnuplot {
 public:
  WithoutGnuplot() : path_(std::getenv("PATH")) { ::setenv("PATH", "/nowhere", 1); }
  ~WithoutGnuplot() { ::setenv("PATH", path_.c_str(), 1); }
  WithoutGnuplot(const WithoutGnuplot&) = delete;
  WithoutGnuplot& operator=(const WithoutGnuplot&) = delete;

 private:
  std::string path_;
};

}  // namespace epicyclic::test

#define EPICYCLIC_NEEDS_GNUPLOT() \
  if (!epicyclic::test::have_gnuplot()) GTEST_SKIP() << "gnuplot is not installed"
