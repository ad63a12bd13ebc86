// What is wrong with options, found by several hands and told at once.
#pragma once

#include <cstddef>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace epicyclic::studies {

using Names = std::set<std::string, std::less<>>;

/// Collects what is wrong.
class ProblemList {
 public:
  void refuse(const std::string& place, std::string message) { found_.emplace_back(place, std::move(message)); }

  /// Names of a list: there, and each once.
  template <class List>
  Names names(const List& list, const std::string& place) {
    Names all;
    for (std::size_t k = 0; k < list.size(); ++k) {
      const std::string at = place + "/" + std::to_string(k) + "/name";
      if (list[k].name.empty())
        refuse(at, "is empty, must be a name");
      else if (!all.insert(list[k].name).second)
        refuse(at, "is \"" + list[k].name + "\", as one before it; names must differ");
    }
    return all;
  }

  [[nodiscard]] std::size_t count() const { return found_.size(); }
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> found() && { return std::move(found_); }

 private:
  std::vector<std::pair<std::string, std::string>> found_;
};

}  // namespace epicyclic::studies
