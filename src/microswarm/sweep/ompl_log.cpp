// SPDX-License-Identifier: Apache-2.0
// The format that ompl::tools::Benchmark writes and ompl_benchmark_statistics.py reads, by the
// grammar of OMPL's page "How to Benchmark Planners"; tests/sweep/ompl_grammar.py checks it.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "microswarm/config/yaml.hpp"
#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/sweep/export.hpp"

namespace microswarm::sweep {
namespace {

using Role = SweepColumn::Role;
using Lines = std::vector<std::string>;

/// A text without spaces, as the grammar requires; `none` for an empty one.
std::string one_word(std::string_view text, std::string_view none) {
  std::string word(text.empty() ? none : text);
  for (char& c : word)
    if (static_cast<unsigned char>(c) <= ' ') c = '_';
  return word;
}

/// A value as one word: "[700,500]".
std::string value_word(std::string_view value) {
  std::string text;
  for (const char c : value)
    if (c != ' ' || text.empty() || text.back() != ',') text += c;
  return one_word(text, "~");
}

/// Name of an experiment's property in SQL, distinct from the columns of every experiment.
std::string property_name(const std::string& column) {
  constexpr std::array<std::string_view, 12> taken{
      "id",      "name",     "totaltime", "timelimit", "memorylimit", "runcount",
      "version", "hostname", "cpuinfo",   "date",      "seed",        "setup"};
  std::string lower = column;
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return std::ranges::find(taken, lower) == taken.end() ? column : "set_" + column;
}

/// Whether values are neither numbers nor true and false.
bool are_words(const SweepParameter& parameter, SweepColumnKind kind) {
  const auto is_word = [](const std::string& v) { return v != "true" && v != "false"; };
  return kind == SweepColumnKind::text && std::ranges::any_of(parameter.values, is_word);
}

/// A grid value as a number: itself, 1 and 0 for true and false, its index for words.
std::string property_value(const SweepParameter& parameter, std::size_t index,
                           SweepColumnKind kind) {
  const std::string& text = parameter.values[index];
  if (kind != SweepColumnKind::text) return number_text(parse_number(text).value_or(0));
  if (are_words(parameter, kind)) return std::to_string(index);
  return text == "true" ? "1" : "0";
}

std::string_view property_type(const SweepParameter& parameter, SweepColumnKind kind) {
  if (kind != SweepColumnKind::text) return enum_name(kind);
  return are_words(parameter, kind) ? "INTEGER" : "BOOLEAN";
}

/// Free text as one line, so that it cannot end its block of the log.
std::string plain_line(std::string_view text) { return one_line(text, 10'000); }

std::string log_number(const SqlValue& value) {
  return std::visit(
      Overloaded{
          [](std::int64_t whole) { return std::to_string(whole); },
          [](double real) { return std::isfinite(real) ? number_text(real) : std::string(); },
          [](const OneOf<std::monostate, std::string> auto&) { return std::string(); }},
      value);
}

std::string log_text(const SqlValue& value) {
  const auto* text = std::get_if<std::string>(&value);
  return text ? *text : log_number(value);
}

/// Words of the column `status`, ordered by their numbers in the log.
Lines statuses() {
  Lines words;
  for (int i = 0; i <= static_cast<int>(Status::fault); ++i)
    words.emplace_back(to_string(static_cast<Status>(i)));
  return words;
}

class LogWriter {
 public:
  explicit LogWriter(const SweepReader& sweep)
      : sweep_(sweep), status_(sweep.column("status")), compute_(sweep.column("compute_s")) {
    const auto& columns = sweep.columns();
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (columns[i].role == Role::parameter) parameters_.push_back(i);
      const bool measured = columns[i].role == Role::metric || columns[i].role == Role::wall_clock;
      if (measured && columns[i].kind != SweepColumnKind::text) properties_.push_back(i);
    }
  }

  /// The log of cells first … first + methods − 1; empty if they have no trials yet.
  std::string log(std::size_t first) const {
    const std::size_t methods = sweep_.sweep().methods.size();
    std::vector<std::vector<std::vector<SqlValue>>> rows(methods);
    double total = 0;
    for (std::size_t i = 0; i < methods; ++i)
      sweep_.each_row(
          [&](std::span<const SqlValue> row) {
            rows[i].emplace_back(row.begin(), row.end());
            if (const auto* seconds = std::get_if<double>(&row[compute_])) total += *seconds;
          },
          first + i);
    std::string planners;
    std::size_t count = 0;
    for (std::size_t i = 0; i < methods; ++i) {
      if (rows[i].empty()) continue;
      planners += planner(sweep_.sweep().methods[i], rows[i]);
      ++count;
    }
    if (count == 0) return {};
    return head(first, total) + fmt::format("{} planners\n", count) + planners;
  }

 private:
  std::string head(std::size_t cell, double total) const {
    const Sweep& sweep = sweep_.sweep();
    const experiment::Scenario scenario = read_yaml_text<experiment::Scenario>(
        sweep_.scenario(cell), sweep_.name() + ", cell's scenario");
    std::string text = fmt::format("microswarm version {}\nExperiment {}\n",
                                   sweep_.about("version"), one_word(sweep.name, "sweep"));
    text += properties_text(cell / sweep.methods.size());
    text += fmt::format("Running on {}\nStarting at {}\n",
                        one_word(sweep_.about("host"), "UNKNOWN"), sweep_.about("begun"));
    text += "<<<|\n" + setup(cell / sweep.methods.size()) + "|>>>\n";
    text += fmt::format("{} is the random seed\n{} seconds per run\n0 MB per run\n",
                        sweep_.about("seed"), number_text(scenario.time_limit));
    text += fmt::format("{} runs per planner\n{} seconds spent to collect the data\n", sweep.trials,
                        number_text(total));
    text += "1 enum type\nstatus";
    for (const std::string& word : statuses()) text += "|" + word;
    return text + "\n";
  }

  /// Indices of the grid's values in their lists.
  std::vector<std::size_t> value_indices(std::size_t combination) const {
    const auto& grid = sweep_.sweep().grid;
    std::vector<std::size_t> indices(grid.size());
    for (std::size_t i = grid.size(); i-- > 0;) {
      indices[i] = combination % grid[i].values.size();
      combination /= grid[i].values.size();
    }
    return indices;
  }

  /// The grid's values as properties of the experiment.
  std::string properties_text(std::size_t combination) const {
    const auto& grid = sweep_.sweep().grid;
    if (grid.empty()) return {};
    const std::vector<std::size_t> indices = value_indices(combination);
    std::string text = fmt::format("{} experiment properties\n", grid.size());
    for (std::size_t i = 0; i < grid.size(); ++i) {
      const SweepColumn& column = sweep_.columns()[parameters_[i]];
      text += fmt::format("{} {} = {}\n", property_name(column.name),
                          property_type(grid[i], column.kind),
                          property_value(grid[i], indices[i], column.kind));
    }
    return text;
  }

  std::string setup(std::size_t combination) const {
    const Sweep& sweep = sweep_.sweep();
    std::string text = fmt::format("scenario: {}\n", plain_line(sweep.scenario));
    if (!sweep.description.empty())
      text += fmt::format("description: {}\n", plain_line(sweep.description));
    for (const std::string& setting : sweep.set)
      text += fmt::format("set: {}\n", plain_line(setting));
    const std::vector<std::size_t> indices = value_indices(combination);
    for (std::size_t i = 0; i < sweep.grid.size(); ++i)
      text += fmt::format("set: {}={}\n", sweep.grid[i].key,
                          plain_line(sweep.grid[i].values[indices[i]]));
    return text;
  }

  std::string planner(const SweepMethod& method,
                      const std::vector<std::vector<SqlValue>>& rows) const {
    std::string text = fmt::format("{}\n{} common properties\n", one_word(method.name, "method"),
                                   method.set.size());
    for (const std::string& setting : method.set) {
      const std::size_t equals = std::min(setting.find('='), setting.size());
      text += fmt::format("{} = {}\n", plain_line(setting.substr(0, equals)),
                          value_word(setting.substr(std::min(equals + 1, setting.size()))));
    }
    text += fmt::format("{} properties for each run\n", properties_.size() + 3);
    text += "solved BOOLEAN\nstatus ENUM\ntime REAL\n";
    for (const std::size_t i : properties_)
      text += fmt::format("{} {}\n", sweep_.columns()[i].name, enum_name(sweep_.columns()[i].kind));
    text += fmt::format("{} runs\n", rows.size());
    const Lines words = statuses();
    for (const std::vector<SqlValue>& row : rows) {
      const std::string status = log_text(row[status_]);
      const auto number = std::find(words.begin(), words.end(), status) - words.begin();
      text += fmt::format("{}; {}; {}; ", status == words[0] ? 1 : 0, number,
                          log_number(row[compute_]));
      for (const std::size_t i : properties_) text += log_number(row[i]) + "; ";
      text += "\n";
    }
    return text + ".\n";
  }

  const SweepReader& sweep_;
  std::size_t status_, compute_;
  std::vector<std::size_t> parameters_, properties_;
};

}  // namespace

std::vector<std::pair<std::string, std::string>> ompl_logs(const SweepReader& sweep) {
  const LogWriter writer(sweep);
  const std::size_t methods = sweep.sweep().methods.size();
  std::vector<std::pair<std::string, std::string>> logs;
  for (std::size_t cell = 0; cell < sweep.cells(); cell += methods)
    if (std::string log = writer.log(cell); !log.empty())
      logs.emplace_back(fmt::format("{:05}.log", cell / methods), std::move(log));
  return logs;
}

}  // namespace microswarm::sweep
