#include "integrate/lanes/lane_pool.hpp"

#include <algorithm>
#include <chrono>
#include <deque>
#include <exception>
#include <list>
#include <map>
#include <memory>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include "core/errors.hpp"
#include "core/fiber.hpp"
#include "integrate/checks.hpp"
#include "integrate/lanes/lane_ensemble.hpp"
#include "integrate/make_flow.hpp"
#include "integrate/methods.hpp"

namespace epicyclic::integrate {

namespace {

/// By ARKODE, with the same pair.
std::unique_ptr<Flow> flow_alone(VectorField field, IntegratorOptions options) {
  options.method = arkode_twin(options.method);
  return make_flow(std::move(field), options);
}

/// One evolution that waits for a lane, or is in progress.
struct Request {
  const void* flow = nullptr;  ///< whose system it is
  const VectorField* system = nullptr;
  double relative_tolerance = 0;
  double absolute_tolerance = 0;
  double first_step = 0;
  std::span<double> state;  ///< with a tangent vector behind it, if it has one
  double from = 0;
  double to = 0;
  std::span<const double> samples;
  const Observer* observer = nullptr;
  Fiber* fiber = nullptr;  ///< that waits for it, if one does

  bool done = false;
  std::exception_ptr failure;
  Evolution evolution;
  Work work;
  double next_step = 0;
};

void prepare(LaneEnsemble& lanes, std::size_t lane, const Request& request) {
  lanes.set_tolerances(lane, request.relative_tolerance, request.absolute_tolerance);
  lanes.set_next_step(lane, request.first_step);
}

/// Right-hand sides and steps since `before`.
Work since(const Work& before, Work now) {
  now.right_hand_sides -= before.right_hand_sides;
  now.steps -= before.steps;
  return now;
}

/// Lanes of one kind, each with a trajectory of its own.
class Shared {
 public:
  explicit Shared(std::unique_ptr<LaneEnsemble> lanes)
      : lanes_(std::move(lanes)), in_progress_(lanes_->width()), loaded_(lanes_->width()) {}

  void take(Request& request) { waiting_.push_back(&request); }
  void forget(const void* flow) {
    std::replace(loaded_.begin(), loaded_.end(), flow, static_cast<const void*>(nullptr));
  }

  /// The error of a tangent vector behind the state does not count.
  void control(std::size_t dimension) { lanes_->control(dimension, 0, false); }

  /// Idle lanes take what waits: first those that have the system already, then the longest waiting.
  /// @param failed  gets the requests that do not fit
  void fill(std::vector<Request*>& failed) {
    for (std::size_t lane = 0; lane < in_progress_.size() && !waiting_.empty(); ++lane) {
      if (in_progress_[lane] != nullptr || loaded_[lane] == nullptr) continue;
      const auto it = std::find_if(waiting_.begin(), waiting_.end(),
                                   [&](const Request* request) { return request->flow == loaded_[lane]; });
      if (it == waiting_.end()) continue;
      Request* const request = *it;
      waiting_.erase(it);
      begin(lane, *request, failed);
    }
    for (std::size_t lane = 0; lane < in_progress_.size(); ++lane) {
      while (in_progress_[lane] == nullptr && !waiting_.empty()) {
        Request* const request = waiting_.front();
        waiting_.pop_front();
        begin(lane, *request, failed);
      }
    }
  }

  [[nodiscard]] std::size_t busy() const { return busy_; }

  /// Goes on until an evolution has ended, with lanes in progress.
  Request& run() {
    const std::size_t lane = lanes_->run();
    Request& request = *std::exchange(in_progress_[lane], nullptr);
    --busy_;
    lanes_->copy_state(lane, request.state);
    request.evolution = lanes_->evolution(lane);
    request.work = since(request.work, lanes_->work(lane));
    request.next_step = lanes_->next_step(lane);
    return request;
  }

  [[nodiscard]] std::size_t width() const { return in_progress_.size(); }
  [[nodiscard]] const LaneEnsemble& lanes() const { return *lanes_; }

 private:
  void begin(std::size_t lane, Request& request, std::vector<Request*>& failed) {
    try {
      if (loaded_[lane] != request.flow) {
        loaded_[lane] = nullptr;
        lanes_->load(lane, *request.system);
        loaded_[lane] = request.flow;
      }
      request.work = lanes_->work(lane);
      prepare(*lanes_, lane, request);
      lanes_->begin(lane, request.state, request.from, request.to, request.samples, *request.observer);
      in_progress_[lane] = &request;
      ++busy_;
    } catch (const InputError&) {
      request.failure = std::current_exception();
      failed.push_back(&request);
    }
  }

