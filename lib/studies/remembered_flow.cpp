#include "studies/remembered_flow.hpp"

#include <algorithm>
#include <utility>

namespace epicyclic::studies {

namespace {

using integrate::Evolution;

class RememberedFlow : public integrate::Flow {
 public:
  RememberedFlow(std::unique_ptr<Flow> flow, FlowMemory memory) : flow_(std::move(flow)), memory_(std::move(memory)) {}

  [[nodiscard]] const VectorField& field() const override { return flow_->field(); }

  Evolution evolve(std::span<double> state, double from, double to, std::span<const double> samples,
                   const integrate::Observer& observer) override {
    if (!samples.empty()) return flow_->evolve(state, from, to, samples, observer);
    return recalled(state, {}, [&] { return flow_->evolve(state, from, to, {}, {}); });
  }

  Evolution evolve_tangents(std::span<double> state, std::span<double> tangents, double from, double to,
                            integrate::LastTangent last) override {
    return recalled(state, tangents, [&] { return flow_->evolve_tangents(state, tangents, from, to, last); });
  }

  [[nodiscard]] integrate::Work work() const override { return flow_->work(); }
  [[nodiscard]] double next_step() const override { return flow_->next_step(); }
  void set_next_step(double step) override { flow_->set_next_step(step); }

 private:
  /// A result: its end time, length of the next step, state, tangents.
  template <class Compute>
  Evolution recalled(std::span<double> state, std::span<double> tangents, Compute compute) {
    constexpr std::size_t head = 2;
    const std::size_t numbers = head + state.size() + tangents.size();
    if (!all_recalled_) {
      if (const auto known = memory_.recall(numbers)) {
        std::copy_n(known->begin() + head, state.size(), state.begin());
        std::copy_n(known->begin() + head + static_cast<std::ptrdiff_t>(state.size()), tangents.size(),
                    tangents.begin());
        flow_->set_next_step((*known)[1]);
        return {integrate::Outcome::reached, (*known)[0], {}};
      }
      all_recalled_ = true;
    }
    Evolution evolution = compute();
    if (!evolution.reached()) return evolution;  // found again in no time
    std::vector<double> result = {evolution.s, flow_->next_step()};
    result.reserve(numbers);
    result.insert(result.end(), state.begin(), state.end());
    result.insert(result.end(), tangents.begin(), tangents.end());
    memory_.keep(result);
    return evolution;
  }

  std::unique_ptr<Flow> flow_;
  FlowMemory memory_;
  bool all_recalled_ = false;
};

}  // namespace

std::unique_ptr<integrate::Flow> remembered(std::unique_ptr<integrate::Flow> flow, FlowMemory memory) {
  if (!memory.recall) return flow;
  return std::make_unique<RememberedFlow>(std::move(flow), std::move(memory));
}

}  // namespace epicyclic::studies
