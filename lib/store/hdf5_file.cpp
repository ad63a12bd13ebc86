#include "store/hdf5_file.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <new>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <hdf5.h>
#include <sys/mman.h>
#include <unistd.h>

#include "core/errors.hpp"

namespace epicyclic::store {

namespace {

static_assert(std::is_same_v<hid_t, std::int64_t> && std::is_same_v<hsize_t, unsigned long long>,
              "hdf5_file.hpp has these types of HDF5 by other names");

/// Data above this size are chunked and compressed [bytes].
constexpr std::size_t compress_above = std::size_t{64} << 10;
/// Aimed size of a chunk [bytes]: within HDF5's chunk cache of 1 MiB.
constexpr std::size_t chunk_bytes = std::size_t{256} << 10;
/// Size of a block of columns that are written together [bytes].
constexpr std::size_t columns_bytes = std::size_t{1} << 20;
/// A section in chaos has all but random mantissas: level 4 takes 1.7 times as long as 1 for a file 1 % smaller.
constexpr unsigned deflate_level = 1;

/// Keeps HDF5 from printing while it lives; the setting of the program around us comes back afterwards.
class QuietErrors {
 public:
  QuietErrors() {
    // A file that could not be written stays open, and HDF5 crashes when it closes it as the program ends.
    [[maybe_unused]] static const herr_t not_at_exit = H5dont_atexit();
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  QuietErrors(const QuietErrors&) = delete;
  QuietErrors& operator=(const QuietErrors&) = delete;
  ~QuietErrors() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

herr_t keep_description(unsigned, const H5E_error2_t* error, void* text) {
  if (error->desc != nullptr) *static_cast<std::string*>(text) = error->desc;
  return 0;
}

/// The innermost entry of HDF5's error stack: the cause; the others are only its callers.
std::string innermost_error() {
  std::string text;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, keep_description, &text);
  return text;
}

/// errno of a failed system call; 0 if HDF5 failed otherwise.
int number_in(std::string_view error) {
  constexpr std::string_view before = "errno = ";
  int number = 0;
  if (const auto found = error.find(before); found != std::string_view::npos)
    std::from_chars(error.data() + found + before.size(), error.data() + error.size(), number);
  return number;
}

/// Calls HDF5 again when a signal interrupted it as it opened a file, which it takes for a failure. (An interrupted
/// ftruncate as well; but a second flush would give other bytes, and no handler of the program interrupts one.)
template <typename Call>
auto uninterrupted(const Call& call) {
  for (;;) {
    const auto result = call();
    if (result >= 0 || number_in(innermost_error()) != EINTR) return result;
  }
}

std::string error_text() {
  std::string text = innermost_error();
  // Of a failed system call the rest is place and time.
  constexpr std::string_view before = "error message = '";
  if (const auto reason = text.find(before); reason != std::string::npos) {
    const std::string_view advice = advice_on(number_in(text));
    text = text.substr(reason + before.size());
    text = text.substr(0, text.find('\''));
    text += advice;
  }
  return text.empty() ? "HDF5 gave no reason" : text;
}

/// Owns an HDF5 identifier.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  [[nodiscard]] hid_t get() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// Passes a result of HDF5 on; a negative one, which is HDF5's word for failure, becomes an `Error`.
template <typename Error, typename Result>
Result checked(Result result, const std::filesystem::path& file, std::string_view object, std::string_view action) {
  if (result < 0) throw Error(fmt::format("{}: cannot {} {}: {}", file.string(), action, object, error_text()));
  return result;
}

/// A creation property list without time stamps.
Handle untimed(hid_t property_class) {
  Handle properties(H5Pcreate(property_class), H5Pclose);
  H5Pset_obj_track_times(properties.get(), false);
  return properties;
}

/// Full rows if they fit, so that a reader of a few rows need not unpack the whole; else parts of one row.
std::vector<hsize_t> chunk_shape(std::span<const hsize_t> shape, std::size_t value_size) {
  std::vector<hsize_t> chunk(shape.size());
  hsize_t room = std::max<hsize_t>(1, chunk_bytes / value_size);
  for (std::size_t axis = shape.size(); axis-- > 0;) {
    chunk[axis] = std::min(shape[axis], room);
    room = std::max<hsize_t>(1, room / chunk[axis]);
  }
  return chunk;
}

/// Texts of exactly `size` bytes, padded with zero bytes.
Handle text_type(std::size_t size, H5T_cset_t characters) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  // HDF5 knows no text type of size 0.
  H5Tset_size(type.get(), std::max<std::size_t>(1, size));
  H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
  H5Tset_cset(type.get(), characters);
  return type;
}

/// Clears the status flags of a superblock (the file is not open for writing any more) and gives it its checksum:
/// Jenkins' lookup3 over the 44 bytes before it, for a superblock of version 2 with 8-byte addresses: "HDF5 File Format
/// Specification 3.0", sections II.A and III.A.
void close_superblock(std::array<char, 48>& image) {
  constexpr std::size_t flags = 11;
  constexpr std::size_t words = 11;
  image[flags] = 0;
  const auto word = [&](std::size_t i) {
    std::uint32_t value = 0;
    for (std::size_t k = 4; k-- > 0;) value = value << 8 | static_cast<unsigned char>(image[4 * i + k]);
    return value;
  };
  const auto finish = [](std::uint32_t& to, std::uint32_t from, int bits) { to = (to ^ from) - std::rotl(from, bits); };
  const auto mix = [](std::uint32_t& x, std::uint32_t& y, std::uint32_t z, int bits) {
    x = (x - y) ^ std::rotl(y, bits);
    y += z;
  };
  std::uint32_t a = 0xdeadbeefU + 4 * words;
  std::uint32_t b = a;
  std::uint32_t c = a;
  for (std::size_t i = 0; i + 3 <= words; i += 3) {
    a += word(i);
    b += word(i + 1);
    c += word(i + 2);
    mix(a, c, b, 4);
    mix(b, a, c, 6);
    mix(c, b, a, 8);
    mix(a, c, b, 16);
    mix(b, a, c, 19);
    mix(c, b, a, 4);
  }
  a += word(words - 2);
  b += word(words - 1);
  finish(c, b, 14);
  finish(a, c, 11);
  finish(b, a, 25);
  finish(c, b, 16);
  finish(a, c, 4);
  finish(b, a, 14);
  finish(c, b, 24);
  for (std::size_t k = 0; k < 4; ++k) image[4 * words + k] = static_cast<char>(c >> (8 * k) & 0xffU);
}

std::string without_padding(std::string_view text) {
  return std::string(text.substr(0, text.find_last_not_of('\0') + 1));
}

/// HDF5 1.10 frees parts of an attribute twice if memory ends within a call: there has to be enough before it.
/// @throws std::bad_alloc
void require_memory() {
  constexpr std::size_t enough = std::size_t{8} << 20;  // more than a call takes, its cache included
  ::operator delete(::operator new(enough));
}

}  // namespace

Hdf5File::Hdf5File(std::filesystem::path path) : path_(std::move(path)), disk_(path_) {
  require_memory();
  const QuietErrors quiet;
  const Handle creation = untimed(H5P_FILE_CREATE);
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_libver_bounds(access.get(), H5F_LIBVER_V18, H5F_LIBVER_V18);
  // Open objects are closed with the file.
  H5Pset_fclose_degree(access.get(), H5F_CLOSE_STRONG);
  // The name is nobody else's, and not every file system knows locks.
  H5Pset_file_locking(access.get(), /*use_file_locking=*/false, /*ignore_when_disabled=*/true);
  nowhere_ = FileDescriptor(::memfd_create("hdf5", MFD_CLOEXEC));
  if (!nowhere_.is_open()) throw_output_error(path_, "create the file", errno);
  // HDF5 does not survive a full disk while it creates a file: it must find room for its first block.
  disk_.write(std::string(4096, '\0'));
  file_ = checked<OutputError>(
      uninterrupted([&] { return H5Fcreate(disk_.temporary().c_str(), H5F_ACC_TRUNC, creation.get(), access.get()); }),
      path_, "the file", "create");
  set_attribute("/", "format_version", hdf5_format_version);
}

Hdf5File::~Hdf5File() { abandon(); }

/// Closes the file without further access to the disk: HDF5 writes the remaining data into memory that is discarded.
/// After a flush these data would only free spare room at the end of the file. After a failure there may be no room.
void Hdf5File::abandon() noexcept {
  if (file_ < 0) return;
  const QuietErrors quiet;
  void* handle = nullptr;
  if (H5Fget_vfd_handle(file_, H5P_DEFAULT, &handle) >= 0)
    ::dup3(nowhere_.get(), *static_cast<const int*>(handle), O_CLOEXEC);
  H5Fclose(std::exchange(file_, -1));
}

void Hdf5File::create_group(std::string_view path) {
  require_memory();
  const QuietErrors quiet;
  const Handle creation = untimed(H5P_GROUP_CREATE);
  // One by one: HDF5's own creation of intermediate groups would give them time stamps.
  for (std::size_t end = 0; end != path.size();) {
    end = std::min(path.find('/', end + 1), path.size());
    const std::string name(path.substr(0, end));
    if (name.empty() || name == "/") continue;
    if (checked<OutputError>(H5Lexists(file_, name.c_str(), H5P_DEFAULT), path_, name, "find") > 0) continue;
    const Handle group(checked<OutputError>(H5Gcreate2(file_, name.c_str(), H5P_DEFAULT, creation.get(), H5P_DEFAULT),
                                            path_, name, "create the group"),
                       H5Gclose);
  }
}

/// @param chunk   of compressed data; empty: all values in one block
/// @param cached  whether HDF5 may keep chunks that are whole
/// @returns an identifier that the caller closes
std::int64_t Hdf5File::create_dataset(std::string_view path, std::int64_t file_type, std::int64_t space,
                                      std::span<const unsigned long long> chunk, bool cached) {
  require_memory();
  const std::string name(path);
  if (const auto slash = path.rfind('/'); slash != std::string_view::npos && slash > 0) {
    create_group(path.substr(0, slash));
  }
  const Handle creation = untimed(H5P_DATASET_CREATE);
  const Handle access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
  if (!chunk.empty()) {
    checked<OutputError>(H5Pset_chunk(creation.get(), static_cast<int>(chunk.size()), chunk.data()), path_, name,
                         "chunk");
    checked<OutputError>(H5Pset_shuffle(creation.get()), path_, name, "shuffle");
    checked<OutputError>(H5Pset_deflate(creation.get(), deflate_level), path_, name, "compress");
    if (!cached)
      checked<OutputError>(H5Pset_chunk_cache(access.get(), 0, 0, H5D_CHUNK_CACHE_W0_DEFAULT), path_, name, "chunk");
  }
  return checked<OutputError>(
      H5Dcreate2(file_, name.c_str(), file_type, space, H5P_DEFAULT, creation.get(), access.get()), path_, name,
      "create the dataset");
}

/// @param space  of the dataset, in which rows become selected
void Hdf5File::write_block(std::int64_t dataset, std::string_view path, std::int64_t memory_type, std::int64_t space,
                           std::span<const unsigned long long> start, std::span<const unsigned long long> block,
                           const void* values) {
  checked<OutputError>(H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, block.data(), nullptr), path_,
                       path, "select rows of");
  const Handle memory(checked<OutputError>(H5Screate_simple(static_cast<int>(block.size()), block.data(), nullptr),
                                           path_, path, "shape"),
                      H5Sclose);
  checked<OutputError>(H5Dwrite(dataset, memory_type, memory.get(), space, H5P_DEFAULT, values), path_, path,
                       "write the dataset");
}

