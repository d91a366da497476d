// SPDX-License-Identifier: Apache-2.0
// The first line is an assignment, the rest the document it changes. What is edited has that value,
// is changed in one place within a line, so that all comments stay, and editing it again changes
// nothing; what is refused says so in a line.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "microswarm/config/yaml_edit.hpp"
#include "microswarm/config/yaml_node.hpp"
#include "microswarm/core/errors/error.hpp"

namespace microswarm {
namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

/// Part of `text` that is not in `edited`, if one place was changed.
std::string_view removed(std::string_view text, std::string_view edited) {
  const auto same = std::ranges::mismatch(text, edited).in1 - text.begin();
  text.remove_prefix(static_cast<std::size_t>(same));
  edited.remove_prefix(static_cast<std::size_t>(same));
  while (!text.empty() && !edited.empty() && text.back() == edited.back())
    text.remove_suffix(1), edited.remove_suffix(1);
  return text;
}

void run(std::string_view bytes) {
  const std::size_t line = bytes.find('\n');
  if (line == std::string_view::npos) return;
  const std::string_view text = bytes.substr(line + 1);
  std::string edited;
  Setting setting;
  try {
    setting = parse_setting(bytes.substr(0, line), "fuzz");
    edited = edit_yaml(text, "fuzz.yaml", {&setting, 1});
  } catch (const InputError& error) {
    require(std::string_view(error.what()).find('\n') == std::string_view::npos);
    return;
  }
  require(removed(text, edited).find('\n') == std::string_view::npos);
  parse_yaml(edited, "edited");
  try {
    require(edit_yaml(edited, "edited", {&setting, 1}) == edited);
  } catch (const InputError&) {  // a list, a map or a quoted text is not replaced
  }
}

}  // namespace
}  // namespace microswarm

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  microswarm::run({reinterpret_cast<const char*>(data), size});
  return 0;
}
