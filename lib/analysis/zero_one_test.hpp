// The 0-1 test for chaos: a vote from a series alone, without the equations.
//
//   p_c(n) = sum_{j<=n} phi_j cos jc ,   q_c(n) = sum_{j<=n} phi_j sin jc
//   M_c(n) = mean_j [ (p_c(j+n) - p_c(j))^2 + (q_c(j+n) - q_c(j))^2 ]
//   K_c = correlation of n and M_c(n) , n = 1 .. N/10 ;   K = median over c in (pi/5, 4 pi/5)               
//
// phi is taken about its mean, so that the oscillating term that the source subtracts from M_c, mean(phi)^2 (1 - cos
// nc) / (1 - cos c), vanishes. K is near 1 for chaos, where p and q are random walks, and near 0 for periodic
// and quasiperiodic series, where they stay bounded.
//
// Source: G. A. Gottwald and I. Melbourne, SIAM J. Appl. Dyn. Syst. 8 (2009) 129. Limits: weak chaos and long
// transients give values between; the series has to be a map's (stroboscopic), not an oversampled flow's. A series that
// varies by no more than its noise is regular, K = 0; as a signal, noise would walk.
#pragma once

#include <span>

namespace epicyclic::analysis {

/// @param series  of a stroboscopic section, 100 points at least
/// @param noise   a range of the series up to this is none
/// @param angles  number of values of c; they are fixed, spread evenly by the golden ratio
/// @throws DomainError for a shorter series or fewer than one angle
[[nodiscard]] double zero_one_test(std::span<const double> series, double noise = 0.0, int angles = 100);

/// K up to the first indicates a regular response, above the second chaos; between them the test abstains.
inline constexpr double regular_vote = 0.3;
inline constexpr double chaotic_vote = 0.5;

}  // namespace epicyclic::analysis
