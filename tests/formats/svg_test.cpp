// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/svg/svg.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "microswarm/formats/map_file.hpp"
#include "tests/files.hpp"

namespace microswarm::formats {
namespace {

using test::Folder;

/// Note on ink that no pixel takes as a wall, with the size of pixels that keeps it.
TEST(Svg, TellsInkThatIsLost) {
  const Folder folder;
  const auto notes = [&](const std::string& drawn, std::optional<double> um_per_px) {
    folder.with("a.svg",
                R"(<svg xmlns="http://www.w3.org/2000/svg" width="2mm" height="1mm" )"
                R"(viewBox="0 0 2000 1000"><rect x="40" y="40" width="300" height="300"/>)" +
                    drawn + "</svg>");
    return load_map(choose_map_spec(folder / "a.svg", {.um_per_px = um_per_px})).notes;
  };
  const std::string thin = R"(<path d="M1000 0 V1000" stroke="#000" stroke-width="2"/>)";
  ASSERT_EQ(notes(thin, 10.0).size(), 1u);
  EXPECT_NE(notes(thin, 10.0)[0].find("thinner than a pixel of 10 µm"), std::string::npos);
  EXPECT_TRUE(notes(thin, 1.0).empty());
  EXPECT_TRUE(notes("", 10.0).empty());
  const std::string slanted = R"(<path d="M900 0 L1000 1000" stroke="#000" stroke-width="3"/>)";
  EXPECT_EQ(notes(slanted, 10.0).size(), 1u);
  const std::string pale = R"(<rect x="600" y="200" width="300" height="300" fill="#ff8"/>)";
  EXPECT_EQ(notes(pale, 10.0).size(), 1u);
}

}  // namespace
}  // namespace microswarm::formats
