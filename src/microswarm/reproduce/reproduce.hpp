// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "microswarm/core/progress.hpp"
#include "microswarm/core/stop.hpp"
#include "microswarm/report/rows.hpp"

namespace microswarm::reproduce {

inline constexpr int full_seeds = 100;
inline constexpr int quick_seeds = 50;

/// How to reproduce: where the scenarios stand, where plots go (nowhere when empty), how many
/// seeds; who shows progress, and who is told what is left out.
struct ReproduceOptions {
  std::string out;
  std::filesystem::path scenarios;
  bool quick = false;
  BeginProgress progress{};
  std::function<void(const std::string& what)> note{};

  int seed_count() const { return quick ? quick_seeds : full_seeds; }
};

// Rows of a paper's figure. An aim is the paper's value with a stated tolerance; a row without one
// says why in its note.

/// A row as it is.
inline ReproduceRow row_of(std::string figure, std::string quantity, std::string unit,
                           std::optional<double> paper, std::optional<double> ours,
                           std::optional<double> aim = {}, bool at_most = true) {
  return {std::move(figure), std::move(quantity), std::move(unit), paper, ours, aim, at_most, {}};
}

/// The row with one more note.
inline ReproduceRow noted(ReproduceRow row, std::string_view note) {
  row.note += (row.note.empty() || note.empty() ? "" : "; ") + std::string(note);
  return row;
}

/// The row with its aim but without a verdict: `why` what was measured cannot judge it.
inline ReproduceRow unjudged(ReproduceRow row, std::string_view why) {
  row.judged = false;
  return noted(std::move(row), why);
}

/// The row without a verdict under --quick, whose trials are too few for it.
inline ReproduceRow unjudged_if_quick(ReproduceRow row, const ReproduceOptions& options) {
  return options.quick ? unjudged(std::move(row), "too few trials") : row;
}

/// A row that has no aim, and why.
inline ReproduceRow row_without_aim(std::string_view why, std::string figure, std::string quantity,
                                    std::string unit, std::optional<double> paper,
                                    std::optional<double> ours) {
  return noted(row_of(std::move(figure), std::move(quantity), std::move(unit), paper, ours), why);
}

/// One whose aim is to be within `share` of the paper's figure, on either side: the bound that is
/// named is the one on our side. Without a figure in the paper it has no aim.
inline ReproduceRow row_within(double share, std::string figure, std::string quantity,
                               std::string unit, std::optional<double> paper,
                               std::optional<double> ours) {
  const bool above = !paper || !ours || *ours >= *paper;
  const auto aim = paper ? std::optional(*paper * (above ? 1 + share : 1 - share)) : std::nullopt;
  return noted(
      row_of(std::move(figure), std::move(quantity), std::move(unit), paper, ours, aim, above),
      paper ? fmt::format("paper ± {:.3g} %", 100 * share) : "");
}

/// One whose aim is on one side only: at most the paper's figure and `share` of it, or at least the
/// figure less `share` of it.
inline ReproduceRow row_at_most(double share, std::string figure, std::string quantity,
                                std::string unit, double paper, std::optional<double> ours) {
  return noted(row_of(std::move(figure), std::move(quantity), std::move(unit), paper, ours,
                      paper + share * std::abs(paper)),
               share == 0 ? "" : fmt::format("paper + {:.3g} %", 100 * share));
}
inline ReproduceRow row_at_least(double share, std::string figure, std::string quantity,
                                 std::string unit, double paper, std::optional<double> ours) {
  return noted(row_of(std::move(figure), std::move(quantity), std::move(unit), paper, ours,
                      paper - share * std::abs(paper), false),
               share == 0 ? "" : fmt::format("paper − {:.3g} %", 100 * share));
}

/// [drrt]: fig3 (S-channel), fig5a (deforming channel), fig5b (moving obstacles), comparison (with
/// the radar among moving obstacles), follower (the learned one beside pure pursuit and its
/// expert), or all when empty.
std::vector<ReproduceRow> drrt_figures(const std::string& figure, const ReproduceOptions& options,
                                       const Stop& stop);

/// [global]: fig1 (vascular network), fig3-5 (step lengths), fig6 (hypercubes), fig7 (distance
/// between the starts), fig8 (digestive system), fig9-10 (four robots, a tree asked again), fig12
/// (two magnets), beyond (the search that uses walls), beyond-6 (six robots), or all when empty.
std::vector<ReproduceRow> global_figures(const std::string& figure, const ReproduceOptions& options,
                                         const Stop& stop);

/// [gather]: fig3-6 (pictures of the tree, its regions and DCA), fig7 (recurrence models beside
/// steps on maps of fewer regions), fig9 (steps of the paper's three methods and two of ours on its
/// maps for 2 … 1024 robots), generated (DCA and HRA on generated maps), fig10 (frames of a camera
/// for robots with a real rig's faults), fig10-rig (the same seen by a camera and driven by coils;
/// not with --quick unless asked for), fig10-frames (with a command for every frame of the camera;
/// only when asked for), or all when empty.
std::vector<ReproduceRow> gather_figures(const std::string& figure, const ReproduceOptions& options,
                                         const Stop& stop);

/// [radar]: fig1 (avoidance cost), fig5-6 (three cases of one obstacle), fig7 (series of radii),
/// fig8 (twelve obstacles), fig10 (the cases as an experiment), fig11-12 (twelve obstacles as an
/// experiment), fig13 (micromaze), safety (generated worlds), safety-noisy (seen with noise), fast
/// (obstacles faster than the swarm), or all when empty.
std::vector<ReproduceRow> radar_figures(const std::string& figure, const ReproduceOptions& options,
                                        const Stop& stop);

}  // namespace microswarm::reproduce
