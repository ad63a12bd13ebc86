#include "studies/mesh_watch.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "studies/pulls.hpp"

namespace epicyclic::studies {

std::string MeshRecord::contact() const {
  std::string text;
  const auto add = [&](bool seen, const char* word) {
    if (!seen) return;
    if (!text.empty()) text += '+';
    text += word;
  };
  add(drive, "drive");
  add(loss, "loss");
  add(back, "back");
  return text;
}

MeshWatch::MeshWatch(const model::DynamicModel& model) : model_(model) {
  MeshRecord empty;
  empty.delta_min = std::numeric_limits<double>::infinity();
  empty.delta_max = -empty.delta_min;
  records_.sun_planet.assign(static_cast<std::size_t>(model.planets), empty);
  records_.ring_planet = records_.sun_planet;
  pulls_.sun_planet.assign(records_.sun_planet.size(), 0.0);
  pulls_.ring_planet = pulls_.sun_planet;
}

void MeshWatch::see(double s, std::span<const double> y) {
  model_.deflections(s, y.data(), now_);
  if (model_.pulls) model_.pulls(s, now_, pulls_);
  ++seen_;
  see_meshes(now_.sun_planet, pulls_.sun_planet, model_.sun_planet_half_gap, records_.sun_planet);
  see_meshes(now_.ring_planet, pulls_.ring_planet, model_.ring_planet_half_gap, records_.ring_planet);
}

MeshRecords MeshWatch::finished() const {
  // Counts become parts.
  MeshRecords all = records_;
  for (auto* meshes : {&all.sun_planet, &all.ring_planet})
    for (MeshRecord& r : *meshes) r.pull_time /= static_cast<double>(std::max(1L, seen_));
  return all;
}

void MeshWatch::see_meshes(const std::vector<double>& delta, const std::vector<double>& pulls, double half_gap,
                           std::vector<MeshRecord>& records) {
  double least = delta[0];
  double most = delta[0];
  for (std::size_t i = 0; i < delta.size(); ++i) {
    MeshRecord& r = records[i];
    least = std::min(least, delta[i]);
    most = std::max(most, delta[i]);
    r.delta_min = std::min(r.delta_min, delta[i]);
    r.delta_max = std::max(r.delta_max, delta[i]);
    const double pull = told_pull(pulls[i], model_.static_mesh_force);
    r.pull = std::max(r.pull, pull / model_.static_mesh_force);
    r.pull_time += pull > 0.0 ? 1.0 : 0.0;
    switch (model::DynamicModel::contact(delta[i], half_gap)) {
      case model::Contact::drive:
        r.drive = true;
        break;
      case model::Contact::loss:
        r.loss = true;
        break;
      case model::Contact::back:
        r.back = true;
        break;
    }
  }
  records_.planet_spread = std::max(records_.planet_spread, most - least);
}

}  // namespace epicyclic::studies
