#include "model/lane_field.hpp"

#include <cstddef>
#include <memory>

#include "core/errors.hpp"
#include "model/dispatch.hpp"
#include "model/folded_constants.hpp"
#include "model/kernels/lane_kernel.hpp"

namespace epicyclic::model {

namespace {

template <std::size_t N, std::size_t W>
LaneField lanes_of(const DynamicModel& like, LaneKernel<N, W> kernel, std::size_t vectors) {
  const auto point = [layout = like.layout, dimension = like.dimension](const VectorField& field) {
    auto constants = constants_of<N>(field, layout);
    if (!constants || field.dimension != dimension)
      throw InputError("a system that is no stage of the lanes' structure cannot run beside them");
    return constants;
  };
  using Instants = PhaseCoefficients<Lanes<W>, N>;
  struct State {
    explicit State(const std::shared_ptr<const Parameters<double, N>>& p) : lanes(p) {}
    LaneParameters<N, W> lanes;
    std::size_t places = 0;
    std::unique_ptr<Instants[]> phase_coefficients;
  };
  const auto state = std::make_shared<State>(point(like));
  LaneField f;
  f.width = W;
  f.dimension = like.dimension * (1 + vectors);
  f.load = [state, point](std::size_t lane, const VectorField& field) { state->lanes.load(lane, point(field)); };
  f.set_segment = [state](std::size_t lane, std::size_t segment) { state->lanes.set_segment(lane, segment); };
  f.set_places = [state, kernel](std::size_t count, const double* s) {
    if (state->places < count) {
      state->phase_coefficients = std::make_unique<Instants[]>(count);
      state->places = count;
    }
    kernel.prepare(state->lanes, count, s, state->phase_coefficients.get());
  };
  f.right_hand_side = [state, kernel](std::size_t place, const double* y, double* dyds) {
    kernel.evaluate(state->lanes, state->phase_coefficients[place], y, dyds);
  };
  if (vectors > 0)
    f.right_hand_side = [state, kernel, vectors, layout = like.layout, vector = like.dimension * W](
                            std::size_t place, const double* y, double* dyds) {
      for (std::size_t j = 1; j <= vectors; ++j)
        kernel.push(layout, state->lanes, state->phase_coefficients[place], y, y + j * vector, dyds, dyds + j * vector);
    };
  f.surfaces = like.surfaces.count;
  f.surface_values = [state, kernel](std::size_t place, const double* y, double* values, double* rates) {
    kernel.measure_contacts(state->lanes, state->phase_coefficients[place], y, values, rates);
  };
  return f;
}

}  // namespace

LaneField make_lane_field(const DynamicModel& like, const char* instruction_set, std::size_t copy,
                          std::size_t vectors) {
  return with_planets(like.planets, [&]<std::size_t N>() -> LaneField {
    if (const auto kernel = lane_kernel<N, 2>(like.layout, instruction_set, copy); kernel.evaluate != nullptr)
      return lanes_of<N, 2>(like, kernel, vectors);
    if (const auto kernel = lane_kernel<N, 4>(like.layout, instruction_set, copy); kernel.evaluate != nullptr)
      return lanes_of<N, 4>(like, kernel, vectors);
    if (const auto kernel = lane_kernel<N, 8>(like.layout, instruction_set, copy); kernel.evaluate != nullptr)
      return lanes_of<N, 8>(like, kernel, vectors);
    return {};
  });
}

}  // namespace epicyclic::model
