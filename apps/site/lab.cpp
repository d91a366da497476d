// SPDX-License-Identifier: Apache-2.0
// The lab's sessions in WebAssembly: what web/src/site/module.ts calls. A text is given in the
// buffer and taken from the result; a message of a session is handed to `post`.
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "lab/sessions/session_thread.hpp"
#include "microswarm/core/errors/error.hpp"

namespace microswarm::site {
/// Given by the page.
[[clang::import_module("lab"), clang::import_name("post")]] void post(std::uint32_t session,
                                                                      const char* bytes,
                                                                      std::size_t size);

namespace {

/// State that lives as long as the module.
struct Lab {
  std::map<std::uint32_t, std::unique_ptr<lab::SessionThread>> sessions;
  std::string buffer;
  std::string result;
};
Lab& the_lab() {
  static Lab only;
  return only;
}

std::unique_ptr<experiment::Session> open_file(const std::filesystem::path& file,
                                               const rig::RigSessionOptions& options) {
  return experiment::open_session(file, options.settings);
}

}  // namespace

#define MICROSWARM_EXPORT(name) [[clang::export_name(#name)]]

/// Memory for a text of this size, valid until the next call.
MICROSWARM_EXPORT(buffer) char* buffer(std::size_t size) {
  the_lab().buffer.resize(size);
  return the_lab().buffer.data();
}

MICROSWARM_EXPORT(result) const char* result() { return the_lab().result.data(); }
MICROSWARM_EXPORT(result_size) std::size_t result_size() { return the_lab().result.size(); }

/// Opens the session that the buffer asks for, {"file": …, "settings": […]}; false with the trouble
/// as result.
MICROSWARM_EXPORT(open) bool open(std::uint32_t number) {
  Lab& lab = the_lab();
  lab.result.clear();
  try {
    const lab::OpenRequest asked = lab::read_open_request(lab.buffer);
    lab::Opening opening{.file = asked.file.value_or("")};
    opening.options.settings = Settings(asked.settings, "");
    auto made = std::make_unique<lab::SessionThread>(
        std::move(opening),
        lab::Host::Callbacks{.opened = [&lab](const std::string& trouble) { lab.result = trouble; },
                             .send =
                                 [number](std::uint64_t, const lab::MessagePtr& message) {
                                   post(number, message->bytes.data(), message->bytes.size());
                                 }},
        open_file);
    if (lab.result.empty()) lab.sessions[number] = std::move(made);
  } catch (const std::exception& error) {
    lab.result = error.what();
  }
  return lab.result.empty();
}

/// Sends the whole state.
MICROSWARM_EXPORT(join) void join(std::uint32_t session) {
  the_lab().sessions.at(session)->join(0);
}

/// Hands the request in the buffer to a session.
MICROSWARM_EXPORT(ask) void ask(std::uint32_t session) {
  Lab& lab = the_lab();
  try {
    lab.sessions.at(session)->ask(0, lab::read_request(lab.buffer));
  } catch (const InputError& error) {
    const auto answer = lab::answer_message(lab::id_in(lab.buffer), error.issues());
    post(session, answer->bytes.data(), answer->bytes.size());
  }
}

/// Does what is due; returns the time until the next turn [ms], -1 if only a request makes one
/// necessary.
MICROSWARM_EXPORT(turn) double turn(std::uint32_t session) {
  const auto next = the_lab().sessions.at(session)->turn();
  if (!next) return -1;
  return std::max(0.0,
                  std::chrono::duration<double, std::milli>(*next - Stop::Clock::now()).count());
}

MICROSWARM_EXPORT(close) void close(std::uint32_t session) { the_lab().sessions.erase(session); }

/// Makes a file of a session, named by the buffer: record.h5 or scenario.yaml. False with the
/// trouble as result.
MICROSWARM_EXPORT(make) bool make(std::uint32_t session) {
  Lab& lab = the_lab();
  lab.result = "this run has ended";
  bool is_made = false;
  try {
    lab.sessions.at(session)->with([&](const experiment::Session& of) {
      try {  // a trouble here is none of the run
        lab.result = lab.buffer == "record.h5"
                         ? experiment::record_bytes(of.record())
                         : experiment::scenario_text(of.record().scene.scenario);
        is_made = true;
      } catch (const std::exception& error) {
        lab.result = error.what();
      }
    });
    lab.sessions.at(session)->turn();
  } catch (const std::exception& error) {
    lab.result = error.what();
  }
  return is_made;
}

/// The hash of the record of a run of the file that the buffer asks for, from start to end.
MICROSWARM_EXPORT(run) bool run() {
  Lab& lab = the_lab();
  try {
    const lab::OpenRequest asked = lab::read_open_request(lab.buffer);
    const auto session =
        experiment::open_session(asked.file.value_or(""), Settings(asked.settings, ""));
    session->finish();
    lab.result = session->record().hash();
  } catch (const std::exception& error) {
    lab.result = error.what();
    return false;
  }
  return true;
}

}  // namespace microswarm::site
