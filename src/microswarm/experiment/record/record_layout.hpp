// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "microswarm/core/units.hpp"
#include "microswarm/experiment/record/record.hpp"
#include "microswarm/planning/common/detection.hpp"

namespace microswarm {

/// How a quantity is kept.
enum class ColumnKind { real, integer, word };

/// One quantity of a table's rows. Reals are NaN where there is none.
template <class Row>
struct Column {
  std::string key;  ///< name with the unit's suffix: the dataset's name
  Unit unit = Unit::none;
  std::string_view doc;
  ColumnKind kind = ColumnKind::real;
  std::function<double(const Row&)> number;
  std::function<void(Row&, double)> set_number;
  double max = 0;  ///< integers only, which go from 0
  std::function<std::string(const Row&)> word;
  /// False when there is no such word.
  std::function<bool(Row&, const std::string&)> set_word;
};

/// The quantities of the rows of each table, each declared once: writing, reading, the hash, the
/// comparison of a replay and the table in the docs all come from these.
std::vector<Column<Frame>> columns_of(const Frame*);
std::vector<Column<PathChange>> columns_of(const PathChange*);
std::vector<Column<PlanEvent>> columns_of(const PlanEvent*);
std::vector<Column<RunEvent>> columns_of(const RunEvent*);
std::vector<Column<RobotMoment>> columns_of(const RobotMoment*);
std::vector<Column<Vec2>> columns_of(const Vec2*);
std::vector<Column<TreeNode>> columns_of(const TreeNode*);
std::vector<Column<Detection>> columns_of(const Detection*);

/// Calls visit.table(group, rows) for each table of a record, and visit.parts(group, rows, part)
/// for each list that every row of a table has, part(row) being the list.
template <class SomeRecord, class Visitor>
void visit_tables(SomeRecord& record, Visitor&& visit) {
  visit.table("/frames", record.frames);
  visit.table("/paths", record.paths);
  visit.parts(
      "/paths/points", record.paths, [](auto& row) -> auto& { return row.path; });
  visit.table("/plans", record.plans);
  visit.parts(
      "/plans/path", record.plans, [](auto& row) -> auto& { return row.plan.path; });
  visit.parts(
      "/plans/tree", record.plans, [](auto& row) -> auto& { return row.plan.tree; });
  visit.parts(
      "/plans/detections", record.plans, [](auto& row) -> auto& { return row.plan.detections; });
  visit.table("/events", record.events);
  visit.table("/robots", record.robots);
  visit.parts(
      "/robots/places", record.robots, [](auto& row) -> auto& { return row.places; });
}

}  // namespace microswarm