void Hdf5File::write_rows(std::string_view path, std::int64_t file_type, std::int64_t memory_type,
                          std::size_t value_size, std::span<const std::size_t> shape, const FillRows& fill) {
  const QuietErrors quiet;
  const std::vector<hsize_t> extent(shape.begin(), shape.end());
  std::size_t row_size = value_size;
  for (const std::size_t length : shape.subspan(1)) row_size *= length;

  const Handle space(checked<OutputError>(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr),
                                          path_, path, "shape"),
                     H5Sclose);
  std::vector<hsize_t> chunk;
  std::size_t rows_at_once = shape[0];
  if (shape[0] * row_size > compress_above) {
    chunk = chunk_shape(extent, value_size);
    // Whole chunks: each is compressed and written once.
    rows_at_once = static_cast<std::size_t>(chunk[0]);
  }
  const Handle dataset(create_dataset(path, file_type, space.get(), chunk, /*cached=*/true), H5Dclose);
  written_.push_back({std::string(path), {shape.begin(), shape.end()}});
  if (shape[0] * row_size == 0) return;
  std::vector<hsize_t> start(extent.size(), 0);
  std::vector<hsize_t> block(extent.begin(), extent.end());
  for (std::size_t row = 0; row < shape[0]; row += rows_at_once) {
    const std::size_t rows = std::min(rows_at_once, shape[0] - row);
    start[0] = row;
    block[0] = rows;
    write_block(dataset.get(), path, memory_type, space.get(), start, block, fill(row, rows));
  }
  // The destructor would do the same, but could not report a failure.
  checked<OutputError>(H5Dflush(dataset.get()), path_, path, "write the dataset");
}

