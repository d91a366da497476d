// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <string_view>

#include "microswarm/actuation/coils/coil_system.hpp"
#include "microswarm/config/type.hpp"
#include "microswarm/experiment/record/record.hpp"
#include "microswarm/experiment/results/metrics.hpp"
#include "microswarm/experiment/scenario/scenario.hpp"
#include "microswarm/learning/follower_training.hpp"
#include "microswarm/rig/params/rig_params.hpp"
#include "microswarm/sweep/sweep_file.hpp"
#include "microswarm/vision/calibration/calibration_grid.hpp"
#include "microswarm/vision/tracking/video_tracker.hpp"
#include "microswarm/vision/vessels/vessels.hpp"

namespace microswarm {
namespace {

// Doc strings of fields are user interface: help, schema and sliders show them.
constexpr std::ptrdiff_t max_length = 60;

std::ptrdiff_t characters(std::string_view text) {
  return std::count_if(text.begin(), text.end(),
                       [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; });
}

struct DocStrings {
  std::set<const Type*> visited;
  std::size_t fields = 0;

  void visit(const Type& type, const std::string& name) {
    if (!visited.insert(&type).second) return;
    std::set<std::string_view> docs;
    for (const Field& field : type.fields) {
      const std::string key = name + "." + field.key;
      const std::string_view doc = field.info.doc;
      ++fields;
      EXPECT_LE(characters(doc), max_length) << key << ": " << doc;
      EXPECT_TRUE(docs.insert(doc).second) << key << ": said twice: " << doc;
      EXPECT_TRUE(doc.ends_with('.')) << key << ": " << doc;
      visit(*field.type, key);
    }
    for (std::size_t i = 0; i < type.parts.size(); ++i)
      visit(*type.parts[i],
            type.kind == TypeKind::variant ? name + "(" + std::string(type.words[i]) + ")" : name);
  }
};

TEST(DocStrings, AreShortAndUniqueInTheirStruct) {
  DocStrings all;
  all.visit(type_of<experiment::Scenario>(), "scenario");
  all.visit(type_of<experiment::Record>(), "record");
  all.visit(type_of<experiment::Metrics>(), "metrics");
  all.visit(type_of<rig::RigParams>(), "rig");
  all.visit(type_of<actuation::CoilSystemParams>(), "coils");
  all.visit(type_of<sweep::Sweep>(), "sweep");
  all.visit(type_of<vision::TrackSettings>(), "track");
  all.visit(type_of<vision::GridParams>(), "grid");
  all.visit(type_of<vision::VesselParams>(), "vessels");
  all.visit(type_of<learning::FollowerTrainingParams>(), "learn");
  EXPECT_GT(all.fields, 550u);
}

}  // namespace
}  // namespace microswarm
