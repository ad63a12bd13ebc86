// One table per type of JSON object: it checks and reads the object, writes it back with all defaults, and states its
// JSON Schema. A key, its unit, bounds and meaning are written once, in the table; its default once, on the member.
//
//   Table<Planet> table("planet", "A planet.");
//   table.number("mass_kg", &Planet::mass_kg, above(0), "Mass.").required();
//   Planet planet;
//   table.read(json, "/planet", planet, findings);     // all errors, at once
//   table.write(planet);                               // every key, defaults included
//   table.schema();                                    // draft 2020-12
//
// A field joins access to the member (Access) and reading and writing of its type (Format), which are compiled apart.
// Table alone knows and checks the types. Below it, in AnyTable, objects and members are passed by their addresses, so
// that the code of a table is compiled once and not for each of 400 keys. A member is named by a pointer to it or by a
// generic lambda [](auto& t) -> auto& {...}; within(a, b) names a member of an optional one. Members that are
// std::optional are keys without a default: they are not written if not set. Every object also takes "origin" (the
// sources of its values) and "note"; see study_input.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "input/json_source.hpp"

namespace epicyclic::input {

/// An error in a JSON value; the caller adds its place in a file.
struct Finding {
  enum class Kind { unknown_key, missing_key, type, range, rule };
  Kind kind = Kind::rule;
  std::string pointer;
  std::string message;
  std::string meant;  ///< unknown_key: pointer of the key that was probably meant, if any
};

/// A key of a table and where it stands.
struct KeyPlace {
  std::string key;
  std::string pointer;
};

/// The findings of a reader, and the objects in which it searches keys that stand elsewhere.
struct ReadContext {
  std::vector<Finding> findings;
  std::vector<KeyPlace> places;
  std::vector<std::string> notes;  ///< unexpected, but no errors

  void add(Finding::Kind kind, const std::string& pointer, std::string message) {
    findings.push_back({kind, pointer, std::move(message), {}});
  }
};

/// An interval of numbers.
struct Bounds {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool min_excluded = false;
  bool max_excluded = false;

  [[nodiscard]] bool contains(double value) const;
  [[nodiscard]] std::string text() const;  ///< "> 0 and <= 100"; "finite" without bounds
  void describe(nlohmann::ordered_json& schema) const;
};

[[nodiscard]] inline Bounds at_least(double min) { return {min}; }
[[nodiscard]] inline Bounds above(double min) { return {min, std::numeric_limits<double>::infinity(), true, false}; }
[[nodiscard]] inline Bounds between(double min, double max) { return {min, max}; }
[[nodiscard]] inline Bounds above_up_to(double min, double max) { return {min, max, true, false}; }
[[nodiscard]] inline Bounds from_below(double min, double max) { return {min, max, false, true}; }

/// Enumerators by their names.
template <class E, class Names>
[[nodiscard]] std::vector<std::pair<std::string, E>> named(const Names& names) {
  std::vector<std::pair<std::string, E>> all;
  for (const auto& [name, value] : names) all.emplace_back(std::string(name), value);
  return all;
}

/// A rule on which keys of an object may or must stand together.
struct KeyRule {
  enum class Kind {
    exactly_one,  ///< of the keys
    at_most_one,  ///< of the keys
    together,     ///< all of the keys or none
    needs,        ///< the first needs the second
    not_empty,    ///< one at least: an empty object has no meaning
  };
  Kind kind;
  std::vector<std::string> keys;
};

/// The shortest text that reads back as the same number.
[[nodiscard]] std::string number_text(double value);

/// "the string \"abc\"", "an object", ...: the description of a value in messages.
[[nodiscard]] std::string described(const nlohmann::json& value);

/// Key of a study or stage by which editors find the schema.
inline constexpr const char* schema_key = "$schema";

/// The unit in a key's ending: "kg" for mass_kg, "N/m" for support_N_per_m; empty if there is none.
[[nodiscard]] std::string unit_of(std::string_view key);

/// The candidate nearest to `word` by edit distance, or empty if none is near.
[[nodiscard]] std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

/// Findings up to this number have a suggestion each. Beyond it, the message alone suffices.
inline constexpr std::size_t findings_max = 200;

/// "; did you mean 'x'?", or nothing.
[[nodiscard]] std::string suggestion(std::string_view word, const std::vector<std::string>& candidates);

/// Names in a row: "a, b, c".
[[nodiscard]] std::string listed(const std::vector<std::string>& names);

namespace table_detail {

using nlohmann::json;
using nlohmann::ordered_json;

template <class V>
struct Plain {
  using type = V;
  static constexpr bool is_optional = false;
};
template <class V>
struct Plain<std::optional<V>> {
  using type = V;
  static constexpr bool is_optional = true;
};

/// Is it a list of at most so many objects? Reports it if not.
bool check_list(const json& value, const std::string& pointer, std::size_t most, ReadContext& context);

/// A function from address to address, with what it captures. std::function takes any signature and any capture, and a
/// compiler several times as long for each of 300 members.
template <class Void>
class Reach {
 public:
  template <class F>
  Reach(Void* (*call)(const void* captured, Void* object), const F& captured) : call_(call) {
    static_assert(std::is_trivially_copyable_v<F> && sizeof(F) <= room && alignof(F) <= alignof(void*));
    std::memcpy(captured_.data(), &captured, sizeof(F));
  }

