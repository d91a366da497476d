// SPDX-License-Identifier: Apache-2.0
#include "microswarm/sweep/sweep.hpp"

#include <fmt/chrono.h>
#include <unistd.h>

#include <array>
#include <memory>
#include <nlohmann/json.hpp>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/fields/overloaded.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/sweep/export.hpp"
#include "microswarm/sweep/same_runs.hpp"
#include "microswarm/sweep/summary.hpp"
#include "support/options.hpp"

namespace microswarm::cli {
namespace {

using Json = nlohmann::ordered_json;

struct SweepOptions {
  std::string sweep;
  std::string out;
  std::string csv;
  int jobs = 0;
  bool json = false;
};

/// Progress with rate and remaining time: a bar on a terminal, otherwise, as under mpirun,
/// occasional lines.
class Meter {
 public:
  explicit Meter(bool lines) : lines_(lines), bar_("sweep") {}

  void show(const sweep::SweepProgress& p) {
    const auto now = Stop::Clock::now();
    if (now - shown_ < std::chrono::milliseconds(500) && p.left > 0) return;
    shown_ = now;
    const double seconds = std::chrono::duration<double>(now - began_).count();
    const double rate = static_cast<double>(p.added) / std::max(seconds, 1e-3);
    const std::string done = fmt::format("{} of {} trials, {:.3g}/s", p.before + p.added,
                                         p.before + p.added + p.left, rate);
    bar_.update(static_cast<double>(p.added) /
                    static_cast<double>(std::max<std::size_t>(1, p.added + p.left)),
                done);
    if (!lines_ || now - written_ < std::chrono::seconds(30)) return;
    written_ = now;
    note("sweep: {}, {:.0f} s left\n", done, static_cast<double>(p.left) / std::max(rate, 1e-6));
  }

