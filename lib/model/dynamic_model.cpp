#include "model/dynamic_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "core/errors.hpp"
#include "model/dispatch.hpp"
#include "model/folded_constants.hpp"
#include "model/kernels/lane_kernel.hpp"
#include "model/kernels/stage_kernel.hpp"
#include "model/right_hand_side.hpp"
#include "model/static_equilibrium.hpp"
#include "model/tangents.hpp"

namespace epicyclic::model {

std::vector<ContactSurface> contact_surfaces(const DynamicModel& model) {
  std::vector<ContactSurface> all;
  const auto both = [&](const std::string& part, bool mesh) {
    all.push_back({part, mesh, true});
    all.push_back({part, mesh, false});
  };
  for (int i = 1; i <= model.planets; ++i)
    for (const char* kind : {"sp_", "rp_"})
      if (kind[0] == 's' || model.has_ring()) both(kind + std::to_string(i), true);
  const std::size_t of_planets = model.planet_bearing_gap ? static_cast<std::size_t>(model.planets) : 0;
  if (all.size() + 1 + of_planets == model.surfaces.count) {
    all.push_back({"sun_bearing", false, true});
  } else {
    both("sun_bearing_x", false);
    both("sun_bearing_y", false);
  }
  for (std::size_t i = 1; i <= of_planets; ++i) all.push_back({"planet_bearing_" + std::to_string(i), false, true});
  return all;
}

std::size_t segment_at(const std::vector<double>& breakpoints, double s) {
  const auto next = std::upper_bound(breakpoints.begin(), breakpoints.end(), s);
  if (next == breakpoints.begin()) return breakpoints.empty() ? 0 : breakpoints.size() - 1;
  return static_cast<std::size_t>(next - breakpoints.begin()) - 1;
}

namespace {

/// Is a rotation by one planet a symmetry without a shift in time?
template <std::size_t N>
bool planets_alike(const Parameters<double, N>& p) {
  constexpr double rounding = 1e-9;
  const auto equal = [&](const Row<double, N>& row) {
    return std::all_of(row.begin(), row.end(), [&](double x) { return std::abs(x - row[0]) <= rounding; });
  };
  const auto mesh_alike = [&](const MeshParameters<double, N>& mesh) {
    bool alike = mesh.in_phase && mesh.shafts.empty();
    for (std::size_t h = 0; h < mesh.harmonics; ++h)
      alike = alike && equal(mesh.stiffness_cos[h]) && equal(mesh.stiffness_sin[h]);
    for (std::size_t h = 0; h < mesh.further_error_cos.size(); ++h)
      alike = alike && equal(mesh.further_error_cos[h]) && equal(mesh.further_error_sin[h]);
    return alike && equal(mesh.error_cos) && equal(mesh.error_sin) && equal(mesh.error_mean);
  };
  // Angles 2 pi / N apart: their N-th multiples are one angle, and no two are the same.
  std::array<double, N> angle;
  for (std::size_t i = 0; i < N; ++i) angle[i] = std::atan2(p.sin_phi[i], p.cos_phi[i]);
  bool spaced = true;
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double steps = (angle[i] - angle[j]) * static_cast<double>(N) / (2.0 * std::numbers::pi);
      const double apart = std::remainder(steps, static_cast<double>(N));
      spaced = spaced && std::abs(steps - std::round(steps)) <= rounding && std::abs(apart) > 0.5;
    }
  for (const Row<double, N>* row : {&p.mass_p, &p.inertia_p, &p.bearing_p, &p.bearing_damping_p, &p.centrifugal})
    spaced = spaced && equal(*row);
  return spaced && mesh_alike(p.sun_planet) && mesh_alike(p.ring_planet);
}

/// Equal parts of all planets, and rotations of the central members, taken out of displacements and of velocities.
template <std::size_t N>
void remove_synchronous(Layout layout, const Parameters<double, N>& p, std::span<double> deviation) {
  const std::size_t n = degrees_of_freedom(layout, N);
  for (std::size_t half = 0; half < 2; ++half) {
    Coordinates<double, N> q = unpack<N>(layout, deviation.data() + half * n);
    q.w_s = q.u_r = q.u_c = 0.0;
    // Along the radius through the planet and across.
    const Row<double, N> radial = q.x_p * p.cos_phi + q.y_p * p.sin_phi;
    const Row<double, N> across = q.y_p * p.cos_phi - q.x_p * p.sin_phi;
    constexpr auto count = static_cast<double>(N);
    const Row<double, N> r = radial - sum(radial) / count;
    const Row<double, N> t = across - sum(across) / count;
    q.x_p = r * p.cos_phi - t * p.sin_phi;
    q.y_p = r * p.sin_phi + t * p.cos_phi;
    q.w_p -= sum(q.w_p) / count;
    pack<N>(layout, q, deviation.data() + half * n);
  }
}

/// Coefficients for deflections alone: without the tables of stiffness and friction.
template <std::size_t N>
PhaseCoefficients<double, N> errors_at(const Parameters<double, N>& p, double s) {
  PhaseCoefficients<double, N> now(p, HarmonicBasis<double>(sine_cosine(s), harmonics_of(p)), s);
  const Segment<N>& segment = p.segments[segment_at(p.breakpoints, s)];
  now.sun_planet.interpolate_error(p.omega, p.sun_planet, segment.sun_planet, s);
  now.ring_planet.interpolate_error(p.omega, p.ring_planet, segment.ring_planet, s);
  return now;
}

template <std::size_t N>
void deflections_at(Layout layout, const Parameters<double, N>& p, double s, const double* y, MeshDeflections& out) {
  constexpr Planets<N> all;
  const Deflections<double, N> d = deflections(p, all, unpack(layout, all, y));
  const Deflections<double, N> d_rate = deflections(p, all, unpack(layout, all, y + degrees_of_freedom(layout, N)));
  const PhaseCoefficients<double, N> now = errors_at(p, s);
  const auto set = [](std::vector<double>& row, const Row<double, N>& values) {
    row.assign(values.begin(), values.end());
  };
  set(out.sun_planet, now.sun_planet.delta(all, d.sun_planet));
  set(out.sun_planet_rate, now.sun_planet.rate(all, d_rate.sun_planet));
  if constexpr (N == 1) {
    out.ring_planet.assign(1, 0.0);
    out.ring_planet_rate.assign(1, 0.0);
  } else {
    set(out.ring_planet, now.ring_planet.delta(all, d.ring_planet));
    set(out.ring_planet_rate, now.ring_planet.rate(all, d_rate.ring_planet));
  }
}

template <std::size_t N>
void forces_at(Layout layout, const Parameters<double, N>& p, double s, const double* y, StageForces& out) {
  std::array<double, OutputRows{N}.count()> seen;
  evaluate_outputs(layout, p, PhaseCoefficients<double, N>(p, segment_at(p.breakpoints, s), s), y, seen.data());
  constexpr OutputRows rows{N};
  for (auto* list :
       {&out.sun_planet, &out.ring_planet, &out.sun_planet_elastic, &out.ring_planet_elastic, &out.planet_bearing})
    list->resize(N);
  for (std::size_t i = 0; i < N; ++i) {
    out.sun_planet[i] = seen[rows.sun_planet(i).force()];
    out.sun_planet_elastic[i] = seen[rows.sun_planet(i).elastic()];
    out.ring_planet[i] = seen[rows.ring_planet(i).force()];
    out.ring_planet_elastic[i] = seen[rows.ring_planet(i).elastic()];
    out.planet_bearing[i] = seen[rows.planet_bearing(i)];
  }
  out.sun_bearing = seen[rows.sun_bearing()];
}

/// Tables with rows of something known: what is between them has an error.
bool has_computed_tables(const gear::Stage& stage) {
  const auto of = [](const gear::Mesh& mesh) {
    const auto computed = [](const auto& curve) { return curve && curve->interpolation == Interpolation::smooth; };
    return mesh.friction.ehl || computed(mesh.stiffness_curve) || computed(mesh.error_curve);
  };
  return of(stage.sun_planet_mesh) || of(stage.ring_planet_mesh);
}

/// The instants of all phases are made here, once.
template <std::size_t N, std::size_t W>
StageOutputsAt stage_outputs(Layout layout, const std::shared_ptr<const Parameters<double, N>>& p,
                             const OutputKernel<N, W>& kernel) {
  using Instants = PhaseCoefficients<Lanes<W>, N>;
  struct OutputInstants {
    OutputInstants(const std::shared_ptr<const Parameters<double, N>>& all, std::size_t size)
        : lanes(all), count(size), phase_coefficients(std::make_unique<Instants[]>(size)) {}
    LaneParameters<N, W> lanes;
    std::size_t count;
    std::unique_ptr<Instants[]> phase_coefficients;
  };
  return [layout, p, kernel](std::span<const double> phases) -> StageOutputs {
    const std::size_t groups = (phases.size() + phases_together - 1) / phases_together;
    const auto outputs_at = std::make_shared<OutputInstants>(p, groups * phases_together / W);
    alignas(sizeof(double) * W) std::array<double, W> s;
    for (std::size_t k = 0; k < outputs_at->count; ++k) {
      for (std::size_t lane = 0; lane < W; ++lane) {
        s[lane] = phases[std::min(k * W + lane, phases.size() - 1)];
        outputs_at->lanes.set_segment(lane, segment_at(p->breakpoints, s[lane]));
      }
      kernel.prepare(outputs_at->lanes, 1, s.data(), &outputs_at->phase_coefficients[k]);
    }
    return [layout, kernel, outputs_at](std::size_t group, const double* states, double* rows) {
      for (std::size_t first = 0; first < phases_together; first += W)
        kernel.evaluate_outputs(layout, outputs_at->lanes,
                                outputs_at->phase_coefficients[(group * phases_together + first) / W], states + first,
                                rows + first);
    };
  };
}

/// By the widest lanes that this machine runs.
template <std::size_t N>
StageOutputsAt make_stage_outputs(Layout layout, const std::shared_ptr<const Parameters<double, N>>& p) {
  if (const auto kernel = output_kernel<N, 8>("avx512"); kernel.evaluate_outputs != nullptr)
    return stage_outputs(layout, p, kernel);
  if (const auto kernel = output_kernel<N, 4>("avx2"); kernel.evaluate_outputs != nullptr)
    return stage_outputs(layout, p, kernel);
  return stage_outputs(layout, p, output_kernel<N, 2>("baseline"));
}

std::vector<Shaft> shafts_of(const gear::Stage& stage) {
  std::vector<Shaft> all;
  if (stage.sun.errors.repeat()) all.push_back({"sun", *stage.sun.teeth});
  if (stage.planet.repeat()) all.push_back({"planets", *stage.planet.teeth});
  if (stage.ring.errors.repeat()) all.push_back({"ring", *stage.ring.teeth});
  return all;
}

template <std::size_t N>
DynamicModel assemble(Layout layout, const gear::Stage& stage, const Scales& scales, double mesh_frequency_ratio,
                      const ModelOptions& options) {
  const auto constants = std::make_shared<const FoldedConstants<N>>(
      layout, make_parameters<N>(stage, scales, mesh_frequency_ratio, options));
  const std::shared_ptr<const Parameters<double, N>> p(constants, &constants->parameters);
  DynamicModel m;
  m.planets = static_cast<int>(N);
  m.period *= p->mesh_periods;
  m.mesh_periods = p->mesh_periods;
  m.shafts = shafts_of(stage);
  m.layout = layout;
  m.dimension = 2 * degrees_of_freedom(layout, N);
  m.state_names = coordinate_names(layout, static_cast<int>(N));
  for (std::size_t k = 0, n = m.state_names.size(); k < n; ++k) m.state_names.push_back(m.state_names[k] + "_rate");
  m.breakpoints = p->breakpoints;
  m.sampling_interval = p->sampling_interval;
  m.sun_planet_half_gap = p->sun_planet.half_gap;
  m.ring_planet_half_gap = p->ring_planet.half_gap;
  m.planet_bearing_gap = p->planet_gap;
  m.omega = mesh_frequency_ratio;
  m.jumps_at_surfaces = p->gap_damping == GapDamping::contact_slope && !p->smooth &&
                        std::max(p->sun_planet.half_gap, p->ring_planet.half_gap) > 0.0;
  m.right_hand_side = [layout, p, kernel = stage_kernel<N>(layout)](std::size_t segment, double s, const double* y,
                                                                    double* dyds) {
    kernel(layout, *p, segment, s, y, dyds);
  };
  m.tangents = make_tangents(layout, *p);
  m.deflections = [layout, p](double s, const double* y, MeshDeflections& out) {
    deflections_at(layout, *p, s, y, out);
  };
  m.surfaces.count = contacts_of(*p);
  m.surfaces.evaluate = [layout, p](double s, const double* y, double* distances, double* rates) {
    contact_distances(layout, *p, errors_at(*p, s), y, distances, rates);
  };
  m.forces = [layout, p](double s, const double* y, StageForces& out) { forces_at(layout, *p, s, y, out); };
  m.outputs_at = make_stage_outputs(layout, p);
  m.scales = scales;
  m.speeds = gear::speeds(stage, mesh_frequency_ratio * scales.omega_sn);
  m.bearings = gear::bearing_loads(stage, mesh_frequency_ratio * scales.omega_sn);
  m.origin = constants;
  if (has_computed_tables(stage)) {
    m.with_halved_tables = [layout, stage = std::make_shared<const gear::Stage>(stage), scales, mesh_frequency_ratio,
                            options] {
      ModelOptions halved = options;
      halved.halved_tables = true;
      return assemble<N>(layout, *stage, scales, mesh_frequency_ratio, halved);
    };
    for (const auto* mesh : {&p->sun_planet, &p->ring_planet})
      if (mesh->friction) m.friction_table_error = std::max(m.friction_table_error, mesh->friction->error());
  }
  m.static_mesh_force =
      (stage.boundary == gear::Boundary::fixed_sun ? p->ring_drive : p->drive) / static_cast<double>(N);
  for (std::size_t i = 0; i < N; ++i)
    m.planet_phases.push_back(p->sun_planet.phase_cycles[i] - p->sun_planet.phase_cycles[0]);
  if (N > 1 && planets_alike(*p)) {
    m.remove_synchronous = [layout, p](std::span<double> deviation) { remove_synchronous(layout, *p, deviation); };
  }
  m.default_start = linear_equilibrium(layout, *p);
  // A planet whose bearing is open would first fall through its clearance.
  if (p->planet_gap)
    if (auto pressed = quasi_static_states(layout, *p, m.default_start, std::array{0.0}); !pressed.empty())
      m.default_start = std::move(pressed.front());
  m.quasi_static_states = [layout, p, start = m.default_start](std::span<const double> phases) {
    return quasi_static_states(layout, *p, start, phases);
  };
  return m;
}

/// [M-ramp]
template <std::size_t N>
DynamicModel ramped(Layout layout, const gear::Stage& stage, const Scales& scales, const ModelOptions& options,
                    const std::shared_ptr<const SpeedRamp>& ramp, double reference,
                    const std::function<double(double tau)>& torque) {
  DynamicModel m = assemble<N>(layout, stage, scales, reference, options);
  const auto base = constants_of<N>(m, layout);
  const auto p = std::make_shared<Parameters<double, N>>(*base);
  const auto set = [base, p, ramp, torque, at_power = stage.load.power_kW.has_value()](double s) {
    const double speed = ramp->omega_at(s) / base->omega;
    double load = at_power ? 1.0 / speed : 1.0;
    if (torque) load *= torque(ramp->tau_at(s));
    p->omega = speed * base->omega;
    p->carrier_speed = speed * base->carrier_speed;
    p->centrifugal = speed * speed * base->centrifugal;
    p->drive = load * base->drive;
    p->ring_drive = load * base->ring_drive;
    p->carrier_load = load * base->carrier_load;
    p->output_load = load * base->output_load;
  };
  m.right_hand_side = [layout, p, set, kernel = stage_kernel<N>(layout)](std::size_t segment, double s, const double* y,
                                                                         double* dyds) {
    set(s);
    kernel(layout, *p, segment, s, y, dyds);
  };
  m.deflections = [layout, p, set](double s, const double* y, MeshDeflections& out) {
    set(s);
    deflections_at(layout, *p, s, y, out);
  };
  m.forces = [layout, p, set](double s, const double* y, StageForces& out) {
    set(s);
    forces_at(layout, *p, s, y, out);
  };
  m.surfaces.evaluate = [layout, p, set](double s, const double* y, double* distances, double* rates) {
    set(s);
    contact_distances(layout, *p, errors_at(*p, s), y, distances, rates);
  };
  m.tangents = {};
  m.outputs_at = {};
  m.with_halved_tables = {};
  m.origin = nullptr;
  return m;
}

}  // namespace

