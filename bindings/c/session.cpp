// SPDX-License-Identifier: Apache-2.0
// Experiments, and navigators in the caller's loop.
#include <algorithm>

#include <nlohmann/json.hpp>

#include "handles.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/experiment/results/metrics_json.hpp"

using namespace microswarm;

namespace {

std::unique_ptr<c::Object> of(std::unique_ptr<experiment::Session> session) {
  auto object = std::make_unique<c::Object>();
  object->session = std::move(session);
  return object;
}

const nlohmann::ordered_json* member(const nlohmann::ordered_json& value, std::string_view name) {
  if (!value.is_object()) return nullptr;
  const auto found = value.find(std::string(name));
  return found == value.end() ? nullptr : &*found;
}

InputError no_metric(std::string_view name, const experiment::Metrics& metrics) {
  std::vector<std::string> names;
  const nlohmann::ordered_json all = experiment::metrics_json(metrics);
  for (const auto& [key, value] : all.items()) names.push_back(key);
  const std::string_view near =
      nearest_word(name, std::vector<std::string_view>(names.begin(), names.end()));
  return InputError("there is no metric " + quote(name) +
                    (near.empty() ? "" : ", did you mean " + quote(near) + "?"));
}

std::unique_ptr<c::Object> of(std::unique_ptr<experiment::StandaloneNavigator> navigator) {
  auto object = std::make_unique<c::Object>();
  object->navigator = std::move(navigator);
  return object;
}

experiment::Experiment open_given(const char* text, const char* folder, const char* const* settings,
                                  std::size_t count) {
  c::require(text, "text");
  return experiment::open_experiment_text(text, "scenario", folder ? folder : "",
                                          c::to_settings(settings, count));
}

experiment::Experiment open_given(const ms_scenario& given) {
  if (given.text) return open_given(given.text, given.folder, given.settings, given.setting_count);
  return experiment::open_experiment(given.file,
                                     c::to_settings(given.settings, given.setting_count));
}

void require_one_source(const ms_scenario* given) {
  c::require(given, "scenario");
  if (!given->file == !given->text)
    throw c::BadCall{"either file or text of the scenario must be null"};
}

ms_frame frame_for_c(const experiment::Frame& frame) {
  return {.t_s = frame.t,
          .x_um = frame.pose.position.x,
          .y_um = frame.pose.position.y,
          .heading_rad = frame.pose.heading,
          .radius_um = frame.radius,
          .speed_um_per_s = frame.speed,
          .command_heading_rad = frame.command.heading,
          .command_speed_um_per_s = frame.command.speed,
          .goal_distance_um = frame.goal_distance,
          .wall_clearance_um = frame.wall_clearance,
          .obstacle_clearance_um = frame.obstacle_clearance,
          .avoidance_cost = frame.avoidance_cost,
          .target_x_um = frame.target ? frame.target->x : c::not_there,
          .target_y_um = frame.target ? frame.target->y : c::not_there,
          .state = static_cast<int32_t>(frame.state),
          .planned = frame.planned};
}

/// Positions x0, y0, x1, ... of a caller.
std::vector<Vec2> positions(const double* xy, std::size_t count, const char* name) {
  if (count > 0) c::require(xy, name);
  constexpr std::size_t most = 10'000'000;
  if (count > most) throw InputError(std::string(name) + " has more than 1e7 places");
  std::vector<Vec2> all;
  all.reserve(count);
  for (std::size_t i = 0; i < count; ++i) all.push_back({xy[2 * i], xy[2 * i + 1]});
  return all;
}

experiment::ExternalObservation to_observation(const ms_observation& seen) {
  experiment::ExternalObservation given{
      .now = seen.now_s, .seen = seen.seen_s, .are_numbered = seen.numbered != 0};
  if (seen.has_swarm) given.swarm = {{{seen.x_um, seen.y_um}, seen.heading_rad}, seen.radius_um};
  if (seen.obstacle_count > 0) c::require(seen.obstacles, "obstacles");
  for (std::size_t i = 0; i < std::min<std::size_t>(seen.obstacle_count, 1'000'000); ++i) {
    const ms_obstacle& one = seen.obstacles[i];
    if (given.are_numbered && one.number < 0)
      throw InputError("the number of an obstacle is " + std::to_string(one.number) +
                       ", must be 0 or more");
    Body body{.shape = Disc{{one.x_um, one.y_um}, one.radius_um},
              .obstacle = static_cast<std::uint32_t>(one.number)};
    if (one.outline_um)
      body.shape = Polygon{positions(one.outline_um, one.points, "outline_um"), {}};
    given.obstacles.push_back(std::move(body));
  }
  given.robots = positions(seen.robots_um, seen.robot_count, "robots_um");
  given.unseen = seen.unseen;
  return given;
}

}  // namespace

