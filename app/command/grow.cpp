#include "grow.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/errors.hpp"
#include "store/identity.hpp"
#include "studies/growth.hpp"

namespace epicyclic::app {

namespace {

/// What may be another in the larger study: its grid, and what is done with finished points.
bool may_grow(std::string_view pointer) {
  constexpr std::array<std::string_view, 9> free = {
      "/name",           "/study/from",       "/study/to",    "/study/points", "/study/directions",
      "/study/segments", "/study/crosscheck", "/study/first", "/study/second"};
  if (pointer == "/study/first/parameter" || pointer == "/study/second/parameter" ||
      pointer == "/study/first/component" || pointer == "/study/second/component")
    return false;
  return std::ranges::any_of(
      free, [&](std::string_view f) { return pointer == f || (pointer.starts_with(f) && pointer[f.size()] == '/'); });
}

/// That chains have other ends, if they do.
std::string other_segments(const studies::SweepPlan& there, const studies::SweepPlan& here) {
  const std::size_t old = there.grid.chains_per_line;
  const std::size_t now = here.grid.chains_per_line;
  if (old == now) return ". The values or the directions differ";
  return fmt::format(". /study/segments differs: {} there, {} here; try --set /study/segments={}", old, now, old);
}

}  // namespace

GrownStudy::GrownStudy(const std::filesystem::path& folder, const input::LoadedInput& input,
                       const studies::SweepPlan& plan, std::string_view command)
    : from_(folder), plan_(plan) {
  const std::string where = "--grow " + folder.string() + ": ";
  if (from_.input().study.kind() != command)
    throw InputError(
        fmt::format("{}is a study of kind {}, this is one of kind {}", where, from_.input().study.kind(), command));
  const auto varied = input::varied_parameters(input.study);
  const bool speed_is_varied = std::ranges::any_of(
      varied, [](const auto& parameter) { return parameter.axis.name == studies::speed_parameter; });
  std::string reasons;
  for (const store::Difference& d :
       store::differing_values({from_.input().resolved, from_.input().computed}, {input.resolved, input.computed}))
    if (!may_grow(d.pointer) && !(d.pointer.starts_with("/operation") && speed_is_varied)) reasons += "\n  " + d.text;
  if (!reasons.empty())
    throw InputError(
        where +
        "its points are not those of this study; only range, points, directions and segments may differ:" + reasons);
  const std::size_t common = studies::points_in_common(from_.plan(), plan_, [](std::size_t, std::size_t) {});
  if (common == 0)
    throw InputError(where +
                     "this study has none of its points. A point is the same if its values are the same and, with "
                     "`start` = `continued`, all points before it in its chain" +
                     other_segments(from_.plan(), plan_));
}

std::size_t GrownStudy::take_into(store::PointStore& store) const {
  const studies::PointSource points = from_.points();
  return studies::points_in_common(from_.plan(), plan_, [&](std::size_t there, std::size_t here) {
    if (store.holds(here)) return;
    studies::PointResult r = points.read(there);
    r.point = plan_.points[here];
    store.append(r);
  });
}

}  // namespace epicyclic::app
