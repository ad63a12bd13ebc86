#include "store/branch_record.hpp"

#include <complex>

#include "store/record_archive.hpp"

namespace epicyclic::store {

namespace archive {

template <class A>
void pass(A& a, Eigen::MatrixXd& m) {
  auto rows = static_cast<std::size_t>(m.rows());
  std::vector<double> numbers(m.data(), m.data() + m.size());
  pass_all(a, rows, numbers);
  a.require(rows == 0 ? numbers.empty() : numbers.size() % rows == 0, "has a matrix that is not whole columns");
  const auto height = static_cast<Eigen::Index>(rows);
  m = Eigen::Map<const Eigen::MatrixXd>(numbers.data(), height,
                                        rows == 0 ? 0 : static_cast<Eigen::Index>(numbers.size()) / height);
}
template <class A>
void pass(A& a, MatrixProduct& m) {
  pass_all(a, m.factors);
}
template <class A>
void pass(A& a, std::complex<double>& x) {
  double parts[] = {x.real(), x.imag()};
  pass_all(a, parts[0], parts[1]);
  x = {parts[0], parts[1]};
}
template <class A>
void pass(A& a, analysis::CurvePoint& p) {
  pass_all(a, p.states, p.value);
}
template <class A>
void pass(A& a, analysis::BranchOrbit& o) {
  pass_all(a, o.at, o.direction, o.monodromy, o.residual);
}
template <class A>
void pass(A& a, analysis::BranchEnd& e) {
  pass_enum(a, e, analysis::BranchEnd::min_step);
}
template <class A>
void pass(A& a, analysis::SpecialKind& k) {
  pass_enum(a, k, analysis::SpecialKind::unresolved);
}
template <class A>
void pass(A& a, analysis::TreeStep::Kind& k) {
  pass_enum(a, k, analysis::TreeStep::Kind::followed);
}
template <class A>
void pass(A& a, analysis::SpecialPlace& p) {
  pass_all(a, p.branch, p.point);
}
template <class A>
void pass(A& a, analysis::SpecialPoint& p) {
  pass_all(a, p.kind, p.value, p.error_bound, p.orbit, p.symmetry_index, p.multiplier, p.outwards, p.surface, p.least,
           p.rising, p.nullity, p.resonance, p.note);
}
/// Whether it is there, and it.
template <class A, class T>
void pass_if_there(A& a, std::optional<T>& x) {
  std::size_t there = x.has_value() ? 1 : 0;  // eight bytes, as elements of lists have at least
  pass(a, there);
  a.require(there <= 1, "says neither that something is there nor that it is not");
  if (there == 1 && !x) x.emplace();
  if (there == 0) x.reset();
  if (x) pass(a, *x);
}
template <class A>
void pass(A& a, std::optional<analysis::SpecialPlace>& x) {
  pass_if_there(a, x);
}
template <class A>
void pass(A& a, analysis::BranchLimit& l) {
  pass_all(a, l.end, l.born, l.place, l.message);
}
template <class A>
void pass(A& a, std::optional<analysis::BranchLimit>& x) {
  pass_if_there(a, x);
}
template <class A>
void pass(A& a, std::optional<analysis::BranchOrbit>& x) {
  pass_if_there(a, x);
}
template <class A>
void pass(A& a, analysis::BranchStart& s) {
  pass_all(a, s.period, s.shooting_intervals, s.keeps_symmetry, s.orbit, s.from, s.origin, s.least, s.greatest);
}
template <class A>
void pass(A& a, analysis::ContinuationState& s) {
  pass_all(a, s.now, s.tangent_derivative, s.step, s.orbits, s.left_start, s.end, s.message, s.evaluations);
}
template <class A>
void pass(A& a, analysis::TreeStep& s) {
  pass_all(a, s.kind, s.full, s.trace, s.orbit, s.special, s.same_as, s.branch_switches, s.limit);
}

template <class A>
void pass(A& a, studies::LocusRow& r) {
  pass_all(a, r.first, r.second, r.first_bound, r.second_bound, r.marked, r.state);
}
template <class A>
void pass(A& a, studies::TracedLocus& l) {
  pass_all(a, l.branch, l.point, l.kind, l.period, l.symmetry_index, l.rows, l.first_end, l.last_end, l.message);
}

template <class A>
void pass(A& a, studies::CoexistingOrbit& m) {
  pass_all(a, m.orbit, m.period, m.shooting_intervals, m.keeps_symmetry, m.images, m.unstable, m.multiplier_max,
           m.starts);
}
template <class A>
void pass(A& a, studies::CoexistingOrbits& f) {
  pass_all(a, f.value, f.starts, f.missed, f.orbits);
}

template <class A>
void pass(A& a, analysis::ExactValue& e) {
  pass_all(a, e.value, e.bound);
}
/// In a record of its own.
struct ExactRecord {
  std::optional<analysis::ExactValue> exact;
  std::string note;
};
template <class A>
void pass(A& a, ExactRecord& r) {
  pass_if_there(a, r.exact);
  pass(a, r.note);
}

}  // namespace archive

std::vector<std::byte> encode_step(const analysis::TreeStep& step) { return archive::encode(step); }

analysis::TreeStep decode_step(std::span<const std::byte> record) {
  return archive::decode<analysis::TreeStep>(record);
}

std::vector<std::byte> encode_locus(const studies::TracedLocus& locus) { return archive::encode(locus); }

studies::TracedLocus decode_locus(std::span<const std::byte> record) {
  return archive::decode<studies::TracedLocus>(record);
}

std::vector<std::byte> encode_found(const studies::CoexistingOrbits& found) { return archive::encode(found); }

studies::CoexistingOrbits decode_found(std::span<const std::byte> record) {
  return archive::decode<studies::CoexistingOrbits>(record);
}

std::vector<std::byte> encode_exact(const std::optional<analysis::ExactValue>& exact, const std::string& note) {
  return archive::encode(archive::ExactRecord{exact, note});
}

std::optional<analysis::ExactValue> decode_exact(std::span<const std::byte> record, std::string& note) {
  archive::ExactRecord read = archive::decode<archive::ExactRecord>(record);
  note = std::move(read.note);
  return read.exact;
}

}  // namespace epicyclic::store
