#include "model/tangents.hpp"

#include <cmath>
#include <type_traits>
#include <vector>

#include "core/difference.hpp"
#include "core/dual.hpp"
#include "core/errors.hpp"
#include "model/kernels/stage_kernel.hpp"
#include "model/right_hand_side.hpp"

namespace epicyclic::model {

namespace {

/// The kernel that fits the scalar.
template <std::size_t N>
struct Either {
  TangentKernel<N, 1> one;
  TangentKernel<N, 4> four;
  template <class P, class T>
  void operator()(Layout layout, const P& p, std::size_t segment, double s, const T* y, T* dyds) const {
    if constexpr (std::is_same_v<T, Dual<1>>) {
      one(layout, p, segment, s, y, dyds);
    } else {
      four(layout, p, segment, s, y, dyds);
    }
  }
};

}  // namespace

template <std::size_t N>
TangentFunction make_tangents(Layout layout, const Parameters<double, N>& p) {
  const auto constants = std::make_shared<const Parameters<double, N>>(p);
  const auto with = [&](auto chunk, const auto& kernel) -> TangentFunction {
    return [layout, constants, kernel](std::size_t segment, double s, const double* y, const Columns<const double>& v,
                                       double* dyds, const Columns<double>& dvds) {
      const auto evaluate = [&](const auto* state, auto* slope) {
        kernel(layout, *constants, segment, s, state, slope);
      };
      push_forward<decltype(chunk)::value>(2 * degrees_of_freedom(layout, N), evaluate, y, v, dyds, dvds);
    };
  };
  const TangentKernel<N, 1> by_one = tangent_kernel<N, 1>();
  if (const TangentKernel<N, 4> by_four = tangent_kernel<N, 4>())
    return with(std::integral_constant<std::size_t, 4>(), Either<N>{by_one, by_four});
  return with(std::integral_constant<std::size_t, 1>(), by_one);
}

template <std::size_t N>
ParameterFunction make_parameter_derivative(Layout layout, const Parameters<double, N>& p,
                                            const std::array<Parameters<double, N>, 4>& near, double h) {
  using D = Dual<1>;
  std::array<std::vector<double>, 4> constants;
  for (std::size_t k = 0; k < 4; ++k) {
    if (near[k].breakpoints != p.breakpoints)
      throw InputError("the parameter moves a breakpoint in the mesh phase; there is no derivative");
    constants[k] = constant_values(near[k]);
  }
  auto dual = std::make_shared<Parameters<D, N>>(convert<D>(p));
  std::size_t at = 0;
  for_each_constant(*dual, [&](D& x) {
    for (const auto& c : constants)
      if (at >= c.size()) throw InputError("the parameter changes the number of the stiffness's harmonics");
    x.derivative[0] = central_derivative({constants[0][at], constants[1][at], constants[2][at], constants[3][at]}, h);
    ++at;
  });
  const auto tables = [&](const MeshParameters<double, N>& mesh, MeshParameters<D, N>& out, auto of) {
    if (mesh.friction)
      out.friction = std::make_shared<FrictionTrack>(
          mesh.friction->with_parameter_derivative({of(near[0]).friction.get(), of(near[1]).friction.get(),
                                                    of(near[2]).friction.get(), of(near[3]).friction.get()},
                                                   h));
    const auto curve = [&](auto member) {
      using Track = std::remove_const_t<typename std::decay_t<decltype(mesh.*member)>::element_type>;
      const auto near_by = [&](std::size_t k) { return (of(near[k]).*member).get(); };
      return std::make_shared<Track>(
          (mesh.*member)->with_parameter_derivative({near_by(0), near_by(1), near_by(2), near_by(3)}, h));
    };
    if (mesh.stiffness_curve) out.stiffness_curve = curve(&MeshParameters<double, N>::stiffness_curve);
    if (mesh.error_curve) out.error_curve = curve(&MeshParameters<double, N>::error_curve);
  };
  tables(
      p.sun_planet, dual->sun_planet, [](const auto& q) -> const auto& { return q.sun_planet; });
  tables(
      p.ring_planet, dual->ring_planet, [](const auto& q) -> const auto& { return q.ring_planet; });

  return [layout, dual](std::size_t segment, double s, const double* y, double* dgdp) {
    constexpr std::size_t most = 2 * degrees_of_freedom(Layout::full, N);
    const std::size_t n = 2 * degrees_of_freedom(layout, N);
    std::array<D, most> state;
    std::array<D, most> slope;
    for (std::size_t i = 0; i < n; ++i) state[i] = y[i];
    right_hand_side(layout, *dual, segment, D(s), state.data(), slope.data());
    for (std::size_t i = 0; i < n; ++i) dgdp[i] = slope[i].derivative[0];
  };
}

#define EPICYCLIC_INSTANTIATE(N)                                                             \
  template TangentFunction make_tangents(Layout, const Parameters<double, N>&);              \
  template ParameterFunction make_parameter_derivative(Layout, const Parameters<double, N>&, \
                                                       const std::array<Parameters<double, N>, 4>&, double);
EPICYCLIC_FOR_PLANETS(EPICYCLIC_INSTANTIATE)
#undef EPICYCLIC_INSTANTIATE

}  // namespace epicyclic::model
