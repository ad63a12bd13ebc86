#include "model/lane_model.hpp"

#include <memory>
#include <vector>

#include "core/errors.hpp"
#include "model/dispatch.hpp"
#include "model/folded_constants.hpp"
#include "model/kernels/lane_kernel.hpp"

namespace epicyclic::model {

namespace {

template <std::size_t N, std::size_t W>
LaneModel lanes_of(const DynamicModel& like, LaneKernel<N, W> kernel) {
  const auto point = [layout = like.layout](const DynamicModel& m) {
    auto constants = constants_of<N>(m);
    if (m.layout != layout || !constants)
      throw InputError("operating points of different structure cannot run side by side");
    return constants;
  };
  struct State {
    LaneParameters<N, W> lanes;
    std::vector<Instant<Lanes<W>, N>> instants;
  };
  const auto state = std::make_shared<State>(State{LaneParameters<N, W>(point(like)), {}});
  LaneModel m;
  m.width = W;
  m.dimension = like.dimension;
  m.load = [state, point](std::size_t lane, const DynamicModel& model) { state->lanes.load(lane, point(model)); };
  m.set_segment = [state](std::size_t lane, std::size_t segment) { state->lanes.set_segment(lane, segment); };
  m.set_places = [state, kernel](std::size_t count, const double* s) {
    if (state->instants.size() < count) state->instants.resize(count);
    kernel.prepare(state->lanes, count, s, state->instants.data());
  };
  m.right_hand_side = [state, kernel](std::size_t place, const double* y, double* dyds) {
    kernel.evaluate(state->lanes, state->instants[place], y, dyds);
  };
  m.contacts = like.contacts;
  m.contact_distances = [state, kernel](std::size_t place, const double* y, double* distances, double* rates) {
    kernel.measure_contacts(state->lanes, state->instants[place], y, distances, rates);
  };
  return m;
}

}  // namespace

LaneModel make_lane_model(const DynamicModel& like, const char* instruction_set, std::size_t copy) {
  return dispatch(like.layout, like.planets, [&]<Layout L, std::size_t N>() -> LaneModel {
    if constexpr (L != Layout::full) {
      if (const auto kernel = lane_kernel<L, N, 2>(instruction_set, copy); kernel.evaluate != nullptr)
        return lanes_of<N, 2>(like, kernel);
      if (const auto kernel = lane_kernel<L, N, 4>(instruction_set, copy); kernel.evaluate != nullptr)
        return lanes_of<N, 4>(like, kernel);
      if (const auto kernel = lane_kernel<L, N, 8>(instruction_set, copy); kernel.evaluate != nullptr)
        return lanes_of<N, 8>(like, kernel);
    }
    return {};
  });
}

}  // namespace epicyclic::model
