#include "store/candidate_record.hpp"

#include "store/record_archive.hpp"

namespace epicyclic::store {

namespace archive {

template <class A>
void pass(A& a, studies::Evaluation& e) {
  pass_all(a, e.cost);
  pass_as<std::uint8_t>(a, e.given_up);
  pass_all(a, e.refused, e.claim_costs);
  std::string holds(e.holds.begin(), e.holds.end());
  pass(a, holds);
  e.holds.assign(holds.begin(), holds.end());
}
template <class A>
void pass(A& a, studies::EvaluatedCandidate& c) {
  pass_all(a, c.key.phase, c.key.number, c.u, c.evaluation);
}

}  // namespace archive

std::vector<std::byte> encode_candidate(const studies::EvaluatedCandidate& candidate) {
  return archive::encode(candidate);
}

studies::EvaluatedCandidate decode_candidate(std::span<const std::byte> record) {
  return archive::decode<studies::EvaluatedCandidate>(record);
}

}  // namespace epicyclic::store
