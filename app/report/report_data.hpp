// The data of a report, as its page reads them (app/browser/payload.js): a header in JSON and columns of numbers, all
// of it deflated and in base64. The bytes depend on the data alone.
//
//   4 bytes    length of the header, little-endian
//   header     JSON: the caller's, which has the descriptions of the tables
//   zeros      up to a multiple of 8 bytes from the beginning
//   columns    each at a multiple of 8 bytes from the end of the zeros, little-endian
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace epicyclic::app {

/// Standard base64, with padding.
[[nodiscard]] std::string base64(std::string_view bytes);

/// A table in the making; to_json() is its description for the header.
class ReportTable {
 public:
  ReportTable(std::string name, std::string title, std::size_t rows)
      : description_({{"name", std::move(name)},
                      {"title", std::move(title)},
                      {"rows", rows},
                      {"columns", nlohmann::json::array()}}),
        rows_(rows) {}

  [[nodiscard]] std::size_t rows() const { return rows_; }
  void add(nlohmann::json column) { description_["columns"].push_back(std::move(column)); }
  void leave_out(const std::string& column) { description_["left_out"].push_back(column); }
  [[nodiscard]] const nlohmann::json& to_json() const { return description_; }

 private:
  nlohmann::json description_;
  std::size_t rows_;
};

/// What a column is.
struct ReportColumn {
  std::string name;
  std::string unit;     ///< "1" of pure numbers; empty of words
  std::string meaning;  ///< empty: none is known
};

class ReportData {
 public:
  /// How numbers are kept.
  enum class Form {
    float64,    ///< to the last bit
    quantised,  ///< 65535 levels from the least to the largest; infinite numbers are not known then
    uint32,     ///< whole numbers from 0 to 2^32 - 1
  };

  /// @returns the description of the column, for its table
  [[nodiscard]] nlohmann::json numbers(const ReportColumn& column, std::span<const double> values, Form form);

  /// @returns as numbers(); null if there are more than 65535 different words
  [[nodiscard]] nlohmann::json words(const ReportColumn& column, std::span<const std::string> values);

  /// Bytes of the columns so far.
  [[nodiscard]] std::size_t size() const { return body_.size(); }

  /// All of it.
  /// @throws std::runtime_error when zlib fails; nlohmann::json::exception for a header that is not UTF-8
  [[nodiscard]] std::string encoded(const nlohmann::json& header) const;

 private:
  [[nodiscard]] nlohmann::json described(const ReportColumn& column, const char* form);

  std::string body_;
};

/// Are all of them whole numbers that uint32 takes?
[[nodiscard]] bool are_counts(std::span<const double> values);

}  // namespace epicyclic::app