int32_t ms_session_open(const char* file, const char* const* settings, size_t count,
                        uint64_t* session) {
  return c::guarded([&]() -> int32_t {
    c::require(file, "file"), c::require(session, "session");
    *session = c::keep(of(experiment::open_session(file, c::to_settings(settings, count))));
    return MS_OK;
  });
}

int32_t ms_session_open_text(const char* text, const char* folder, const char* const* settings,
                             size_t count, uint64_t* session) {
  return c::guarded([&]() -> int32_t {
    c::require(session, "session");
    *session = c::keep(
        of(std::make_unique<experiment::Session>(open_given(text, folder, settings, count))));
    return MS_OK;
  });
}

int32_t ms_session_open_trial(const ms_scenario* scenario, uint64_t* session) {
  return c::guarded([&]() -> int32_t {
    require_one_source(scenario), c::require(session, "session");
    if (scenario->file)
      *session = c::keep(of(experiment::open_session(
          scenario->file, c::to_settings(scenario->settings, scenario->setting_count),
          {.trial = scenario->trial})));
    else
      *session = c::keep(of(std::make_unique<experiment::Session>(
          open_given(*scenario), experiment::SessionParts{.trial = scenario->trial})));
    return MS_OK;
  });
}

int32_t ms_session_step(uint64_t handle, ms_frame* frame) {
  return c::with_session(handle, [&](experiment::Session& session, c::Object& object) -> int32_t {
    const experiment::Tick* tick = session.step(Stop(&object.stops));
    if (!tick) return MS_END;
    object.frame = tick->frame;
    if (frame) *frame = frame_for_c(tick->frame);
    return MS_OK;
  });
}

int32_t ms_session_finish(uint64_t handle) {
  return c::with_session(handle, [&](experiment::Session& session, c::Object& object) -> int32_t {
    const bool stopped = session.finish(Stop(&object.stops)).status == Status::stopped;
    if (!session.record().frames.empty()) object.frame = session.record().frames.back();
    return stopped ? c::fail(MS_STOPPED, "the run was stopped") : MS_OK;
  });
}

int32_t ms_session_set(uint64_t handle, const char* key, const char* value) {
  return c::with_session(handle, [&](experiment::Session& session, c::Object&) -> int32_t {
    c::require(key, "key"), c::require(value, "value");
    const Issues issues = session.set(key, value);
    return issues.empty() ? MS_OK : c::fail(MS_BAD_INPUT, issues);
  });
}

int32_t ms_session_status(uint64_t handle, const char** status) {
  return c::with_session(handle, [&](experiment::Session& session, c::Object&) -> int32_t {
    c::require(status, "status");
    *status = to_string(session.result().status).data();
    return MS_OK;
  });
}

int32_t ms_session_metrics(uint64_t handle, const char** json) {
  return c::with_session(handle, [&](experiment::Session& session, c::Object& object) -> int32_t {
    c::require(json, "json");
    object.text = experiment::metrics_json_with_former_names(session.result().metrics).dump();
    *json = object.text.c_str();
    return MS_OK;
  });
}

int32_t ms_session_metric(uint64_t handle, const char* name, double* value) {
  return c::with_session(handle, [&](experiment::Session& session, c::Object&) -> int32_t {
    c::require(name, "name"), c::require(value, "value");
    const nlohmann::ordered_json all =
        experiment::metrics_json_with_former_names(session.result().metrics);
    const std::string_view asked = name;
    const std::size_t dot = asked.find('.');  // of a former name: "walls.clearance_um"
    const nlohmann::ordered_json* here = member(all, asked.substr(0, dot));
    if (here && dot != asked.npos) here = member(*here, asked.substr(dot + 1));
    if (!here || here->is_object()) throw no_metric(asked, session.result().metrics);
    *value = here->is_number() ? here->get<double>() : infinity;  // null: no obstacle came near
    return MS_OK;
  });
}

int32_t ms_session_robots(uint64_t handle, const double** xy_um, size_t* count) {
  return c::with_session(handle, [&](experiment::Session& session, c::Object& object) {
    return c::show(object, session.view().robots, xy_um, count);
  });
}