  std::unique_ptr<LaneEnsemble> lanes_;
  std::vector<Request*> in_progress_;  ///< by lane
  std::vector<const void*> loaded_;    ///< whose system a lane has
  std::deque<Request*> waiting_;
  std::size_t busy_ = 0;
};

/// One trajectory, its tangent vectors over all lanes: vector j is that number j / W of lane j % W.
class Bundle {
 public:
  Bundle(std::unique_ptr<LaneEnsemble> lanes, std::size_t dimension, std::size_t each)
      : lanes_(std::move(lanes)), dimension_(dimension), each_(each), all_(dimension * (1 + each)) {
    lanes_->keep_together();
  }

  [[nodiscard]] std::size_t vectors() const { return each_ * lanes_->width(); }
  void forget(const void* flow) { loaded_ = loaded_ == flow ? nullptr : loaded_; }

  /// @throws InputError when the system does not fit the lanes
  void integrate(Request& request, std::span<double> tangents, bool controlled) {
    const std::size_t width = lanes_->width();
    const std::size_t count = tangents.size() / dimension_;
    const auto each_vector = [&](std::size_t lane, const auto& f) {
      for (std::size_t j = 0; j < each_; ++j) {
        const std::span<double> own = std::span(all_).subspan((1 + j) * dimension_, dimension_);
        const std::size_t vector = j * width + lane;
        f(own, vector < count ? tangents.subspan(vector * dimension_, dimension_) : std::span<double>());
      }
    };
    if (loaded_ != request.flow) {
      loaded_ = nullptr;
      for (std::size_t lane = 0; lane < width; ++lane) lanes_->load(lane, *request.system);
      loaded_ = request.flow;
    }
    lanes_->control(dimension_, controlled ? each_ : 0, false);
    request.work = lanes_->work(0);
    for (std::size_t lane = 0; lane < width; ++lane) {
      prepare(*lanes_, lane, request);
      std::copy(request.state.begin(), request.state.end(), all_.begin());
      each_vector(lane, [](std::span<double> own, std::span<const double> vector) {
        std::fill(std::copy(vector.begin(), vector.end(), own.begin()), own.end(), 0.0);
      });
      lanes_->begin(lane, all_, request.from, request.to);
    }
    for (std::size_t k = 0; k < width; ++k) {
      const std::size_t lane = lanes_->run();
      lanes_->copy_state(lane, all_);
      each_vector(lane, [](std::span<const double> own, std::span<double> vector) {
        std::copy_n(own.begin(), vector.size(), vector.begin());
      });
    }
    std::copy_n(all_.begin(), dimension_, request.state.begin());
    request.evolution = lanes_->evolution(0);
    request.work = since(request.work, lanes_->work(0));
    request.next_step = lanes_->next_step(0);
  }

 private:
  std::unique_ptr<LaneEnsemble> lanes_;
  std::size_t dimension_;
  std::size_t each_;
  std::vector<double> all_;
  const void* loaded_ = nullptr;  ///< whose system the lanes have
};

}  // namespace

class LanePool::Impl {
 public:
  Impl(Lanes fields, const IntegratorOptions& options, const StepLoops& kernels)
      : fields_(std::move(fields)), options_(options), kernels_(kernels) {
    begin_anew();
  }

  [[nodiscard]] std::size_t width() const { return kernels_.width; }
  [[nodiscard]] bool has_tangents() const { return tangents_ != nullptr; }

  [[nodiscard]] std::size_t room() const {
    std::size_t sum = 0;
    for (const Shared* kind : kinds()) sum += kind->lanes().evaluations() * width();
    return sum;
  }
  [[nodiscard]] std::size_t taken() const {
    std::size_t sum = 0;
    for (const Shared* kind : kinds()) sum += kind->lanes().evaluations_in_progress();
    return sum;
  }

  /// Returns when it is done.
  /// @param with_tangent  the state has one behind it
  void integrate(Request& request, bool with_tangent) {
    request.fiber = Fiber::current();
    (with_tangent ? *tangents_ : *states_).take(request);
    if (request.fiber != nullptr) {
      Fiber::suspend();
    } else {
      while (!request.done) advance();
    }
    if (request.failure) std::rethrow_exception(request.failure);
  }