  Void* operator()(Void* object) const { return call_(captured_.data(), object); }

 private:
  static constexpr std::size_t room = 32;
  Void* (*call_)(const void*, Void*);
  alignas(void*) std::array<std::byte, room> captured_{};
};

/// Reaches a member of an object, by their addresses: to write (making what is absent) and to read (null if absent).
struct AnyAccess {
  Reach<void> make;
  Reach<const void> find;
};

/// The same of a member V of a T.
template <class T, class V>
struct Access : AnyAccess {
  /// From [](T&) -> V& and [](const T&) -> const V*.
  template <class Make, class Find>
  Access(Make make_member, Find find_member)
      : AnyAccess{{[](const void* f, void* t) -> void* { return &(*static_cast<const Make*>(f))(*static_cast<T*>(t)); },
                   make_member},
                  {[](const void* f, const void* t) -> const void* {
                     return (*static_cast<const Find*>(f))(*static_cast<const T*>(t));
                   },
                   find_member}} {}

  /// From a member's pointer or [](auto& t) -> auto&.
  template <class F>
  explicit Access(F member)
      : AnyAccess{{[](const void* f, void* t) -> void* { return &of(*static_cast<const F*>(f), *static_cast<T*>(t)); },
                   member},
                  {[](const void* f, const void* t) -> const void* {
                     return &of(*static_cast<const F*>(f), *static_cast<const T*>(t));
                   },
                   member}} {}

