// Results as one HDF5 file, over the C API of HDF5 1.10.
//
// The same data give the same bytes: no time stamps, a fixed version of the file format (that of HDF5 1.8, which every
// reader in use knows), fixed chunking and compression (shuffle + deflate for data above 64 KiB), texts of fixed
// length. The file grows on the disk under a temporary name (core/atomic_file.hpp), and datasets may be given row by
// row: it need not fit into memory.
//
// Every axis has a dimension scale, as the HDF5 Dimension Scale Specification and netCDF-4 define it: a dataset of the
// group that has the name of the axis. So readers of netCDF open the file. The group /columns lists the attributes
// "units" and "meaning" of all datasets once more, for readers that know no attributes, as Octave's `load`.
//
// HDF5 is not safe to use from several threads at once: one thread at a time, over all files. Its own error printing is
// silenced during each call, and its error stack becomes the text of the OutputError.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/atomic_file.hpp"

namespace epicyclic::store {

/// Attribute "format_version" of the file, which is higher if a reader of the version before it would fail. Version 1
/// had no such attribute, and one matrix for all columns of /poincare and /history.
inline constexpr std::int64_t hdf5_format_version = 2;

/// Writes one HDF5 file. Objects are named by paths such as "/points/delta_sp"; groups on the way are made as needed.
/// Each member throws OutputError, naming file, object and reason, when HDF5 refuses (a name twice, say).
class Hdf5File {
 public:
  explicit Hdf5File(std::filesystem::path path);
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;
  /// Without close(), no file appears.
  ~Hdf5File();

  /// Makes the group and those on the way to it, as far as they do not exist yet.
  void create_group(std::string_view path);

  /// A dataset with one axis.
  void write(std::string_view path, std::span<const double> values);
  void write(std::string_view path, std::span<const std::int64_t> values);
  /// Texts have one fixed length, padded with zero bytes; a text must contain none. HDF5 marks them as ASCII, and the
  /// attribute _Encoding names their encoding, UTF-8: Octave's `load` stops at the mark of UTF-8.
  void write(std::string_view path, std::span<const std::string> values);

  /// A dataset with two axes, given row by row.
  /// @throws std::invalid_argument when values.size() is not rows * columns
  void write(std::string_view path, std::span<const double> values, std::size_t rows, std::size_t columns);
  void write(std::string_view path, std::span<const std::int64_t> values, std::size_t rows, std::size_t columns);

  /// The value in a row.
  template <class Value>
  using Column = std::function<Value(std::size_t row)>;

  /// A dataset with one axis that is not kept in memory: rows are asked for in order, each once; texts twice.
  void write(std::string_view path, std::size_t rows, const Column<double>& value);
  void write(std::string_view path, std::size_t rows, const Column<std::int64_t>& value);
  void write(std::string_view path, std::size_t rows, const Column<std::string>& value);

  /// A dataset with two axes that is not kept in memory.
  /// @param row_values  fills a row of `columns` values; rows are asked for in order, each once
  void write(std::string_view path, std::size_t rows, std::size_t columns,
             const std::function<void(std::size_t row, std::span<double> values)>& row_values);

  /// Numbers of a group, a dataset with one axis each, that are not kept in memory: some rows of all datasets at a
  /// time.
  /// @param row_values  fills a value of each dataset; rows are required in order, each once
  void write_columns(std::string_view group, std::span<const std::string> names, std::size_t rows,
                     const std::function<void(std::size_t row, std::span<double> values)>& row_values);

  /// Names the axes of a dataset; "row" and "column" if nobody does, with a number behind them if their lengths differ
  /// within a group. The dimension scale of an axis is the dataset of that name and length in the group or in one above
  /// it, else a new one of numbers from 0.
  /// @throws std::logic_error when there is no such dataset, or its axes are more or less
  void name_axes(std::string_view path, std::vector<std::string> names);

  /// An attribute of a dataset or group ("/" is the file itself). Texts are marked as ASCII, those of other characters
  /// as UTF-8.
  void set_attribute(std::string_view object, std::string_view name, std::string_view value);
  void set_attribute(std::string_view object, std::string_view name, double value);
  void set_attribute(std::string_view object, std::string_view name, std::int64_t value);
  void set_attribute(std::string_view object, std::string_view name, const char* value) {
    set_attribute(object, name, std::string_view(value));
  }

  /// The attribute "units", as in "N/m"; "1" if dimensionless.
  void set_units(std::string_view object, std::string_view units) { set_attribute(object, "units", units); }

  /// Writes the file to the disk.
  /// @throws OutputError when that fails; what stood under the name before is then unchanged
  void close();

 private:
  /// Bytes of `rows` rows from `row` on, valid until the next call.
  using FillRows = std::function<const std::byte*(std::size_t row, std::size_t rows)>;

  /// A dataset that was written, for the dimension scales.
  struct Written {
    std::string path;
    std::vector<std::size_t> shape;
    std::vector<std::string> axes{};  ///< names
    std::string units{}, meaning{};   ///< attributes
  };

  void abandon() noexcept;
  std::int64_t create_dataset(std::string_view path, std::int64_t file_type, std::int64_t space,
                              std::span<const unsigned long long> chunk, bool cached);
  void write_block(std::int64_t dataset, std::string_view path, std::int64_t memory_type, std::int64_t space,
                   std::span<const unsigned long long> start, std::span<const unsigned long long> block,
                   const void* values);
  std::size_t scale_of(std::size_t dataset, std::size_t axis);
  void write_scales();
  void write_list_of_columns();
  void write_rows(std::string_view path, std::int64_t file_type, std::int64_t memory_type, std::size_t value_size,
                  std::span<const std::size_t> shape, const FillRows& fill);
  void write_values(std::string_view path, std::int64_t file_type, std::int64_t memory_type, std::size_t value_size,
                    const void* values, std::span<const std::size_t> shape);
  void write_attribute(std::string_view object, std::string_view name, std::int64_t file_type, std::int64_t memory_type,
                       const void* value, std::size_t count = 0);

  std::filesystem::path path_;
  AtomicFile disk_;
  FileDescriptor nowhere_;  // memory, for what must not reach the disk any more
  std::vector<Written> written_;
  std::int64_t file_ = -1;  // an hid_t, kept out of this header with the rest of hdf5.h
};

/// A dataset read back: values in row order; numbers of other types are converted.
struct Hdf5Dataset {
  std::vector<std::size_t> shape;
  std::vector<double> values;
};

/// @throws InputError when file or dataset cannot be read
Hdf5Dataset read_hdf5(const std::filesystem::path& file, std::string_view dataset);

/// @throws InputError when file or dataset cannot be read, or the dataset is not one of texts of fixed length
std::vector<std::string> read_hdf5_texts(const std::filesystem::path& file, std::string_view dataset);

/// A text attribute of an object.
/// @throws InputError when it cannot be read
std::string read_hdf5_attribute(const std::filesystem::path& file, std::string_view object, std::string_view name);

}  // namespace epicyclic::store
