// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <utility>

#include "microswarm/core/fields/fields.hpp"
#include "microswarm/formats/images/image.hpp"
#include "microswarm/formats/images/mask.hpp"
#include "microswarm/geometry/vec2.hpp"

namespace microswarm::vision {

/// A rectangle of a picture [px]; x and y are those of its upper left pixel.
struct PictureRegion {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
  template <class Self, class V>
  static void fields(Self& self, V&& visit) {
    visit(self.x, px("x", 0, 100000, "Left column."));
    visit(self.y, px("y", 0, 100000, "Upper row."));
    visit(self.width, px("width", 1, 100000, "Columns."));
    visit(self.height, px("height", 1, 100000, "Rows."));
  }
};

/// Part of a picture in which robots are tracked.
class SearchArea {
 public:
  /// An empty mask is the whole picture. `reach` is the distance beyond the area that is needed to
  /// see a robot at its border [px].
  SearchArea(std::optional<PictureRegion> region, formats::Mask mask, int reach)
      : region_(region), mask_(std::move(mask)), reach_(reach) {}

  /// The smallest part of the picture that shows the area and `reach` around it. Valid until the
  /// next call. Throws InputError if the area does not fit the picture or is empty.
  const formats::Image& crop(const formats::Image& grey);
  /// Upper left pixel of that part.
  Vec2 offset() const { return {1.0 * part_.x, 1.0 * part_.y}; }
  /// Whether a position in the whole picture is in the area.
  bool contains(Vec2 at_px) const;

 private:
  void fit(const formats::Image& grey);

  std::optional<PictureRegion> region_;
  formats::Mask mask_;
  int reach_;
  int width_ = 0;  ///< of the picture
  int height_ = 0;
  PictureRegion part_;
  formats::Image cut_;
};

}  // namespace microswarm::vision
