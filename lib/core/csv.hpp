// Tables as CSV text (RFC 4180, but with "\n" as line end), for people, pandas and gnuplot alike.
//
// The bytes depend on the data alone, never on locale or platform: a number is the shortest decimal text that reads
// back as the same number (std::to_chars), nan is an empty cell, infinities are `inf` and `-inf`, truth values 0 and 1.
// A text is quoted only if it must be.
#pragma once

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/atomic_file.hpp"

namespace epicyclic {

/// Appends the shortest decimal text that reads back as the same double; nan appends nothing.
void append_number(std::string& text, double value);
/// Appends the shortest decimal text that reads back as the same float: 0.1f is `0.1`; nan appends nothing.
void append_number(std::string& text, float value);

/// Writes a table row by row, either to memory or, in blocks, to a file that appears when it is complete.
class CsvWriter {
 public:
  /// A table in memory; see text().
  explicit CsvWriter(const std::vector<std::string>& columns);

  /// A table that becomes the file `path` at commit().
  /// @throws OutputError when the file cannot be created
  CsvWriter(const std::filesystem::path& path, const std::vector<std::string>& columns);

  /// Writes one row.
  /// @throws std::logic_error when the number of cells is not the number of columns
  /// @throws OutputError      when a block cannot be written
  template <typename... Cells>
  void row(const Cells&... cells) {
    (cell(cells), ...);
    end_row();
  }

  /// Adds one cell to the current row, for rows whose width is known only at run time.
  CsvWriter& cell(double value);
  CsvWriter& cell(float value);
  CsvWriter& cell(std::string_view value);
  CsvWriter& cell(std::integral auto value) { return integer_cell(value); }

  /// Ends the current row; throws as row() does.
  void end_row();

  /// The table so far; for tables in memory.
  [[nodiscard]] const std::string& text() const { return buffer_; }

  /// Writes what is left and lets the file appear.
  /// @throws OutputError      when that fails; no file appears
  /// @throws std::logic_error when a row is unfinished or the table is in memory
  void commit();

 private:
  template <std::integral T>
  CsvWriter& integer_cell(T value) {
    if constexpr (std::signed_integral<T>) {
      return signed_cell(static_cast<std::int64_t>(value));
    } else {
      return unsigned_cell(static_cast<std::uint64_t>(value));
    }
  }
  CsvWriter& signed_cell(std::int64_t value);
  CsvWriter& unsigned_cell(std::uint64_t value);
  void begin_cell();

  std::size_t columns_;
  std::size_t cells_ = 0;
  std::size_t row_start_ = 0;
  std::string buffer_;
  std::optional<AtomicFile> file_;
};

/// A table as texts.
struct CsvTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  ///< of as many cells as there are columns

  /// Index of a column, or columns.size().
  [[nodiscard]] std::size_t index_of(std::string_view column) const;
};

/// Reads what CsvWriter writes, row by row, the names of the columns first.
/// @param row  may take the cells
/// @returns false where the text is no such table: a row of another length, a quote that does not end
[[nodiscard]] bool scan_csv(std::string_view text, const std::function<void(std::vector<std::string>& cells)>& row);

/// Reads what CsvWriter writes.
/// @returns nothing where the text is no such table: a row of another length, a quote that does not end
[[nodiscard]] std::optional<CsvTable> parse_csv(std::string_view text);

}  // namespace epicyclic
