// SPDX-License-Identifier: Apache-2.0
#include "microswarm/core/places.hpp"

namespace microswarm {

Places Places::within(std::string_view key, const std::string& words) const {
  Places inner = *this;
  inner.prefix_.append(key).append(".");
  if (!words.empty()) inner.words_ += words + ": ";
  return inner;
}

std::string Places::before(std::initializer_list<std::string_view> keys) const {
  const auto begun = [&](const std::string& place) {
    return place.empty() ? words_ : place + ": " + words_;
  };
  if (!find_) return begun(name_);
  for (const std::string_view key : keys)
    if (const auto place = find_(prefix_ + std::string(key), Seek::all_of_it)) return begun(*place);
  std::string key = prefix_ + std::string(*keys.begin());
  for (std::size_t dot = key.rfind('.'); dot != std::string::npos; dot = key.rfind('.')) {
    key.resize(dot);
    if (const auto place = find_(key, Seek::missing_in_it)) return begun(*place);
  }
  return begun(name_);
}

bool Places::given(std::string_view key) const {
  return find_ && find_(prefix_ + std::string(key), Seek::itself);
}

InputError Places::error(std::initializer_list<std::string_view> keys,
                         const std::string& what) const {
  return InputError(before(keys) + what);
}

}  // namespace microswarm