 private:
  template <class F, class Object>
  static auto& of(const F& member, Object& object) {
    if constexpr (std::is_member_object_pointer_v<F>) {
      return object.*member;
    } else {
      return member(object);
    }
  }
};

template <class T, class F>
auto access(F member) {
  if constexpr (std::derived_from<F, AnyAccess>) {
    return member;
  } else {
    return Access<T, std::remove_reference_t<std::invoke_result_t<F, T&>>>(member);
  }
}

/// V of an Access<T, V>, without std::optional.
template <class T, class V>
typename Plain<V>::type plain_member(const Access<T, V>& at);

// Parts that do not depend on the type that is read.
void check_note(const json& object, const std::string& pointer, ReadContext& context);
bool check_object(const json& value, const std::string& pointer, ReadContext& context);
void check_keys(const json& object, const std::string& pointer, const std::vector<std::string>& known,
                const std::vector<KeyRule>& rules, ReadContext& context);
std::optional<double> read_number(const json& value, const std::string& pointer, std::string_view key,
                                  const Bounds& bounds, ReadContext& context, std::string_view also = {});
std::optional<double> read_integer(const json& value, const std::string& pointer, const Bounds& bounds,
                                   ReadContext& context);
std::optional<std::vector<double>> read_numbers(const json& value, const std::string& pointer, std::string_view key,
                                                const Bounds& bounds, std::size_t size_min, std::size_t size_max,
                                                ReadContext& context);
std::optional<std::size_t> read_name(const json& value, const std::string& pointer,
                                     const std::vector<std::string>& names, ReadContext& context);
ordered_json number_schema(const Bounds& bounds, bool integer = false);
ordered_json numbers_schema(const Bounds& bounds, std::size_t size_min, std::size_t size_max);
ordered_json object_schema(const std::string& title, const std::string& description, const ordered_json& properties,
                           const std::vector<std::string>& required, const std::vector<KeyRule>& rules);

/// How a value is read, written and described, whatever object it is a member of.
template <class V>
struct Format {
  std::function<std::optional<V>(const json&, const std::string& pointer, ReadContext&)> read;
  std::function<json(const V&)> write = [](const V& value) { return json(value); };  ///< null: the key is left out
  std::function<ordered_json()> schema;
};

/// The same of a member by its address.
struct AnyFormat {
  std::function<void(const json&, const std::string& pointer, const AnyAccess& at, void* object, ReadContext&)> read;
  std::function<json(const void* member)> write;
  std::function<ordered_json()> schema;
};

/// Of a member M, which is a V or an optional one. It is created only if a good value is read into it.
template <class M, class V>
AnyFormat any_format(Format<V> format) {
  AnyFormat any;
  any.read = [read = std::move(format.read)](const json& value, const std::string& pointer, const AnyAccess& at,
                                             void* object, ReadContext& context) {
    if (auto good = read(value, pointer, context)) *static_cast<M*>(at.make(object)) = std::move(*good);
  };
  any.write = [write = std::move(format.write)](const void* found) {
    const M& member = *static_cast<const M*>(found);
    if constexpr (Plain<M>::is_optional) {
      return member.has_value() ? write(*member) : json();
    } else {
      return write(member);
    }
  };
  any.schema = std::move(format.schema);
  return any;
}

/// A list of objects by its address.
struct AnyList {
  std::function<void(void*)> clear;
  std::function<void*(void*)> append;  ///< one more, made by default
  std::function<std::size_t(const void*)> size;
  std::function<const void*(const void*, std::size_t)> element;
};

template <class U>
AnyList any_list() {
  using List = std::vector<U>;
  return {[](void* list) { static_cast<List*>(list)->clear(); },
          [](void* list) -> void* { return &static_cast<List*>(list)->emplace_back(); },
          [](const void* list) { return static_cast<const List*>(list)->size(); },
          [](const void* list, std::size_t k) -> const void* { return &(*static_cast<const List*>(list))[k]; }};
}

Format<double> number_format(std::string_view key, const Bounds& bounds);
Format<double> number_or_rigid_format(std::string_view key, const Bounds& bounds);
/// 0 stands for "auto".
Format<int> integer_or_auto_format(const Bounds& bounds);
Format<bool> boolean_format();
Format<std::string> text_format();
Format<std::vector<std::string>> texts_format(std::size_t size_max);
Format<std::vector<double>> numbers_format(std::string_view key, const Bounds& bounds, std::size_t size_min,
                                           std::size_t size_max);
Format<std::vector<double>> number_or_numbers_format(std::string_view key, const Bounds& bounds, std::size_t size_max);
/// Of a class that is made of one number or several, values(), as gear::PerPlanet is.
template <class V>
Format<V> values_format(Format<std::vector<double>> numbers) {
  return {
      [read = numbers.read](const json& value, const std::string& pointer, ReadContext& context) -> std::optional<V> {
        if (auto read_numbers = read(value, pointer, context)) return V(std::move(*read_numbers));
        return std::nullopt;
      },
      [write = numbers.write](const V& value) { return write(value.values()); }, numbers.schema};
}
/// The same, or "rigid" in place of one number.
template <class V>
Format<V> values_or_rigid_format(std::string_view key, const Bounds& bounds, std::size_t size_max) {
  const Format<double> rigid = number_or_rigid_format(key, bounds);
  const Format<V> numbers = values_format<V>(number_or_numbers_format(key, bounds, size_max));
  return {[rigid, numbers](const json& value, const std::string& pointer, ReadContext& context) -> std::optional<V> {
            if (value.is_array()) return numbers.read(value, pointer, context);
            if (const auto one = rigid.read(value, pointer, context)) return V(*one);
            return std::nullopt;
          },
          [rigid, numbers](const V& value) {
            return value.values().size() == 1 ? rigid.write(value.values()[0]) : numbers.write(value);
          },
          [rigid, bounds, size_max] {
            ordered_json schema = rigid.schema();
            schema["anyOf"].push_back(numbers_schema(bounds, 1, size_max));
            return schema;
          }};
}
/// Of places in a list of names.
Format<std::size_t> name_format(const std::vector<std::string>& names);
Format<std::vector<std::size_t>> names_format(const std::vector<std::string>& names);

template <class I>
Format<I> integer_format(const Bounds& bounds) {
  Format<I> format;
  format.read = [bounds](const json& value, const std::string& pointer, ReadContext& context) -> std::optional<I> {
    const auto number = read_integer(value, pointer, bounds, context);
    if (!number || !bounds.contains(*number)) return std::nullopt;
    return static_cast<I>(*number);
  };
  format.schema = [bounds] { return number_schema(bounds, true); };
  return format;
}

/// The place of a value in a list of pairs with names.
template <class E>
std::size_t place_in(const std::vector<std::pair<std::string, E>>& choices, const E& chosen) {
  const auto found = std::find_if(choices.begin(), choices.end(), [&](const auto& c) { return c.second == chosen; });
  return static_cast<std::size_t>(found - choices.begin());
}

template <class E>
std::vector<std::string> names_of(const std::vector<std::pair<std::string, E>>& choices) {
  std::vector<std::string> names;
  for (const auto& choice : choices) names.push_back(choice.first);
  return names;
}

template <class E>
Format<E> choice_format(const std::vector<std::pair<std::string, E>>& choices) {
  const Format<std::size_t> name = name_format(names_of(choices));
  Format<E> format;
  format.read = [=](const json& value, const std::string& pointer, ReadContext& context) -> std::optional<E> {
    const auto place = name.read(value, pointer, context);
    if (!place) return std::nullopt;
    return choices[*place].second;
  };
  format.write = [=](const E& chosen) { return name.write(place_in(choices, chosen)); };
  format.schema = name.schema;
  return format;
}

template <class E>
Format<std::vector<E>> choices_format(const std::vector<std::pair<std::string, E>>& choices) {
  const Format<std::vector<std::size_t>> names = names_format(names_of(choices));
  Format<std::vector<E>> format;
  format.read = [=](const json& value, const std::string& pointer,
                    ReadContext& context) -> std::optional<std::vector<E>> {
    const auto places = names.read(value, pointer, context);
    if (!places) return std::nullopt;
    std::vector<E> chosen;
    for (const std::size_t place : *places) chosen.push_back(choices[place].second);
    return chosen;
  };
  format.write = [=](const std::vector<E>& chosen) {
    std::vector<std::size_t> places;
    for (const E& one : chosen) places.push_back(place_in(choices, one));
    return names.write(places);
  };
  format.schema = names.schema;
  return format;
}

}  // namespace table_detail

/// The member `inner` of the optional member `outer`: reading a key makes the outer one.
template <class T, class U, class V>
auto within(std::optional<U> T::*outer, V U::*inner) {
  return table_detail::Access<T, V>{[=](T& t) -> V& {
                                      auto& holder = t.*outer;
                                      if (!holder) holder.emplace();
                                      return (*holder).*inner;
                                    },
                                    [=](const T& t) -> const V* {
                                      const auto& holder = t.*outer;
                                      return holder ? &((*holder).*inner) : nullptr;
                                    }};
}

/// The value of an optional member: reading it makes one.
template <class T, class U>
auto present(std::optional<U> T::*member) {
  return table_detail::Access<T, U>{[=](T& t) -> U& {
                                      auto& holder = t.*member;
                                      if (!holder) holder.emplace();
                                      return *holder;
                                    },
                                    [=](const T& t) -> const U* {
                                      const auto& holder = t.*member;
                                      return holder ? &*holder : nullptr;
                                    }};
}

/// The properties of a key that do not depend on the type of its object.
struct FieldWords {
  std::string key;
  std::string description;
  std::function<nlohmann::ordered_json()> schema;
  std::function<void(const std::string& pointer, std::vector<KeyPlace>&)> collect;  ///< keys of an object; may be empty
};

/// A key of an object of type T that reads and writes itself: for Table::custom.
template <class T>
struct Field : FieldWords {
  std::function<void(const nlohmann::json&, const std::string& pointer, T&, ReadContext&)> read;
  std::function<nlohmann::json(const T&)> write;  ///< null: the key is left out
  /// Of an object: Table::change. Empty: the field is a leaf.
  std::function<bool(std::string_view rest, double value, const std::string& pointer, T&, ReadContext&)> change;
};

/// A key of any object: the same by its address.
struct AnyField : FieldWords {
  bool is_required = false;
  std::function<void(const nlohmann::json&, const std::string& pointer, void* object, ReadContext&)> read;
  std::function<nlohmann::json(const void* object)> write;
  std::function<bool(std::string_view rest, double value, const std::string& pointer, void* object, ReadContext&)>
      change;

