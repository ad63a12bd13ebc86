#include "reports/expected_output.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "core/errors.hpp"
#include "core/text.hpp"
#include "input/field_table.hpp"
#include "input/json_source.hpp"
#include "input/recorded_study.hpp"
#include "input/stage_completion.hpp"
#include "store/identity.hpp"

namespace epicyclic::reports {

namespace {

using nlohmann::json;
using studies::LocatedPoint;
using studies::PointComparison;
using studies::PointVerdict;

constexpr const char* format_name = "epicyclic expected points 1";
constexpr std::size_t points_most = 100000;

struct ExpectedFile {
  std::string format;
  json study;
  std::vector<LocatedPoint> points;
};

const input::Table<LocatedPoint>& point_table() {
  static const auto table = [] {
    input::Table<LocatedPoint> t("point", "A special point.");
    t.text("kind", &LocatedPoint::kind, "Kind of the point, as in special.csv.").required();
    t.integer("period", &LocatedPoint::period, input::between(1, 1e6), "Period of the branch, in mesh periods [-].")
        .required();
    t.number("value", &LocatedPoint::value, input::between(-1e300, 1e300), "Value of the parameter, in its unit.")
        .required();
    t.number("bound", &LocatedPoint::bound, input::above(0), "How far off a value may be, in the parameter's unit.")
        .required();
    t.text("contact", &LocatedPoint::contact, "Of a grazing: contact, as in special.csv.");
    t.text("broken_symmetry", &LocatedPoint::broken_symmetry,
           "Symmetry index of the orbits that break the planets' symmetry.");
    return t;
  }();
  return table;
}

const input::Table<ExpectedFile>& file_table() {
  static const auto table = [] {
    using input::Finding;
    input::Table<ExpectedFile> t("expected_points", "Special points that are expected of a study.");
    t.choice("format", &ExpectedFile::format, std::vector<std::string>{format_name}, "What the file is.").required();
    input::Field<ExpectedFile> study;
    study.key = "study";
    study.description = "The resolved input of the study.";
    study.read = [](const json& value, const std::string& pointer, ExpectedFile& file, input::ReadContext& context) {
      file.study = value;
      const json::json_pointer from("/study/from"), to("/study/to"), kind("/study/kind");
      if (!value.is_object() || !value.contains(from) || !value[from].is_number() || !value.contains(to) ||
          !value[to].is_number() || !value.contains(kind) || value[kind] != "continue")
        context.add(Finding::Kind::type, pointer, "is not the resolved input of a study of kind continue");
    };
    t.custom(std::move(study)).required();
    input::Field<ExpectedFile> points;
    points.key = "points";
    points.description = "The points.";
    points.read = [](const json& value, const std::string& pointer, ExpectedFile& file, input::ReadContext& context) {
      if (!value.is_array() || value.size() > points_most) {
        context.add(Finding::Kind::type, pointer,
                    fmt::format("is {}, must be an array of at most {} objects", input::described(value), points_most));
        return;
      }
      for (std::size_t k = 0; k < value.size(); ++k)
        point_table().read(value[k], pointer + "/" + std::to_string(k), file.points.emplace_back(), context);
    };
    t.custom(std::move(points)).required();
    return t;
  }();
  return table;
}

/// Whether the values at a pointer may differ between studies of the same points.
bool may_differ(std::string_view pointer) {
  constexpr std::array<std::string_view, 5> fixed = {"/study/parameter", "/study/from", "/study/to", "/study/kind",
                                                     "/integrator/clearance_smoothing"};
  return pointer == "/name" || ((pointer.starts_with("/integrator/") || pointer.starts_with("/study/")) &&
                                !std::ranges::count(fixed, pointer));
}

std::string name_of(const LocatedPoint& p) {
  std::string name = fmt::format("{} of period {}", p.kind, p.period);
  if (!p.contact.empty()) name += ", " + p.contact;
  if (!p.broken_symmetry.empty()) name += ", " + p.broken_symmetry;
  return name;
}

const LocatedPoint& either(const PointComparison& c) { return c.expected ? *c.expected : *c.found; }

std::string what_is(const PointComparison& c) {
  std::string text;
  if (c.expected) text = fmt::format("expected {}", with_error(c.expected->value, c.expected->bound));
  if (c.found) text += fmt::format("{}found {}", text.empty() ? "" : ", ", with_error(c.found->value, c.found->bound));
  if (c.expected && c.found)
    text += fmt::format(", off by {} of the bound",
                        short_text(std::abs(c.found->value - c.expected->value) / c.expected->bound));
  return text;
}

std::string xml(std::string_view text) {
  std::string escaped;
  for (const char c : text) switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        // Other control characters have no place in XML.
        escaped += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  // Nor have bytes that are no UTF-8, as in names of files: dump() replaces them.
  const std::string quoted = json(escaped).dump(-1, ' ', false, json::error_handler_t::replace);
  return json::parse(quoted).get<std::string>();
}

json to_json(const LocatedPoint& p) { return point_table().write(p); }

}  // namespace

double ExpectedPoints::reach() const {
  constexpr double part = 1e-3;
  const json& range = study.at("study");
  return part * std::abs(range.at("to").get<double>() - range.at("from").get<double>());
}

ExpectedPoints read_expected(const std::filesystem::path& file) {
  const input::JsonSource source = input::read_json_file(file);
  std::vector<input::Problem> problems = source.problems;
  ExpectedFile read;
  if (source.complete) {
    input::ReadContext context;
    file_table().read(source.value, "", read, context);
    for (const input::Finding& f : context.findings)
      if (!source.unreadable.contains(f.pointer))
        problems.push_back({source.name, source.line_of(f.pointer), f.pointer, f.message});
  }
  if (!problems.empty()) throw input::InputProblems(std::move(problems));
  return {std::move(read.study), std::move(read.points)};
}

std::vector<LocatedPoint> expected_of(const std::vector<LocatedPoint>& found, const studies::BranchesOptions& study) {
  constexpr double least = 1e-9;
  std::vector<LocatedPoint> points;
  for (LocatedPoint p : found) {
    if (p.kind == "unresolved" || !std::isfinite(p.value) || !std::isfinite(p.bound)) continue;
    p.bound = std::max(2.0 * p.bound, least * (study.to - study.from));
    points.push_back(std::move(p));
  }
  return points;
}

std::string expected_text(const input::LoadedInput& study, const std::vector<LocatedPoint>& points) {
  std::string text = fmt::format("{{\n\"format\": \"{}\",\n\"points\": [", format_name);
  for (std::size_t k = 0; k < points.size(); ++k) text += (k == 0 ? "\n" : ",\n") + to_json(points[k]).dump();
  return text + "\n],\n\"study\": " + study.resolved.dump() + "\n}\n";
}

std::vector<std::string> unlike(const ExpectedPoints& expected, const input::LoadedInput& study) {
  json there = expected.study;
  input::add_later_keys(there);
  const json computed = input::computed_values(there);
  std::vector<std::string> lines;
  for (const store::Difference& d : store::differing_values({there, computed}, {study.resolved, study.computed}))
    if (!may_differ(d.pointer)) lines.push_back(d.text);
  return lines;
}

std::string compared_table(const std::vector<PointComparison>& compared) {
  std::string text;
  for (const PointComparison& c : compared)
    text += fmt::format("{:<13}  {}: {}\n", to_string(c.verdict), name_of(either(c)), what_is(c));
  return text;
}

json compared_json(const std::vector<PointComparison>& compared) {
  json rows = json::array();
  for (const PointComparison& c : compared) {
    json row = {{"verdict", to_string(c.verdict)}};
    if (c.expected) row["expected"] = to_json(*c.expected);
    if (c.found) row["found"] = to_json(*c.found);
    rows.push_back(std::move(row));
  }
  return {{"points", std::move(rows)}};
}

namespace {

std::string junit_suite(const std::string& name, std::size_t tests, std::size_t failures, std::size_t errors,
                        const std::string& cases) {
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<testsuites>\n<testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"0\">\n{}"
      "</testsuite>\n</testsuites>\n",
      xml(name), tests, failures, errors, cases);
}

}  // namespace

std::string error_junit_text(const std::string& name, const std::string& message, const std::string& text) {
  return junit_suite(name, 1, 0, 1,
                     fmt::format("<testcase classname=\"special_points\" name=\"the study\">\n"
                                 "<error type=\"not compared\" message=\"{}\">{}</error>\n</testcase>\n",
                                 xml(message), xml(text)));
}

std::string junit_text(const std::string& name, const std::vector<PointComparison>& compared) {
  const auto failures = static_cast<std::size_t>(
      std::ranges::count_if(compared, [](const auto& c) { return c.verdict != PointVerdict::agrees; }));
  std::string text;
  for (const PointComparison& c : compared) {
    text += fmt::format("<testcase classname=\"special_points\" name=\"{} at {}\"", xml(name_of(either(c))),
                        short_text(c.value(), 12));
    if (c.verdict == PointVerdict::agrees)
      text += "/>\n";
    else
      text += fmt::format(">\n<failure type=\"{0}\" message=\"{0}\">{1}</failure>\n</testcase>\n",
                          xml(to_string(c.verdict)), xml(what_is(c)));
  }
  return junit_suite(name, compared.size(), failures, 0, text);
}

}  // namespace epicyclic::reports
