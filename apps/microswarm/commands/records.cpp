// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <nlohmann/json.hpp>

#include "microswarm/experiment/record/record.hpp"
#include "support/options.hpp"

namespace microswarm::cli {
namespace {

int replay_command(const std::string& file, bool json, const Context& context) {
  const Record record = read_record(file);
  const ReplayResult result = replay(record, context.stop);
  if (json)
    print("{}\n", nlohmann::ordered_json{{"identical", result.identical},
                                         {"stopped", result.stopped},
                                         {"difference", result.difference},
                                         {"record_hash", record.hash()}}
                      .dump(2));
  else if (result.identical)
    print("identical: record {}\n", record.hash());
  else
    print("{}\n", result.stopped ? "stopped" : "differs: " + result.difference);
  return result.identical ? ok : not_reached;
}

int report_command(const std::string& file, const std::string& out, const PhotoOptions& photo) {
  const Record record = read_record(file);
  const ReportOptions options = report_options(photo);
  const OutFolder hold(out);
  write_run_report(record, out, options);
  print("wrote {}/index.html\n", out);
  return ok;
}

}  // namespace

void add_replay(Command app, Action& action) {
  auto file = std::make_shared<std::string>();
  auto json = std::make_shared<bool>(false);
  Command cmd =
      app.add_command("replay", "Run a record again and compare; exit code 3 if it differs",
                      "replay out/first/run.h5");
  cmd.add_option("record", *file, "Record of a run (run.h5)").required().type_name("FILE");
  add_json(cmd, *json);
  cmd.callback([=, &action] {
    action = [=](const Context& context) { return replay_command(*file, *json, context); };
  });
}

void add_report(Command app, Action& action) {
  auto file = std::make_shared<std::string>();
  auto out = std::make_shared<std::string>("report");
  auto photo = std::make_shared<PhotoOptions>();
  Command cmd =
      app.add_command("report", "Write the report of a record: pictures and an HTML page",
                      "report out/first/run.h5 --out out/report --photo photo.jpg --um-per-px 6");
  cmd.add_option("record", *file, "Record of a run (run.h5)").required().type_name("FILE");
  cmd.add_option("--out", *out, "Output folder (default: report)").type_name("FOLDER");
  add_photo(cmd, *photo);
  cmd.callback([=, &action] {
    action = [=](const Context&) { return report_command(*file, *out, *photo); };
  });
}

}  // namespace microswarm::cli
