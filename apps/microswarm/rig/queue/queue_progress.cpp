// SPDX-License-Identifier: Apache-2.0
#include "rig/queue/queue_progress.hpp"

#include <algorithm>
#include <chrono>

#include "microswarm/core/execution/clock.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm::cli {
namespace {

constexpr double longest_standstill = 600;  // of the queue between runs [s]
constexpr double status_period = 5;         // of the status for the manager [s]

void sleep_seconds(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

}  // namespace

std::string queue_table(const rig::QueueState& state) {
  std::size_t name = 4;
  for (const rig::ItemStatus& item : state.items) name = std::max(name, to_columns(item.name));
  std::string table = fmt::format("{:>4}  {:<{}}  {:>3}  {:<8}  {:>3}  {:>8}  {:>7}  {}\n", "no",
                                  "name", name, "run", "state", "att", "time", "coils", "");
  for (const rig::ItemStatus& item : state.items) {
    const rig::QueueAttempt* const last = item.attempts.empty() ? nullptr : &item.attempts.back();
    std::string note = item.note;
    if (last && note.empty()) note = last->reason.empty() ? last->status : last->reason;
    const std::string heat = last && last->max_temperature
                                 ? fmt::format("{:.1f} °C", *last->max_temperature)
                                 : std::string();
    table += fmt::format(
        "{:>4}  {}{:<{}}  {:>3}  {:<8}  {:>3}  {:>8}  {:>7}  {}\n", item.number, item.name, "",
        name - to_columns(item.name), item.repetition, enum_name(item.state), item.attempts.size(),
        last ? fmt::format("{:.1f} s", last->seconds) : std::string(), heat, one_line(note, 120));
  }
  return table + fmt::format("{}{}\n", state.active ? "now: " : "", one_line(state.doing, 400));
}

QueueProgress::QueueProgress(ServiceManager& service, const Context& context)
    : service_(service), context_(context), shown_(steady_seconds()), thread_([this] { live(); }) {}

QueueProgress::~QueueProgress() {
  over_ = true;
  thread_.join();
}

void QueueProgress::live() {
  while (!over_) {
    if (steady_seconds() - shown_ < longest_standstill) service_.live();
    sleep_seconds(0.1);
  }
}

void QueueProgress::show(const std::string& doing) {
  shown_ = steady_seconds();
  if (!line_) line_.emplace();
  if (line_->is_there()) line_->show(doing);
  if (doing == doing_ || shown_ < told_ + status_period) return;
  doing_ = doing;
  told_ = shown_;
  service_.status(doing);
}

void QueueProgress::wait(double seconds) {
  shown_ = steady_seconds();
  if (!keys_)
    keys_.emplace([this] { halts_ = true; },
                  [this](const Key& key) {
                    if (key.kind == Key::Kind::character && (key.character | 0x20) == 'q')
                      stops_ = true;
                  },
                  context_.stop);
  const double until = shown_ + seconds;
  while (steady_seconds() < until && !stops() && !halts_)
    sleep_seconds(std::clamp(until - steady_seconds(), 0.0, 0.05));
}

void QueueProgress::begin_run() {
  keys_.reset();
  line_.reset();
  shown_ = steady_seconds();
}

}  // namespace microswarm::cli