void Hdf5File::write_columns(std::string_view group, std::span<const std::string> names, std::size_t rows,
                             const std::function<void(std::size_t, std::span<double>)>& row_values) {
  const QuietErrors quiet;
  create_group(group);
  if (names.empty()) return;
  const std::size_t together = std::max<std::size_t>(1, columns_bytes / (sizeof(double) * names.size()));
  std::vector<hsize_t> chunk;
  if (rows * sizeof(double) > compress_above) chunk = {std::min(rows, together)};
  const std::array<hsize_t, 1> extent{rows};
  const Handle space(checked<OutputError>(H5Screate_simple(1, extent.data(), nullptr), path_, group, "shape"),
                     H5Sclose);
  std::vector<std::string> paths;
  std::vector<Handle> datasets;
  for (const std::string& name : names) {
    paths.push_back(fmt::format("{}/{}", group, name));
    datasets.emplace_back(create_dataset(paths.back(), H5T_IEEE_F64LE, space.get(), chunk, /*cached=*/false), H5Dclose);
    written_.push_back({paths.back(), {rows}});
  }
  std::vector<double> row(names.size());
  std::vector<double> block(names.size() * std::min(rows, together));
  for (std::size_t first = 0; first < rows; first += together) {
    const std::size_t count = std::min(together, rows - first);
    for (std::size_t k = 0; k < count; ++k) {
      row_values(first + k, row);
      for (std::size_t j = 0; j < row.size(); ++j) block[j * count + k] = row[j];
    }
    for (std::size_t j = 0; j < row.size(); ++j)
      write_block(datasets[j].get(), paths[j], H5T_NATIVE_DOUBLE, space.get(), std::array<hsize_t, 1>{first},
                  std::array<hsize_t, 1>{count}, block.data() + j * count);
  }
  for (std::size_t j = 0; j < paths.size(); ++j)
    checked<OutputError>(H5Dflush(datasets[j].get()), path_, paths[j], "write the dataset");
}

