#include "claims/candidate_record.hpp"

#include "store/record_archive.hpp"

namespace epicyclic {

namespace store::archive {

template <class A>
void pass(A& a, claims::Evaluation& e) {
  pass_all(a, e.cost);
  pass_as<std::uint8_t>(a, e.stopped_early);
  pass_all(a, e.refused, e.claim_costs);
  std::string holds(e.holds.begin(), e.holds.end());
  pass(a, holds);
  e.holds.assign(holds.begin(), holds.end());
}
template <class A>
void pass(A& a, claims::EvaluatedCandidate& c) {
  pass_all(a, c.key.phase, c.key.number, c.u, c.evaluation);
}

}  // namespace store::archive

namespace claims {

std::vector<std::byte> encode_candidate(const EvaluatedCandidate& candidate) {
  return store::archive::encode(candidate);
}

EvaluatedCandidate decode_candidate(std::span<const std::byte> record) {
  return store::archive::decode<EvaluatedCandidate>(record);
}

}  // namespace claims

}  // namespace epicyclic
