#include "studies/response_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <iterator>
#include <numbers>
#include <numeric>

#include "studies/tension.hpp"

namespace epicyclic::studies {

namespace {

/// Of slow changes: a peak is known to 1 - cos(pi / 256) of its amplitude at 64 phases.
constexpr int least_refinement = 4;

/// In the order of time.
template <class Numbers>
double sum_of(const Numbers& x) {
  double sum = 0.0;
  for (std::size_t lane = 0; lane < model::phases_together; ++lane) sum += x[lane];
  return sum;
}

template <class Numbers>
double largest_of(const Numbers& x) {
  double most = x[0];
  for (std::size_t lane = 1; lane < model::phases_together; ++lane) most = std::max(most, x[lane]);
  return most;
}

/// The largest of a number of some meshes; 0 of none.
template <class F>
double largest(const std::vector<MeshRecord>& meshes, const F& number) {
  if (meshes.empty()) return 0.0;
  return std::invoke(number, *std::ranges::max_element(meshes, {}, number));
}

/// Of the values of a quantity at `phases`.
Course course_of(const std::vector<double>& x, const analysis::RecordingPhases& phases) {
  Course c;
  c.least = *std::ranges::min_element(x);
  c.largest = *std::ranges::max_element(x);
  std::vector<double> uniform;
  for (std::size_t k = 0; k < x.size(); ++k)
    if (phases.kind[k] == analysis::SampleKind::uniform) uniform.push_back(x[k]);
  const auto count = static_cast<double>(uniform.size());
  c.mean = std::accumulate(uniform.begin(), uniform.end(), 0.0) / count;
  double squares = 0.0;
  for (const double value : uniform) squares += (value - c.mean) * (value - c.mean);
  c.rms = std::sqrt(squares / count);
  return c;
}

/// The outputs of a model without outputs of its own: deflections.
model::StageOutputs outputs_of_deflections(const model::DynamicModel& model, const std::vector<double>& phases) {
  return [&model, phases, y = std::vector<double>(model.dimension), d = model::MeshDeflections()](
             std::size_t group, const double* states, double* rows) mutable {
    constexpr std::size_t together = model::phases_together;
    const model::OutputRows at{static_cast<std::size_t>(model.planets)};
    std::fill(rows, rows + at.count() * together, 0.0);
    for (std::size_t lane = 0; lane < together; ++lane) {
      for (std::size_t k = 0; k < y.size(); ++k) y[k] = states[k * together + lane];
      model.deflections(phases[std::min(group * together + lane, phases.size() - 1)], y.data(), d);
      for (std::size_t i = 0; i < d.sun_planet.size(); ++i) {
        rows[at.sun_planet(i).delta() * together + lane] = d.sun_planet[i];
        rows[at.ring_planet(i).delta() * together + lane] = d.ring_planet[i];
      }
    }
  };
}

}  // namespace

int extrema_refinement(const model::DynamicModel& model, int phases) {
  constexpr double samples = 20.0;  // of an oscillation: its peak is known to 1 - cos(pi / 20), 1.2 % of the amplitude
  constexpr int most = 8192;
  const double wanted = model.omega > 0.0 ? samples * fastest_mode / model.omega : 0.0;
  const int half = static_cast<int>(std::ceil(std::min(wanted, double{most}) / (2.0 * phases)));
  return std::max(least_refinement, 2 * half);
}

double MeshRecord::loss() const {
  constexpr double rounding = 1e-12;  // far below the part of one sample
  const double part = 1.0 - drive - back;
  return std::abs(part) < rounding ? 0.0 : part;
}

std::string MeshRecord::contact() const {
  std::string text;
  const auto add = [&](double time, const char* word) {
    if (!(time > 0.0)) return;
    if (!text.empty()) text += '+';
    text += word;
  };
  add(drive, "drive");
  add(loss(), "loss");
  add(back, "back");
  return text;
}

double MeshRecord::kv() const { return studies::dynamic_factor(force.largest, quasi_static); }

double StageRecord::share(const std::vector<MeshRecord>& meshes, double Course::*of, std::size_t planet) {
  double sum = 0.0;
  for (const MeshRecord& r : meshes) sum += r.force.*of;
  return static_cast<double>(meshes.size()) * meshes[planet].force.*of / sum;
}

double StageRecord::largest_share(double Course::*of) const {
  double most = 0.0;
  for (const auto* meshes : {&sun_planet, &ring_planet})
    for (std::size_t i = 0; i < meshes->size(); ++i) most = std::max(most, share(*meshes, of, i));
  return most;
}

double StageRecord::dynamic_factor(const std::vector<MeshRecord>& meshes) const {
  return largest(meshes, [](const MeshRecord& r) { return r.force.largest; }) / static_force;
}

double StageRecord::kv(const std::vector<MeshRecord>& meshes) {
  if (meshes.empty()) return std::numeric_limits<double>::quiet_NaN();
  return std::ranges::max_element(meshes, {}, [](const MeshRecord& r) { return r.force.largest; })->kv();
}

double StageRecord::k_gamma(const std::vector<MeshRecord>& meshes) {
  double mean = 0.0;
  for (const MeshRecord& r : meshes) mean += r.quasi_static.mean / static_cast<double>(meshes.size());
  return largest(meshes, [](const MeshRecord& r) { return r.quasi_static.largest; }) / mean;
}

std::vector<Course> quasi_static_forces(const model::DynamicModel& model, int count) {
  if (!(model.static_mesh_force > 0.0) || !model.quasi_static_states) return {};
  const analysis::RecordingPhases phases(model, count, least_refinement);
  const std::vector<std::vector<double>> states = model.quasi_static_states(phases.s);
  std::vector<std::vector<double>> forces(2 * static_cast<std::size_t>(model.planets));
  model::StageForces f;
  for (std::size_t k = 0; k < states.size(); ++k) {
    model.forces(phases.s[k], states[k].data(), f);
    auto mesh = forces.begin();
    for (const auto* list : {&f.sun_planet_elastic, &f.ring_planet_elastic})
      for (const double force : *list) (mesh++)->push_back(model.scales.force_newton(force));
  }
  std::vector<Course> all;
  if (!states.empty())
    std::ranges::transform(forces, std::back_inserter(all), [&](const auto& x) { return course_of(x, phases); });
  return all;
}

double StageRecord::tension(const std::vector<MeshRecord>& meshes) { return largest(meshes, &MeshRecord::tension); }

double StageRecord::tension_time(const std::vector<MeshRecord>& meshes) {
  return largest(meshes, &MeshRecord::tension_time);
}

double StageRecord::loss_time(const std::vector<MeshRecord>& meshes) { return largest(meshes, &MeshRecord::loss); }

double StageRecord::largest_bearing_force() const {
  return planet_bearing.empty() ? 0.0 : std::ranges::max(planet_bearing, {}, &Course::largest).largest;
}

double StageRecord::shortest_life() const {
  if (planet_lives.empty()) return std::numeric_limits<double>::quiet_NaN();
  return std::ranges::min(planet_lives, {}, &gear::BearingLife::hours).hours;
}

ResponseStatistics::ResponseStatistics(const model::DynamicModel& model, int phases, StatisticsOptions options)
    : model_(model),
      rows_{static_cast<std::size_t>(model.planets)},
      phases_(recording_phases(model, phases)),
      count_(static_cast<std::size_t>(phases)),
      states_(model.dimension, Numbers(0.0)),
      now_(rows_.count()),
      sums_(rows_.count()),
      sun_planet_(rows_.planets),
      ring_planet_(rows_.planets),
      options_(options) {
  recording_ = model.outputs_at ? model.outputs_at(phases_.s) : outputs_of_deflections(model, phases_.s);
  uniform_.assign((phases_.size() + model::phases_together - 1) / model::phases_together, Numbers(0.0));
  odd_ = uniform_;
  for (std::size_t k = 0; k < phases_.size(); ++k) {
    const std::size_t group = k / model::phases_together;
    const std::size_t lane = k % model::phases_together;
    if (phases_.kind[k] == analysis::SampleKind::uniform) uniform_[group].set(lane, 1.0);
    if (phases_.kind[k] == analysis::SampleKind::odd) odd_[group].set(lane, 1.0);
  }
  for (std::vector<double>& profile : profiles_) profile.assign(count_, 0.0);
  for (std::size_t i = 0; i < rows_.planets; ++i)
    forces_.insert(forces_.end(), {rows_.sun_planet(i).force(), rows_.ring_planet(i).force(), rows_.planet_bearing(i)});
  forces_.push_back(rows_.sun_bearing());
  if (model.bearings.planet)
    for (std::size_t i = 0; i < rows_.planets; ++i)
      rated_planets_.push_back({rows_.planet_bearing(i), *model.bearings.planet});
  if (model.bearings.sun) rated_sun_.push_back({rows_.sun_bearing(), *model.bearings.sun});
  coarse_.assign(forces_.size(), Numbers(0.0));
}

void ResponseStatistics::see(std::span<const double> y) {
  const std::size_t phase = seen_ % phases_.size();
  const std::size_t lane = phase % model::phases_together;
  for (std::size_t k = 0; k < y.size(); ++k) states_[k].set(lane, y[k]);
  ++seen_;
  if (lane + 1 == model::phases_together || phase + 1 == phases_.size())
    recording(phase / model::phases_together, lane + 1);
}

void ResponseStatistics::recording(std::size_t group, std::size_t count) {
  recording_(group, reinterpret_cast<const double*>(states_.data()), reinterpret_cast<double*>(now_.data()));
  if (seen_ == count)
    for (std::size_t row = 0; row < sums_.size(); ++row) {
      const Numbers first(now_[row][0]);
      sums_[row] = {first, first, first, Numbers(0.0), Numbers(0.0)};
    }
  if (seen_ == count)
    for (std::size_t k = 0; k < forces_.size(); ++k) coarse_[k] = sums_[forces_[k]].first;
  // A group at the end of a period may not be full: missing members add nothing.
  Numbers one = uniform_[group];
  const auto is_odd = odd_[group] > Numbers(0.0);
  for (std::size_t lane = count; lane < model::phases_together; ++lane) {
    one.set(lane, 0.0);
    for (std::size_t row = 0; row < sums_.size(); ++row) now_[row].set(lane, sums_[row].first[0]);
  }
  for (std::size_t row = 0; row < sums_.size(); ++row) {
    Sums& s = sums_[row];
    const Numbers beyond = one * (now_[row] - s.first);
    s.sum += beyond;
    s.squares += beyond * beyond;
    s.least = min(s.least, now_[row]);
    s.largest = max(s.largest, now_[row]);
  }
  for (std::size_t k = 0; k < forces_.size(); ++k)
    coarse_[k] = max(coarse_[k], select(is_odd, coarse_[k], now_[forces_[k]]));
  for (std::size_t i = 0; i < rows_.planets; ++i) {
    count_contact(rows_.sun_planet(i), model_.sun_planet_half_gap, one, sun_planet_[i]);
    count_contact(rows_.ring_planet(i), model_.ring_planet_half_gap, one, ring_planet_[i]);
  }
  for (const auto kind : {&model::OutputRows::sun_planet, &model::OutputRows::ring_planet}) {
    Numbers least = now_[(rows_.*kind)(0).delta()];
    Numbers most = least;
    for (std::size_t i = 1; i < rows_.planets; ++i) {
      const Numbers& delta = now_[(rows_.*kind)(i).delta()];
      least = min(least, delta);
      most = max(most, delta);
    }
    spread_ = max(spread_, most - least);
  }
  for (auto* list : {&rated_planets_, &rated_sun_})
    for (Rated& rated : *list)
      for (std::size_t lane = 0; lane < count; ++lane)
        if (one[lane] != 0.0) rated.sum += std::pow(now_[rated.row][lane], rated.bearing.exponent);
  const std::array signals = {rows_.sun_planet(0).delta(), rows_.ring_planet(0).delta(), rows_.transmission_error()};
  for (std::size_t lane = 0; lane < count; ++lane) {
    if (one[lane] == 0.0) continue;
    const std::size_t j = weighed_++ % count_;
    for (std::size_t k = 0; k < signals.size(); ++k) profiles_[k][j] += now_[signals[k]][lane];
    if (options_.signal) signal_.push_back(now_[signals[0]][lane]);
  }
}

void ResponseStatistics::count_contact(const model::OutputRows::Mesh& at, double half_gap, const Numbers& one,
                                       Counts& counts) const {
  const Numbers nothing(0.0);
  const Numbers& delta = now_[at.delta()];
  const Numbers drive = select(delta > Numbers(half_gap), one, nothing);
  const Numbers back = select(delta < Numbers(-half_gap), one, nothing);
  counts.drive += drive;
  counts.back += back;
  const Numbers tension = noticeable_tension(
      model::tensile_force(delta, half_gap, now_[at.elastic()], now_[at.force()]), model_.static_mesh_force);
  counts.tension = max(counts.tension, tension);
  counts.tensile += select(tension > nothing, one, nothing);
}

StageRecord ResponseStatistics::finish() {
  const std::size_t phase = seen_ % phases_.size();
  if (const std::size_t begun = phase % model::phases_together; begun > 0)
    recording(phase / model::phases_together, begun);
  const double newton = model_.scales.force_newton(1.0);
  StageRecord all;
  for (std::size_t i = 0; i < rows_.planets; ++i) {
    all.sun_planet.push_back(mesh(rows_.sun_planet(i), sun_planet_[i]));
    all.ring_planet.push_back(mesh(rows_.ring_planet(i), ring_planet_[i]));
    all.planet_bearing.push_back(course(rows_.planet_bearing(i), newton));
  }
  if (!model_.has_ring()) {
    all.ring_planet.assign(1, MeshRecord());
    all.ring_planet[0].drive = 1.0;
  }
  all.planet_spread = largest_of(spread_);
  all.force_error = force_error();
  all.sun_bearing = course(rows_.sun_bearing(), newton);
  for (const Rated& rated : rated_planets_) all.planet_lives.push_back(life(rated));
  for (const Rated& rated : rated_sun_) all.sun_life = life(rated);
  all.transmission_error = course(rows_.transmission_error(), 1.0);
  all.sun_planet_harmonics = harmonics(profiles_[0]);
  all.ring_planet_harmonics = harmonics(profiles_[1]);
  all.transmission_error_harmonics = harmonics(profiles_[2]);
  all.static_force = newton * model_.static_mesh_force;
  all.mesh_frequency = model_.omega * model_.scales.omega_sn;
  all.speeds = model_.speeds;
  if (seen_ == 0 || !options_.quasi_static) return all;
  const std::vector<Course> forces = quasi_static_forces(model_, static_cast<int>(count_));
  for (std::size_t k = 0; k < forces.size(); ++k)
    (k < rows_.planets ? all.sun_planet[k] : all.ring_planet[k - rows_.planets]).quasi_static = forces[k];
  return all;
}

Course ResponseStatistics::course(std::size_t row, double unit) const {
  if (seen_ == 0) return {};
  const Sums& s = sums_[row];
  const auto count = static_cast<double>(weighed_);
  const double mean = sum_of(s.sum) / count;
  Course c;
  c.least = unit * -largest_of(-s.least);
  c.largest = unit * largest_of(s.largest);
  c.mean = unit * (s.first[0] + mean);
  c.rms = unit * std::sqrt(std::max(0.0, sum_of(s.squares) / count - mean * mean));
  return c;
}

gear::BearingLife ResponseStatistics::life(const Rated& rated) const {
  if (seen_ == 0) return {};
  const double mean = rated.sum / static_cast<double>(weighed_);
  return gear::bearing_life(rated.bearing, model_.scales.force_newton(std::pow(mean, 1.0 / rated.bearing.exponent)));
}

double ResponseStatistics::force_error() const {
  if (seen_ == 0) return 0.0;
  double most = 0.0;
  for (std::size_t k = 0; k < forces_.size(); ++k) {
    const double largest = largest_of(sums_[forces_[k]].largest);
    if (largest > 0.0) most = std::max(most, 1.0 - largest_of(coarse_[k]) / largest);
  }
  constexpr double quadratic = 3.0;  // a peak that is missed by e is missed by 4 e at twice the spacing
  return most / quadratic;
}

MeshRecord ResponseStatistics::mesh(const model::OutputRows::Mesh& at, const Counts& counts) const {
  MeshRecord m;
  if (seen_ == 0) return m;
  const double part = 1.0 / static_cast<double>(weighed_);
  m.delta = course(at.delta(), 1.0);
  m.force = course(at.force(), model_.scales.force_newton(1.0));
  m.drive = part * sum_of(counts.drive);
  m.back = part * sum_of(counts.back);
  if (model_.static_mesh_force > 0.0) m.tension = largest_of(counts.tension) / model_.static_mesh_force;
  m.tension_time = part * sum_of(counts.tensile);
  return m;
}

MeshHarmonics ResponseStatistics::harmonics(const std::vector<double>& profile) const {
  MeshHarmonics amplitudes;
  const auto phases = static_cast<double>(count_);
  for (std::size_t h = 1; h <= amplitudes.size(); ++h) {
    if (weighed_ == 0 || weighed_ % count_ != 0 || count_ <= 2 * h) {
      amplitudes[h - 1] = std::numeric_limits<double>::quiet_NaN();
      continue;
    }
    std::complex<double> sum;
    for (std::size_t j = 0; j < count_; ++j)
      sum += profile[j] * std::polar(1.0, -2.0 * std::numbers::pi * static_cast<double>(h * (j + 1) % count_) / phases);
    amplitudes[h - 1] = 2.0 * std::abs(sum) / static_cast<double>(weighed_);
  }
  return amplitudes;
}

}  // namespace epicyclic::studies
