// SPDX-License-Identifier: Apache-2.0
// Laws that hold for every width of vectors.
#pragma once

#include <hwy/targets.h>

#include <cstdint>

namespace microswarm::test {

/// Calls `check` once for each instruction set that Highway compiles for and this machine has, the
/// widest first, the narrowest last; afterwards the widest is in use again.
template <class Check>
void for_each_target(Check check) {
  for (std::int64_t left = hwy::SupportedTargets() & HWY_TARGETS; left != 0; left &= left - 1) {
    const std::int64_t target = left & -left;
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(target);
    check(hwy::TargetName(target));
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
}

}  // namespace microswarm::test
