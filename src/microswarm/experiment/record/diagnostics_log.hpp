// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "microswarm/config/type.hpp"
#include "microswarm/contracts/diagnostics.hpp"
#include "microswarm/io/hdf5_image.hpp"

namespace microswarm::experiment {

/// Diagnostics of one tick.
template <class Shown>
struct DiagnosticsRow {
  double t = 0;  ///< [s]
  Shown shown{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.t, s("t", "Time of the tick."));
    Shown::fields(self.shown, visit);
  }
};

/// Diagnostics of a run, one row for each tick in which its navigator had some. It is not part of
/// the record's hash.
struct DiagnosticsLog {
  std::vector<DiagnosticsRow<RadarDiagnostics>> radar{};
  /// Nodes and regions only where they differ from those before.
  std::vector<DiagnosticsRow<AggregationDiagnostics>> aggregation{};
  std::vector<DiagnosticsRow<PredictiveDiagnostics>> predictive{};
  std::vector<DiagnosticsRow<HierarchicalDiagnostics>> hierarchical{};
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.radar, plain("radar", "Decisions of the hierarchical radar."));
    visit(self.aggregation, plain("aggregation", "Plan and state of an aggregation."));
    visit(self.predictive,
          plain("predictive", "Bodies as the safe-interval navigator predicts them."));
    visit(self.hierarchical, plain("hierarchical", "Decisions of hierarchical D-RRT*."));
  }

  bool empty() const;
  /// Adds those of a tick, later than all before. A tree that is the newest one may be left out.
  void add(double t, Diagnostics shown);
  /// Drops every second row, but no tree.
  void thin();
  /// Those of the tick at time t; nothing if it has none.
  Diagnostics at(double t) const;
};

/// Writes the tables that have rows into the group /diagnostics.
void write_diagnostics(io::Hdf5Writer& out, const DiagnosticsLog& log);

/// Reads the tables; empty if there are none. Tables of other names are ignored. Throws InputError
/// if they are damaged.
DiagnosticsLog read_diagnostics(const io::Hdf5Reader& in);

}  // namespace microswarm::experiment

namespace microswarm {

/// Compiled once, in diagnostics_log.cpp.
extern template const Type& type_of<experiment::DiagnosticsLog>();

}  // namespace microswarm
