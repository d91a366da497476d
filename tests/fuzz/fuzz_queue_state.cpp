// SPDX-License-Identifier: Apache-2.0
// The state of a queue: what is read is written and read back the same, and its table has a line
// for each attempt; what is refused is refused in a line for each mistake.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "microswarm/config/write.hpp"
#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/rig/queue/queue_state.hpp"

namespace microswarm::rig {
namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

void check(const QueueState& state) {
  const std::string yaml = to_yaml(state);
  require(to_yaml(read_yaml_text<QueueState>(yaml, "again")) == yaml);
  std::ptrdiff_t lines = 1;
  for (const ItemStatus& item : state.items) {
    lines += std::max<std::ptrdiff_t>(1, std::ssize(item.attempts));
    require(item.faults() >= 0 && item.interruptions() >= 0);
  }
  require(std::ranges::count(summary_csv(state), '\n') == lines);
  require(state.count(ItemState::done) <= std::ssize(state.items));
}

}  // namespace
}  // namespace microswarm::rig

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace microswarm;
  rig::QueueState state;
  try {
    state = read_yaml_text<rig::QueueState>({reinterpret_cast<const char*>(data), size}, "fuzz");
  } catch (const InputError& error) {
    const std::string_view text = error.what();
    const auto breaks = static_cast<std::size_t>(std::ranges::count(text, '\n'));
    if (breaks > 0 && breaks >= error.issues().size()) std::abort();
    return 0;
  }
  rig::check(state);
  return 0;
}