  /// Integrates a state with several tangent vectors.
  void integrate_bundle(Request& request, std::span<double> tangents, bool controlled) {
    const std::size_t count = tangents.size() / request.state.size();
    const std::size_t each = (count + width() - 1) / width();
    std::unique_ptr<Bundle>& bundle = bundles_[each];
    if (!bundle)
      bundle = std::make_unique<Bundle>(std::make_unique<LaneEnsemble>(fields_(each), options_, kernels_),
                                        request.state.size(), each);
    bundle->integrate(request, tangents, controlled);
  }

  void run(std::size_t count, const std::function<void()>& work) {
    std::vector<std::unique_ptr<Fiber>> fibers;
    try {
      for (std::size_t k = 0; k < count; ++k) {
        fibers.push_back(std::make_unique<Fiber>(work));
        ready_.push_back(fibers.back().get());
      }
      while (go_on()) {
      }
    } catch (...) {
      // The evolutions of the other fibers end with them.
      fibers.clear();
      ready_.clear();
      parked_.clear();
      begin_anew();
      throw;
    }
  }

  void wait(const std::function<bool()>& over) {
    if (over()) return;
    parked_.push_back({Fiber::current(), &over});
    Fiber::suspend();
  }

  /// A flow's system is gone.
  void forget(const void* flow) {
    for (Shared* kind : kinds()) kind->forget(flow);
    for (auto& [each, bundle] : bundles_) bundle->forget(flow);
  }

 private:
  struct Parked {
    Fiber* fiber;
    const std::function<bool()>* over;
  };

  [[nodiscard]] std::vector<Shared*> kinds() const {
    std::vector<Shared*> all{states_.get()};
    if (tangents_) all.push_back(tangents_.get());
    return all;
  }

  /// @returns false if nothing is left
  bool go_on() {
    while (!ready_.empty()) {
      Fiber* const fiber = ready_.front();
      ready_.pop_front();
      fiber->resume();
    }
    for (auto it = parked_.begin(); it != parked_.end();) {
      if ((*it->over)()) {
        ready_.push_back(it->fiber);
        it = parked_.erase(it);
      } else {
        ++it;
      }
    }
    if (!ready_.empty() || advance()) return true;
    if (parked_.empty()) return false;
    constexpr std::chrono::microseconds pause{200};
    std::this_thread::sleep_for(pause);  // until another thread has what is waited for
    return true;
  }

  /// Goes on until one evolution has ended, in the lanes that are fullest.
  /// @returns false if no evolution is in progress
  bool advance() {
    std::vector<Request*> failed;
    states_->fill(failed);
    if (tangents_) tangents_->fill(failed);
    for (Request* const request : failed) finish(*request);
    if (!failed.empty()) return true;
    Shared& fullest = tangents_ && tangents_->busy() >= states_->busy() ? *tangents_ : *states_;
    if (fullest.busy() == 0) return false;
    finish(fullest.run());
    return true;
  }

  void finish(Request& request) {
    request.done = true;
    if (request.fiber != nullptr) ready_.push_back(request.fiber);
  }

  /// With nothing in the lanes.
  void begin_anew() {
    states_ = std::make_unique<Shared>(std::make_unique<LaneEnsemble>(fields_(0), options_, kernels_));
    tangents_.reset();
    bundles_.clear();
    LaneField with_tangent = fields_(1);
    if (with_tangent.width == 0) return;
    const std::size_t n = with_tangent.dimension / 2;
    tangents_ = std::make_unique<Shared>(std::make_unique<LaneEnsemble>(std::move(with_tangent), options_, kernels_));
    tangents_->control(n);
  }

  Lanes fields_;
  IntegratorOptions options_;
  const StepLoops& kernels_;
  std::unique_ptr<Shared> states_;
  std::unique_ptr<Shared> tangents_;                        ///< null if there are none
  std::map<std::size_t, std::unique_ptr<Bundle>> bundles_;  ///< by vectors of a lane
  std::deque<Fiber*> ready_;
  std::list<Parked> parked_;
};

/// Evolutions by the lanes of a pool.
class LanePool::PooledFlow final : public Flow {
 public:
  PooledFlow(Impl& pool, VectorField field, const IntegratorOptions& options)
      : pool_(pool), field_(std::move(field)), options_(options) {}
  ~PooledFlow() override { pool_.forget(this); }

  [[nodiscard]] const VectorField& field() const override { return field_; }

