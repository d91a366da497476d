// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <utility>

namespace microswarm {

/// Value that is computed when it is first asked for, and only once. For one thread at a time.
template <class T>
class Lazy {
 public:
  /// A default value.
  Lazy() = default;
  /// `compute` must be callable until the value is asked for.
  explicit Lazy(std::function<T()> compute) : compute_(std::move(compute)) {}

  const T& value() const {
    if (!value_) value_ = compute_ ? compute_() : T{};
    return *value_;
  }

 private:
  std::function<T()> compute_;
  mutable std::optional<T> value_;
};

}  // namespace microswarm
