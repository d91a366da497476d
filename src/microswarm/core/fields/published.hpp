// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <string>
#include <type_traits>
#include <utility>

#include "microswarm/core/errors/issue.hpp"
#include "microswarm/core/fields/fields.hpp"

namespace microswarm {

namespace published_detail {

/// Compares the fields of `given` in turn with those of `paper` and `usual`.
template <class T>
class Comparison {
 public:
  Comparison(Issues& issues, const IsGiven& is_given, const T& given, const T& paper,
             const T& usual, std::string prefix = {})
      : issues_(issues),
        is_given_(is_given),
        given_(given),
        paper_(paper),
        usual_(usual),
        prefix_(std::move(prefix)) {}

  template <class V>
  void operator()(const V& value, const FieldInfo& info) {
    const auto offset = reinterpret_cast<const char*>(&value) -  // NOLINT
                        reinterpret_cast<const char*>(&given_);  // NOLINT
    const V& paper = at<V>(paper_, offset);
    const V& usual = at<V>(usual_, offset);
    const std::string key = prefix_ + key_text(info);
    if constexpr (HasFields<V>) {
      V::fields(value, Comparison<V>(issues_, is_given_, value, paper, usual, key + "."));
    } else if constexpr (std::is_arithmetic_v<V> || std::is_enum_v<V>) {
      const bool written = is_given_ && is_given_(key);
      if (value == paper || (value == usual && !written)) return;
      issues_.add(key, fmt::format("{} is not the paper's, and as_published is true", key));
    }
  }

 private:
  template <class V>
  static const V& at(const T& params, std::ptrdiff_t offset) {
    return *reinterpret_cast<const V*>(reinterpret_cast<const char*>(&params) + offset);  // NOLINT
  }

  Issues& issues_;
  const IsGiven& is_given_;
  const T& given_;
  const T& paper_;
  const T& usual_;
  std::string prefix_;
};

}  // namespace published_detail

/// Checks parameters that have `as_published`. Returns an issue for each key given by the user, in
/// the file or on the command line, whose value differs from the one in effect and would be
/// ignored. `given`: parameters as read; `paper`: parameters in effect; `usual`: defaults. A key
/// not given must have its default or the paper's value.
template <HasFields T>
Issues validate_published(const IsGiven& is_given, const T& given, const T& paper, const T& usual) {
  Issues issues;
  T::fields(given, published_detail::Comparison<T>(issues, is_given, given, paper, usual));
  return issues;
}

}  // namespace microswarm
