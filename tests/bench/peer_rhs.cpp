// The right-hand side of the benchmarks for peers in other languages, with a C interface for Python's ctypes, and as a
// MEX function for Octave:
//
//   n = peer_rhs()                               calls since the model was opened
//   [start, reference, stops] = peer_rhs(omega)  opens the model: the orbit's state, where 20 mesh periods lead from
//   it,
//                                             and where the right-hand side may jump within (0, 2 pi)
//   f = peer_rhs(k, s, y)                     dy/ds in the k-th piece between the stops, from 0
//
// The MEX interface is declared here as far as it is used, so that Octave's headers are not needed to build it; its
// symbols are weak because Python does not have them.

#include <algorithm>
#include <cstdint>
#include <memory>

#include "bench/orbit.hpp"

namespace {

using namespace epicyclic::bench;

struct Opened {
  explicit Opened(double omega) : model(model_at(omega)), start(on_orbit(model)) {
    const auto field = model;
    stops = epicyclic::integrate::breakpoints_between(field, 0.0, period);
    double from = 0.0;
    segments.push_back(epicyclic::integrate::segment_after(field, from));
    for (const double stop : stops) segments.push_back(epicyclic::integrate::segment_after(field, stop));
    if (!start.empty()) reference = reference_from(model, start);
  }

  epicyclic::model::DynamicModel model;
  State start, reference;
  std::vector<double> stops;
  std::vector<std::size_t> segments;
  double calls = 0.0;
};

std::unique_ptr<Opened> opened;  // NOLINT: the interface has no place for it

/// No exception leaves: there is C outside.
bool open(double omega) {
  try {
    opened = std::make_unique<Opened>(omega);
    return !opened->start.empty();
  } catch (...) {
    return false;
  }
}

}  // namespace

extern "C" {

#define EPICYCLIC_EXPORT [[gnu::visibility("default")]]

/// @returns components of the state; 0 where there is no attracting periodic orbit, or no model
EPICYCLIC_EXPORT int peer_open(double omega) { return open(omega) ? static_cast<int>(opened->start.size()) : 0; }

EPICYCLIC_EXPORT int peer_stops() { return static_cast<int>(opened->stops.size()); }

/// start and reference have peer_open() numbers, stops peer_stops().
EPICYCLIC_EXPORT void peer_read(double* start, double* reference, double* stops) {
  std::copy(opened->start.begin(), opened->start.end(), start);
  std::copy(opened->reference.begin(), opened->reference.end(), reference);
  std::copy(opened->stops.begin(), opened->stops.end(), stops);
}

EPICYCLIC_EXPORT void peer_rhs(int piece, double s, const double* y, double* f) {
  opened->calls += 1.0;
  opened->model.right_hand_side(opened->segments[static_cast<std::size_t>(piece)], s, y, f);
}

struct mxArray;
[[gnu::weak]] mxArray* mxCreateDoubleMatrix(std::int64_t rows, std::int64_t columns, int complexity);
[[gnu::weak]] double* mxGetPr(const mxArray* array);
[[gnu::weak]] double mxGetScalar(const mxArray* array);
[[gnu::weak]] void mexErrMsgTxt(const char* message);

EPICYCLIC_EXPORT void mexFunction(int outputs, mxArray** output, int inputs, const mxArray** input) {
  const auto column = [](const State& numbers) {
    mxArray* array = mxCreateDoubleMatrix(static_cast<std::int64_t>(numbers.size()), 1, 0);
    std::copy(numbers.begin(), numbers.end(), mxGetPr(array));
    return array;
  };
  if (inputs == 3) {
    output[0] = mxCreateDoubleMatrix(static_cast<std::int64_t>(opened->start.size()), 1, 0);
    peer_rhs(static_cast<int>(mxGetScalar(input[0])), mxGetScalar(input[1]), mxGetPr(input[2]), mxGetPr(output[0]));
    return;
  }
  if (inputs == 0) {
    output[0] = column({opened->calls});
    return;
  }
  if (inputs != 1 || outputs != 3) return mexErrMsgTxt("peer_rhs: none, one or three arguments");
  if (!open(mxGetScalar(input[0]))) return mexErrMsgTxt("peer_rhs: no attracting periodic orbit");
  output[0] = column(opened->start);
  output[1] = column(opened->reference);
  output[2] = column(opened->stops);
}

}  // extern "C"
