// What the page of `serve` requests: the studies with their points so far, short histories, finer regions, changed
// numbers. A request names studies, points and numbers of the input by their index; names of folders are made here.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "command/commands.hpp"
#include "served_computation.hpp"

namespace epicyclic::app {

/// A number of the input that the page offers, or several that have one value or one factor.
struct AdjustableNumber {
  std::string name;  ///< its key, or the name of a parameter
  std::string meaning;
  std::string unit;  ///< empty of pure numbers
  std::vector<std::string> pointers;
  std::vector<double> values;  ///< in the input
  bool is_factor = false;      ///< of all values
  bool is_suggested = false;   ///< among the four that the page begins with

  [[nodiscard]] double value() const { return is_factor ? 1.0 : values.front(); }
};

class ServedStudies {
 public:
  /// Changes nothing in the folders. Finds what an earlier session computed in them.
  /// @param arguments  folders, threads, ranks
  /// @throws InputError where there is no study
  explicit ServedStudies(const Arguments& arguments);
  ~ServedStudies();

  /// Names of requests.
  [[nodiscard]] static std::vector<std::string> actions();

  /// @param body  JSON
  /// @returns status of HTTP, and the text of the answer
  [[nodiscard]] std::pair<int, std::string> answer(std::string_view action, std::string body);

  [[nodiscard]] std::string title() const;

  /// Stops what is at work and waits for it.
  /// @returns whether something was stopped
  bool end();

 private:
  struct Served;
  /// A number of the input and its value.
  using Change = std::pair<std::size_t, double>;

  [[nodiscard]] Served& served(const nlohmann::json& request) const;
  [[nodiscard]] nlohmann::json state() const;
  [[nodiscard]] std::string data(Served& study) const;
  [[nodiscard]] nlohmann::json history(Served& study, const nlohmann::json& request) const;
  [[nodiscard]] nlohmann::json refine(const Served& study, const nlohmann::json& request);
  [[nodiscard]] nlohmann::json change(const Served& study, const nlohmann::json& request);
  /// @param sets  behind those of the changes
  [[nodiscard]] nlohmann::json begin(const Served& root, const char* place, std::vector<Change> changes,
                                     const std::vector<std::string>& sets, bool figures);
  void add(std::filesystem::path folder, const Served* root);
  void find_derived(const Served& root);

  Arguments arguments_;
  mutable std::mutex mutex_;  ///< of the list: studies are added and stay
  std::vector<std::unique_ptr<Served>> all_;
  mutable std::mutex starting_;  ///< held while a computation is started, and while none may be
  std::unique_ptr<ServedComputation> computation_;
};

}  // namespace epicyclic::app
