// SPDX-License-Identifier: Apache-2.0
// Learned followers: what is read answers with numbers, and is written back as it was read.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/navigation/following/follower_model.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace microswarm;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const navigation::FollowerModel model = navigation::parse_follower_model(text, "fuzz.yaml");
    const std::string written = navigation::follower_model_text(model);
    if (navigation::follower_model_text(navigation::parse_follower_model(written, "again.yaml")) !=
        written)
      std::abort();
    const std::vector<Vec2> path{{0, 0}, {100, 0}, {100, 100}};
    const navigation::FollowerQuery query{.path = path,
                                          .position = {},
                                          .pose = {{10, 1}, 0},
                                          .speed = 60,
                                          .flow = {},
                                          .max_turn_rate = 3};
    if (const auto command = model.command(query))
      if (!std::isfinite(command->heading) || !(command->speed > 0 && command->speed <= 60))
        std::abort();
  } catch (const InputError& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) std::abort();
  }
  return 0;
}
