// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <string>
#include <type_traits>
#include <utility>

#include "microswarm/core/fields.hpp"
#include "microswarm/core/places.hpp"

namespace microswarm {

namespace published_detail {

/// Compares the fields of `given`, in order, with those of the other two.
template <class T>
class Comparison {
 public:
  Comparison(const Places& where, const T& given, const T& paper, const T& usual,
             std::string prefix = {})
      : where_(where), given_(given), paper_(paper), usual_(usual), prefix_(std::move(prefix)) {}

  template <class V>
  void operator()(const V& value, const FieldInfo& info) {
    const auto offset = reinterpret_cast<const char*>(&value) -  // NOLINT
                        reinterpret_cast<const char*>(&given_);  // NOLINT
    const V& paper = at<V>(paper_, offset);
    const V& usual = at<V>(usual_, offset);
    const std::string key = prefix_ + key_of(info);
    if constexpr (HasFields<V>) {
      V::fields(value, Comparison<V>(where_, value, paper, usual, key + "."));
    } else if constexpr (std::is_arithmetic_v<V> || std::is_enum_v<V>) {
      if (value == paper || (value == usual && !where_.given(key))) return;
      throw where_.error(key, fmt::format("{} is not the paper's, and as_published is true", key));
    }
  }

 private:
  template <class V>
  static const V& at(const T& params, std::ptrdiff_t offset) {
    return *reinterpret_cast<const V*>(reinterpret_cast<const char*>(&params) + offset);  // NOLINT
  }

  const Places& where_;
  const T& given_;
  const T& paper_;
  const T& usual_;
  std::string prefix_;
};

}  // namespace published_detail

/// For parameters with `as_published`: throws InputError when a key of ours is given, in the file
/// or after it, with a value that is not the one in effect, since it would have no effect. `given`
/// are the parameters as read, `paper` the same in effect, `usual` their defaults: what no file
/// gives must be the default or the paper's.
template <HasFields T>
void check_published(const Places& where, const T& given, const T& paper, const T& usual) {
  T::fields(given, published_detail::Comparison<T>(where, given, paper, usual));
}

}  // namespace microswarm
