// SPDX-License-Identifier: Apache-2.0
#include "lab/sessions/host.hpp"

#include <unistd.h>

#include <array>

namespace microswarm::lab {

namespace {

/// The file's name from any folder; empty for an empty one.
std::string from_anywhere(const std::filesystem::path& file) {
  if (file.empty()) return "";
  std::array<char, 4096> here{};
  const std::filesystem::path folder = ::getcwd(here.data(), here.size()) ? here.data() : "";
  return (folder / file).lexically_normal().string();
}

}  // namespace

Source to_source(const Opening& opening) {
  return {.file = from_anywhere(opening.file),
          .rig = from_anywhere(opening.options.rig),
          .settings = opening.options.settings.texts(),
          .rig_settings = opening.options.rig_settings.texts(),
          .live = opening.live.has_value(),
          .photo = opening.photo};
}

/// Opens the session and says so.
void Host::start() {
  std::string trouble;
  try {
    open();
  } catch (const std::exception& error) {
    trouble = error.what();
    if (trouble.empty()) trouble = "it cannot be opened";
  }
  if (!trouble.empty()) ends_ = true;
  callbacks_.opened(trouble);
}

void Host::serve_once() {
  try {
    serve();
  } catch (const std::exception& error) {
    fail(error.what());
  }
}

void Host::join(std::uint64_t page) {
  later([this, page] { welcome(page); });
}

void Host::leave(std::uint64_t) {}

void Host::stop(const std::string&) {}

void Host::ask(std::uint64_t page, Request request) {
  later([this, page, request = std::move(request)] { answer(page, request); });
}

void Host::with(std::function<void(experiment::Session&)> work) {
  later([this, work = std::move(work)] { work(session()); });
}

void Host::fail(const std::string& why) {
  Standing& standing = publisher_.standing;
  standing.plays = false;
  standing.ended = true;
  standing.trouble = why;
  publisher_.tell_standing(session());
}

void Host::answer(std::uint64_t page, const Request& request) {
  Issues issues;
  try {
    obey(page, request, issues);
    if (request.ask == Ask::clearance) callbacks_.send(page, clearance_message(session().map()));
  } catch (const InputError& error) {
    issues.add(to_issues(error));
  } catch (const std::exception& error) {
    issues.add(to_issues(error));
  }
  publisher_.changed();
  callbacks_.send(page, answer_message(request.id, issues));
}

void Host::operate(const Request& request, Issues& issues) {
  experiment::Operation* operation = session().operation();
  if (!operation)
    issues.add({}, "a record is not steered");
  else if (request.ask == Ask::hold)
    operation->pause(request.on);
  else if (request.ask == Ask::manual)
    operation->manual(request.on);
  else if (request.ask == Ask::steer)
    operation->steer({.heading = request.heading, .speed = request.speed});
  else
    operation->end();
}

void Host::keep(const experiment::Tick& tick, const experiment::Session& of) {
  kept_.add(tick, of.result().metrics, of.scenario().record.diagnostics);
}

void Host::look_back(double frame, Issues& issues) {
  Standing& standing = publisher_.standing;
  if (frame < 0 || frame > 1e15 || !publisher_.has_rows()) {
    issues.add("number", "there is no such frame");
    return;
  }
  const auto number = static_cast<std::size_t>(frame);
  if (session().is_playback()) {
    session().seek(number);
    standing.ended = false;
  } else {
    if (!past_) {
      experiment::Record record(session().record());
      if (record.diagnostics.empty()) record.diagnostics = kept_.diagnostics();
      past_ = std::make_unique<experiment::Session>(std::move(record));
    }
    past_->seek(number);
    standing.past_metrics = kept_.metrics(past_->view().number);
    standing.decisions_every = kept_.period();
    standing.looks_back = true;
    standing.plays = false;
  }
  publisher_.freshen();
}

void Host::look_at_newest() {
  if (past_) {
    publisher_.freshen();
    publisher_.tell_scenario(session());
  }
  past_.reset();
  publisher_.standing.looks_back = false;
  publisher_.standing.past_metrics.reset();
}

}  // namespace microswarm::lab