/// Paths without the first slash.
void Hdf5File::write_list_of_columns() {
  std::vector<std::string> paths, units, meanings;
  for (const Written& dataset : written_) {
    if (dataset.units.empty() && dataset.meaning.empty()) continue;
    paths.push_back(dataset.path.substr(1));
    units.push_back(dataset.units);
    meanings.push_back(dataset.meaning);
  }
  if (paths.empty()) return;
  write("/columns/path", std::span<const std::string>(paths));
  write("/columns/units", std::span<const std::string>(units));
  write("/columns/meaning", std::span<const std::string>(meanings));
}

void Hdf5File::name_axes(std::string_view path, std::vector<std::string> names) {
  const auto found = std::ranges::find(written_, path, &Written::path);
  if (found == written_.end() || found->shape.size() != names.size())
    throw std::logic_error(fmt::format("Hdf5File: {} has no {} axes", path, names.size()));
  found->axes = std::move(names);
}

/// The dataset that is the scale of an axis, which is made if there is none.
std::size_t Hdf5File::scale_of(std::size_t dataset, std::size_t axis) {
  const std::string group = written_[dataset].path.substr(0, written_[dataset].path.rfind('/'));
  const std::size_t length = written_[dataset].shape[axis];
  const auto find = [&](const std::string& path) {
    return static_cast<std::size_t>(std::ranges::find(written_, path, &Written::path) - written_.begin());
  };
  const auto fits = [&](std::size_t k) { return written_[k].shape == std::vector{length}; };
  const std::vector<std::string>& names = written_[dataset].axes;
  const bool named = !names.empty();
  const std::string stem = named ? names[axis] : axis == 0 ? "row" : "column";
  if (named)
    for (std::string above = group; !above.empty(); above = above.substr(0, above.rfind('/')))
      if (const std::size_t k = find(fmt::format("{}/{}", above, stem)); k < written_.size() && fits(k)) return k;
  for (int number = 1;; ++number) {
    const std::string path =
        number == 1 ? fmt::format("{}/{}", group, stem) : fmt::format("{}/{}_{}", group, stem, number);
    const std::size_t k = find(path);
    if (k == written_.size()) {
      write(path, length, Column<std::int64_t>([](std::size_t row) { return static_cast<std::int64_t>(row); }));
      set_attribute(path, "units", "1");
      set_attribute(path, "meaning", "number along the axis, from 0");
    }
    if (fits(k)) return k;
  }
}

