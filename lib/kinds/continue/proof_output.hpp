// The files of a comparison of a sweep with branches: proof.csv, proof.md, figures of the branches over the sweep's
// Poincare points. They follow from the branches and the sweep alone.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "kinds/continue/output.hpp"
#include "studies/branch_proof.hpp"
#include "studies/point_source.hpp"

namespace epicyclic::kinds {

/// The sweep that is compared.
struct ProvedSweep {
  std::string name;      ///< of the study
  std::string identity;  ///< SHA-256 of it
  std::vector<std::string> poincare_columns;
  studies::PointSource points;
};

/// @throws OutputError
void write_proof_csv(const std::filesystem::path& file, const studies::TracedBranches& traced,
                     const studies::BranchProof& proof);

/// Text of proof.md.
[[nodiscard]] std::string proof_summary(const ContinueOutput& output, const ProvedSweep& sweep,
                                        const studies::TracedBranches& traced, const studies::BranchProof& proof);

[[nodiscard]] std::vector<reports::DrawnFigure> draw_proof_figures(const std::filesystem::path& folder,
                                                                   const ContinueOutput& output,
                                                                   const ProvedSweep& sweep,
                                                                   const studies::TracedBranches& traced);

}  // namespace epicyclic::kinds
