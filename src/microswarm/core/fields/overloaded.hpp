// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>
#include <type_traits>
#include <utility>

namespace microswarm {

/// Refuses an alternative that Overloaded does not name.
struct NoOtherAlternative {
  template <class Forgotten>
  void operator()(const Forgotten&) const = delete;
};

/// Overloads for std::visit that name each alternative of a variant: one that none of them names,
/// not even as a base or by a conversion, does not compile.
template <class... Overloads>
struct Overloaded : Overloads..., NoOtherAlternative {
  explicit Overloaded(Overloads... overloads) : Overloads(std::move(overloads))... {}
  using Overloads::operator()...;
  using NoOtherAlternative::operator();
};

/// An overload for several alternatives: `[](const OneOf<A, B> auto& value) { … }`.
template <class Alternative, class... Alternatives>
concept OneOf = (std::same_as<std::remove_cv_t<Alternative>, Alternatives> || ...);

}  // namespace microswarm