DynamicModel make_ramped_model(const gear::Stage& stage, const Scales& scales, const ModelOptions& options,
                               std::shared_ptr<const SpeedRamp> ramp, double reference,
                               std::function<double(double tau)> torque) {
  return with_planets(stage.planet_count, [&]<std::size_t N>() {
    return ramped<N>(layout_of(stage, CoordinateChoice::relative), stage, scales, options, ramp, reference, torque);
  });
}

Layout layout_of(const gear::Stage& stage, CoordinateChoice choice) {
  if (stage.is_pair()) {
    const bool moves = std::isfinite(stage.sun.support_N_per_m);
    const bool both = choice == CoordinateChoice::full || stage.sun.torsional_support_N_per_m > 0.0 ||
                      stage.planet.torsional_support_N_per_m.value_or(0.0) > 0.0;
    if (moves) return both ? Layout::pair_supported : Layout::pair;
    return both ? Layout::pair_torsional_supported : Layout::pair_torsional;
  }
  if (choice == CoordinateChoice::full) return Layout::full;
  if (!stage.has_free_carrier()) return Layout::relative_to_ring;
  if (stage.boundary == gear::Boundary::free) return Layout::relative_to_carrier_rigid_ring;
  return std::isfinite(stage.ring.torsional_support_N_per_m) ? Layout::relative_to_carrier
                                                             : Layout::relative_to_carrier_rigid_ring;
}

