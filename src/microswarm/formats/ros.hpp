// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/formats/images/mask.hpp"

namespace microswarm::formats {

/// Encoding of the occupancy probability in the pixels of a ROS map.
enum class RosMode {
  trinary,  ///< dark is occupied, bright is free, between the thresholds is unknown
  scale,    ///< the same; transparent is unknown. Between the thresholds a cell is neither free nor
            ///< certainly occupied
  raw       ///< the value is a percentage; above 100 is unknown. Not with negate: ROS 1 turns the
            ///< values around, ROS 2 does not
};
constexpr auto enum_names(RosMode) {
  return std::array<std::pair<RosMode, std::string_view>, 3>{
      {{RosMode::trinary, "trinary"}, {RosMode::scale, "scale"}, {RosMode::raw, "raw"}}};
}

/// YAML file of a map of ROS' map_server.
struct RosHeader {
  std::string image{};
  double resolution = 0;
  std::vector<double> origin{0, 0, 0};
  int negate = 0;
  double occupied_thresh = 0.65;
  double free_thresh = 0.196;
  RosMode mode = RosMode::trinary;
  std::vector<std::string> unread{};  ///< keys of others, such as frame_id

  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.image, plain("image", "Image, beside the YAML file.").needed());
    visit(self.resolution, plain("resolution", 1e-9, 1e6, "Side of a pixel [m].").needed());
    visit(self.origin,
          plain("origin", -1e6, 1e6, "Lower left corner: x, y [m], yaw [rad].").needed());
    visit(self.negate, plain("negate", 0, 1, "1: bright pixels are occupied."));
    visit(self.occupied_thresh,
          plain("occupied_thresh", 0, 1, "Probability above which a cell is occupied."));
    visit(self.free_thresh, plain("free_thresh", 0, 1, "Probability below which a cell is free."));
    visit(self.mode, plain("mode", "Interpretation: trinary, scale or raw."));
  }
};

/// Reads the YAML file as nav2 does: the mode in capitals too, `negate` also as true or false, and
/// keys that neither names nor resembles ours are left out (`unread`). Throws InputError
/// "NAME:LINE:COLUMN: WHY", also for negate in the mode raw.
RosHeader read_ros_header(const std::filesystem::path& path);
RosHeader parse_ros_header(std::string_view text, std::string_view name);

/// Cells of grey 205, which map_saver writes for unknown, that free_thresh alone would make free:
/// map_saver of ROS 2 long wrote 0.25, under which unknown is lost. Only in the mode trinary
/// without negate.
struct SaverUnknown {
  std::size_t cells = 0;
  /// Cells that are free by free_thresh, and would be unknown by 0.196: those of 205, and in a
  /// picture that was compressed with loss, or shaded, of greys near it.
  std::size_t lost = 0;
  /// Whether the picture has map_saver's greys only: 0, 205 and 254 or 255, all of them.
  bool is_of_map_saver = false;
};
SaverUnknown find_saver_unknown(const Image& image, const RosHeader& header);

/// Wall cells: the occupied ones, and the unknown ones unless `unknown_free`. Pixels that
/// `transparent` marks, as of read_transparency, are unknown; it may be empty. So is 205 in a
/// picture of map_saver.
Mask ros_walls(const Image& image, const RosHeader& header, bool unknown_free = false,
               std::span<const std::uint8_t> transparent = {});

/// The YAML file of a header.
std::string ros_header_text(const RosHeader& header);

}  // namespace microswarm::formats
