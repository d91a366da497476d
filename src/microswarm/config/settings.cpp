// SPDX-License-Identifier: Apache-2.0
#include "microswarm/config/settings.hpp"

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm {

std::string to_string(const Setting& setting) { return setting.key + "=" + setting.value; }

Setting parse_setting(std::string_view text, std::string_view option) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos || equals == 0)
    throw InputError(Issue{.text = "must be KEY=VALUE",
                           .location = setting_location(option, quote(text)),
                           .value = one_line(text),
                           .limit = "KEY=VALUE"});
  return {std::string(text.substr(0, equals)), std::string(text.substr(equals + 1))};
}

Settings::Settings(const std::vector<std::string>& texts, std::string from)
    : option(std::move(from)) {
  for (const std::string& text : texts) list.push_back(parse_setting(text, option));
}

std::vector<std::string> Settings::texts() const {
  std::vector<std::string> all;
  for (const Setting& setting : list) all.push_back(to_string(setting));
  return all;
}

std::string setting_location(std::string_view option, std::string_view key) {
  const std::string shown = one_line(key);
  return option.empty() ? shown : std::string(option) + " " + shown;
}

}  // namespace microswarm