/// Attributes as H5DSset_scale and H5DSattach_scale write them, from the HDF5 Dimension Scale Specification, 2005; each
/// once, when all datasets are there.
void Hdf5File::write_scales() {
  const QuietErrors quiet;
  const std::size_t count = written_.size();
  std::vector<std::vector<std::size_t>> scales(count);  // of each dataset, one an axis
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t axis = 0; axis < written_[k].shape.size(); ++axis) scales[k].push_back(scale_of(k, axis));
  scales.resize(written_.size());
  struct Use {
    hobj_ref_t dataset;
    std::int32_t axis;
  };
  std::vector<std::vector<Use>> uses(written_.size());
  std::vector<bool> is_scale(written_.size(), false);
  for (const auto& of_dataset : scales)
    for (const std::size_t k : of_dataset) is_scale[k] = true;
  const auto reference = [&](std::size_t k) {
    hobj_ref_t result{};
    checked<OutputError>(H5Rcreate(&result, file_, written_[k].path.c_str(), H5R_OBJECT, -1), path_, written_[k].path,
                         "refer to");
    return result;
  };
  const Handle list_type(H5Tvlen_create(H5T_STD_REF_OBJ), H5Tclose);
  for (std::size_t k = 0; k < scales.size(); ++k) {
    if (is_scale[k] || scales[k].empty()) continue;  // a scale has no scale
    std::vector<hobj_ref_t> references;
    std::vector<hvl_t> lists;
    references.reserve(scales[k].size());
    for (std::size_t axis = 0; axis < scales[k].size(); ++axis) {
      references.push_back(reference(scales[k][axis]));
      lists.push_back({1, &references.back()});
      uses[scales[k][axis]].push_back({reference(k), static_cast<std::int32_t>(axis)});
    }
    write_attribute(written_[k].path, "DIMENSION_LIST", list_type.get(), list_type.get(), lists.data(), lists.size());
  }
  const Handle use_type(H5Tcreate(H5T_COMPOUND, sizeof(Use)), H5Tclose);
  H5Tinsert(use_type.get(), "dataset", offsetof(Use, dataset), H5T_STD_REF_OBJ);
  H5Tinsert(use_type.get(), "dimension", offsetof(Use, axis), H5T_NATIVE_INT32);
  const Handle use_file_type(H5Tcreate(H5T_COMPOUND, 12), H5Tclose);
  H5Tinsert(use_file_type.get(), "dataset", 0, H5T_STD_REF_OBJ);
  H5Tinsert(use_file_type.get(), "dimension", 8, H5T_STD_I32LE);
  for (std::size_t k = 0; k < written_.size(); ++k) {
    if (!is_scale[k]) continue;
    const std::string name = written_[k].path.substr(written_[k].path.rfind('/') + 1);
    for (const auto& [attribute, text] :
         {std::pair<const char*, std::string>("CLASS", "DIMENSION_SCALE"), {"NAME", name}}) {
      const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);  // ends with a zero byte, as the specification requires
      H5Tset_size(type.get(), text.size() + 1);
      write_attribute(written_[k].path, attribute, type.get(), type.get(), text.c_str());
    }
    if (!uses[k].empty())
      write_attribute(written_[k].path, "REFERENCE_LIST", use_file_type.get(), use_type.get(), uses[k].data(),
                      uses[k].size());
  }
}

