// SPDX-License-Identifier: Apache-2.0
// Videos that cannot be written, and what their encoder prints.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "microswarm/core/errors/write_error.hpp"
#include "microswarm/formats/images/image.hpp"
#include "microswarm/vision/camera/video_file_writer.hpp"

namespace microswarm::vision {
namespace {

namespace fs = std::filesystem;

class VideoFiles : public testing::Test {
 protected:
  VideoFiles() : folder(fs::path(testing::TempDir()) / ("video_" + std::to_string(::getpid()))) {
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  ~VideoFiles() override { fs::remove_all(folder); }
  static formats::Image flat(int width, int height, std::uint8_t grey) {
    return {width, height, 3,
            std::vector<std::uint8_t>(static_cast<std::size_t>(width) * height * 3, grey)};
  }

  fs::path folder;
};

TEST_F(VideoFiles, AFullDiskIsALineAndLeavesNoVideo) {
  const fs::path file = folder / "v.mp4";
  const auto write = [&] {
    VideoFileWriter writer(file, 10);
    formats::Image picture = flat(320, 240, 0);
    std::uint32_t noise = 1;
    for (int i = 0; i < 12; ++i) {
      for (std::uint8_t& sample : picture.pixels)
        sample = static_cast<std::uint8_t>((noise = 1664525U * noise + 1013904223U) >> 24U);
      writer.add(picture);
    }
    writer.commit();
  };
  write();
  const std::uintmax_t whole = fs::file_size(file);
  ASSERT_GT(whole, 100'000U);
  fs::remove(file);
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  for (const std::uintmax_t size : {std::uintmax_t{0}, std::uintmax_t{40}, whole / 2, whole - 1}) {
    std::string why;
    const rlimit small{size, before.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &small);
    try {
      write();
    } catch (const WriteError& e) {
      why = e.what();
    } catch (const std::exception& e) {
      why = std::string("not a WriteError: ") + e.what();
    }
    ::setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_EQ(why, file.string() + ": cannot write: File too large") << size;
    EXPECT_TRUE(fs::is_empty(folder)) << size;
    fs::remove(file);
  }
  std::signal(SIGXFSZ, handler);
}

TEST_F(VideoFiles, TheEncoderPrintsNothing) {
  testing::internal::CaptureStderr();
  {
    VideoFileWriter writer(folder / "v.mp4", 10);
    for (int i = 0; i < 7; ++i) writer.add(flat(64, 48, static_cast<std::uint8_t>(30 * i)));
    writer.commit();
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace microswarm::vision
