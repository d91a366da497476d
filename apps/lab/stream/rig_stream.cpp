// SPDX-License-Identifier: Apache-2.0
#include "lab/stream/rig_stream.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "microswarm/formats/images/jpeg.hpp"

namespace microswarm::lab {
namespace {

using Json = nlohmann::json;

Json optional(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

Json list(const Eigen::VectorXd& values) {
  Json json = Json::array();
  for (const double value : values) json.push_back(value);
  return json;
}

Json quantiles_ms(const Durations& d) {
  Json json = Json::array();
  for (const double q : {0.5, 0.95, 0.99}) json.push_back(1e3 * d.quantile(q));
  return json;
}

/// Reduces a picture by averaging squares of `factor` pixels.
formats::Image shrunk(const formats::Image& picture, int factor) {
  formats::Image small{.width = picture.width / factor, .height = picture.height / factor};
  small.pixels.resize(small.index(0, small.height));
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x) {
      int sum = 0;
      for (int dy = 0; dy < factor; ++dy)
        for (int dx = 0; dx < factor; ++dx)
          sum += picture.pixels[picture.index(x * factor + dx, y * factor + dy)];
      small.pixels[small.index(x, y)] = static_cast<std::uint8_t>(sum / (factor * factor));
    }
  return small;
}

void add_run(Json& json, const rig::LiveSession& run) {
  const rig::LiveStatus status = run.status();
  const rig::RigTiming timing = run.live().timing();
  const actuation::CoilOutput& output = status.coils.output;
  json["t_s"] = status.t;
  json["field_mt"] = {output.wanted.x(), output.wanted.y(), output.wanted.z()};
  json["currents_a"] = list(output.acknowledged.size() > 0 ? output.acknowledged : output.currents);
  json["temperatures_c"] = list(output.temperatures);
  json["scale"] = status.coils.scale;
  json["device_scale"] = output.device_scale;
  json["sight"] = status.not_found ? enum_name(*status.not_found) : "";
  json["robots"] = status.robots;
  json["unseen"] = status.unseen;
  json["gap_um"] = std::isfinite(status.gap) ? Json(status.gap) : Json();
  json["speed_um_per_s"] = status.command_speed;
  json["latency_ms"] = {{"frame_age", quantiles_ms(timing.frame_age)},
                        {"vision", quantiles_ms(timing.vision)},
                        {"tick", quantiles_ms(timing.tick)},
                        {"camera_to_current", quantiles_ms(timing.camera_to_current)},
                        {"coil_late", quantiles_ms(timing.coil_late)},
                        {"round_trip", quantiles_ms(timing.round_trip)}};
  json["ticks"] = timing.tick.count();
  json["missed_deadlines"] = timing.missed_deadlines;
  json["late_currents"] = timing.late_currents;
  json["frames"] = timing.frames;
  json["dropped_frames"] = timing.dropped_frames;
  json["frame_gaps"] = timing.frame_gaps;
  json["unseen_frames"] = timing.unseen_frames;
  json["resumed"] = timing.resumed;
  json["limited"] = timing.limited;
  json["weakened"] = timing.scaled;
}

}  // namespace

MessagePtr rig_hello_message(const experiment::Session& session, const Source& source,
                             const rig::Rig& rig, const std::vector<std::string>& warnings) {
  Json json = hello_json(session, source);
  Json currents = Json::array(), temperatures = Json::array();
  for (const actuation::AmplifierParams& amplifier : rig.system.amplifiers()) {
    currents.push_back(optional(amplifier.max_current));
    temperatures.push_back(optional(amplifier.max_temperature));
  }
  json["rig_info"] = {{"name", rig::rig_name(rig)},
                      {"coils", rig.system.coil_names()},
                      {"real_coils", rig::has_coil_device(rig)},
                      {"real_camera", rig::device_camera(rig.params).has_value()},
                      {"max_current_a", std::move(currents)},
                      {"max_temperature_c", std::move(temperatures)},
                      {"field_mt", rig.params.field.amplitude},
                      {"warnings", warnings}};
  return make_message(json, Message::Kind::hello);
}

MessagePtr rig_message(const RigStanding& standing, const rig::LiveSession* run) {
  Json json{{"type", "rig"},
            {"state", enum_name(standing.state)},
            {"why", standing.why},
            {"zero_confirmed", Json()},
            {"stop_trouble", standing.zero ? standing.zero->trouble : ""},
            {"folder", standing.folder}};
  if (standing.zero) json["zero_confirmed"] = standing.zero->confirmed;
  if (run) add_run(json, *run);
  return make_message(json, Message::Kind::rig);
}

MessagePtr controls_message(bool holds, bool are_free, std::size_t pages) {
  return make_message(
      {{"type", "controls"}, {"holds", holds}, {"free", are_free}, {"pages", pages}});
}

MessagePtr picture_message(const formats::Image& picture, const vision::CameraScale& scale,
                           double t) {
  constexpr int widest = 1280;
  constexpr int quality = 80;
  const int factor = (picture.width + widest - 1) / widest;
  const formats::Image shown = factor > 1 ? shrunk(picture, factor) : picture;
  const auto position = [&](int column, int row) {
    const double middle = 0.5 * (factor - 1);
    return scale.to_world({column * factor + middle, row * factor + middle});
  };
  const Vec2 o = position(0, 0);
  const Vec2 u = position(1, 0) - o;
  const Vec2 v = position(0, 1) - o;
  const std::string jpeg = formats::encode_jpeg(shown, quality);
  return make_message({{"type", "picture"},
                       {"t_s", t},
                       {"width", shown.width},
                       {"height", shown.height},
                       {"to_um", {u.x, v.x, o.x, u.y, v.y, o.y}},
                       {"jpeg", Json::binary({jpeg.begin(), jpeg.end()})}},
                      Message::Kind::picture);
}

}  // namespace microswarm::lab
