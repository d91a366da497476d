// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

namespace microswarm {

/// Shows the share of some work that is done, in [0, 1], and what is being done. The display ends
/// when the function is destroyed.
using ShowShare = std::function<void(double share, const std::string& doing)>;
/// Begins to show the progress of work with this label.
using BeginProgress = std::function<ShowShare(const std::string& label)>;

/// Tells how far some work is to whoever shows it, if anybody does.
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
