// A command at work on a thread of its own. Python waits for it in short steps, so that its signals and callbacks run
// in between, and takes messages, progress and points as they come.

#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstddef>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include <pybind11/stl.h>

#include "binding.hpp"
#include "command/commands.hpp"
#include "command/host.hpp"
#include "command/kind_commands.hpp"
#include "command/progress.hpp"
#include "core/errors.hpp"
#include "core/instruction_set.hpp"
#include "ranks/ranks.hpp"
#include "store/point_columns.hpp"
#include "studies/sweep.hpp"

namespace epicyclic::binding {

namespace py = pybind11;

namespace {

/// Signals of the process belong to Python's threads: blocked in threads that are made while the object lives.
class SignalsBlocked {
 public:
  SignalsBlocked() {
    sigset_t all;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  SignalsBlocked(const SignalsBlocked&) = delete;
  SignalsBlocked& operator=(const SignalsBlocked&) = delete;
  ~SignalsBlocked() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

 private:
  sigset_t before_{};
};

class Job {
 public:
  /// @param rows  points that are kept until they are taken; after as many the command stops
  Job(std::string command, app::Arguments arguments, std::size_t rows)
      : command_(std::move(command)), arguments_(std::move(arguments)) {
    run_ = command_ == "gear" ? &app::gear_command : app::command_of(command_).run;
    const auto keep = [this](std::vector<std::string>& all) {
      return [this, &all](std::string_view text) {
        const std::scoped_lock lock(mutex_);
        all.emplace_back(text);
      };
    };
    host_.words = keep(words_);
    host_.data = keep(data_);
    host_.warning = keep(warnings_);
    host_.progress = [this](const std::string& label, const app::ProgressState& state) {
      const std::scoped_lock lock(mutex_);
      progress_.emplace(label, state);
    };
    if (rows > 0)
      host_.point = [this, rows](const studies::PointResult& point) {
        const std::scoped_lock lock(mutex_);
        points_.push_back(point);
        if (++seen_ >= rows) host_.stop = true;
      };
    const SignalsBlocked blocked;
    worker_ = std::thread([this] { work(); });
  }
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;
  ~Job() {
    host_.stop = true;
    const py::gil_scoped_release release;
    worker_.join();
  }

  void stop() { host_.stop = true; }

  /// @returns whether it is over
  bool wait(double seconds) {
    const py::gil_scoped_release release;
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, std::chrono::duration<double>(seconds), [this] { return over_; });
  }

  /// Since the last call: words, data, warnings.
  py::tuple messages() {
    std::vector<std::string> words, data, warnings;
    {
      const std::scoped_lock lock(mutex_);
      words.swap(words_);
      data.swap(data_);
      warnings.swap(warnings_);
    }
    return py::make_tuple(words, data, warnings);
  }

  /// The last one since the last call, or None: label, done, total or None, failed.
  py::object progress() {
    std::optional<std::pair<std::string, app::ProgressState>> last;
    {
      const std::scoped_lock lock(mutex_);
      last.swap(progress_);
    }
    if (!last) return py::none();
    const app::ProgressState& state = last->second;
    return py::make_tuple(last->first, state.done,
                          state.total == app::unknown_total ? py::object(py::none()) : py::cast(state.total),
                          state.failed);
  }

  /// Points since the last call, in the order of the computation: dicts with the columns of points.csv.
  py::list rows() {
    std::vector<studies::PointSummary> points;
    {
      const std::scoped_lock lock(mutex_);
      points.swap(points_);
    }
    py::list rows;
    for (const studies::PointSummary& point : points) {
      if (columns_.empty()) columns_ = store::point_columns_like(point);
      py::dict row;
      for (const store::PointColumn& column : columns_)
        std::visit([&](const auto& value) { row[py::str(column.name)] = value(point); }, column.value);
      rows.append(std::move(row));
    }
    return rows;
  }

  /// Of a job that is over: its exit code.
  /// @throws what ended it, or InputError if it is not over
  int result() {
    {
      const std::scoped_lock lock(mutex_);
      if (!over_) throw InputError("the command is not over");
    }
    if (error_) std::rethrow_exception(error_);
    return code_;
  }

 private:
  void work() {
    try {
      const app::HostScope scope(&host_);
      check_instruction_set_limit();
      app::Ranks alone;
      arguments_.ranks = &alone;
      code_ = run_(arguments_);
    } catch (...) {
      error_ = std::current_exception();
    }
    const std::scoped_lock lock(mutex_);
    over_ = true;
    changed_.notify_all();
  }

  std::string command_;
  app::Arguments arguments_;
  int (*run_)(const app::Arguments&) = nullptr;
  app::Host host_;
  int code_ = app::bug;
  std::exception_ptr error_;
  std::mutex mutex_;  ///< of the members below
  std::condition_variable changed_;
  bool over_ = false;
  std::vector<std::string> words_, data_, warnings_;
  std::optional<std::pair<std::string, app::ProgressState>> progress_;
  std::vector<studies::PointSummary> points_;
  std::size_t seen_ = 0;
  std::vector<store::PointColumn> columns_;
  std::thread worker_;
};

std::unique_ptr<Job> make_job(const std::string& command, const std::string& input, const std::string& output,
                              int threads, const std::vector<std::string>& sets, const std::vector<std::string>& from,
                              const std::string& grow, const std::string& against, std::size_t rows, std::size_t part,
                              std::size_t parts) {
  const bool whole = part == 0 && parts == 0;
  if (!whole && (part < 1 || part > parts))
    throw InputError("there is no part " + std::to_string(part) + " of " + std::to_string(parts));
  app::Arguments arguments;
  arguments.part.number = part;
  arguments.part.of = parts;
  arguments.input = input;
  arguments.output = output;
  arguments.threads = threads;
  arguments.sets = sets;
  arguments.from = from;
  arguments.grow = grow;
  arguments.against = against;
  arguments.json = true;
  return std::make_unique<Job>(command, std::move(arguments), rows);
}

}  // namespace

void add_jobs(py::module_& module) {
  py::class_<Job>(module, "Job")
      .def(py::init(&make_job), py::arg("command"), py::arg("input"), py::arg("output"), py::arg("threads"),
           py::arg("sets"), py::arg("origins"), py::arg("grow"), py::arg("against"), py::arg("rows"), py::arg("part"),
           py::arg("parts"))
      .def("stop", &Job::stop)
      .def("wait", &Job::wait, py::arg("seconds"))
      .def("messages", &Job::messages)
      .def("progress", &Job::progress)
      .def("rows", &Job::rows)
      .def("result", &Job::result);
}

}  // namespace epicyclic::binding
