#include "store/versions.hpp"

#include <Eigen/Core>
#include <H5public.h>
#include <fmt/core.h>
#include <gsl/gsl_version.h>
#include <nlohmann/json.hpp>

#include "integrate/lanes/step_loops.hpp"
#include "integrate/sundials/arkode_flow.hpp"

namespace epicyclic::store {

std::map<std::string, std::string> dependency_versions() {
  return {
      {"SUNDIALS", integrate::arkode_version()},
      {"Eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"GSL", gsl_version},
      {"nlohmann-json",
       fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH)},
      {"HDF5", fmt::format("{}.{}.{}", H5_VERS_MAJOR, H5_VERS_MINOR, H5_VERS_RELEASE)},
      {"fmt", fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)},
  };
}

std::string simd_level() { return integrate::step_loops().name; }

}  // namespace epicyclic::store
