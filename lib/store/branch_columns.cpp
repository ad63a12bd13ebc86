#include "store/branch_columns.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "core/csv.hpp"

namespace epicyclic::store {

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Those of a sweep's columns that an orbit has too, but for the meshes of each planet.
constexpr std::array<std::string_view, 12> of_sweeps = {
    "delta_sp_min",  "delta_sp_max", "delta_rp_min", "delta_rp_max", "contact_sp",   "contact_rp",
    "planet_spread", "pull_sp",      "pull_rp",      "pull_time_sp", "pull_time_rp", "orbit_residual"};

bool is_of_a_planet(const std::string& name) {
  for (const std::string_view kind : {"delta_sp_", "delta_rp_", "contact_sp_", "contact_rp_"})
    if (name.size() > kind.size() && name.starts_with(kind) && name[kind.size()] >= '0' && name[kind.size()] <= '9')
      return true;
  return false;
}

/// A column of points as one of orbits; what was not carried has none of it.
Column<BranchPlace> of_place(const PointColumn& column) {
  Column<BranchPlace> result{column.name, column.unit, column.meaning, {}};
  const bool needs_motion = column.name != "orbit_residual";
  std::visit(
      [&]<class Value>(const std::function<Value(const studies::PointSummary&)>& value) {
        result.value = std::function<Value(const BranchPlace&)>([value, needs_motion](const BranchPlace& p) {
          if (p.row.carried || !needs_motion) return value(p.point);
          if constexpr (std::is_same_v<Value, double>) return unknown;
          return Value{};
        });
      },
      column.value);
  return result;
}

}  // namespace

std::string multiplier_text(const std::complex<double>& multiplier) {
  std::string text;
  append_number(text, multiplier.real());
  std::string imaginary;
  append_number(imaginary, std::abs(multiplier.imag()));
  return text + (std::signbit(multiplier.imag()) ? "-" : "+") + imaginary + "i";
}

std::vector<Column<BranchPlace>> branch_columns(std::size_t planets) {
  using Integer = Column<BranchPlace>::Getter<std::int64_t>;
  using Number = Column<BranchPlace>::Getter<double>;
  const auto integer = [](auto x) { return static_cast<std::int64_t>(x); };
  std::vector<Column<BranchPlace>> all = {
      {"branch", "1", "number of the branch, from 0", Integer([=](const BranchPlace& p) { return integer(p.branch); })},
      {"index", "1", "number of the orbit along it, from 0",
       Integer([=](const BranchPlace& p) { return integer(p.index); })},
      {"value", "of the parameter", "of the parameter that is varied",
       Number([](const BranchPlace& p) { return p.row.value; })},
      {"period", "mesh periods", "n of the orbits",
       Integer([=](const BranchPlace& p) { return integer(p.row.period); })},
      {"stable", "1", "1: no multiplier is beyond the unit circle, 0: one is",
       Integer([=](const BranchPlace& p) { return integer(p.row.stable); })},
      {"multiplier_max", "1", "largest modulus of the orbit's Floquet multipliers",
       Number([](const BranchPlace& p) { return p.row.multiplier_max(); })},
      {"unstable", "1", "number of multipliers beyond the unit circle",
       Integer([=](const BranchPlace& p) { return integer(p.row.unstable); })}};
  for (const PointColumn& column : point_columns(planets))
    if (std::find(of_sweeps.begin(), of_sweeps.end(), column.name) != of_sweeps.end() || is_of_a_planet(column.name))
      all.push_back(of_place(column));
  return all;
}