  std::function<bool(const void* object)> excused;  ///< a required key that this object need not have; may be empty
  std::string excused_by;                           ///< the key that decides it

  AnyField& required() {
    is_required = true;
    return *this;
  }
  /// Required, but not of an object with some property, which a key decides. If that one is refused, it may be missing.
  AnyField& required_unless(const char* decider, std::function<bool(const void* object)> property) {
    excused_by = decider;
    excused = std::move(property);
    return required();
  }
};

/// A table without its type: what Table does, by the addresses of objects.
class AnyTable {
 public:
  void rule(KeyRule::Kind kind, std::vector<std::string> keys) { rules_.push_back({kind, std::move(keys)}); }

  [[nodiscard]] std::vector<std::string> keys() const;
  void collect(const std::string& pointer, std::vector<KeyPlace>& places) const;
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const std::string& description() const { return description_; }

 protected:
  using json = nlohmann::json;
  using ordered_json = nlohmann::ordered_json;

  /// Makes an object by default.
  using MakePlain = std::function<std::shared_ptr<const void>()>;

  AnyTable(std::string_view name, std::string_view description, MakePlain make_plain)
      : name_(name), description_(description), make_plain_(std::move(make_plain)) {}

  AnyField& add(AnyField field) { return fields_.emplace_back(std::move(field)); }
  AnyField& add_leaf(std::string_view key, const table_detail::AnyAccess& at, table_detail::AnyFormat format,
                     std::string_view description);
  AnyField& add_object(std::string_view key, const table_detail::AnyAccess& at, const AnyTable& table);
  AnyField& add_objects(std::string_view key, const table_detail::AnyAccess& at, table_detail::AnyList list,
                        const AnyTable& table, std::size_t most, std::string_view description);

