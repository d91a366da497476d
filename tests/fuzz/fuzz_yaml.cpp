// SPDX-License-Identifier: Apache-2.0
// The bytes are a document; its first line is also a `--set` assignment. What is read must be
// written and read back the same; what is refused must be refused with an InputError of a line for
// each mistake.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "microswarm/config/write.hpp"
#include "microswarm/config/yaml.hpp"
#include "microswarm/core/errors/error.hpp"
#include "tests/config/sample.hpp"

namespace microswarm::sample {
namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

template <class F>
bool accepted(F&& f) {
  try {
    f();
    return true;
  } catch (const InputError& error) {
    // A line for each mistake.
    const std::string_view text = error.what();
    const auto breaks = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
    require(breaks == 0 || breaks < error.issues().size());
    return false;
  }
}

void check_round_trip(const Scene& scene) {
  const std::string yaml = to_yaml(scene);
  require(read_yaml_text<Scene>(yaml, "yaml") == scene);
  require(to_yaml(read_yaml_text<Scene>(to_json_text(scene), "json")) == yaml);
}

void run(std::string_view bytes) {
  Scene scene;
  if (accepted([&] { scene = read_yaml_text<Scene>(bytes, "fuzz"); })) check_round_trip(scene);
  if (accepted([&] { set_value(scene, bytes.substr(0, bytes.find('\n'))); }))
    check_round_trip(scene);
}

}  // namespace
}  // namespace microswarm::sample

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  microswarm::sample::run({reinterpret_cast<const char*>(data), size});
  return 0;
}