  Evolution evolve(std::span<double> state, double from, double to, std::span<const double> samples,
                   const Observer& observer) override {
    if (fits_) {
      Request request = request_of(state, from, to);
      request.samples = samples;
      request.observer = &observer;
      if (integrated(request, [&] { pool_.integrate(request, false); })) {
        work_.right_hand_sides += request.work.right_hand_sides;
        return request.evolution;
      }
    }
    return by_itself([&](Flow& flow) { return flow.evolve(state, from, to, samples, observer); });
  }

  Evolution evolve_tangents(std::span<double> state, std::span<double> tangents, double from, double to,
                            LastTangent last) override {
    check_tangents(field_, tangents, last);
    if (fits_ && pool_.has_tangents() && last == LastTangent::homogeneous) {
      static const Observer nobody;
      const std::size_t n = state.size();
      std::vector<double> both;
      Request request = request_of(state, from, to);
      request.observer = &nobody;
      const bool fitted = integrated(request, [&] {
        if (tangents.size() != n || options_.tangent_error_control) {
          pool_.integrate_bundle(request, tangents, options_.tangent_error_control);
          return;
        }
        both.assign(state.begin(), state.end());
        both.insert(both.end(), tangents.begin(), tangents.end());
        request.state = both;
        pool_.integrate(request, true);
        std::copy_n(both.begin(), n, state.begin());
        std::copy_n(both.begin() + static_cast<std::ptrdiff_t>(n), n, tangents.begin());
      });
      if (fitted) {
        work_.tangent_right_hand_sides += request.work.right_hand_sides;
        return request.evolution;
      }
    }
    return by_itself([&](Flow& flow) { return flow.evolve_tangents(state, tangents, from, to, last); });
  }

  [[nodiscard]] Work work() const override {
    Work sum = work_;
    if (!alone_) return sum;
    const Work more = alone_->work();
    sum.right_hand_sides += more.right_hand_sides;
    sum.tangent_right_hand_sides += more.tangent_right_hand_sides;
    sum.jacobians += more.jacobians;
    sum.steps += more.steps;
    return sum;
  }

  [[nodiscard]] double next_step() const override { return next_step_; }
  void set_next_step(double step) override { next_step_ = step; }

 private:
  [[nodiscard]] Request request_of(std::span<double> state, double from, double to) const {
    Request request;
    request.flow = this;
    request.system = &field_;
    request.relative_tolerance = options_.relative_tolerance;
    request.absolute_tolerance = options_.absolute_tolerance;
    request.first_step = next_step_;
    request.state = state;
    request.from = from;
    request.to = to;
    return request;
  }

  /// @returns false if the system does not fit the lanes: it has another structure than the others, for example because
  /// a swept value switches something off
  template <class F>
  bool integrated(const Request& request, const F& integration) {
    try {
      integration();
    } catch (const InputError&) {
      fits_ = false;
      return false;
    }
    work_.steps += request.work.steps;
    next_step_ = request.next_step;
    return true;
  }

  template <class F>
  Evolution by_itself(const F& evolve) {
    if (!alone_) alone_ = flow_alone(field_, options_);
    alone_->set_next_step(next_step_);
    const Evolution evolution = evolve(*alone_);
    next_step_ = alone_->next_step();
    return evolution;
  }

  Impl& pool_;
  VectorField field_;
  IntegratorOptions options_;
  bool fits_ = true;
  double next_step_ = 0;
  Work work_{};
  std::unique_ptr<Flow> alone_;
};

LanePool::LanePool(Lanes lanes, const IntegratorOptions& options, const StepLoops& kernels)
    : impl_(std::make_unique<Impl>(std::move(lanes), options, kernels)) {}
LanePool::~LanePool() = default;

std::size_t LanePool::width() const { return impl_->width(); }
std::unique_ptr<Flow> LanePool::make_flow(VectorField field, const IntegratorOptions& options) {
  options.validate();
  check_field(field);
  if (method_named(options.method).family != Family::lanes) return flow_alone(std::move(field), options);
  return std::make_unique<PooledFlow>(*impl_, std::move(field), options);
}
void LanePool::run(std::size_t fibers, const std::function<void()>& work) { impl_->run(fibers, work); }
void LanePool::wait(const std::function<bool()>& over) { impl_->wait(over); }
std::size_t LanePool::room() const { return impl_->room(); }
std::size_t LanePool::taken() const { return impl_->taken(); }

}  // namespace epicyclic::integrate