DynamicModel make_dynamic_model(const gear::Stage& stage, const Scales& scales, double mesh_frequency_ratio,
                                const ModelOptions& options, CoordinateChoice choice) {
  const bool printed = options.gyroscopic == Gyroscopic::as_printed || options.gyroscopic == Gyroscopic::carrier_row;
  if (printed && stage.has_free_carrier() && choice == CoordinateChoice::relative)
    throw InputError(
        "/model/gyroscopic: the printed terms do not close in relative coordinates when the carrier is free "
        "(boundary fixed_ring, fixed_sun or free); use automatic, invariant or off");
  return with_planets(stage.planet_count, [&]<std::size_t N>() {
    return assemble<N>(layout_of(stage, choice), stage, scales, mesh_frequency_ratio, options);
  });
}

void set_parameter_derivative(DynamicModel& model, const std::function<OperatingPoint(double value)>& at,
                              const Scales& scales, double value, double step) {
  const std::array<double, 4> offsets = {-2.0 * step, -step, step, 2.0 * step};
  std::vector<OperatingPoint> points = {at(value)};
  for (const double offset : offsets) points.push_back(at(value + offset));
  const CoordinateChoice choice = model.layout == Layout::full ? CoordinateChoice::full : CoordinateChoice::relative;
  for (const OperatingPoint& point : points)
    if (layout_of(point.stage, choice) != model.layout || point.stage.planet_count != model.planets)
      throw InputError("the parameter changes the state itself; there is no derivative");
  model.parameter_derivative = with_planets(model.planets, [&]<std::size_t N>() -> ParameterFunction {
    const auto folded = [&](const OperatingPoint& point, const Parameters<double, N>* like) {
      return make_parameters<N>(point.stage, scales, point.mesh_frequency_ratio, point.options, like);
    };
    const Parameters<double, N> here = folded(points[0], nullptr);
    const std::array near = {folded(points[1], &here), folded(points[2], &here), folded(points[3], &here),
                             folded(points[4], &here)};
    return make_parameter_derivative(model.layout, here, near, step);
  });
}

}  // namespace epicyclic::model
