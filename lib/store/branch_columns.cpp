#include "store/branch_columns.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>

#include "core/csv.hpp"
#include "gear/kinematics.hpp"

namespace epicyclic::store {

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Columns of an orbit's periods; empty for an orbit that was not integrated over its periods.
Column<BranchPlace> of_orbit(const StageColumn& column) {
  Column<BranchPlace> result{column.name, column.unit, column.meaning, {}};
  std::visit(
      [&]<class Value>(const std::function<Value(const studies::StageRecord&)>& value) {
        result.value = std::function<Value(const BranchPlace&)>([value](const BranchPlace& p) {
          if (p.row.evaluated) return value(p.row.meshes);
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

std::vector<Column<BranchPlace>> branch_columns(std::size_t planets, const KnownLives& lives) {
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
  const auto append = [&all](const std::vector<StageColumn>& columns) {
    for (const StageColumn& column : columns) all.push_back(of_orbit(column));
  };
  append(contact_columns());
  append(stage_columns());
  all.push_back({"orbit_residual", "b_c, b_c per tau", "by which the orbit found does not close",
                 Number([](const BranchPlace& p) { return p.row.residual; })});
  append(planet_columns(planets));
  append(life_columns(planets, lives));
  if (planets == 1) std::erase_if(all, [](const auto& column) { return !is_of_pair(column.name); });
  return all;
}

std::vector<Column<studies::SpecialRow>> special_columns() {
  using studies::SpecialRow;
  using Integer = Column<SpecialRow>::Getter<std::int64_t>;
  using Number = Column<SpecialRow>::Getter<double>;
  using Words = Column<SpecialRow>::Getter<std::string>;
  const auto integer = [](auto x) { return static_cast<std::int64_t>(x); };
  // An orbit that could not be integrated over its periods has no such values.
  const auto of_speed = [](auto get) {
    return Number([get](const SpecialRow& r) { return r.mesh_frequency > 0.0 ? get(r) : unknown; });
  };
  return {
      {"branch", "1", "number of the branch, from 0", Integer([=](const SpecialRow& r) { return integer(r.branch); })},
      {"kind", "",
       "kind of the point: `fold`, `flip` (period doubling), `neimark_sacker`, `resonance_1_1` to `resonance_1_4`, "
       "`branch_point`, `grazing`, or `unresolved`",
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
      {"broken_symmetry", "", "symmetry index of the orbits that break the planets' symmetry; empty: none is broken",
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
      {"mesh_frequency_Hz", "Hz", "mesh frequency there",
       of_speed([](const SpecialRow& r) { return 0.5 / std::numbers::pi * r.mesh_frequency; })},
      {"sun_speed_rpm", "rpm", "speed of the sun there",
       of_speed([](const SpecialRow& r) { return gear::rpm * r.speeds.sun; })},
      {"carrier_speed_rpm", "rpm", "speed of the carrier there",
       of_speed([](const SpecialRow& r) { return gear::rpm * r.speeds.carrier; })},
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
      {"kind", "",
       "of the special points: `fold`, `flip` (period doubling), `neimark_sacker`, `branch_point`, `grazing`",
       Words([](const LocusPlace& p) { return to_string(p.of.kind); })},
      {"first", "of the parameter", "value of the parameter that branches go along",
       Number([](const LocusPlace& p) { return p.row.first; })},
      {"second", "of the second parameter", "value of the second parameter",
       Number([](const LocusPlace& p) { return p.row.second; })},
      {"error_bound", "of the parameter", "of the first value",
       Number([](const LocusPlace& p) { return p.row.first_bound; })},
      {"codimension_two", "", "point of codimension two: cusp, resonance_1_1 ..., fold_flip, ...; empty: none",
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
