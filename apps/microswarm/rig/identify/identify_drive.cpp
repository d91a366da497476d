// SPDX-License-Identifier: Apache-2.0
#include "rig/identify/identify_drive.hpp"

#include <algorithm>
#include <atomic>
#include <cctype>
#include <utility>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/rig/identify/identify_programme.hpp"
#include "microswarm/rig/session/live_session.hpp"
#include "microswarm/vision/image/threads.hpp"
#include "rig/keys/key_terminal.hpp"
#include "rig/keys/rig_keys.hpp"
#include "rig/rig_notes.hpp"
#include "rig/run/rig_operator.hpp"
#include "rig/run/rig_status.hpp"

namespace microswarm::cli {
namespace {

double usual_speed(const experiment::Scenario& scenario) {
  return scenario.robots ? scenario.robots->max_speed : swarm_limits(scenario.swarm).max_speed;
}

/// Distance from a place to walls and to the edge of the picture [µm].
double free_distance(const rig::LiveSession& live, Vec2 place) {
  const rig::LiveRig& rig = live.live();
  const vision::CameraScale& scale = rig.scale();
  const Vec2 px = scale.to_picture(place);
  const formats::Image& picture = rig.picture();
  const double edge =
      std::min(std::min(px.x, picture.width - 1 - px.x), std::min(px.y, picture.height - 1 - px.y));
  return std::min(live.session().map().clearance(place), edge * scale.um_per_px);
}

/// Steers by a programme.
class ProgrammeDriver {
 public:
  ProgrammeDriver(rig::LiveSession& live, rig::IdentifyPlan plan)
      : live_(live), programme_(std::move(plan)) {
    live_.session().operation()->manual();
    live_.set_field_frequency(programme_.plan().frequency);
  }
  /// Steps to the end; false if it did not come to it. A sweep ends where the swarm no longer
  /// follows.
  bool finish(const Stop& stop) {
    experiment::Session& session = live_.session();
    ProgressBar bar("identify");
    std::optional<double> frequency;
    while (session.step(stop)) {
      note_each(live_.take_notes());
      if (done_ || session.tick()->end) continue;
      if (frequency) live_.set_field_frequency(*frequency);
      const auto step = programme_.next(session.tick()->frame.t, place());
      done_ = !step;
      if (done_) session.operation()->end();
      if (!step) continue;
      session.operation()->steer(step->command);
      frequency = step->frequency;
      sweeps_ = step->is_sweep;
      bar.update(programme_.progress(), step->is_sweep ? fmt::format("{:.3g} Hz", step->frequency)
                                                       : std::string("square"));
    }
    if (!done_ && sweeps_ && live_.live().lost_following())
      note("note: the swarm no longer followed at {:.3g} Hz, which ended the sweep\n", *frequency);
    return done_ || (sweeps_ && live_.live().lost_following());
  }

 private:
  std::optional<Vec2> place() const {
    const rig::Detections& seen = live_.live().detections();
    return seen.swarm ? std::optional(seen.swarm->pose.position) : std::nullopt;
  }

  rig::LiveSession& live_;
  rig::IdentifyProgramme programme_;
  bool done_ = false;
  bool sweeps_ = false;
};

/// Plan for the place where the swarm is seen.
rig::IdentifyPlan plan_at(const rig::LiveSession& live, const rig::Rig& rig, double speed,
                          double max_frequency, const IdentifyDrive& drive) {
  const rig::Detections& seen = live.live().detections();
  if (!seen.swarm)
    throw InputError("no swarm is seen at the start of the scenario, see `microswarm rig see`");
  return rig::plan_identification(rig, {.free = free_distance(live, seen.swarm->pose.position),
                                        .radius = seen.swarm->radius,
                                        .speed = speed,
                                        .seconds = drive.seconds,
                                        .max_frequency = max_frequency});
}

/// Steps while a person steers, until `q` or the time.
bool drive_by_hand(rig::LiveSession& live, const std::atomic<bool>& ended, const Stop& stop) {
  RigStatusLine status(live);
  live.session().operation()->manual();
  while (live.session().step(stop)) {
    note_each(live.take_notes());
    status.update();
  }
  return ended;
}

/// Steps the session to its end, with the keys. Returns whether the drive is complete.
bool drive(rig::LiveSession& live, std::optional<rig::IdentifyPlan> plan,
           const IdentifyDrive& drive, const Context& context) {
  RigOperator person(live);
  std::atomic<bool> ended = false;
  const auto press = [&](const Key& key) {
    const bool is_letter = key.kind == Key::Kind::character;
    const int letter = is_letter ? std::tolower(static_cast<unsigned char>(key.character)) : 0;
    if (letter == 'q') ended = true;
    const bool automatic = letter == 'm' || letter == 'p';  // would hand over to the navigator
    if (letter == 'q' || (drive.by_hand && !automatic)) person.press(key);
  };
  const RigKeys keys([&] { live.stop("the emergency key was pressed"); }, press, context.stop);
  note_how_to_stop(keys.are_there(), drive.by_hand
                                         ? "; arrow keys: steer, + and -: speed, q: end and fit"
                                         : "; q: end without a result");
  if (plan) return ProgrammeDriver(live, std::move(*plan)).finish(context.stop) && !ended;
  const Stop timed = context.within(drive.seconds);
  const bool by_key = drive_by_hand(live, ended, timed);
  return by_key || !context.stop();
}

}  // namespace

IdentifyOutcome drive_to_identify(const rig::RigExperiment& on, const IdentifyDrive& o,
                                  const Context& context) {
  if (o.by_hand && !has_keys()) throw InputError("--by-hand: there is no terminal with keys");
  require_person(on.rig, o.coils, false, o.drawn_swarm);
  note_field(on.rig, on.scenario());
  const double max_frequency = o.max_frequency.value_or(rig::largest_frequency(on.rig));
  const double speed = o.speed.value_or(usual_speed(on.scenario()));
  vision::set_picture_threads(1);
  rig::LiveSession live(rig::for_identification(on, max_frequency),
                        {.folder = o.out,
                         .without_limits = o.coils.without_limits,
                         .uncommissioned = true,
                         .coils_cold = o.coils.coils_cold,
                         .note = "rig identify",
                         .seconds = 2 * o.seconds});
  note_each(live.warnings());
  std::optional<rig::IdentifyPlan> plan;
  if (o.by_hand)
    live.set_field_frequency(on.rig.params.field.frequency);
  else
    plan = plan_at(live, on.rig, speed, max_frequency, o);
  if (plan)
    note("a square of {:.0f} µm in both senses, then {:.3g} to {:.3g} Hz: {:.0f} s\n", plan->side(),
         plan->frequencies.front(), plan->frequencies.back(), plan->seconds());
  IdentifyOutcome outcome;
  const bool is_complete = drive(live, std::move(plan), o, context);
  const std::string why = is_complete && live.live().lost_following() ? "" : live.fault();
  const std::string lost = live.close();
  if (!lost.empty()) note("microswarm: {}\n", lost);
  if (!why.empty()) note("microswarm: {}\n", why);
  const bool at_zero = note_zero(live.stop("the drive has ended"));
  if (!is_complete && why.empty()) note("stopped: nothing is written\n");
  outcome.code = !why.empty() || !at_zero ? hardware : is_complete ? ok : not_reached;
  outcome.record = live.session().record();
  return outcome;
}

}  // namespace microswarm::cli
