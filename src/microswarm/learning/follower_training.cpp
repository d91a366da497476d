// SPDX-License-Identifier: Apache-2.0
#include "microswarm/learning/follower_training.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "microswarm/config/write.hpp"
#include "microswarm/core/execution/parallel.hpp"
#include "microswarm/core/maths/statistics.hpp"
#include "microswarm/learning/fit.hpp"
#include "microswarm/navigation/following/follower_model.hpp"

namespace microswarm::learning {
namespace {

constexpr std::uint32_t held_out = 10;  // every tenth run

/// Demonstrations, split into training and held-out ones.
struct Collected {
  std::vector<Demonstration> learned, held_out;
};

/// Completed work, in runs and in examples passed through the network.
class Work {
 public:
  Work(const FollowerTrainingParams& p, const TrainingOptions& options) : options_(options) {
    for (int round = 0; round <= p.rounds; ++round)
      total_ += p.runs * run_cost + fit_cost(p, round) * iterations(p, round);
  }
  static int iterations(const FollowerTrainingParams& p, int round) {
    return round == p.rounds ? p.last_iterations : p.iterations;
  }
  void add(double cost, const std::string& what) {
    done_ += cost;
    if (options_.progress) options_.progress(std::min(1.0, done_ / total_), what);
  }
  /// Cost of one iteration.
  static double fit_cost(const FollowerTrainingParams& p, int round) {
    return examples_of_run * p.runs * (round + 1) * example_cost;
  }
  static constexpr double run_cost = 15e-3;  // [s], approximate

 private:
  static constexpr double examples_of_run = 150;
  static constexpr double example_cost = 4e-6;  // [s], approximate
  const TrainingOptions& options_;
  double total_ = 0, done_ = 0;
};

void collect(const FollowerTrainingParams& p, int round,
             const std::shared_ptr<const navigation::FollowerModel>& student,
             const TrainingOptions& options, Work& work, const Stop& stop, Collected& all) {
  std::vector<std::vector<Demonstration>> runs(static_cast<std::size_t>(p.runs));
  const auto first = static_cast<std::uint32_t>(round * p.runs);
  std::mutex telling;
  for_each_index(runs.size(), options.jobs, [&](std::size_t i) {
    if (stop()) return;
    const FollowerTask task = follower_task(p.tasks, p.seed, first + static_cast<std::uint32_t>(i));
    runs[i] = demonstrate(task, student, stop);
    const std::lock_guard lock(telling);
    work.add(Work::run_cost,
             student ? fmt::format("round {}: student drives", round) : "expert drives");
  });
  for (std::size_t i = 0; i < runs.size(); ++i) {
    auto& to = i % held_out == held_out - 1 ? all.held_out : all.learned;
    to.insert(to.end(), runs[i].begin(), runs[i].end());
  }
}

/// Sets the range of each feature: between two extreme quantiles, slightly extended.
void set_ranges(navigation::FollowerModel& model, const std::vector<Demonstration>& shown) {
  constexpr double rare = 5e-4;
  constexpr double beyond = 0.05;
  std::vector<double> values(shown.size());
  for (std::size_t f = 0; f < navigation::feature_count; ++f) {
    std::transform(shown.begin(), shown.end(), values.begin(),
                   [f](const Demonstration& d) { return d.features[f]; });
    const double lo = quantile(values, rare), hi = quantile(values, 1 - rare);
    const double more = std::max(1e-6, beyond * (hi - lo));
    model.lowest[f] = lo - more;
    model.highest[f] = hi + more;
  }
}

/// The demonstrations within the ranges, scaled for the network.
Examples to_examples(const navigation::FollowerModel& model,
                     const std::vector<Demonstration>& shown) {
  Examples examples{.in = navigation::feature_count, .out = 2, .inputs = {}, .answers = {}};
  examples.inputs.reserve(shown.size() * navigation::feature_count);
  examples.answers.reserve(shown.size() * 2);
  for (const Demonstration& d : shown) {
    const auto scaled = model.scaled(d.features);
    if (!scaled) continue;
    examples.inputs.insert(examples.inputs.end(), scaled->begin(), scaled->end());
    examples.answers.insert(examples.answers.end(), d.answer.begin(), d.answer.end());
  }
  return examples;
}

double mean_error(const navigation::MultilayerPerceptron& network, const Examples& examples,
                  int jobs) {
  std::vector<double> unused;
  return std::sqrt(loss_with_gradient(network, examples, unused, jobs) / 2);
}

}  // namespace

TrainedFollower train_follower(const FollowerTrainingParams& p, const TrainingOptions& options,
                               const Stop& stop) {
  Work work(p, options);
  Collected all;
  TrainedFollower trained;
  std::shared_ptr<const navigation::FollowerModel> student;
  for (int round = 0; round <= p.rounds && !stop(); ++round) {
    collect(p, round, student, options, work, stop, all);
    navigation::FollowerModel model{
        .seed = p.seed, .training = json_line(type_of<FollowerTrainingParams>(), Unit::none, &p)};
    set_ranges(model, all.learned);
    const Examples examples = to_examples(model, all.learned);
    const auto hidden = static_cast<std::size_t>(p.hidden);
    Rng rng(p.seed, Purpose::learning, ~0U);
    const auto tell = [&](int) {
      work.add(Work::fit_cost(p, round),
               fmt::format("round {}: fits {} ticks", round, examples.count()));
    };
    model.network = fit({navigation::feature_count, hidden, hidden, 2}, examples,
                        {.iterations = Work::iterations(p, round),
                         .decay = p.decay,
                         .jobs = options.jobs,
                         .progress = tell},
                        rng, stop);
    trained.demonstrations = all.learned.size() + all.held_out.size();
    trained.training_error = mean_error(model.network, examples, options.jobs);
    trained.held_out_error =
        mean_error(model.network, to_examples(model, all.held_out), options.jobs);
    student = std::make_shared<const navigation::FollowerModel>(std::move(model));
  }
  if (student) trained.model = *student;
  trained.finished = !stop();
  return trained;
}

}  // namespace microswarm::learning
