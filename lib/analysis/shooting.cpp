#include "analysis/shooting.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

namespace epicyclic::analysis {

namespace {

/// Interval of s within a period of the forcing.
struct Span {
  double from = 0;
  double to = 0;
};

/// Shooting interval `i` of n periods, cut where periods end, so that each part begins at the phase 0 to the last bit.
std::vector<Span> spans(double period, Eigen::Index n, Eigen::Index shooting_intervals, Eigen::Index i) {
  std::vector<Span> all;
  // In units of a period over the number of shooting intervals.
  const auto phase = [&](Eigen::Index parts) {
    return period * static_cast<double>(parts) / static_cast<double>(shooting_intervals);
  };
  for (Eigen::Index at = i * n; at < (i + 1) * n;) {
    const Eigen::Index begun = at / shooting_intervals * shooting_intervals;
    const Eigen::Index to = std::min((i + 1) * n, begun + shooting_intervals);
    all.push_back({phase(at - begun), phase(to - begun)});
    at = to;
  }
  return all;
}

std::span<double> span_of(Eigen::Ref<Eigen::VectorXd> v) { return {v.data(), static_cast<std::size_t>(v.size())}; }

}  // namespace

Shot shoot(integrate::Flow& flow, const Eigen::MatrixXd& y, Eigen::Index periods, integrate::LastTangent last) {
  const Eigen::Index n = y.rows();
  const Eigen::Index count = y.cols();
  const bool parameter = last == integrate::LastTangent::parameter;
  Shot shot;
  shot.residual.resize(n, count);
  if (parameter) shot.parameter.resize(n, count);
  flow.forget();
  for (Eigen::Index i = 0; i < count; ++i) {
    Eigen::VectorXd end = y.col(i);
    Eigen::MatrixXd m = Eigen::MatrixXd::Identity(n, n + (parameter ? 1 : 0));
    for (const Span& span : spans(period_of(flow.field()), periods, count, i)) {
      shot.evolution =
          flow.evolve_tangents(span_of(end), {m.data(), static_cast<std::size_t>(m.size())}, span.from, span.to, last);
      if (!shot.evolution.reached()) return shot;
    }
    shot.residual.col(i) = end - y.col((i + 1) % count);
    if (parameter) {
      shot.parameter.col(i) = m.col(n);
      m.conservativeResize(n, n);
    }
    shot.interval_maps.push_back(std::move(m));
  }
  return shot;
}

Shot shoot_states(integrate::Flow& flow, const Eigen::MatrixXd& y, Eigen::Index periods) {
  Shot shot;
  shot.residual.resize(y.rows(), y.cols());
  flow.forget();
  for (Eigen::Index i = 0; i < y.cols(); ++i) {
    Eigen::VectorXd end = y.col(i);
    for (const Span& span : spans(period_of(flow.field()), periods, y.cols(), i)) {
      shot.evolution = flow.evolve(span_of(end), span.from, span.to);
      if (!shot.evolution.reached()) return shot;
    }
    shot.residual.col(i) = end - y.col((i + 1) % y.cols());
  }
  return shot;
}

std::vector<Stretch> stretches(integrate::Flow& flow, const Eigen::MatrixXd& y, Eigen::Index periods) {
  std::vector<Stretch> all;
  flow.forget();
  for (Eigen::Index i = 0; i < y.cols(); ++i) {
    Eigen::VectorXd state = y.col(i);
    for (const Span& span : spans(period_of(flow.field()), periods, y.cols(), i)) {
      all.push_back({span.from, span.to, state});
      if (!flow.evolve(span_of(state), span.from, span.to).reached()) return {};
    }
  }
  return all;
}

integrate::Evolution integrate_to_intervals(integrate::Flow& flow, Eigen::Index periods, Eigen::MatrixXd& y) {
  Eigen::VectorXd state = y.col(0);
  integrate::Evolution e;
  flow.forget();
  for (Eigen::Index i = 1; i < y.cols(); ++i) {
    for (const Span& span : spans(period_of(flow.field()), periods, y.cols(), i - 1)) {
      e = flow.evolve(span_of(state), span.from, span.to);
      if (!e.reached()) return e;
    }
    y.col(i) = state;
  }
  return e;
}

}  // namespace epicyclic::analysis
