// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace microswarm::report {

/// One value of a paper and ours. `paper` is empty if the paper gives no value, `ours` if it is
/// undefined (a median over no trials), `aim` if there is none, for which `note` gives the reason.
/// `at_most` selects whether `aim` is an upper or a lower bound. An empty `ours` never meets an
/// aim. A row that is not `judged` keeps its aim but has no verdict: too few trials, or the run was
/// interrupted.
struct ReproduceRow {
  std::string figure{};
  std::string quantity{};
  std::string unit{};
  std::optional<double> paper{};
  std::optional<double> ours{};
  std::optional<double> aim{};
  bool at_most = true;
  std::string note{};
  bool judged = true;

  bool has_verdict() const { return aim && judged; }
  /// False only if a judged row misses its aim.
  bool ok() const { return !has_verdict() || (ours && (at_most ? *ours <= *aim : *ours >= *aim)); }
};

/// One measured speed and that of a peer in the same run. `ratio` is peer ÷ ours for times and ours
/// ÷ peer for rates: values above 1 mean that ours is faster. A row is ok if it is at least as good
/// as both its peer and its aim, as far as it has them.
struct BenchRow {
  std::string name{};
  std::string quantity{};
  std::string unit{};
  double ours = 0;
  std::optional<double> peer{};
  std::string peer_name{};
  std::optional<double> aim{};
  bool at_most = true;  ///< true for a time, false for a rate

  bool has_verdict() const { return aim || peer; }
  bool ok() const { return (!aim || reaches(*aim)) && (!peer || reaches(*peer)); }
  /// Ratio to the peer, above 1 if ours is better; nothing without a peer.
  std::optional<double> ratio() const;

 private:
  bool reaches(double value) const { return at_most ? ours <= value : ours >= value; }
};

/// The rows as JSON, {"rows": [...]}; missing values and verdicts are null.
std::string rows_json(const std::vector<ReproduceRow>& rows);
std::string rows_json(const std::vector<BenchRow>& rows);
/// The rows as an aligned text table. A column says "ok", "falls short", "no verdict" or, without
/// an aim, nothing.
std::string rows_table(const std::vector<ReproduceRow>& rows);
std::string rows_table(const std::vector<BenchRow>& rows);
/// The rows as CSV with a header line.
std::string rows_csv(const std::vector<ReproduceRow>& rows);
std::string rows_csv(const std::vector<BenchRow>& rows);

/// Whether every row is ok.
template <class Row>
bool all_ok(const std::vector<Row>& rows) {
  for (const Row& row : rows)
    if (!row.ok()) return false;
  return true;
}

}  // namespace microswarm::report
