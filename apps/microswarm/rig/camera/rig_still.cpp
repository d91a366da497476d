// SPDX-License-Identifier: Apache-2.0
// `rig still` stores a picture of a camera, unprocessed.
#include <memory>

#include "microswarm/core/errors/error.hpp"
#include "rig/camera/still.hpp"
#include "rig/rig.hpp"
#include "support/options.hpp"

namespace microswarm::cli {
namespace {

struct StillOptions {
  std::string camera;
  std::string rig;
  std::vector<std::string> settings;
  std::string out = "still.png";
};

int still(const StillOptions& o) {
  if (!is_camera(o.camera)) throw InputError(o.camera + ": is no " + camera_names);
  keep_input(o.out, o.rig);
  const formats::Image picture = take_picture(o.camera, find_camera(o.camera, o.rig, o.settings));
  formats::write_png(o.out, picture);
  print("wrote {}: {} × {} px, {}\n", o.out, picture.width, picture.height,
        picture.channels == 1 ? "grey" : "in colours");
  return ok;
}

}  // namespace

void add_rig_still(Command rig, Action& action) {
  auto o = std::make_shared<StillOptions>();
  Command cmd =
      rig.add_command("still", "Store a picture of a camera as it comes, as a PNG",
                      "rig still /dev/video0 --rig scenarios/rigs/bench.yaml --out empty.png");
  cmd.add_option("camera", o->camera, "Camera such as /dev/video0 or genicam:ID")
      .required()
      .type_name("FILE");
  cmd.add_option("--rig", o->rig, "Use the camera's settings of this rig (YAML)")
      .type_name("FILE")
      .input("rigs");
  add_settings(cmd, o->settings, "Override a setting, e.g. exposure_ms=5",
               type_of<vision::CameraParams>);
  cmd.add_option("--out", o->out, "File to write (PNG)")
      .type_name("FILE")
      .check(file_kind({".png"}));
  cmd.callback([o, &action] { action = [o](const Context&) { return still(*o); }; });
}

}  // namespace microswarm::cli
