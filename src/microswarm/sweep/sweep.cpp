// SPDX-License-Identifier: Apache-2.0
#include "microswarm/sweep/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/sweep/worker_pool.hpp"

namespace microswarm::sweep {
namespace {

using MessageKind = SweepMessage::Kind;

constexpr std::chrono::milliseconds alone_poll_timeout{50};  // then checks for Ctrl-C
constexpr std::chrono::milliseconds rank_poll_timeout{1};    // then checks for messages

void append(std::vector<SweepRow>& rows, std::vector<SweepRow> more) {
  rows.insert(rows.end(), std::make_move_iterator(more.begin()),
              std::make_move_iterator(more.end()));
}

/// Adds rows to the store in batches. After a transaction it pauses for as long as the
/// transaction took, so that others can read.
class RowWriter {
 public:
  explicit RowWriter(SweepStore& store) : store_(store) {}

  void add(std::vector<SweepRow> rows) { append(rows_, std::move(rows)); }
  bool waits() const { return !rows_.empty(); }
  /// The number of rows written: none, or all.
  std::size_t write_when_due() { return waits() && Stop::Clock::now() >= due_ ? write() : 0; }
  std::size_t write() {
    const auto began = Stop::Clock::now();
    store_.add(rows_);
    const auto ended = Stop::Clock::now();
    due_ = ended + (ended - began);
    return std::exchange(rows_, {}).size();
  }

 private:
  SweepStore& store_;
  std::vector<SweepRow> rows_;
  Stop::Clock::time_point due_{};
};

}  // namespace

RemoteWorkers::RemoteWorkers(const Ranks& ranks) : ranks_(ranks), at_work_(ranks.count() - 1) {}

RemoteWorkers::~RemoteWorkers() {
  try {
    shutdown();
  } catch (const std::exception&) {  // the error that led here is reported elsewhere
  }
}

void RemoteWorkers::handle(int from, SweepMessage message, const std::string& plan_hash) {
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
    case MessageKind::tasks:  // sent by rank 0 only
    case MessageKind::over:
      return;
  }
}

std::vector<SweepRow> RemoteWorkers::take(const std::string& plan_hash) {
  while (auto message = ranks_.receive())
    handle(message->from, parse_message(message->bytes), plan_hash);
  if (!failure_.empty()) throw InputError(failure_);
  return std::exchange(rows_, {});
}

void RemoteWorkers::dispatch(const std::function<std::vector<SweepTask>(std::size_t)>& next) {
  for (auto& [rank, wanted] : wanted_) {
    if (wanted == 0) continue;
    const std::vector<SweepTask> tasks = next(wanted);
    if (tasks.empty()) return;
    ranks_.send(rank,
                to_bytes({.kind = MessageKind::tasks, .text = {}, .tasks = tasks, .rows = {}}));
    wanted -= tasks.size();
  }
}

std::vector<SweepRow> RemoteWorkers::shutdown() {
  if (at_work_ == 0) return {};
  for (int rank = 1; rank < ranks_.count(); ++rank)
    ranks_.send(rank, to_bytes({.kind = MessageKind::over, .text = {}, .tasks = {}, .rows = {}}));
  while (at_work_ > 0) {  // ends: each worker sends done once, or mpirun aborts
    if (auto message = ranks_.receive())
      handle(message->from, parse_message(message->bytes), "");
    else
      std::this_thread::sleep_for(rank_poll_timeout);
  }
  return std::exchange(rows_, {});
}

SweepProgress run_sweep(const SweepPlan& plan, SweepStore& store, RemoteWorkers& workers,
                        const SweepOptions& options, const Stop& stop) {
  const std::vector<SweepTask> tasks = store.missing();
  const std::size_t all = plan.cells.size() * static_cast<std::size_t>(plan.sweep.trials);
  SweepProgress progress{all - tasks.size(), 0, tasks.size()};
  std::size_t begun = 0;
  const auto next = [&](std::size_t most) {
    const std::size_t n = std::min(most, tasks.size() - begun);
    const auto first = tasks.begin() + static_cast<std::ptrdiff_t>(std::exchange(begun, begun + n));
    return std::vector<SweepTask>(first, first + static_cast<std::ptrdiff_t>(n));
  };
  RowWriter writer(store);
  const std::string hash = plan.hash();
  {
    WorkerPool pool(plan, options.jobs);
    while (progress.left > 0 && !stop() && !workers.stopped()) {
      writer.add(workers.take(hash));
      workers.dispatch(next);
      if (pool.room() > 0) pool.give(next(pool.room()));
      const bool busy = workers.any() || writer.waits();
      writer.add(pool.take(busy ? rank_poll_timeout : alone_poll_timeout));
      const std::size_t written = writer.write_when_due();
      progress.added += written;
      progress.left -= written;
      if (options.progress) options.progress(progress);
    }
    writer.add(pool.take(std::chrono::milliseconds(0)));
  }
  writer.add(workers.shutdown());
  const std::size_t written = writer.write();
  progress.added += written;
  progress.left -= written;
  if (options.progress) options.progress(progress);
  return progress;
}

void run_sweep_worker(const Ranks& ranks, const std::filesystem::path& file, int jobs,
                      const Stop& stop) {
  const auto send = [&](const SweepMessage& message) { ranks.send(0, to_bytes(message)); };
  const auto send_kind = [&](MessageKind kind, const std::string& text) {
    send({.kind = kind, .text = text, .tasks = {}, .rows = {}});
  };
  SweepPlan plan;
  std::unique_ptr<WorkerPool> pool;
  const auto attempt = [&](auto action) {
    try {
      action();
    } catch (const std::exception& error) {
      pool.reset();
      send_kind(MessageKind::failed, error.what());
    }
  };
  std::size_t asked = 0;
  const auto want = [&] {  // room for tasks not yet requested
    const std::size_t more = pool->room() > asked ? pool->room() - asked : 0;
    asked += more;
    return static_cast<std::uint32_t>(more);
  };
  attempt([&] {
    plan = load_sweep(file, jobs);
    pool = std::make_unique<WorkerPool>(plan, jobs);
    send(
        {.kind = MessageKind::ready, .text = plan.hash(), .want = want(), .tasks = {}, .rows = {}});
  });
  for (bool over = false, stopped = false; !over;) {
    if (stop() && !std::exchange(stopped, true)) send_kind(MessageKind::stopped, "");
    std::vector<SweepRow> rows;
    attempt([&] { rows = pool ? pool->take(rank_poll_timeout) : std::vector<SweepRow>(); });
    if (!rows.empty())
      send({.kind = MessageKind::rows,
            .text = {},
            .want = want(),
            .tasks = {},
            .rows = std::move(rows)});
    const auto message = ranks.receive();
    if (!message && !pool) std::this_thread::sleep_for(rank_poll_timeout);
    if (!message) continue;
    const SweepMessage order = parse_message(message->bytes);
    over = order.kind == MessageKind::over;
    if (!pool) continue;
    pool->give(order.tasks);
    asked -= order.tasks.size();
  }
  pool.reset();
  send_kind(MessageKind::done, "");
}

}  // namespace microswarm::sweep
