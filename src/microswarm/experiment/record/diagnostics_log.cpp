// SPDX-License-Identifier: Apache-2.0
#include "microswarm/experiment/record/diagnostics_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/core/text/lines.hpp"
#include "microswarm/io/hdf5_tables.hpp"

namespace microswarm::experiment {
namespace {

constexpr std::string_view diagnostics_group = "/diagnostics";
constexpr const char* kinds_attribute = "diagnostics";  // of the root: tables, joined by spaces

using AggregationRows = std::vector<DiagnosticsRow<AggregationDiagnostics>>;

/// The newest of the first `count` rows with a tree; null before the first.
const AggregationDiagnostics* newest_tree(const AggregationRows& rows, std::size_t count) {
  while (count > 0)
    if (const auto& shown = rows[--count].shown; !shown.nodes.empty()) return &shown;
  return nullptr;
}

template <class Shown>
bool has_tree(const Shown& shown) {
  if constexpr (requires { shown.nodes; }) return !shown.nodes.empty();
  return false;
}

std::string wrong_index(const RadarDiagnostics& shown) {
  return shown.best && *shown.best >= shown.beams.size() ? "best is no beam" : "";
}

std::string wrong_index(const AggregationDiagnostics& shown) {
  const auto is_node = [&](std::uint32_t index) { return index < shown.nodes.size(); };
  const auto is_region = [&](std::uint32_t index) { return index < shown.regions.size(); };
  for (const AggregationNode& node : shown.nodes) {
    if (!is_node(node.next)) return "nodes: next is no node";
    if (!is_region(node.region)) return "nodes: region is no region";
  }
  for (const Region& region : shown.regions) {
    if (!is_node(region.node) || !is_node(region.gate)) return "regions: node or gate is no node";
    if (!is_region(region.next)) return "regions: next is no region";
  }
  return "";
}

std::string wrong_index(const PredictiveDiagnostics&) { return ""; }
std::string wrong_index(const HierarchicalDiagnostics&) { return ""; }

/// The first column of a read table that cannot be right; empty if there is none.
template <class Shown>
std::string wrong_row(const std::vector<DiagnosticsRow<Shown>>& rows) {
  double before = -std::numeric_limits<double>::infinity();
  for (const auto& row : rows) {
    if (!(row.t > before && std::isfinite(row.t))) return "t_s does not rise";
    before = row.t;
    if (std::string wrong = wrong_index(row.shown); !wrong.empty()) return wrong;
  }
  return "";
}

}  // namespace

bool DiagnosticsLog::empty() const {
  bool is_empty = true;
  fields(*this, [&](const auto& rows, const FieldInfo&) { is_empty = is_empty && rows.empty(); });
  return is_empty;
}

void DiagnosticsLog::add(double t, Diagnostics shown) {
  std::visit(Overloaded{[](std::monostate) {},
                        [&](RadarDiagnostics&& of) {
                          radar.push_back({t, std::move(of)});
                        },
                        [&](AggregationDiagnostics&& of) {
                          const auto* before =
                              has_tree(of) ? newest_tree(aggregation, aggregation.size()) : nullptr;
                          if (before && before->nodes == of.nodes && before->regions == of.regions)
                            of.nodes.clear(), of.regions.clear();
                          aggregation.push_back({t, std::move(of)});
                        },
                        [&](PredictiveDiagnostics&& of) {
                          predictive.push_back({t, std::move(of)});
                        },
                        [&](const HierarchicalDiagnostics& of) {
                          hierarchical.push_back({t, of});
                        }},
             std::move(shown));
}

void DiagnosticsLog::thin() {
  fields(*this, [](auto& rows, const FieldInfo&) {
    std::size_t number = 0;
    std::erase_if(rows, [&](const auto& row) { return number++ % 2 != 0 && !has_tree(row.shown); });
  });
}

Diagnostics DiagnosticsLog::at(double t) const {
  Diagnostics found;
  fields(*this, [&](const auto& rows, const FieldInfo&) {
    const auto row = std::ranges::lower_bound(rows, t, {}, [](const auto& one) { return one.t; });
    if (row != rows.end() && row->t == t) found = row->shown;
  });
  if (auto* of = std::get_if<AggregationDiagnostics>(&found); of && of->nodes.empty()) {
    const auto after =
        std::ranges::lower_bound(aggregation, t, {}, [](auto& one) { return one.t; });
    if (const auto* tree =
            newest_tree(aggregation, static_cast<std::size_t>(after - aggregation.begin())))
      of->nodes = tree->nodes, of->regions = tree->regions;
  }
  return found;
}

void write_diagnostics(io::Hdf5Writer& out, const DiagnosticsLog& log) {
  std::string kinds;
  for (const Field& field : type_of<DiagnosticsLog>().fields) {
    if (field.type->count(field.in(&log)) == 0) continue;
    io::write_table(out, field, &log, diagnostics_group);
    kinds.append(kinds.empty() ? "" : " ").append(field.info.name);
  }
  if (!kinds.empty()) out.attribute("/", kinds_attribute, kinds);
}

DiagnosticsLog read_diagnostics(const io::Hdf5Reader& in) {
  DiagnosticsLog log;
  if (!in.has_attribute("/", kinds_attribute)) return log;
  const std::string kinds = in.text_attribute("/", kinds_attribute);
  for (const std::string_view kind : split(kinds, ' '))
    for (const Field& field : type_of<DiagnosticsLog>().fields)
      if (field.info.name == kind) io::read_table(in, field, &log, diagnostics_group);
  DiagnosticsLog::fields(log, [&](const auto& rows, const FieldInfo& info) {
    if (const std::string wrong = wrong_row(rows); !wrong.empty())
      in.fail(fmt::format("{}/{}/{}", diagnostics_group, info.name, wrong));
  });
  return log;
}

}  // namespace microswarm::experiment

namespace microswarm {

template const Type& type_of<experiment::DiagnosticsLog>();

}  // namespace microswarm