std::vector<Column<studies::SpecialRow>> special_columns() {
  using studies::SpecialRow;
  using Integer = Column<SpecialRow>::Getter<std::int64_t>;
  using Number = Column<SpecialRow>::Getter<double>;
  using Words = Column<SpecialRow>::Getter<std::string>;
  const auto integer = [](auto x) { return static_cast<std::int64_t>(x); };
  return {
      {"branch", "1", "number of the branch, from 0", Integer([=](const SpecialRow& r) { return integer(r.branch); })},
      {"kind", "", "fold, flip, neimark_sacker, resonance_1_1 to resonance_1_4, branch_point, grazing, or unresolved",
       Words([](const SpecialRow& r) { return kind_word(r); })},
      {"value", "of the parameter", "of the parameter, there", Number([](const SpecialRow& r) { return r.value; })},
      {"error_bound", "of the parameter", "of the value, from other tolerances and subdivisions",
       Number([](const SpecialRow& r) { return r.error_bound; })},
      {"period", "mesh periods", "n of the branch", Integer([=](const SpecialRow& r) { return integer(r.period); })},
      {"multipliers", "", "that reach the unit circle, re+imi", Words([](const SpecialRow& r) {
         std::string text;
         for (const auto& m : r.multipliers) text += (text.empty() ? "" : " ") + multiplier_text(m);
         return text;
       })},
      {"broken_symmetry", "", "wave of the motions that break the planets' symmetry; empty: none is broken",
       Words([](const SpecialRow& r) { return r.broken_symmetry; })},
      {"contact", "", "of a grazing: the meshes, and what they first do: drive, loss, back; of the bearing touch",
       Words([](const SpecialRow& r) { return r.contact; })},
      {"point", "1", "number of the point on its branch, from 0",
       Integer([=](const SpecialRow& r) { return integer(r.point); })},
      {"after", "1", "index of the orbit before it on its branch",
       Integer([=](const SpecialRow& r) { return integer(r.after); })},
      {"same_as", "", "branch:point of an earlier branch, if it is that one", Words([](const SpecialRow& r) {
         return r.same_as ? std::to_string(r.same_as->branch) + ":" + std::to_string(r.same_as->point) : std::string();
       })},
      {"exact_value", "of the parameter", "with a smooth clearance: the value extrapolated to the exact one",
       Number([](const SpecialRow& r) { return r.exact ? r.exact->value : unknown; })},
      {"exact_bound", "of the parameter", "its error bound",
       Number([](const SpecialRow& r) { return r.exact ? r.exact->bound : unknown; })},
      {"note", "", "what was not as usual", Words([](const SpecialRow& r) { return r.note; })}};
}

std::vector<Column<LocusPlace>> locus_columns() {
  using Integer = Column<LocusPlace>::Getter<std::int64_t>;
  using Number = Column<LocusPlace>::Getter<double>;
  using Words = Column<LocusPlace>::Getter<std::string>;
  const auto integer = [](auto x) { return static_cast<std::int64_t>(x); };
  return {
      {"locus", "1", "number of the locus, from 0", Integer([=](const LocusPlace& p) { return integer(p.locus); })},
      {"index", "1", "number of the point along it, from 0",
       Integer([=](const LocusPlace& p) { return integer(p.index); })},
      {"kind", "", "of the special points: fold, flip, neimark_sacker, branch_point, grazing",
       Words([](const LocusPlace& p) { return to_string(p.of.kind); })},
      {"first", "of the parameter", "value of the parameter that branches go along",
       Number([](const LocusPlace& p) { return p.row.first; })},
      {"second", "of the second parameter", "value of the second parameter",
       Number([](const LocusPlace& p) { return p.row.second; })},
      {"error_bound", "of the parameter", "of the first value",
       Number([](const LocusPlace& p) { return p.row.first_bound; })},
      {"marked", "", "point of codimension two: cusp, resonance_1_1 ..., fold_flip, ...; empty: none",
       Words([](const LocusPlace& p) { return p.row.marked; })},
      {"error_bound_second", "of the second parameter", "of the second value",
       Number([](const LocusPlace& p) { return p.row.second_bound; })},
      {"period", "mesh periods", "n of the orbits", Integer([=](const LocusPlace& p) { return integer(p.of.period); })},
      {"branch", "1", "of the special point that it was followed from",
       Integer([=](const LocusPlace& p) { return integer(p.of.branch); })},
      {"point", "1", "of the special point on its branch",
       Integer([=](const LocusPlace& p) { return integer(p.of.point); })}};
}

}  // namespace epicyclic::store
