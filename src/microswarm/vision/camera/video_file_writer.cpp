// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/camera/video_file_writer.hpp"

#include <cstdio>
#include <opencv2/imgproc.hpp>
#include <system_error>

#include "microswarm/core/errors/write_error.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/formats/images/gif.hpp"
#include "microswarm/formats/media/media.hpp"
#include "microswarm/vision/image/mat.hpp"

namespace microswarm::vision {

struct VideoFileWriter::Parts {
  Parts(std::filesystem::path path, double pictures_a_second)
      : file(std::move(path)), rate(pictures_a_second), staged(std::in_place, file) {
    if (is_gif() && rate > formats::max_gif_rate)
      throw InputError(file.string(), "a GIF has at most 50 pictures a second");
  }

  bool is_gif() const { return file.extension() == ".gif"; }

  /// False if neither codec is available.
  bool open(cv::Size size) {
    if (is_gif()) {
      gif.emplace(staged->path(), rate);
      return true;
    }
    formats::VideoForm form{.rate = rate, .width = size.width, .height = size.height};
    for (const formats::VideoCodec codec :
         {formats::VideoCodec::h264, formats::VideoCodec::mpeg4}) {
      form.codec = codec;
      video = formats::media().create(staged->path(), form);
      if (video) return true;
    }
    return false;
  }

  std::filesystem::path file;
  double rate;
  std::optional<StagedFile> staged;  ///< empty without a codec
  std::unique_ptr<formats::VideoOutput> video;
  std::optional<formats::GifWriter> gif;
  cv::Mat bgr;
  int pictures = 0;
};

VideoFileWriter::VideoFileWriter(std::filesystem::path file, double rate)
    : parts_(std::make_unique<Parts>(std::move(file), rate)) {}

VideoFileWriter::~VideoFileWriter() { parts_->video.reset(); }

void VideoFileWriter::add(const formats::Image& picture) {
  Parts& p = *parts_;
  std::filesystem::path folder = p.file;
  folder.replace_extension();
  if (p.pictures == 0) {
    formats::check_image_size(picture.width, picture.height, p.file.string());
    if (!p.open({picture.width, picture.height})) {
      p.staged.reset();
      std::filesystem::create_directories(folder);
    }
  }
  if (p.gif) {
    p.gif->add(picture);
  } else if (p.staged) {
    cv::cvtColor(as_mat(picture), p.bgr, cv::COLOR_RGB2BGR);
    p.video->write(p.bgr);
  } else {
    char name[32];
    std::snprintf(name, sizeof name, "%06d.png", p.pictures);
    formats::write_png(folder / name, picture);
  }
  ++p.pictures;
}

std::optional<std::filesystem::path> VideoFileWriter::commit() {
  Parts& p = *parts_;
  if (p.pictures == 0) return std::nullopt;
  std::filesystem::path folder = p.file;
  if (!p.staged) return folder.replace_extension();
  const int error = p.video ? p.video->finish() : 0;
  p.video.reset();
  if (error != 0)
    throw WriteError(p.file.string(), "cannot write: " + std::generic_category().message(error));
  if (p.gif) p.gif->finish();
  if (std::filesystem::file_size(p.staged->path()) == 0)
    throw InputError(p.file.string(), "cannot write: the video stayed empty");
  p.staged->commit();
  return p.file;
}

}  // namespace microswarm::vision
