// The journal and its records: good records before the first damage are read as they were written, a torn tail is cut,
// damage before good records is refused, and what decodes encodes to itself.
//
// An input is a sequence of pieces: kind, point, length of two bytes, bytes. CRCs are made here, since no mutation
// would: kinds are good records, bytes as they are, a record cut short, and one with a flipped bit. A first byte says
// whether the header is good; else the input is the file.

#include "store/journal.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz.hpp"
#include "store/point_record.hpp"

namespace epicyclic::fuzz {
namespace {

using fuzz::require;
namespace fs = std::filesystem;

const fuzz::Folder& folder() {
  static const fuzz::Folder the_folder;
  return the_folder;
}

const std::string& identity() {
  static const std::string digits(64, 'a');
  return digits;
}

std::string contents(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::span<const std::byte> bytes_of(std::string_view text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

/// As the journal itself writes them.
const std::string& header() {
  static const std::string bytes = [] {
    const fs::path file = folder() / "header";
    store::Journal(file, identity()).close();
    return contents(file);
  }();
  return bytes;
}

std::uint32_t crc_of(std::string_view bytes) {
  std::uint32_t crc = 0xffffffffU;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int k = 0; k < 8; ++k) crc = (crc >> 1) ^ ((crc & 1U) != 0 ? 0xedb88320U : 0U);
  }
  return ~crc;
}

void put(std::string& bytes, std::uint64_t value, int size) {
  for (int i = 0; i < size; ++i) bytes += static_cast<char>((value >> (8 * i)) & 0xffU);
}

std::string record(std::uint64_t point, std::string_view payload) {
  std::string bytes = "EPJR";
  put(bytes, payload.size(), 4);
  put(bytes, point, 8);
  bytes += payload;
  put(bytes, crc_of(bytes), 4);
  return bytes;
}

template <class Decode, class Encode>
void look_at_record(std::span<const std::byte> payload, Decode decode, Encode encode) {
  try {
    const auto once = encode(decode(payload));
    require(encode(decode(std::span<const std::byte>(once))) == once, "a record encodes to itself");
  } catch (const store::DamagedData&) {
  }
}

void look_at_payload(std::span<const std::byte> payload) {
  look_at_record(payload, store::decode_point, store::encode_point);
  look_at_record(payload, store::decode_tolerance_point, store::encode_tolerance_point);
  for (const std::size_t most : {payload.size(), payload.size() / 2, payload.size() / 3}) try {
      (void)store::decode_point_beginning(payload.first(most));
    } catch (const store::DamagedData&) {
    }
}

struct Good {
  std::uint64_t point;
  std::string payload;
};

bool same(const store::Journal& journal, const std::vector<Good>& good) {
  if (journal.entries().size() != good.size()) return false;
  for (std::size_t k = 0; k < good.size(); ++k) {
    const store::JournalEntry& entry = journal.entries()[k];
    const auto payload = journal.read(entry);
    const auto expected = bytes_of(good[k].payload);
    if (entry.point != good[k].point || !std::equal(payload.begin(), payload.end(), expected.begin(), expected.end()))
      return false;
    const auto beginning = journal.read_beginning(entry, 8);
    if (!std::equal(beginning.begin(), beginning.end(), payload.begin())) return false;
  }
  return true;
}

/// What a reader of its own finds: the records before the first damage, and whether there is one behind it.
struct Expected {
  std::vector<Good> good;
  bool good_after = false;
};

std::optional<Good> record_at(std::string_view file) {
  constexpr std::size_t head = 16;
  if (file.size() < head + 4 || !file.starts_with("EPJR")) return std::nullopt;
  const auto number = [&](std::size_t at, std::size_t size) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i) value |= std::uint64_t{static_cast<unsigned char>(file[at + i])} << (8 * i);
    return value;
  };
  const std::uint64_t length = number(4, 4);
  if (length > file.size() - head - 4 || number(head + length, 4) != crc_of(file.substr(0, head + length)))
    return std::nullopt;
  return Good{number(8, 8), std::string(file.substr(head, length))};
}

Expected expected_of(std::string_view records) {
  Expected expected;
  while (const auto good = record_at(records)) {
    expected.good.push_back(*good);
    records.remove_prefix(20 + good->payload.size());
  }
  for (; !records.empty() && !expected.good_after; records.remove_prefix(1))
    expected.good_after = record_at(records).has_value();
  return expected;
}

void look_at_pieces(std::string_view data) {
  std::string file = header();
  constexpr std::size_t head = 4;
  while (data.size() >= head) {
    const int kind = static_cast<unsigned char>(data[0]) % 8;
    const auto point = static_cast<std::uint64_t>(static_cast<unsigned char>(data[1]));
    const std::size_t length = static_cast<unsigned char>(data[2]) + 256U * static_cast<unsigned char>(data[3]);
    const std::string payload(data.substr(head, length));
    data.remove_prefix(head + payload.size());
    std::string piece = record(point, payload);
    if (kind == 5) piece = payload;
    if (kind == 6) piece.resize(piece.size() - 1 - point % piece.size());
    if (kind == 7) piece[point % piece.size()] = static_cast<char>(piece[point % piece.size()] ^ 4);
    file += piece;
  }
  auto [good, good_after] = expected_of(std::string_view(file).substr(header().size()));
  const fs::path path = folder() / "journal.bin";
  fuzz::put_file(path, file);
  bool refused = false;
  try {
    const store::Journal journal(path, identity(), store::Journal::Use::read);
    require(same(journal, good), "good records are read as they were written");
    for (const store::JournalEntry& entry : journal.entries()) look_at_payload(journal.read(entry));
  } catch (const store::DamagedData&) {
    refused = true;
  }
  require(contents(path) == file, "reading changes nothing");
  require(refused == good_after, "damage before good records is refused, nothing else is");
  std::size_t size = file.size();
  try {
    store::Journal journal(path, identity());
    require(!refused, "what cannot be read cannot be appended to");
    size -= journal.cut_bytes();
    require(same(journal, good), "a cut journal has its good records");
  } catch (const store::DamagedData&) {
    require(refused, "what can be read can be appended to");
  }
  require(contents(path) == file.substr(0, size), "only the tail is cut");
  if (refused) return;
  // Once in a while, since it flushes.
  if (file.size() % 16 != 0) return;
  good.push_back({7, "appended"});
  {
    store::Journal journal(path, identity());
    require(journal.cut_bytes() == 0, "what was cut is whole");
    const store::JournalEntry entry = journal.append(good.back().point, bytes_of(good.back().payload));
    const auto payload = journal.read(entry);
    require(std::equal(payload.begin(), payload.end(), bytes_of(good.back().payload).begin()), "it is there at once");
    journal.close();
  }
  require(same(store::Journal(path, identity(), store::Journal::Use::read), good),
          "what is appended stands behind the good records");
}

/// Whatever the file holds, it is a journal or refused.
void look_at_file(std::string_view bytes) {
  const fs::path path = folder() / "file.bin";
  fuzz::put_file(path, bytes);
  try {
    const store::Journal journal(path, identity(), store::Journal::Use::read);
    for (const store::JournalEntry& entry : journal.entries()) look_at_payload(journal.read(entry));
  } catch (const store::DamagedData&) {
  }
  look_at_payload(bytes_of(bytes));
}

}  // namespace
}  // namespace epicyclic::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(data, data + size);
  if (bytes.empty()) return 0;
  const std::string_view rest = std::string_view(bytes).substr(1);
  if (bytes[0] == 'f')
    epicyclic::fuzz::look_at_file(rest);
  else
    epicyclic::fuzz::look_at_pieces(rest);
  return 0;
}