  void read_any(const json& value, const std::string& pointer, void* object, ReadContext& context) const;
  bool change_any(std::string_view rest, double number, const std::string& pointer, void* object,
                  ReadContext& context) const;
  [[nodiscard]] json write_any(const void* object) const;
  [[nodiscard]] ordered_json schema_any(const void* plain) const;

 private:
  std::string name_;
  std::string description_;
  MakePlain make_plain_;
  std::vector<AnyField> fields_;
  std::vector<KeyRule> rules_;
};

template <class T>
class Table : public AnyTable {
 public:
  Table(std::string_view name, std::string_view description)
      : AnyTable(name, description, [] { return std::make_shared<const T>(); }) {}

  /// double or std::optional<double>.
  template <class F>
  AnyField& number(std::string_view key, F member, Bounds bounds, std::string_view description) {
    return leaf(key, table_detail::access<T>(member), table_detail::number_format(key, bounds), description);
  }

  /// An integer type or an optional of one; a number without fractional part.
  template <class F>
  AnyField& integer(std::string_view key, F member, Bounds bounds, std::string_view description) {
    const auto at = table_detail::access<T>(member);
    using I = decltype(table_detail::plain_member(at));
    return leaf(key, at, table_detail::integer_format<I>(bounds), description);
  }

  /// An integer, or "auto", which is stored as 0.
  template <class F>
  AnyField& integer_or_auto(std::string_view key, F member, Bounds bounds, std::string_view description) {
    return leaf(key, table_detail::access<T>(member), table_detail::integer_or_auto_format(bounds), description);
  }