 private:
  bool lines_;
  ProgressBar bar_;
  Stop::Clock::time_point began_ = Stop::Clock::now(), shown_{}, written_ = began_;
};

sweep::SweepOrigin origin() {
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  return {host.data(), fmt::format("{:%Y-%m-%d %H:%M:%S}", fmt::gmtime(std::time(nullptr)))};
}

Json to_json(const sweep::SqlValue& value) {
  return std::visit(Overloaded{[](std::monostate) { return Json(nullptr); },
                               [](const OneOf<std::int64_t, double, std::string> auto& held) {
                                 return Json(held);
                               }},
                    value);
}

Json to_json(const sweep::SweepReader& sweep, const sweep::CellSummary& cell) {
  Json parameters = Json::object(), medians = Json::object();
  std::size_t next = 0;
  for (const sweep::SweepColumn& column : sweep.columns()) {
    if (column.role == sweep::SweepColumn::Role::parameter && next < cell.parameters.size())
      parameters[column.name] = to_json(cell.parameters[next++]);
    if (const auto found = cell.medians.find(column.name); found != cell.medians.end())
      medians[column.name] = found->second;
  }
  return {{"cell", cell.cell},        {"method", cell.method},
          {"parameters", parameters}, {"trials", cell.trials},
          {"arrived", cell.arrived},  {"share_arrived", cell.share_arrived()},
          {"status", cell.endings},   {"medians", medians}};
}

using Lines = std::vector<std::vector<std::string>>;

/// Columns with minimum widths, text left-aligned, numbers right-aligned.
std::string aligned(const Lines& lines) {
  std::vector<std::size_t> widths(lines.front().size());
  for (const auto& line : lines)
    for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
  std::string text;
  for (const auto& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i) {
      const bool is_number = parse_number(lines.back()[i]).has_value() || lines.back()[i] == "-";
      text += is_number ? fmt::format("{:>{}}  ", line[i], widths[i])
                        : fmt::format("{:<{}}  ", line[i], widths[i]);
    }
    text.erase(text.find_last_not_of(' ') + 1) += '\n';
  }
  return text;
}

std::string table(const sweep::SweepReader& sweep, const std::vector<sweep::CellSummary>& cells) {
  Lines lines(1);
  for (const sweep::SweepColumn& column : sweep.columns())
    if (column.role == sweep::SweepColumn::Role::parameter) lines[0].push_back(column.name);
  for (const char* name :
       {"method", "trials", "arrived_%", "time_s", "length_um", "planning_mean_ms"})
    lines[0].emplace_back(name);
  for (const sweep::CellSummary& cell : cells) {
    if (cell.trials == 0) continue;
    std::vector<std::string> line;
    for (const sweep::SqlValue& value : cell.parameters) {
      const auto* text = std::get_if<std::string>(&value);
      line.push_back(text ? *text : to_json(value).dump());
    }
    line.insert(line.end(), {cell.method, std::to_string(cell.trials),
                             fmt::format("{:.1f}", 100 * cell.share_arrived())});
    const auto add = [&](const char* name, double factor) {
      const auto found = cell.medians.find(name);
      line.push_back(found == cell.medians.end() ? "-"
                                                 : fmt::format("{:.5g}", factor * found->second));
    };
    add("time_s", 1), add("length_um", 1), add("planning_mean_s", 1e3);
    lines.push_back(std::move(line));
  }
  return aligned(lines);
}

/// Prints what is in the database, and whether trials are the same run; `notes` are those on the
/// plan.
void tell(const SweepOptions& o, const sweep::SweepProgress& progress, Notes notes) {
  const sweep::SweepReader sweep(o.out);
  const std::vector<sweep::CellSummary> cells = summarise(sweep);
  if (!o.csv.empty()) write_file_atomically(o.csv, sweep::sweep_csv(sweep));
  const std::size_t there = progress.before + progress.added;
  sweep::SameRuns runs(sweep.columns());
  sweep.each_row([&](std::span<const sweep::SqlValue> row) { runs.add(row); });
  if (const std::string same = runs.note(); !same.empty()) {
    note("note: {}\n", same);
    notes.push_back(same);
  }
  if (o.json) {
    Json list = Json::array();
    for (const sweep::CellSummary& cell : cells) list.push_back(to_json(sweep, cell));
    print("{}\n", Json{{"database", o.out},
                       {"trials", there},
                       {"added", progress.added},
                       {"left", progress.left},
                       {"cells", list},
                       {"notes", notes}}
                      .dump(2));
    return;
  }
  print("{}medians are of the trials that arrived\n", table(sweep, cells));
  print("{} of {} trials are in {}, {} of them new{}\n", there, there + progress.left, o.out,
        progress.added, progress.left > 0 ? "; the same command resumes it" : "");
}

int sweep_command(SweepOptions o, const Context& context) {
  const sweep::Ranks ranks;
  if (o.jobs == 0 && ranks.count() > 1) o.jobs = 1;
  if (ranks.rank() > 0) {
    sweep::run_sweep_worker(ranks, o.sweep, o.jobs, context.stop);
    return ok;  // mpirun ends all if one fails; rank 0 reports the result
  }
  sweep::RemoteWorkers workers(ranks);
  const std::filesystem::path file = o.sweep;
  const sweep::SweepPlan plan = sweep::load_sweep(file, o.jobs, context.stop);
  note_each(plan.notes);
  check(plan, o.jobs, context.stop);
  if (context.stop()) return not_reached;
  if (o.out.empty()) o.out = file.stem().string() + ".db";
  keep_input(o.out, o.sweep);
  keep_input(o.csv, o.sweep);
  keep_input(o.csv, o.out);
  const std::filesystem::path folder = std::filesystem::path(o.out).parent_path();
  if (!folder.empty()) make_folder(folder.string());
  sweep::SweepProgress progress;
  {
    sweep::SweepDatabase database(o.out, plan, origin());
    Meter meter(ranks.count() > 1);
    progress = sweep::run_sweep(
        plan, database, workers,
        {.jobs = o.jobs, .progress = [&](const sweep::SweepProgress& p) { meter.show(p); }},
        context.stop);
  }
  tell(o, progress, plan.notes);
  flush_output();
  return progress.left == 0 ? ok : not_reached;
}

}  // namespace

void add_sweep(Command app, Action& action) {
  auto o = std::make_shared<SweepOptions>();
  Command cmd = app.add_command(
      "sweep",
      "Run trials for all combinations of parameters and methods of a scenario, into a database",
      "sweep scenarios/sweeps/first_flight.yaml --out out/first_flight.db");
  cmd.add_option("sweep", o->sweep, "Sweep file (YAML); `schema sweep --keys` lists its keys")
      .required()
      .type_name("FILE")
      .input("sweeps");
  cmd.add_option("--out", o->out, "SQLite database; an interrupted sweep is resumed")
      .type_name("FILE")
      .default_text("sweep name with .db");
  cmd.add_option("--jobs", o->jobs, "Number of threads")
      .type_name("NUMBER")
      .default_text("one per core, under mpirun one per rank")
      .check(whole(0, 1024));
  cmd.add_option("--csv", o->csv, "Also write the table of trials to this CSV file")
      .type_name("FILE");
  add_json(cmd, o->json);
  cmd.callback([o, &action] {
    action = [o](const Context& context) { return sweep_command(*o, context); };
  });
}

}  // namespace microswarm::cli
