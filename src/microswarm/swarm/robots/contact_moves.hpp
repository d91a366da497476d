// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "microswarm/swarm/robots/contact_rule.hpp"
#include "microswarm/swarm/robots/wall_faces.hpp"

namespace microswarm {

/// Contacts after which a sliding robot stays for the rest of its move.
inline constexpr int max_slide_contacts = 64;

/// Move of one robot under a contact rule, independent of how contacts are found. `first_contact(p,
/// piece)` returns the FaceContact of a piece of at most `reach` µm.
template <class FirstContact>
class ContactMoves {
 public:
  ContactMoves(float reach, float guard, FirstContact first_contact)
      : reach_(reach), guard_(guard), first_contact_(first_contact) {}

  /// End position of a robot at `p`.
  PointF moved(PointF p, PointF move, ContactRule rule) const {
    if (rule == ContactRule::slide) return slid(p, move);
    bool met = false;
    const PointF end = stopped(p, move, met);
    return met && rule == ContactRule::reject ? p : end;
  }

  /// Resolves contacts in order along the move. The rest of the move continues along the wall until
  /// nothing is left or a corner stops the robot. Along a wall, each piece is offset away from it
  /// by more than rounding can bring the robot nearer.
  PointF slid(PointF p, PointF left) const {
    int contacts = 0;
    PointF lean;
    const float max_pieces = std::ceil(length(left) / reach_) + max_slide_contacts;
    for (float k = 0; k < max_pieces; ++k) {
      const float far = length(left);
      const float share = far > reach_ ? reach_ / far : 1.0f;
      const PointF done{share * left.x, share * left.y};
      const PointF piece{done.x + lean.x, done.y + lean.y};
      const FaceContact contact = first_contact_(p, piece);
      if (!contact.met()) {
        p = {p.x + piece.x, p.y + piece.y};
        if (share == 1.0f) return p;
        left = {left.x - done.x, left.y - done.y};
        continue;
      }
      p = {p.x + contact.time * piece.x, p.y + contact.time * piece.y};
      if (++contacts == max_slide_contacts) return p;
      left = {left.x - contact.time * done.x, left.y - contact.time * done.y};
      const PointF n = contact.normal;
      const float along = left.y * n.x - left.x * n.y;
      left = {-along * n.y, along * n.x};
      lean = {guard_ / 4 * n.x, guard_ / 4 * n.y};
      if (std::abs(along) < guard_) return p;
    }
    return p;
  }

 private:
  static float length(PointF v) { return std::sqrt(v.x * v.x + v.y * v.y); }

  PointF stopped(PointF p, PointF move, bool& met) const {
    const float count = std::max(1.0f, std::ceil(length(move) / reach_));
    const PointF piece{move.x / count, move.y / count};
    for (float k = 0; k < count; ++k) {
      const FaceContact contact = first_contact_(p, piece);
      met = contact.met();
      if (met) return {p.x + contact.time * piece.x, p.y + contact.time * piece.y};
      p = {p.x + piece.x, p.y + piece.y};
    }
    return p;
  }

  float reach_;
  float guard_;
  FirstContact first_contact_;
};

}  // namespace microswarm