  /// true or false.
  template <class F>
  AnyField& boolean(std::string_view key, F member, std::string_view description) {
    return leaf(key, table_detail::access<T>(member), table_detail::boolean_format(), description);
  }

  /// std::string; an empty one is left out when written.
  template <class F>
  AnyField& text(std::string_view key, F member, std::string_view description) {
    return leaf(key, table_detail::access<T>(member), table_detail::text_format(), description);
  }

  /// One name of a list, read into an enum (by the pairs) or into a string (by names).
  template <class F, class E>
  AnyField& choice(std::string_view key, F member, const std::vector<std::pair<std::string, E>>& choices,
                   std::string_view description) {
    return leaf(key, table_detail::access<T>(member), table_detail::choice_format(choices), description);
  }
  template <class F>
  AnyField& choice(std::string_view key, F member, const std::vector<std::string>& names,
                   std::string_view description) {
    std::vector<std::pair<std::string, std::string>> same;
    for (const auto& name : names) same.emplace_back(name, name);
    return choice(key, member, same, description);
  }

  /// Different names of a list, in an order that counts; at least one.
  template <class F, class E>
  AnyField& choices(std::string_view key, F member, const std::vector<std::pair<std::string, E>>& choices,
                    std::string_view description) {
    return leaf(key, table_detail::access<T>(member), table_detail::choices_format(choices), description);
  }

  /// A stiffness: a number, or "rigid", which is stored as infinity.
  template <class F>
  AnyField& number_or_rigid(std::string_view key, F member, Bounds bounds, std::string_view description) {
    return leaf(key, table_detail::access<T>(member), table_detail::number_or_rigid_format(key, bounds), description);
  }

  /// An array of texts; one without any is left out when written.
  template <class F>
  AnyField& texts(std::string_view key, F member, std::size_t size_max, std::string_view description) {
    return leaf(key, table_detail::access<T>(member), table_detail::texts_format(size_max), description);
  }

  /// An array of numbers; one that is shorter than `size_min` is left out when written.
  template <class F>
  AnyField& numbers(std::string_view key, F member, Bounds bounds, std::size_t size_min, std::size_t size_max,
                    std::string_view description) {
    return leaf(key, table_detail::access<T>(member), table_detail::numbers_format(key, bounds, size_min, size_max),
                description);
  }

  /// One number for all, or an array with a number for each; stored as an array, one number as one of length 1.
  template <class F>
  AnyField& number_or_numbers(std::string_view key, F member, Bounds bounds, std::size_t size_max,
                              std::string_view description) {
    return leaf(key, table_detail::access<T>(member), table_detail::number_or_numbers_format(key, bounds, size_max),
                description);
  }

