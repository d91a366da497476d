// SPDX-License-Identifier: Apache-2.0
#include "lab/stream/publisher.hpp"

#include <algorithm>

namespace microswarm::lab {
namespace {

const AggregationDiagnostics* aggregation_diagnostics(const experiment::Session& shown) {
  return std::get_if<AggregationDiagnostics>(&shown.diagnostics());
}

/// Adds a change KEY=VALUE in place of an earlier one of the key.
void note_change(Standing& standing, const std::string& change) {
  const std::string key = change.substr(0, change.find('=') + 1);
  std::erase_if(standing.changes, [&](const std::string& one) { return one.starts_with(key); });
  standing.changes.push_back(change);
}

}  // namespace

void Publisher::add(const Row& row) {
  standing.steered |= row.state == NavigatorState::manual || row.state == NavigatorState::paused;
  rows_.push_back(row);
}

void Publisher::clear() {
  rows_.clear();
  events_.clear();
  changes_ = 0;
  told_rows_ = told_events_ = 0;
  told_plans_ = 0;
  told_changes_.reset();
  told_nodes_.clear();
  standing = {.speed = standing.speed};
  is_fresh_ = true;
}

void Publisher::take(const experiment::Record& record) {
  take_more(record);
  told_rows_ = rows_.size();
  told_events_ = events_.size();
}

void Publisher::take_more(const experiment::Record& record) {
  const auto& steps = record.result.timing.steps;
  for (std::size_t i = rows_.size(); i < record.frames.size(); ++i)
    add(to_row({.frame = record.frames[i], .step_time = i < steps.size() ? steps[i] : 0}));
  for (std::size_t i = events_.size(); i < record.events.size(); ++i)
    events_.push_back(record.events[i]);
  for (; changes_ < record.changes.size(); ++changes_)
    note_change(standing, record.changes[changes_].setting);
  standing.frames = record.frames.size();
}

void Publisher::take(const experiment::Tick& tick) {
  add(to_row(tick));
  events_.insert(events_.end(), tick.events.begin(), tick.events.end());
  standing.frames = rows_.size();
  is_fresh_ = true;
}

void Publisher::welcome(std::uint64_t page, const MessagePtr& hello, experiment::Session& session,
                        const experiment::Session& shown, const experiment::SessionView& view) {
  tell_rows();
  send_(page, hello);
  send_(page, rows_message(rows_, events_, true));
  if (shown.is_playback()) send_(page, scenario_message(shown.scenario()));
  if (!view.tree.empty()) send_(page, plan_message(view));
  // A record without diagnostics keeps no regions: those of now are the newest known.
  const auto* past = aggregation_diagnostics(shown);
  if (const auto* plan = past ? past : aggregation_diagnostics(session))
    send_(page, aggregation_message(*plan));
  standing.frame = view.number;
  send_(page, frame_message(view, shown.diagnostics()));
  send_(page, standing_message(standing, session.result()));
}

void Publisher::set(experiment::Session& session, const Request& request, Issues& issues) {
  issues = session.set(request.key, request.value);
  if (!issues.empty()) return;
  note_change(standing, request.key + "=" + request.value);
  tell_standing(session);  // first, so that a page with the new scenario also has the changes
  send_(0, scenario_message(session.scenario()));
  is_fresh_ = true;
}

void Publisher::tell_frame(const experiment::Session& shown, const experiment::SessionView& view) {
  is_fresh_ = false;
  has_changed_ = true;
  published_ = Stop::Clock::now();
  tell_rows();
  tell_scenario(shown, view.number);
  if (view.plans != told_plans_) send_(0, plan_message(view));
  told_plans_ = view.plans;
  if (const auto* plan = aggregation_diagnostics(shown); plan && plan->nodes != told_nodes_) {
    send_(0, aggregation_message(*plan));
    told_nodes_ = plan->nodes;
  }
  standing.frame = view.number;
  send_(0, frame_message(view, shown.diagnostics()));
}

void Publisher::tell_scenario(const experiment::Session& shown, std::uint64_t frame) {
  std::optional<std::size_t> changes;
  if (shown.is_playback())
    changes = std::ranges::count_if(shown.record().changes,
                                    [&](const auto& change) { return change.frame <= frame; });
  if (changes != told_changes_) send_(0, scenario_message(shown.scenario()));
  told_changes_ = changes;
}

void Publisher::tell_rows() {
  if (told_rows_ == rows_.size() && told_events_ == events_.size()) return;
  send_(0, rows_message(std::span(rows_).subspan(told_rows_),
                        std::span(events_).subspan(told_events_), false));
  told_rows_ = rows_.size();
  told_events_ = events_.size();
}

void Publisher::tell_standing(experiment::Session& session) {
  has_changed_ = false;
  if (const experiment::Operation* operation = session.operation())
    standing.mode = operation->mode();
  send_(0, standing_message(standing, session.result()));
}

}  // namespace microswarm::lab