void Hdf5File::write_values(std::string_view path, std::int64_t file_type, std::int64_t memory_type,
                            std::size_t value_size, const void* values, std::span<const std::size_t> shape) {
  std::size_t row_size = value_size;
  for (const std::size_t length : shape.subspan(1)) row_size *= length;
  write_rows(path, file_type, memory_type, value_size, shape, [&](std::size_t row, std::size_t /*rows*/) {
    return static_cast<const std::byte*>(values) + row * row_size;
  });
}

void Hdf5File::write(std::string_view path, std::size_t rows, const Column<double>& value) {
  const std::array shape{rows};
  std::vector<double> block;
  write_rows(path, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, sizeof(double), shape, [&](std::size_t row, std::size_t count) {
    block.resize(count);
    for (std::size_t k = 0; k < count; ++k) block[k] = value(row + k);
    return reinterpret_cast<const std::byte*>(block.data());
  });
}

void Hdf5File::write(std::string_view path, std::size_t rows, const Column<std::int64_t>& value) {
  const std::array shape{rows};
  std::vector<std::int64_t> block;
  write_rows(path, H5T_STD_I64LE, H5T_NATIVE_INT64, sizeof(std::int64_t), shape,
             [&](std::size_t row, std::size_t count) {
               block.resize(count);
               for (std::size_t k = 0; k < count; ++k) block[k] = value(row + k);
               return reinterpret_cast<const std::byte*>(block.data());
             });
}

void Hdf5File::write(std::string_view path, std::size_t rows, const Column<std::string>& value) {
  std::size_t size = 1;
  for (std::size_t row = 0; row < rows; ++row) size = std::max(size, value(row).size());
  // HDF5 converts no text marked as UTF-8 to one marked as ASCII, and Octave 7.3 gives up the whole file there.
  const Handle type = text_type(size, H5T_CSET_ASCII);
  const std::array shape{rows};
  std::string block;
  write_rows(path, type.get(), type.get(), size, shape, [&](std::size_t row, std::size_t count) {
    block.clear();
    for (std::size_t k = 0; k < count; ++k) {
      const std::string text = value(row + k);
      block.append(text).append(size - text.size(), '\0');
    }
    return reinterpret_cast<const std::byte*>(block.data());
  });
  set_attribute(path, "_Encoding", "utf-8");  // as netCDF has it
}

