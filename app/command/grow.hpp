// A study that goes on from a smaller one: its points are taken where a fresh computation would give the same bytes.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>

#include "finished_study.hpp"
#include "input/study_input.hpp"
#include "store/point_store.hpp"
#include "studies/sweep_plan.hpp"

namespace epicyclic::app {

class GrownStudy {
 public:
  /// @throws InputError where nothing of the finished study in `folder` can be taken, with the reason; and as
  /// FinishedStudy
  GrownStudy(const std::filesystem::path& folder, const input::LoadedInput& input, const studies::SweepPlan& plan,
             std::string_view command);

  /// Puts those points into the store that it does not hold.
  /// @returns how many points of the study are the other's
  std::size_t take_into(store::PointStore& store) const;

 private:
  FinishedStudy from_;
  const studies::SweepPlan& plan_;
};

}  // namespace epicyclic::app
