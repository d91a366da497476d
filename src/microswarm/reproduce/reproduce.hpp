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

#include "microswarm/core/execution/progress.hpp"
#include "microswarm/core/execution/stop.hpp"
#include "microswarm/report/rows.hpp"

namespace microswarm::reproduce {

inline constexpr int full_seeds = 100;
inline constexpr int quick_seeds = 50;

/// Options of a reproduction: output folder of plots (empty: none), folder of the scenarios, number
/// of seeds, and callbacks for progress and for omitted parts.
struct ReproduceOptions {
  std::string out{};
  std::filesystem::path scenarios{};
  bool quick = false;
  BeginProgress progress{};
  std::function<void(const std::string& what)> note{};

  int seed_count() const { return quick ? quick_seeds : full_seeds; }
};

// Rows of a paper's figure. An aim is the paper's value with a stated tolerance; a row without an
// aim gives the reason in its note.

/// A plain row.
inline report::ReproduceRow make_row(std::string figure, std::string quantity, std::string unit,
                                     std::optional<double> paper, std::optional<double> ours,
                                     std::optional<double> aim = {}, bool at_most = true) {
  return {std::move(figure), std::move(quantity), std::move(unit), paper, ours, aim, at_most, {}};
}

/// The row with an additional note.
inline report::ReproduceRow noted(report::ReproduceRow row, std::string_view note) {
  row.note += (row.note.empty() || note.empty() ? "" : "; ") + std::string(note);
  return row;
}

/// The row with its aim but without a verdict; `why` is the reason.
inline report::ReproduceRow unjudged(report::ReproduceRow row, std::string_view why) {
  row.judged = false;
  return noted(std::move(row), why);
}

/// The row without a verdict under --quick, which has too few trials.
inline report::ReproduceRow unjudged_if_quick(report::ReproduceRow row,
                                              const ReproduceOptions& options) {
  return options.quick ? unjudged(std::move(row), "too few trials") : row;
}

/// A row without an aim; `why` is the reason.
inline report::ReproduceRow row_without_aim(std::string_view why, std::string figure,
                                            std::string quantity, std::string unit,
                                            std::optional<double> paper,
                                            std::optional<double> ours) {
  return noted(make_row(std::move(figure), std::move(quantity), std::move(unit), paper, ours), why);
}

/// A row whose aim is the paper's value ± `share`. The stated bound is the one on our side. Without
/// a published value there is no aim.
inline report::ReproduceRow row_within(double share, std::string figure, std::string quantity,
                                       std::string unit, std::optional<double> paper,
                                       std::optional<double> ours) {
  const bool above = !paper || !ours || *ours >= *paper;
  const auto aim = paper ? std::optional(*paper * (above ? 1 + share : 1 - share)) : std::nullopt;
  return noted(
      make_row(std::move(figure), std::move(quantity), std::move(unit), paper, ours, aim, above),
      paper ? fmt::format("paper ± {:.3g} %", 100 * share) : "");
}

/// A row with a one-sided aim: at most the paper's value plus `share` of it, or at least the value
/// minus `share` of it.
inline report::ReproduceRow row_at_most(double share, std::string figure, std::string quantity,
                                        std::string unit, double paper,
                                        std::optional<double> ours) {
  return noted(make_row(std::move(figure), std::move(quantity), std::move(unit), paper, ours,
                        paper + share * std::abs(paper)),
               share == 0 ? "" : fmt::format("paper + {:.3g} %", 100 * share));
}
inline report::ReproduceRow row_at_least(double share, std::string figure, std::string quantity,
                                         std::string unit, double paper,
                                         std::optional<double> ours) {
  return noted(make_row(std::move(figure), std::move(quantity), std::move(unit), paper, ours,
                        paper - share * std::abs(paper), false),
               share == 0 ? "" : fmt::format("paper − {:.3g} %", 100 * share));
}

/// Figures of [drrt]: fig3 (S-channel), fig5a (deforming channel), fig5b (moving obstacles),
/// comparison (with the radar among moving obstacles), follower (learned follower, pure pursuit and
/// expert), or all if empty.
std::vector<report::ReproduceRow> drrt_figures(const std::string& figure,
                                               const ReproduceOptions& options, const Stop& stop);

/// Figures of [global]: fig1 (vascular network), fig3-5 (step lengths), fig6 (hypercubes), fig7
/// (distance between the starts), fig8 (digestive system), fig9-10 (four robots, reused tree),
/// fig12 (two magnets), beyond (the search that uses walls), beyond-6 (six robots), or all if
/// empty.
std::vector<report::ReproduceRow> global_figures(const std::string& figure,
                                                 const ReproduceOptions& options, const Stop& stop);

/// Figures of [gather]: fig3-6 (pictures of the tree, its regions and DCA), fig7 (recurrence models
/// and steps on maps with fewer regions), fig9 (steps of the paper's three methods and two of ours
/// on its maps for 2 … 1024 robots), generated (DCA and HRA on generated maps), fig10 (camera
/// frames for robots with the faults of a real rig), fig10-rig (the same through camera and coils;
/// with --quick only on request), fig10-frames (with a command per camera frame; only on request),
/// or all if empty.
std::vector<report::ReproduceRow> gather_figures(const std::string& figure,
                                                 const ReproduceOptions& options, const Stop& stop);

/// Figures of [radar]: fig1 (avoidance cost), fig5-6 (three cases of one obstacle), fig7 (series of
/// radii), fig8 (twelve obstacles), fig10 (the cases as an experiment), fig11-12 (twelve obstacles
/// as an experiment), fig13 (micromaze), safety (generated worlds), safety-noisy (noisy
/// detections), fast (obstacles faster than the swarm), hardships (ribbons, flow, dead ends and
/// more), or all if empty.
std::vector<report::ReproduceRow> radar_figures(const std::string& figure,
                                                const ReproduceOptions& options, const Stop& stop);

/// Every navigator through the scenes of the arena (scenes/arena), beside the earliest arrival of
/// one that knows all motions: `all`, the only figure. A method of ours; no paper has it.
std::vector<report::ReproduceRow> arena_figures(const std::string& figure,
                                                const ReproduceOptions& options, const Stop& stop);

/// The 60 worlds of DynaBARN, read from the folder dynabarn of MICROSWARM_DATA: `all`. Without it
/// there are no rows, and a note.
std::vector<report::ReproduceRow> dynabarn_figures(const std::string& figure,
                                                   const ReproduceOptions& options,
                                                   const Stop& stop);

/// 500 circle crossings among five people who avoid one another and not the robot
/// (scenes/orca_crowd): `all`.
std::vector<report::ReproduceRow> crowd_figures(const std::string& figure,
                                                const ReproduceOptions& options, const Stop& stop);

}  // namespace microswarm::reproduce
