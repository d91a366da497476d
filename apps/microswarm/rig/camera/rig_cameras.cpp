// SPDX-License-Identifier: Apache-2.0
// `rig cameras` lists the connected cameras with their formats.
#include <memory>
#include <nlohmann/json.hpp>

#include "microswarm/vision/camera/camera_list.hpp"
#include "microswarm/vision/camera/genicam_device.hpp"
#include "rig/rig.hpp"
#include "support/options.hpp"

namespace microswarm::cli {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const vision::ListedCamera& camera) {
  Json json{{"device", camera.device}, {"model", camera.model}, {"formats", Json::array()}};
  for (const vision::ListedFormat& format : camera.formats)
    json["formats"].push_back(
        {{"name", format.name}, {"readable", format.readable}, {"sizes", format.sizes}});
  if (!camera.trouble.empty()) json["trouble"] = camera.trouble;
  return json;
}

void tell(const vision::ListedCamera& camera) {
  print("{}  {}\n", camera.device, camera.model);
  if (!camera.trouble.empty()) print("  {}\n", camera.trouble);
  for (const vision::ListedFormat& format : camera.formats)
    print("  {:<10} {}{}\n", format.name, format.sizes, format.readable ? "" : "  (not read)");
}

int cameras(bool as_json) {
  const std::vector<vision::ListedCamera> list = vision::list_cameras();
  if (as_json) {
    Json json{{"genicam", vision::has_genicam()}, {"cameras", Json::array()}};
    for (const vision::ListedCamera& camera : list) json["cameras"].push_back(to_json(camera));
    print("{}\n", json.dump(2));
    return ok;
  }
  for (const vision::ListedCamera& camera : list) tell(camera);
  if (list.empty()) print("no camera was found\n");
  if (!vision::has_genicam()) note("note: this build has no GenICam cameras\n");
  return ok;
}

}  // namespace

void add_rig_cameras(Command rig, Action& action) {
  auto as_json = std::make_shared<bool>(false);
  Command cmd = rig.add_command(
      "cameras", "List the cameras of V4L2 and GenICam, their formats and sizes", "rig cameras");
  add_json(cmd, *as_json);
  cmd.callback(
      [as_json, &action] { action = [as_json](const Context&) { return cameras(*as_json); }; });
}

}  // namespace microswarm::cli
