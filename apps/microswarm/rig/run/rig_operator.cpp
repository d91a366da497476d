// SPDX-License-Identifier: Apache-2.0
#include "rig/run/rig_operator.hpp"

#include <algorithm>
#include <cctype>

#include "microswarm/core/maths/angles.hpp"

namespace microswarm::cli {

RigOperator::RigOperator(rig::LiveSession& session) : operation_(*session.session().operation()) {}

void RigOperator::press(const Key& key) {
  switch (key.kind) {
    case Key::Kind::right:
      return steer(0);
    case Key::Kind::up:
      return steer(90);
    case Key::Kind::left:
      return steer(180);
    case Key::Kind::down:
      return steer(-90);
    case Key::Kind::character:
      return press(static_cast<char>(std::tolower(static_cast<unsigned char>(key.character))));
    default:
      return;
  }
}

void RigOperator::press(char key) {
  constexpr double step = 0.1;
  switch (key) {
    case 'p':
      return operation_.pause(!operation_.is_paused());
    case 'm':
      return operation_.manual(!operation_.is_manual());
    case 'q':
      return operation_.end();
    case 'd':
      return steer(0);
    case 'w':
      return steer(90);
    case 'a':
      return steer(180);
    case 's':
      return steer(-90);
    case '+':
    case '=':
      share_ = std::min(1.0, share_ + step);
      return;
    case '-':
    case '_':
      share_ = std::max(step, share_ - step);
      return;
    default:
      return;
  }
}

void RigOperator::steer(double degrees) {
  operation_.steer({radians(degrees), share_ * operation_.max_speed()});
}

}  // namespace microswarm::cli