int32_t ms_session_path(uint64_t handle, const double** xy_um, size_t* count) {
  return c::with_session(handle, [&](experiment::Session& session, c::Object& object) {
    return c::show(object, session.view().path, xy_um, count);
  });
}

int32_t ms_session_obstacles(uint64_t handle, const double** xyr_um, size_t* count) {
  return c::with_session(handle, [&](experiment::Session& session, c::Object& object) -> int32_t {
    c::require(xyr_um, "xyr_um"), c::require(count, "count");
    object.numbers.clear();
    for (const Body& body : session.view().bodies) {
      const Disc disc = enclosing_disc(body);
      object.numbers.insert(object.numbers.end(), {disc.centre.x, disc.centre.y, disc.radius});
    }
    *count = object.numbers.size() / 3;
    *xyr_um = *count > 0 ? object.numbers.data() : nullptr;
    return MS_OK;
  });
}

int32_t ms_session_frames(uint64_t handle, const ms_frame** frames, size_t* count) {
  return c::with_session(handle, [&](experiment::Session& session, c::Object& object) -> int32_t {
    c::require(frames, "frames"), c::require(count, "count");
    const std::vector<experiment::Frame>& all = session.record().frames;
    object.frames.resize(all.size());
    std::transform(all.begin(), all.end(), object.frames.begin(), frame_for_c);
    *count = object.frames.size();
    *frames = object.frames.empty() ? nullptr : object.frames.data();
    return MS_OK;
  });
}

int32_t ms_session_hash(uint64_t handle, const char** hash) {
  return c::with_session(handle, [&](experiment::Session& session, c::Object& object) -> int32_t {
    c::require(hash, "hash");
    object.text = session.record().hash();
    *hash = object.text.c_str();
    return MS_OK;
  });
}

int32_t ms_session_record(uint64_t handle, const char* file) {
  return c::with_session(handle, [&](experiment::Session& session, c::Object&) -> int32_t {
    c::require(file, "file");
    session.record_to(file);
    return MS_OK;
  });
}

int32_t ms_navigator_open(const char* file, const char* const* settings, size_t count,
                          uint64_t* navigator) {
  return c::guarded([&]() -> int32_t {
    c::require(file, "file"), c::require(navigator, "navigator");
    *navigator = c::keep(of(std::make_unique<experiment::StandaloneNavigator>(
        experiment::open_experiment(file, c::to_settings(settings, count)))));
    return MS_OK;
  });
}

int32_t ms_navigator_open_text(const char* text, const char* folder, const char* const* settings,
                               size_t count, uint64_t* navigator) {
  return c::guarded([&]() -> int32_t {
    c::require(navigator, "navigator");
    *navigator = c::keep(of(std::make_unique<experiment::StandaloneNavigator>(
        open_given(text, folder, settings, count))));
    return MS_OK;
  });
}

int32_t ms_navigator_open_trial(const ms_scenario* scenario, uint64_t* navigator) {
  return c::guarded([&]() -> int32_t {
    require_one_source(scenario), c::require(navigator, "navigator");
    *navigator = c::keep(of(
        std::make_unique<experiment::StandaloneNavigator>(open_given(*scenario), scenario->trial)));
    return MS_OK;
  });
}

int32_t ms_navigator_step(uint64_t handle, const ms_observation* seen, ms_command* command) {
  return c::with_navigator(
      handle, [&](experiment::StandaloneNavigator& navigator, c::Object& object) -> int32_t {
        c::require(seen, "seen"), c::require(command, "command");
        const Command made = navigator.step(to_observation(*seen), Stop(&object.stops));
        const NavigatorView view = navigator.view();
        *command = {.heading_rad = made.heading,
                    .speed_um_per_s = made.speed,
                    .target_x_um = view.local_target ? view.local_target->x : c::not_there,
                    .target_y_um = view.local_target ? view.local_target->y : c::not_there,
                    .state = static_cast<int32_t>(view.state),
                    .planned = view.planned};
        return object.stops.exchange(false) ? c::fail(MS_STOPPED, "the navigator was stopped")
                                            : MS_OK;
      });
}

int32_t ms_navigator_path(uint64_t handle, const double** xy_um, size_t* count) {
  return c::with_navigator(handle,
                           [&](experiment::StandaloneNavigator& navigator, c::Object& object) {
                             return c::show(object, navigator.view().path, xy_um, count);
                           });
}