  /// The same in a class of its own, such as gear::PerPlanet.
  template <class F>
  AnyField& values(std::string_view key, F member, Bounds bounds, std::size_t size_max, std::string_view description) {
    const auto at = table_detail::access<T>(member);
    using V = decltype(table_detail::plain_member(at));
    return leaf(key, at, table_detail::values_format<V>(table_detail::number_or_numbers_format(key, bounds, size_max)),
                description);
  }

  /// The same, or the string "rigid".
  template <class F>
  AnyField& values_or_rigid(std::string_view key, F member, Bounds bounds, std::size_t size_max,
                            std::string_view description) {
    const auto at = table_detail::access<T>(member);
    using V = decltype(table_detail::plain_member(at));
    return leaf(key, at, table_detail::values_or_rigid_format<V>(key, bounds, size_max), description);
  }

  /// An object of its own; left out when written, if nothing in it is set.
  template <class F, class U>
  AnyField& object(std::string_view key, F member, const Table<U>& table) {
    static_assert(std::is_same_v<decltype(table_detail::plain_member(table_detail::access<T>(member))), U>);
    return add_object(key, table_detail::access<T>(member), table);
  }

  /// A list of objects, each as its table reads it; left out when written, if there are none.
  /// @param member  std::vector<U>
  template <class F, class U>
  AnyField& objects(std::string_view key, F member, const Table<U>& table, std::size_t most,
                    std::string_view description) {
    using List = decltype(table_detail::plain_member(table_detail::access<T>(member)));
    static_assert(std::is_same_v<List, std::vector<U>>);
    return add_objects(key, table_detail::access<T>(member), table_detail::any_list<U>(), table, most, description);
  }

  /// A field made by hand.
  AnyField& custom(Field<T> field) {
    AnyField any;
    static_cast<FieldWords&>(any) = std::move(static_cast<FieldWords&>(field));
    any.read = [read = std::move(field.read)](const json& value, const std::string& pointer, void* t,
                                              ReadContext& context) {
      read(value, pointer, *static_cast<T*>(t), context);
    };
    any.write = [write = std::move(field.write)](const void* t) { return write(*static_cast<const T*>(t)); };
    if (field.change)
      any.change = [change = std::move(field.change)](std::string_view rest, double value, const std::string& pointer,
                                                      void* t, ReadContext& context) {
        return change(rest, value, pointer, *static_cast<T*>(t), context);
      };
    return add(std::move(any));
  }

  /// Reads into `t` what can be read, and reports errors. A number out of its range is read, too.
  void read(const nlohmann::json& value, const std::string& pointer, T& t, ReadContext& context) const {
    read_any(value, pointer, &t, context);
  }

  /// Replaces one number of an object that was read. The number is checked as in reading. Rules on combinations of keys
  /// are not checked, since no key is added or removed.
  /// @param rest     its place below this object, "/lumped/sun/mass_kg", "/phase/2"
  /// @param pointer  its whole place, for findings
  /// @returns false if the table has no such number; `t` is then unchanged
  bool change(std::string_view rest, double number, const std::string& pointer, T& t, ReadContext& context) const {
    return change_any(rest, number, pointer, &t, context);
  }

  [[nodiscard]] nlohmann::json write(const T& t) const { return write_any(&t); }

  /// @param plain the object at the start of reading: its values are the defaults
  [[nodiscard]] nlohmann::ordered_json schema(const T& plain = {}) const { return schema_any(&plain); }

 private:
  /// A member M, which is a V or an optional one.
  template <class M, class V>
  AnyField& leaf(std::string_view key, const table_detail::Access<T, M>& at, table_detail::Format<V> format,
                 std::string_view description) {
    return add_leaf(key, at, table_detail::any_format<M>(std::move(format)), description);
  }
};

}  // namespace epicyclic::input
