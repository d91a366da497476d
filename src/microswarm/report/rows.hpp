// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace microswarm {

/// One figure of a paper beside ours. `paper` is empty where the paper gives none, `ours` where
/// there is nothing to tell (a median over nobody), `aim` where we set none, for which `note` says
/// why; `at_most` says on which side of the aim ours has to be. Nothing meets no aim. A row that is
/// not `judged` keeps its aim but has no verdict: too few trials, or the run was interrupted.
struct ReproduceRow {
  std::string figure;
  std::string quantity;
  std::string unit;
  std::optional<double> paper;
  std::optional<double> ours;
  std::optional<double> aim;
  bool at_most = true;
  std::string note;
  bool judged = true;

  bool has_verdict() const { return aim && judged; }
  /// False only for a verdict against us.
  bool ok() const { return !has_verdict() || (ours && (at_most ? *ours <= *aim : *ours >= *aim)); }
};

/// One measured speed beside its peer's in the same run. `ratio` is peer ÷ ours for times and ours
/// ÷ peer for rates: above 1 we are faster.
struct BenchRow {
  std::string name;
  std::string quantity;
  std::string unit;
  double ours = 0;
  std::optional<double> peer;
  std::string peer_name;
  std::optional<double> aim;
  bool at_most = true;

  bool has_verdict() const { return !!aim; }
  bool ok() const { return !aim || (at_most ? ours <= *aim : ours >= *aim); }
  std::optional<double> ratio() const;
};

/// {"rows": [...]} for machines; what is not there is null, a verdict too.
std::string rows_json(const std::vector<ReproduceRow>& rows);
std::string rows_json(const std::vector<BenchRow>& rows);
/// The same rows as an aligned table for people; a column says "ok", "falls short",
/// "no verdict" or, without an aim, nothing.
std::string rows_table(const std::vector<ReproduceRow>& rows);
std::string rows_table(const std::vector<BenchRow>& rows);
/// The same rows as CSV with a header line.
std::string rows_csv(const std::vector<ReproduceRow>& rows);
std::string rows_csv(const std::vector<BenchRow>& rows);

/// Does no row fall short of its aim?
template <class Row>
bool all_ok(const std::vector<Row>& rows) {
  for (const Row& row : rows)
    if (!row.ok()) return false;
  return true;
}

}  // namespace microswarm
