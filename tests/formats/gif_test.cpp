// SPDX-License-Identifier: Apache-2.0
#include "microswarm/formats/images/gif.hpp"

#include <gtest/gtest.h>

#include "microswarm/core/errors/error.hpp"
#include "tests/files.hpp"

namespace microswarm::formats {
namespace {

TEST(Gifs, NameTheFileThatCannotBeWritten) {
  const test::Folder folder;
  const auto file = folder / "none/x.gif";
  try {
    const GifWriter writer(file, 10);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(file.string() + ": cannot write: "),
              std::string::npos);
  }
}

}  // namespace
}  // namespace microswarm::formats