void Hdf5File::write(std::string_view path, std::size_t rows, std::size_t columns,
                     const std::function<void(std::size_t, std::span<double>)>& row_values) {
  const std::array shape{rows, columns};
  std::vector<double> block;
  write_rows(path, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, sizeof(double), shape, [&](std::size_t row, std::size_t count) {
    block.resize(count * columns);
    for (std::size_t k = 0; k < count; ++k) row_values(row + k, std::span(block).subspan(k * columns, columns));
    return reinterpret_cast<const std::byte*>(block.data());
  });
}

void Hdf5File::write(std::string_view path, std::span<const double> values) {
  const std::array shape{values.size()};
  write_values(path, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, sizeof(double), values.data(), shape);
}

void Hdf5File::write(std::string_view path, std::span<const std::int64_t> values) {
  const std::array shape{values.size()};
  write_values(path, H5T_STD_I64LE, H5T_NATIVE_INT64, sizeof(std::int64_t), values.data(), shape);
}

void Hdf5File::write(std::string_view path, std::span<const std::string> values) {
  write(path, values.size(), Column<std::string>([&](std::size_t row) { return values[row]; }));
}

void Hdf5File::write(std::string_view path, std::span<const double> values, std::size_t rows, std::size_t columns) {
  if (values.size() != rows * columns) throw std::invalid_argument(fmt::format("{}: not rows x columns values", path));
  const std::array shape{rows, columns};
  write_values(path, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, sizeof(double), values.data(), shape);
}

void Hdf5File::write(std::string_view path, std::span<const std::int64_t> values, std::size_t rows,
                     std::size_t columns) {
  if (values.size() != rows * columns) throw std::invalid_argument(fmt::format("{}: not rows x columns values", path));
  const std::array shape{rows, columns};
  write_values(path, H5T_STD_I64LE, H5T_NATIVE_INT64, sizeof(std::int64_t), values.data(), shape);
}

void Hdf5File::write_attribute(std::string_view object, std::string_view name, std::int64_t file_type,
                               std::int64_t memory_type, const void* value, std::size_t count) {
  require_memory();
  const QuietErrors quiet;
  const std::string label = fmt::format("the attribute {} of {}", name, object);
  const hsize_t extent = count;
  const Handle space(count > 0 ? H5Screate_simple(1, &extent, nullptr) : H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(
      checked<OutputError>(H5Acreate_by_name(file_, std::string(object).c_str(), std::string(name).c_str(), file_type,
                                             space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                           path_, label, "create"),
      H5Aclose);
  checked<OutputError>(H5Awrite(attribute.get(), memory_type, value), path_, label, "write");
}

void Hdf5File::set_attribute(std::string_view object, std::string_view name, std::string_view value) {
  const bool ascii = std::ranges::all_of(value, [](char c) { return static_cast<unsigned char>(c) < 0x80U; });
  const Handle type = text_type(value.size(), ascii ? H5T_CSET_ASCII : H5T_CSET_UTF8);
  // A copy, because an empty view need not point anywhere, while HDF5 reads at least one byte.
  const std::string text(value);
  write_attribute(object, name, type.get(), type.get(), text.c_str());
  if (name != "units" && name != "meaning") return;
  const auto found = std::ranges::find(written_, object, &Written::path);
  if (found != written_.end()) (name == "units" ? found->units : found->meaning) = text;
}

void Hdf5File::set_attribute(std::string_view object, std::string_view name, double value) {
  write_attribute(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value);
}

void Hdf5File::set_attribute(std::string_view object, std::string_view name, std::int64_t value) {
  write_attribute(object, name, H5T_STD_I64LE, H5T_NATIVE_INT64, &value);
}

void Hdf5File::close() {
  const QuietErrors quiet;
  if (file_ < 0) throw std::logic_error("Hdf5File: close after close");
  write_list_of_columns();
  write_scales();
  checked<OutputError>(H5Fflush(file_, H5F_SCOPE_GLOBAL), path_, "the file", "finish");
  abandon();
  const FileDescriptor file = open_descriptor(disk_.temporary(), O_RDWR);
  if (!file.is_open()) throw_output_error(path_, "open the file", errno);
  std::array<char, 48> superblock{};
  if (read_at(file.get(), path_, 0, superblock.data(), superblock.size()) != superblock.size())
    throw_output_error(path_, "read back its beginning", EIO);
  close_superblock(superblock);
  write_at(file.get(), {superblock.data(), superblock.size()}, 0, path_);
  disk_.commit();
}

namespace {

Handle open_for_reading(const std::filesystem::path& file) {
  return {checked<InputError>(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), file, "the file", "open"), H5Fclose};
}

Handle open_dataset(const std::filesystem::path& file, hid_t handle, const std::string& name) {
  return {checked<InputError>(H5Dopen2(handle, name.c_str(), H5P_DEFAULT), file, name, "open the dataset"), H5Dclose};
}

std::vector<std::size_t> shape_of(hid_t dataset) {
  const Handle space(H5Dget_space(dataset), H5Sclose);
  std::vector<hsize_t> extent(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space.get()))));
  H5Sget_simple_extent_dims(space.get(), extent.data(), nullptr);
  return {extent.begin(), extent.end()};
}

