#include "io/gear_output.hpp"

#include <numbers>

#include "io/csv.hpp"
#include "model/modes.hpp"

namespace epicyclic::io {

void write_modes_csv(const std::filesystem::path& file, const gear::Stage& stage) {
  const model::Scales scales = model::scales_of(stage);
  CsvWriter csv(file, {"mode", "frequency_Hz", "frequency_ratio", "type", "multiplicity"});
  int number = 1;
  for (const model::Mode& mode : model::modes(stage, scales))
    csv.row(number++, mode.frequency_ratio * scales.omega_sn / (2.0 * std::numbers::pi), mode.frequency_ratio,
            model::to_string(mode.type), mode.multiplicity);
  csv.commit();
}

}  // namespace epicyclic::io
