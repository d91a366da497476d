// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli.hpp"
#include "microswarm/report/rows.hpp"

namespace microswarm::cli {

inline constexpr int full_seeds = 100;
inline constexpr int quick_seeds = 50;

/// How to reproduce: where the scenarios stand, where plots go (nowhere when empty), how many
/// seeds.
struct ReproduceOptions {
  std::string out;
  std::filesystem::path scenarios;
  bool quick = false;

  int seed_count() const { return quick ? quick_seeds : full_seeds; }
};

/// A row of a paper's figure.
inline ReproduceRow row_of(std::string figure, std::string quantity, std::string unit,
                           std::optional<double> paper, std::optional<double> ours,
                           std::optional<double> aim = {}, bool at_most = true) {
  return {std::move(figure), std::move(quantity), std::move(unit), paper, ours, aim, at_most, {}};
}

/// One whose aim is to be within `share` of the paper's figure, on either side: the bound that is
/// named is the one on our side. Without a figure in the paper it has no aim.
inline ReproduceRow row_within(double share, std::string figure, std::string quantity,
                               std::string unit, std::optional<double> paper,
                               std::optional<double> ours) {
  const bool above = !paper || !ours || *ours >= *paper;
  const auto aim = paper ? std::optional(*paper * (above ? 1 + share : 1 - share)) : std::nullopt;
  return row_of(std::move(figure), std::move(quantity), std::move(unit), paper, ours, aim, above);
}

/// [drrt]: fig3 (S-channel), fig5a (deforming channel), fig5b (moving obstacles), follower (the
/// learned one beside pure pursuit and its expert), or all when empty.
std::vector<ReproduceRow> reproduce_drrt(const std::string& figure, const ReproduceOptions& options,
                                         const Stop& stop);

/// [global]: fig1 (vascular network), fig3-5 (step lengths), fig6 (hypercubes), fig7 (distance
/// between the starts), fig8 (digestive system), fig9-10 (four robots, a tree asked again), fig12
/// (two magnets), beyond (the search that uses walls), beyond-6 (six robots), or all when empty.
std::vector<ReproduceRow> reproduce_global(const std::string& figure,
                                           const ReproduceOptions& options, const Stop& stop);

/// [gather]: fig7 (recurrence models beside steps on maps of fewer regions), fig9 (steps of three
/// methods and the rollout planner on three maps for 2 … 1024 robots), fig10 (frames of a camera
/// for robots with a real rig's faults), fig10-rig (the same seen by a camera and driven by coils),
/// fig10-frames (with a command for every frame of the camera), or all when empty.
std::vector<ReproduceRow> reproduce_gather(const std::string& figure,
                                           const ReproduceOptions& options, const Stop& stop);

/// [radar]: fig5-6 (three cases of one obstacle), fig7 (series of radii), fig8 (twelve obstacles),
/// fig10 (the cases as an experiment), fig11-12 (twelve obstacles as an experiment), fig13
/// (micromaze), safety (generated worlds), fast (obstacles faster than the swarm), or all when
/// empty.
std::vector<ReproduceRow> reproduce_radar(const std::string& figure,
                                          const ReproduceOptions& options, const Stop& stop);

}  // namespace microswarm::cli