std::size_t count_of(std::span<const std::size_t> shape) {
  std::size_t count = 1;
  for (const std::size_t length : shape) count *= length;
  return count;
}

/// Size of a text of the type; 0 if it is not one of texts of fixed length.
std::size_t fixed_text_size(hid_t type) {
  return H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0 ? H5Tget_size(type) : 0;
}

}  // namespace

Hdf5Dataset read_hdf5(const std::filesystem::path& file, std::string_view dataset) {
  const QuietErrors quiet;
  const std::string name(dataset);
  const Handle opened = open_for_reading(file);
  const Handle data = open_dataset(file, opened.get(), name);
  Hdf5Dataset result;
  result.shape = shape_of(data.get());
  result.values.resize(count_of(result.shape));
  checked<InputError>(H5Dread(data.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, result.values.data()), file,
                      name, "read the dataset");
  return result;
}

std::vector<std::string> read_hdf5_texts(const std::filesystem::path& file, std::string_view dataset) {
  const QuietErrors quiet;
  const std::string name(dataset);
  const Handle opened = open_for_reading(file);
  const Handle data = open_dataset(file, opened.get(), name);
  const Handle type(H5Dget_type(data.get()), H5Tclose);
  const std::size_t size = fixed_text_size(type.get());
  if (size == 0) throw InputError(fmt::format("{}: {} does not hold texts of fixed length", file.string(), name));
  const std::size_t count = count_of(shape_of(data.get()));
  std::string bytes(size * count, '\0');
  checked<InputError>(H5Dread(data.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()), file, name,
                      "read the dataset");
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < count; ++i) {
    texts.push_back(without_padding(std::string_view(bytes).substr(i * size, size)));
  }
  return texts;
}

std::string read_hdf5_attribute(const std::filesystem::path& file, std::string_view object, std::string_view name) {
  const QuietErrors quiet;
  const std::string label = fmt::format("the attribute {} of {}", name, object);
  const Handle opened = open_for_reading(file);
  const Handle attribute(checked<InputError>(H5Aopen_by_name(opened.get(), std::string(object).c_str(),
                                                             std::string(name).c_str(), H5P_DEFAULT, H5P_DEFAULT),
                                             file, label, "open"),
                         H5Aclose);
  const Handle type(H5Aget_type(attribute.get()), H5Tclose);
  const std::size_t size = fixed_text_size(type.get());
  if (size == 0) throw InputError(fmt::format("{}: {} is not a text of fixed length", file.string(), label));
  std::string text(size, '\0');
  checked<InputError>(H5Aread(attribute.get(), type.get(), text.data()), file, label, "read");
  return without_padding(text);
}

}  // namespace epicyclic::store
