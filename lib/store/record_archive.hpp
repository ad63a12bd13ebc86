// Records of the journal as bytes and back: pass(archive, value), one description of a record for both directions.
//
// Numbers one after another in native byte order: a journal is read on the machine that wrote it. A list is its length
// (u64) and its elements. A user-defined type passes by a pass() in this namespace, so that the lists of this file find
// it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "store/journal.hpp"

namespace epicyclic::store::archive {

/// Encodes the values that pass.
class Encoder {
 public:
  template <class T>
  void bytes_of(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto* bytes = reinterpret_cast<const std::byte*>(&value);
    bytes_.insert(bytes_.end(), bytes, bytes + sizeof value);
  }
  template <class List>
  void size_of(List& list, std::size_t /*least_bytes*/) {
    auto size = static_cast<std::uint64_t>(list.size());
    bytes_of(size);
  }
  void require(bool /*holds*/, const char* /*what*/) {}
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

/// Decodes the bytes of a record.
class Decoder {
 public:
  explicit Decoder(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <class T>
  void bytes_of(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    require(sizeof(T) <= bytes_.size() - at_, "is shorter than its contents");
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
  }
  /// @param least_bytes  of an element: no memory is requested that the record cannot fill
  template <class List>
  void size_of(List& list, std::size_t least_bytes) {
    std::uint64_t size = 0;
    bytes_of(size);
    require(size <= (bytes_.size() - at_) / least_bytes, "is shorter than its contents");
    list.resize(static_cast<std::size_t>(size));
  }
  void require(bool holds, const char* what) {
    if (!holds) throw DamagedData(std::string("a journal record ").append(what));
  }
  void finish() { require(at_ == bytes_.size(), "is longer than its contents"); }

 private:
  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
};

/// A number stored with another type than in memory, so that the record does not depend on the platform's widths.
template <class Wire, class A, class T>
void pass_as(A& a, T& value) {
  auto wire = static_cast<Wire>(value);
  a.bytes_of(wire);
  value = static_cast<T>(wire);
}

template <class A>
void pass(A& a, double& x) {
  a.bytes_of(x);
}
template <class A>
void pass(A& a, int& x) {
  pass_as<std::int32_t>(a, x);
}
template <class A>
void pass(A& a, long& x) {
  pass_as<std::int64_t>(a, x);
}
template <class A>
void pass(A& a, std::size_t& x) {
  pass_as<std::uint64_t>(a, x);
}
template <class A>
void pass(A& a, bool& x) {
  pass_as<std::uint8_t>(a, x);
}

template <class A, class E>
void pass_enum(A& a, E& value, E last) {
  auto wire = static_cast<std::uint8_t>(value);
  a.bytes_of(wire);
  a.require(wire <= static_cast<std::uint8_t>(last), "names a direction, an outcome or a regime that does not exist");
  value = static_cast<E>(wire);
}
template <class A>
void pass(A& a, std::string& text) {
  a.size_of(text, 1);
  for (char& c : text) a.bytes_of(c);
}

template <class A, class T, std::size_t n>
void pass(A& a, std::array<T, n>& values) {
  for (T& v : values) pass(a, v);
}

template <class A, class... T>
void pass_all(A& a, T&... values) {
  (pass(a, values), ...);
}

/// Elements take eight bytes at least.
template <class A, class T>
void pass(A& a, std::vector<T>& values) {
  a.size_of(values, sizeof(double));
  for (T& v : values) pass(a, v);
}

template <class T>
std::vector<std::byte> encode(T value) {
  Encoder e;
  pass(e, value);
  return e.take();
}

template <class T>
T decode(std::span<const std::byte> record) {
  Decoder d(record);
  T value;
  pass(d, value);
  d.finish();
  return value;
}

}  // namespace epicyclic::store::archive
