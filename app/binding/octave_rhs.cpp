// A stage's equations of motion as a MEX function for Octave; app/octave/+epicyclic/rhs.m is what users call.
//
//   [handle, period, start, names, omega, omega_sn] = rhs_mex(FILE, SETS)   opens a study; SETS: as --set, a line each
//   dydtau = rhs_mex(handle, tau, y)                             y: a column, or several
//   rhs_mex(handle)                                              forgets it
//
// The interface is declared here as far as it is used, so that Octave's headers are not needed.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "binding/rates.hpp"
#include "core/errors.hpp"
#include "input/study_input.hpp"

struct mxArray;

extern "C" {
mxArray* mxCreateDoubleMatrix(std::int64_t rows, std::int64_t columns, int complexity);
mxArray* mxCreateString(const char* text);
double* mxGetPr(const mxArray* array);
double mxGetScalar(const mxArray* array);
std::int64_t mxGetM(const mxArray* array);
std::int64_t mxGetN(const mxArray* array);
bool mxIsChar(const mxArray* array);
bool mxIsDouble(const mxArray* array);
bool mxIsComplex(const mxArray* array);
char* mxArrayToString(const mxArray* array);
void mxFree(void* memory);
[[noreturn]] void mexErrMsgIdAndTxt(const char* identifier, const char* format, ...);
}

namespace {

using epicyclic::InputError;
using epicyclic::binding::Rates;

std::map<int, std::unique_ptr<Rates>>& opened() {
  static std::map<int, std::unique_ptr<Rates>> all;
  return all;
}

std::string text_of(const mxArray* array) {
  if (!mxIsChar(array)) throw InputError("a text is needed");
  char* text = mxArrayToString(array);
  const std::string copy = text == nullptr ? "" : text;
  mxFree(text);
  return copy;
}

mxArray* number(double value) {
  mxArray* array = mxCreateDoubleMatrix(1, 1, 0);
  *mxGetPr(array) = value;
  return array;
}

void open(int outputs, mxArray** output, const mxArray* file, const mxArray* sets) {
  std::vector<std::string> lines;
  std::istringstream text(text_of(sets));
  for (std::string line; std::getline(text, line);)
    if (!line.empty()) lines.push_back(line);
  const auto input = std::make_shared<const epicyclic::input::LoadedInput>(
      epicyclic::input::load_input(text_of(file), epicyclic::input::parse_assignments(lines)));
  auto rates = std::make_unique<Rates>(input);
  const auto& model = rates->model();
  std::string names;
  for (const std::string& name : model.state_names) names += (names.empty() ? "" : ",") + name;
  mxArray* start = mxCreateDoubleMatrix(static_cast<std::int64_t>(model.dimension), 1, 0);
  std::copy(model.default_start.begin(), model.default_start.end(), mxGetPr(start));
  const int handle = opened().empty() ? 1 : opened().rbegin()->first + 1;
  mxArray* const all[] = {number(handle),      number(rates->period()),      start, mxCreateString(names.c_str()),
                          number(model.omega), number(model.scales.omega_sn)};
  std::copy_n(std::begin(all), std::clamp(outputs, 1, 6), output);
  opened()[handle] = std::move(rates);
}

mxArray* evaluate(const Rates& rates, const mxArray* tau, const mxArray* y) {
  const auto rows = static_cast<std::int64_t>(rates.model().dimension);
  for (const mxArray* array : {tau, y})
    if (!mxIsDouble(array) || mxIsComplex(array)) throw InputError("tau and y must be real numbers");
  if (mxGetM(tau) * mxGetN(tau) != 1) throw InputError("tau must be one number");
  if (mxGetM(y) != rows) throw InputError("y has " + std::to_string(mxGetM(y)) + " rows, not " + std::to_string(rows));
  const std::int64_t columns = mxGetN(y);
  const double* states = mxGetPr(y);
  if (!std::all_of(states, states + rows * columns, [](double x) { return std::isfinite(x); }))
    throw InputError("y has numbers that are not finite");
  mxArray* result = mxCreateDoubleMatrix(rows, columns, 0);
  for (std::int64_t k = 0; k < columns; ++k)
    rates.evaluate(mxGetScalar(tau), states + k * rows, mxGetPr(result) + k * rows);
  return result;
}

void call(int outputs, mxArray** output, int inputs, const mxArray** input) {
  if (inputs == 2) return open(outputs, output, input[0], input[1]);
  if (inputs != 1 && inputs != 3) throw InputError("one, two or three arguments are needed");
  if (!mxIsDouble(input[0]) || mxGetM(input[0]) * mxGetN(input[0]) != 1) throw InputError("no such handle");
  const auto found = opened().find(static_cast<int>(mxGetScalar(input[0])));
  if (found == opened().end()) throw InputError("no such handle");
  if (inputs == 1)
    opened().erase(found);
  else
    output[0] = evaluate(*found->second, input[1], input[2]);
}

}  // namespace

extern "C" [[gnu::visibility("default")]] void mexFunction(int outputs, mxArray** output, int inputs,
                                                           const mxArray** input) {
  // No exception leaves, and nothing that has to be destroyed is left behind: errors are long jumps.
  static std::string message;
  bool failed = false;
  try {
    call(outputs, output, inputs, input);
  } catch (const std::exception& error) {
    message = error.what();
    failed = true;
  }
  if (failed) mexErrMsgIdAndTxt("epicyclic:input", "%s", message.c_str());
}
