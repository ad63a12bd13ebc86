#include "io/gear_output.hpp"

#include <numbers>

#include "io/atomic_file.hpp"
#include "io/csv.hpp"
#include "model/modes.hpp"

namespace epicyclic::io {

std::string write_modes_csv(const std::filesystem::path& file, const gear::Stage& stage) {
  const model::Scales scales = model::scales_of(stage);
  CsvWriter csv({"mode", "frequency_Hz", "frequency_ratio", "type", "multiplicity"});
  int number = 1;
  for (const model::Mode& mode : model::modes(stage, scales))
    csv.row(number++, mode.frequency_ratio * scales.omega_sn / (2.0 * std::numbers::pi), mode.frequency_ratio,
            model::to_string(mode.type), mode.multiplicity);
  write_file_atomically(file, csv.text());
  return csv.text();
}

}  // namespace epicyclic::io
