// Lines "pointer: message" on a stage, collected before they are reported together: problems, and warnings with a rank.
#pragma once

#include <algorithm>
#include <charconv>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace epicyclic::gear {

/// Texts and numbers in one line, the same in every locale.
class MessageText {
 public:
  /// @param digits  significant digits of numbers; 0: as many as read back as the same number
  explicit MessageText(int digits) : digits_(digits) {}

  template <class... Parts>
  [[nodiscard]] std::string of(const Parts&... parts) const {
    std::string line;
    (line.append(part(parts)), ...);
    return line;
  }

 private:
  static std::string part(const char* s) { return s; }
  static std::string part(const std::string& s) { return s; }
  [[nodiscard]] std::string part(double x) const {
    char buffer[40];
    const auto end = digits_ == 0
                         ? std::to_chars(buffer, buffer + sizeof buffer, x)
                         : std::to_chars(buffer, buffer + sizeof buffer, x, std::chars_format::general, digits_);
    return {buffer, end.ptr};
  }

  int digits_;
};

class Problems {
 public:
  explicit Problems(int digits = 0) : text_(digits) {}

  template <class... Parts>
  void add(const std::string& pointer, const Parts&... parts) {
    lines_.push_back(pointer + ": " + text_.of(parts...));
  }
  std::vector<std::string> take() { return std::exchange(lines_, {}); }

 private:
  MessageText text_;
  std::vector<std::string> lines_;
};

/// The mesh of sun and planet: "the {} mesh".
[[nodiscard]] inline std::string sun_planet_words(bool pair) { return pair ? "pair's" : "sun-planet"; }

/// How much a warning matters; the first ones first.
enum class Rank {
  impossible,  ///< no machine runs like this
  doubtful,    ///< some do; mostly it is a slip
  note,        ///< what was done with the input, or where a formula is stretched
};

struct Warning {
  Rank rank = Rank::note;
  double excess = 1;    ///< how many times the bound that it is about
  std::string pointer;  ///< relative to the stage
  std::string subject;  ///< what it is about: one warning of a subject is enough
  std::string message;

  [[nodiscard]] std::string text() const { return pointer + ": " + message; }
};

/// Most important first; of several on one subject the one that exceeds its bound most.
inline void put_in_order(std::vector<Warning>& warnings) {
  std::stable_sort(warnings.begin(), warnings.end(), [](const Warning& a, const Warning& b) {
    return std::tuple(a.rank, -a.excess) < std::tuple(b.rank, -b.excess);
  });
  std::vector<Warning> once;
  for (Warning& w : warnings)
    if (std::none_of(once.begin(), once.end(), [&](const Warning& o) { return o.subject == w.subject; }))
      once.push_back(std::move(w));
  warnings = std::move(once);
}

class Warnings {
 public:
  /// @param subject  at this pointer
  template <class... Parts>
  void add(Rank rank, double excess, const std::string& pointer, const std::string& subject, const Parts&... parts) {
    add_once(rank, excess, pointer, pointer + " " + subject, parts...);
  }
  /// @param subject  independent of the pointer
  template <class... Parts>
  void add_once(Rank rank, double excess, const std::string& pointer, const std::string& subject,
                const Parts&... parts) {
    all_.push_back({rank, excess, pointer, subject, text_.of(parts...)});
  }
  std::vector<Warning> take() { return std::exchange(all_, {}); }

 private:
  static constexpr int digits = 6;
  MessageText text_{digits};
  std::vector<Warning> all_;
};

}  // namespace epicyclic::gear
