#include "core/csv.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace epicyclic {

namespace {

// Large enough that the number of system calls does not matter.
constexpr std::size_t block_bytes = std::size_t{1} << 20;

template <typename T>
void append_characters(std::string& text, T value) {
  std::array<char, 32> digits{};
  const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  text.append(digits.data(), result.ptr);
}

}  // namespace

void append_number(std::string& text, double value) {
  if (!std::isnan(value)) append_characters(text, value);
}

void append_number(std::string& text, float value) {
  if (!std::isnan(value)) append_characters(text, value);
}

CsvWriter::CsvWriter(const std::vector<std::string>& columns) : columns_(columns.size()) {
  for (const std::string& name : columns) cell(name);
  end_row();
}

CsvWriter::CsvWriter(const std::filesystem::path& path, const std::vector<std::string>& columns) : CsvWriter(columns) {
  file_.emplace(path);
}

void CsvWriter::begin_cell() {
  if (cells_++ > 0) buffer_ += ',';
}

CsvWriter& CsvWriter::cell(double value) {
  begin_cell();
  append_number(buffer_, value);
  return *this;
}

CsvWriter& CsvWriter::cell(float value) {
  begin_cell();
  append_number(buffer_, value);
  return *this;
}

CsvWriter& CsvWriter::signed_cell(std::int64_t value) {
  begin_cell();
  append_characters(buffer_, value);
  return *this;
}

CsvWriter& CsvWriter::unsigned_cell(std::uint64_t value) {
  begin_cell();
  append_characters(buffer_, value);
  return *this;
}

CsvWriter& CsvWriter::cell(std::string_view value) {
  begin_cell();
  if (value.find_first_of(",\"\r\n") == std::string_view::npos) {
    buffer_ += value;
    return *this;
  }
  buffer_ += '"';
  for (const char character : value) {
    if (character == '"') buffer_ += '"';
    buffer_ += character;
  }
  buffer_ += '"';
  return *this;
}

void CsvWriter::end_row() {
  if (cells_ != columns_) {
    throw std::logic_error(fmt::format("CsvWriter: a row of {} cells in a table of {} columns", cells_, columns_));
  }
  // The only cell of a row, if empty, would leave a blank line, which readers skip.
  if (columns_ == 1 && buffer_.size() == row_start_) buffer_ += "\"\"";
  buffer_ += '\n';
  cells_ = 0;
  if (file_ && buffer_.size() >= block_bytes) {
    file_->write(buffer_);
    buffer_.clear();
  }
  row_start_ = buffer_.size();
}

void CsvWriter::commit() {
  if (!file_) throw std::logic_error("CsvWriter: commit of a table in memory");
  if (cells_ != 0) throw std::logic_error("CsvWriter: commit within a row");
  file_->write(buffer_);
  buffer_.clear();
  file_->commit();
}

std::size_t CsvTable::index_of(std::string_view column) const {
  return static_cast<std::size_t>(std::find(columns.begin(), columns.end(), column) - columns.begin());
}

bool scan_csv(std::string_view text, const std::function<void(std::vector<std::string>& cells)>& row) {
  std::vector<std::string> cells(1);
  std::size_t used = 1;     // of the cells; those behind keep their memory
  std::size_t columns = 0;  // of the first row
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    std::string& cell = cells[used - 1];
    if (quoted) {
      if (c != '"') {
        cell += c;
      } else if (i + 1 < text.size() && text[i + 1] == '"') {
        cell += text[++i];
      } else {
        quoted = false;
      }
    } else if (c == '"' && cell.empty()) {
      quoted = true;
    } else if (c == ',') {
      if (++used > cells.size()) cells.emplace_back();
      cells[used - 1].clear();
    } else if (c == '\n') {
      if (columns > 0 && used != columns) return false;
      cells.resize(columns = used);
      row(cells);
      cells.resize(columns);
      used = 1;
      cells[0].clear();
    } else {
      cell += c;
    }
  }
  return !quoted && used == 1 && cells[0].empty() && columns > 0;
}

std::optional<CsvTable> parse_csv(std::string_view text) {
  CsvTable table;
  const bool is_table = scan_csv(text, [&table](std::vector<std::string>& cells) {
    if (table.columns.empty())
      table.columns = std::move(cells);
    else
      table.rows.push_back(std::move(cells));
  });
  if (!is_table) return std::nullopt;
  return table;
}

}  // namespace epicyclic
