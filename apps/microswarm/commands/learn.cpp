// SPDX-License-Identifier: Apache-2.0
#include <fmt/ranges.h>

#include <filesystem>
#include <memory>

#include "microswarm/config/yaml.hpp"
#include "microswarm/core/maths/hash.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/version.hpp"
#include "microswarm/learning/follower_training.hpp"
#include "microswarm/navigation/following/follower_model.hpp"
#include "microswarm/reproduce/drrt/follower_rows.hpp"
#include "support/cli.hpp"
#include "support/options.hpp"

namespace microswarm::cli {
namespace {

struct LearnOptions {
  std::string out;
  std::vector<std::string> settings;
  int jobs = 0;
  bool quick = false;
  bool json = false;
};

constexpr int tasks = 200;
constexpr int quick_tasks = 40;

learning::FollowerTrainingParams training_params(const LearnOptions& o) {
  learning::FollowerTrainingParams params;
  if (o.quick) {
    params.runs = 20;
    params.rounds = 1;
    params.iterations = params.last_iterations = 60;
  }
  note_each(set_values(params, {o.settings, "--set"}));
  return params;
}

std::string hash_text(const std::string& text) {
  Hash hash;
  hash.text(text);
  return hash.hex();
}

/// The model card.
std::string card(const learning::TrainedFollower& trained, const std::string& model,
                 const LearnOptions& o, const std::vector<report::ReproduceRow>& rows) {
  std::string command = "microswarm learn follower --out DIR";
  if (o.quick) command += " --quick";
  for (const std::string& setting : o.settings) command += " --set " + setting;
  return fmt::format(
      "# Card of follower.yaml\n\n"
      "| | |\n|---|---|\n"
      "| made by | `{}`, microswarm {} |\n"
      "| bytes, fingerprint (FNV-1a) | {}, {} |\n"
      "| seed | {} |\n"
      "| layers | {} |\n"
      "| data | {} ticks at which the expert said what it would command, in simulations of random "
      "paths; every tenth run held out |\n"
      "| error of both answers, RMS | {:.4f} of what it learned from, {:.4f} of what was held out "
      "|\n"
      "| for | a swarm that is a unicycle or goes into any direction at once, at 10 Hz, within the "
      "ranges of the file; outside it hands over to pure pursuit |\n"
      "| not for | avoiding anything: it knows the path only |\n\n"
      "Parameters of the training:\n\n```json\n{}\n```\n\n"
      "On {} paths that it has not seen, beside pure pursuit and the expert:\n\n```text\n{}```\n",
      command, std::string(version), model.size(), hash_text(model), trained.model.seed,
      fmt::join(trained.model.network.layers, "-"), trained.demonstrations, trained.training_error,
      trained.held_out_error, trained.model.training, o.quick ? quick_tasks : tasks,
      report::rows_table(rows));
}

int learn_command(const LearnOptions& o, const Context& context) {
  const learning::FollowerTrainingParams params = training_params(o);
  const OutFolder hold(o.out);
  const std::filesystem::path folder = o.out;
  learning::TrainedFollower trained;
  {
    ProgressBar bar("learn");
    trained = learning::train_follower(
        params,
        {.jobs = o.jobs,
         .progress = [&](double share, const std::string& what) { bar.update(share, what); }},
        context.stop);
  }
  if (!trained.finished) {
    note("interrupted: nothing is written\n");
    return not_reached;
  }
  const std::string model = navigation::follower_model_text(trained.model);
  write_file_atomically(folder / "follower.yaml", model);
  const learning::ComparisonOptions comparison{
      .tasks = o.quick ? quick_tasks : tasks,
      .params = params.tasks,
      .seed = params.seed,
      .model = std::make_shared<const navigation::FollowerModel>(trained.model),
      .jobs = o.jobs,
      .progress = {}};
  const auto outcomes = reproduce::compare_with_progress(comparison, progress_bars(), context.stop);
  if (context.stop.requested()) {
    note("interrupted: follower.yaml is written, and not compared\n");
    return not_reached;
  }
  const auto rows = reproduce::follower_rows(outcomes);
  reproduce::write_follower_figures(outcomes, comparison, folder);
  write_file_atomically(folder / "follower.md", card(trained, model, o, rows));
  if (o.quick) note("quick: less training, fewer paths\n");
  put(o.json ? report::rows_json(rows) : report::rows_table(rows) + aims_met(rows));
  return report::all_ok(rows) ? ok : not_reached;
}

}  // namespace

void add_learn(Command app, Action& action) {
  auto o = std::make_shared<LearnOptions>();
  Command cmd = app.add_group("learn", "Train and compare learned components");
  Command follower =
      cmd.add_command("follower", "Train a path follower from an expert in simulation",
                      "learn follower --out out/follower --set hidden=32");
  follower
      .add_option("--out", o->out,
                  "Folder for follower.yaml, its model card, the comparison and plots")
      .required()
      .type_name("FOLDER");
  add_settings(follower, o->settings, "Override a training parameter, e.g. runs=300",
               type_of<learning::FollowerTrainingParams>);
  follower.add_option("--jobs", o->jobs, "Number of threads")
      .type_name("NUMBER")
      .default_text("one per core")
      .check(whole(1, 1024));
  follower.add_flag("--quick", o->quick, "Less training and fewer paths; takes at most 50 s");
  add_json(follower, o->json);
  follower.callback([o, &action] {
    action = [o](const Context& context) { return learn_command(*o, context); };
  });
}

}  // namespace microswarm::cli
