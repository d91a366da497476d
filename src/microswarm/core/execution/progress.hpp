// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

namespace microswarm {

/// Shows the completed share of some work, in [0, 1], and the current step. The display ends when
/// the function object is destroyed.
using ShowShare = std::function<void(double share, const std::string& doing)>;
/// Starts a progress display with this label.
using BeginProgress = std::function<ShowShare(const std::string& label)>;

/// Reports the progress of some work to a display, if there is one.
class Progress {
 public:
  Progress(const BeginProgress& begin, const std::string& label)
      : show_(begin ? begin(label) : ShowShare()) {}

  void update(double share, const std::string& doing = {}) const {
    if (show_) show_(share, doing);
  }

 private:
  ShowShare show_;
};

}  // namespace microswarm
