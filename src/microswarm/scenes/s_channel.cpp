// SPDX-License-Identifier: Apache-2.0
#include "microswarm/scenes/s_channel.hpp"

#include "microswarm/world/obstacles/channel.hpp"

namespace microswarm::scenes {

DeformingChannel s_channel_shape() {
  DeformingChannel channel;
  channel.centre_line = {{200, 700}, {600, 797}, {975, 500}, {1350, 203}, {1750, 300}};
  channel.half_width = 120;
  channel.end_half_width = 200;
  channel.end_length = 500;
  channel.amplitude = 0;
  channel.block_centre = {1000, 500};
  channel.block_width = 2000;
  channel.block_height = 1000;
  return channel;
}

Snapshot s_channel(const DeformingChannel& shape) {
  return Snapshot(std::make_shared<const Map>(Box{{0, 0}, {2000, 1000}},
                                              std::vector<Polygon>{channel_block(shape, 0)}));
}

}  // namespace microswarm::scenes
