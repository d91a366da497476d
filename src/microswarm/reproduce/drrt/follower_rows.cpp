// SPDX-License-Identifier: Apache-2.0
#include "microswarm/reproduce/drrt/follower_rows.hpp"

#include <array>

#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/io/columns.hpp"
#include "microswarm/report/plot.hpp"
#include "microswarm/reproduce/reproduce.hpp"

namespace microswarm::reproduce {
namespace {

/// One value for each path that was followed to its end.
template <class Value>
std::vector<double> collect_values(const learning::FollowerOutcome& outcome, Value&& value) {
  std::vector<double> values;
  values.reserve(outcome.paths.size());
  for (const learning::FollowedPath& path : outcome.paths)
    if (path.arrived) values.push_back(value(path));
  return values;
}

double rms_off(const learning::FollowedPath& p) { return p.rms_off; }
double turning(const learning::FollowedPath& p) { return degrees(p.field_turning); }
double relative_time(const learning::FollowedPath& p) { return 100 * p.time / p.fair_time; }

double arrived_share(const learning::FollowerOutcome& o) {
  return 100 * static_cast<double>(collect_values(o, rms_off).size()) /
         std::max<double>(1, static_cast<double>(o.paths.size()));
}

/// A path of a follower as in follower.csv.
struct FollowerRow {
  std::string follower;
  std::uint64_t task = 0;
  learning::FollowedPath path;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.follower, plain("follower", "Follower."));
    visit(self.task, plain("task", "Number of the task."));
    learning::FollowedPath::fields(self.path, visit);
  }
};

}  // namespace

std::vector<report::ReproduceRow> follower_rows(
    const std::vector<learning::FollowerOutcome>& outcomes) {
  std::vector<report::ReproduceRow> rows;
  const auto row = [&](std::string what, const char* unit, double ours,
                       std::optional<double> aim = {}, bool at_most = true) {
    rows.push_back(make_row("follower", std::move(what), unit, {}, ours, aim, at_most));
  };
  for (const learning::FollowerOutcome& o : outcomes) {
    const bool learned = o.name == "learned";
    row(o.name + ": arrived", "%", arrived_share(o), learned ? std::optional(100.0) : std::nullopt,
        false);
    row(o.name + ": RMS off the path, median", "µm", median(collect_values(o, rms_off)));
    row(o.name + ": RMS off the path, mean", "µm", mean(collect_values(o, rms_off)));
    row(o.name + ": most off the path, p95", "µm",
        quantile(collect_values(o, [](const learning::FollowedPath& p) { return p.max_off; }),
                 0.95));
    row(o.name + ": turning of the field, median", "°/s", median(collect_values(o, turning)));
    row(o.name + ": time beside way ÷ speed, median", "%",
        median(collect_values(o, relative_time)));
  }
  const auto off = [&](std::size_t i) { return mean(collect_values(outcomes[i], rms_off)); };
  row("learned nearer to the path than pure pursuit", "%", 100 * (1 - off(2) / off(0)), 20, false);
  row("learned nearer than pure pursuit against the flow", "%", 100 * (1 - off(2) / off(1)), 0,
      false);
  row("learned: steps handed over, mean", "%",
      100 * mean(collect_values(outcomes[2],
                                [](const learning::FollowedPath& p) { return p.fallback_share; })));
  return rows;
}

std::string follower_csv(const std::vector<learning::FollowerOutcome>& outcomes) {
  std::vector<FollowerRow> rows;
  for (const learning::FollowerOutcome& o : outcomes)
    for (std::size_t i = 0; i < o.paths.size(); ++i) rows.push_back({o.name, i, o.paths[i]});
  return io::csv_table(rows);
}

void write_follower_figures(const std::vector<learning::FollowerOutcome>& outcomes,
                            const learning::ComparisonOptions& options,
                            const std::filesystem::path& folder) {
  write_file_atomically(folder / "follower.csv", follower_csv(outcomes));
  const std::array<const char*, 4> names{"pursuit", "+ flow", "learned", "expert"};
  std::vector<report::Plot> boxes{{.title = "Off the path, RMS", .y_label = "µm", .y_min = 0},
                                  {.title = "Turning of the field", .y_label = "°/s", .y_min = 0},
                                  {.title = "Time beside way ÷ speed", .y_label = "%"}};
  const std::array<double (*)(const learning::FollowedPath&), 3> values{rms_off, turning,
                                                                        relative_time};
  for (std::size_t i = 0; i < outcomes.size(); ++i)
    for (std::size_t k = 0; k < boxes.size(); ++k) {
      std::vector<double> y = collect_values(outcomes[i], values[k]);
      std::vector<double> x(y.size(), static_cast<double>(i + 1));
      boxes[k].series.push_back({names[i], std::move(x), std::move(y), report::PlotStyle::box});
    }
  report::Plot trace{.title = "On one of the paths",
                     .x_label = "t (s)",
                     .y_label = "off the path (µm)",
                     .key_below = true};
  for (const learning::FollowerTrace& follower :
       learning::follow_one(options, learning::first_unseen_task)) {
    report::Series series{.label = follower.name, .x = {}, .y = follower.off};
    series.x.reserve(series.y.size());
    for (std::size_t i = 0; i < series.y.size(); ++i)
      series.x.push_back(0.1 * static_cast<double>(i));
    trace.series.push_back(std::move(series));
  }
  for (const char* kind : {".png", ".svg", ".pdf"}) {
    report::write_plots(boxes, folder / (std::string("follower") + kind));
    report::write_plots({trace}, folder / (std::string("follower-trace") + kind));
  }
}

std::vector<learning::FollowerOutcome> compare_with_progress(learning::ComparisonOptions options,
                                                             const BeginProgress& progress,
                                                             const Stop& stop) {
  const Progress bar(progress, "compare");
  options.progress = [&](double share) { bar.update(share); };
  return learning::compare_followers(options, stop);
}

}  // namespace microswarm::reproduce
