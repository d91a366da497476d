// SPDX-License-Identifier: Apache-2.0
#include "microswarm/sweep/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "microswarm/core/error.hpp"
#include "microswarm/sweep/crew.hpp"

namespace microswarm {
namespace {

using MessageKind = SweepMessage::Kind;

constexpr std::chrono::milliseconds alone_patience{50};  // then Ctrl-C is looked for
constexpr std::chrono::milliseconds rank_patience{1};    // then messages are

void append(std::vector<SweepRow>& rows, std::vector<SweepRow> more) {
  rows.insert(rows.end(), std::make_move_iterator(more.begin()),
              std::make_move_iterator(more.end()));
}

/// Puts rows into the database, all that have gathered at a time. After a transaction it rests for
/// as long as that took, so that others can read.
class RowWriter {
 public:
  explicit RowWriter(SweepDatabase& database) : database_(database) {}

  void add(std::vector<SweepRow> rows) { append(rows_, std::move(rows)); }
  bool waits() const { return !rows_.empty(); }
  /// The number of rows written: none, or all.
  std::size_t write_when_due() { return waits() && Stop::Clock::now() >= due_ ? write() : 0; }
  std::size_t write() {
    const auto began = Stop::Clock::now();
    database_.add(rows_);
    const auto ended = Stop::Clock::now();
    due_ = ended + (ended - began);
    return std::exchange(rows_, {}).size();
  }

 private:
  SweepDatabase& database_;
  std::vector<SweepRow> rows_;
  Stop::Clock::time_point due_{};
};

}  // namespace

SweepHelpers::SweepHelpers(const Ranks& ranks) : ranks_(ranks), at_work_(ranks.count() - 1) {}

SweepHelpers::~SweepHelpers() {
  try {
    send_home();
  } catch (const std::exception&) {  // the error that led here is told by who sees it
  }
}

void SweepHelpers::hear(int from, SweepMessage message, const std::string& plan_hash) {
  switch (message.kind) {
    case MessageKind::ready:
      if (message.text == plan_hash)
        wanted_[from] += message.want;
      else
        failure_ = fmt::format("rank {} has read other files than rank 0", from);
      return;
    case MessageKind::failed:
      failure_ = fmt::format("rank {}: {}", from, message.text);
      return;
    case MessageKind::rows:
      wanted_[from] += message.want;
      return append(rows_, std::move(message.rows));
    case MessageKind::stopped:
      stopped_ = true;
      return;
    case MessageKind::done:
      --at_work_;
      return;
    default:
      return;
  }
}

std::vector<SweepRow> SweepHelpers::take(const std::string& plan_hash) {
  while (auto message = ranks_.receive())
    hear(message->from, message_of(message->bytes), plan_hash);
  if (!failure_.empty()) throw InputError(failure_);
  return std::exchange(rows_, {});
}

void SweepHelpers::feed(const std::function<std::vector<SweepTask>(std::size_t)>& next) {
  for (auto& [rank, wanted] : wanted_) {
    if (wanted == 0) continue;
    const std::vector<SweepTask> tasks = next(wanted);
    if (tasks.empty()) return;
    ranks_.send(rank,
                to_bytes({.kind = MessageKind::tasks, .text = {}, .tasks = tasks, .rows = {}}));
    wanted -= tasks.size();
  }
}

std::vector<SweepRow> SweepHelpers::send_home() {
  if (at_work_ == 0) return {};
  for (int rank = 1; rank < ranks_.count(); ++rank)
    ranks_.send(rank, to_bytes({.kind = MessageKind::over, .text = {}, .tasks = {}, .rows = {}}));
  while (at_work_ > 0) {  // ends: each says done once, or mpirun ends all
    if (auto message = ranks_.receive())
      hear(message->from, message_of(message->bytes), "");
    else
      std::this_thread::sleep_for(rank_patience);
  }
  return std::exchange(rows_, {});
}

SweepProgress run_sweep(const SweepPlan& plan, SweepDatabase& database, SweepHelpers& helpers,
                        const SweepOptions& options, const Stop& stop) {
  const std::vector<SweepTask> tasks = database.missing();
  const std::size_t all = plan.cells.size() * static_cast<std::size_t>(plan.sweep.trials);
  SweepProgress progress{all - tasks.size(), 0, tasks.size()};
  std::size_t begun = 0;
  const auto next = [&](std::size_t most) {
    const std::size_t n = std::min(most, tasks.size() - begun);
    const auto first = tasks.begin() + static_cast<std::ptrdiff_t>(std::exchange(begun, begun + n));
    return std::vector<SweepTask>(first, first + static_cast<std::ptrdiff_t>(n));
  };
  RowWriter writer(database);
  const std::string hash = plan.hash();
  {
    SweepCrew crew(plan, options.jobs);
    while (progress.left > 0 && !stop() && !helpers.stopped()) {
      writer.add(helpers.take(hash));
      helpers.feed(next);
      if (crew.room() > 0) crew.give(next(crew.room()));
      const bool busy = helpers.any() || writer.waits();
      writer.add(crew.take(busy ? rank_patience : alone_patience));
      const std::size_t written = writer.write_when_due();
      progress.added += written;
      progress.left -= written;
      if (options.progress) options.progress(progress);
    }
    writer.add(crew.take(std::chrono::milliseconds(0)));
  }
  writer.add(helpers.send_home());
  const std::size_t written = writer.write();
  progress.added += written;
  progress.left -= written;
  if (options.progress) options.progress(progress);
  return progress;
}

void help_sweep(const Ranks& ranks, const std::filesystem::path& file, int jobs, const Stop& stop) {
  const auto say = [&](const SweepMessage& message) { ranks.send(0, to_bytes(message)); };
  const auto say_word = [&](MessageKind kind, const std::string& text) {
    say({.kind = kind, .text = text, .tasks = {}, .rows = {}});
  };
  SweepPlan plan;
  std::unique_ptr<SweepCrew> crew;
  const auto attempt = [&](auto action) {
    try {
      action();
    } catch (const std::exception& error) {
      crew.reset();
      say_word(MessageKind::failed, error.what());
    }
  };
  std::size_t asked = 0;
  const auto want = [&] {  // what there is room for and not asked for yet
    const std::size_t more = crew->room() > asked ? crew->room() - asked : 0;
    asked += more;
    return static_cast<std::uint32_t>(more);
  };
  attempt([&] {
    plan = load_sweep(file, jobs);
    crew = std::make_unique<SweepCrew>(plan, jobs);
    say({.kind = MessageKind::ready, .text = plan.hash(), .want = want(), .tasks = {}, .rows = {}});
  });
  for (bool over = false, stopped = false; !over;) {
    if (stop() && !std::exchange(stopped, true)) say_word(MessageKind::stopped, "");
    std::vector<SweepRow> rows;
    attempt([&] { rows = crew ? crew->take(rank_patience) : std::vector<SweepRow>(); });
    if (!rows.empty())
      say({.kind = MessageKind::rows,
           .text = {},
           .want = want(),
           .tasks = {},
           .rows = std::move(rows)});
    const auto message = ranks.receive();
    if (!message && !crew) std::this_thread::sleep_for(rank_patience);
    if (!message) continue;
    const SweepMessage order = message_of(message->bytes);
    over = order.kind == MessageKind::over;
    if (!crew) continue;
    crew->give(order.tasks);
    asked -= order.tasks.size();
  }
  crew.reset();
  say_word(MessageKind::done, "");
}

}  // namespace microswarm
