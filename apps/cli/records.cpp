// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "cli.hpp"
#include "microswarm/experiment/record.hpp"
#include "microswarm/report/run_report.hpp"

namespace microswarm::cli {
namespace {

int replay_command(const std::string& file, bool json, const Context& context) {
  const Record record = read_record(file);
  const ReplayResult result = replay(record, context.stop);
  if (json)
    fmt::print("{}\n", nlohmann::ordered_json{{"identical", result.identical},
                                              {"difference", result.difference},
                                              {"record_hash", record.hash()}}
                           .dump(2));
  else
    fmt::print("{}\n", result.identical ? "identical: record " + record.hash() : result.difference);
  return result.identical ? ok : not_reached;
}

int report_command(const std::string& file, const std::string& out, const std::string& photo,
                   double um_per_px) {
  const Record record = read_record(file);
  ReportOptions options;
  if (!photo.empty()) options = {read_image(photo), um_per_px};
  make_folder(out);
  write_run_report(record, out, options);
  fmt::print("wrote {}/index.html\n", out);
  return ok;
}

}  // namespace

void add_replay(CLI::App& app, Action& action) {
  auto file = std::make_shared<std::string>();
  auto json = std::make_shared<bool>(false);
  CLI::App* cmd =
      app.add_subcommand("replay", "Run a record again and say whether it is identical");
  cmd->add_option("record", *file, "Record (run.h5)")->required();
  cmd->add_flag("--json", *json, "Result for machines");
  cmd->callback([=, &action] {
    action = [=](const Context& context) { return replay_command(*file, *json, context); };
  });
}

void add_report(CLI::App& app, Action& action) {
  auto file = std::make_shared<std::string>();
  auto out = std::make_shared<std::string>("report");
  auto photo = std::make_shared<std::string>();
  auto um_per_px = std::make_shared<double>(1);
  CLI::App* cmd = app.add_subcommand("report", "Draw the pictures and the page of a record");
  cmd->add_option("record", *file, "Record (run.h5)")->required();
  cmd->add_option("--out", *out, "Folder to write into");
  cmd->add_option("--photo", *photo, "Photograph to lay under the pictures");
  cmd->add_option("--um-per-px", *um_per_px, "µm per pixel of the photograph")
      ->check(CLI::Range(1e-6, 1e6));
  cmd->callback([=, &action] {
    action = [=](const Context&) { return report_command(*file, *out, *photo, *um_per_px); };
  });
}

}  // namespace microswarm::cli
