// SPDX-License-Identifier: Apache-2.0
// libmicroswarm_media.so, the only part that is linked with OpenCV's imgcodecs and videoio and with
// FFmpeg.
#include <cerrno>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <utility>

#include "microswarm/formats/media/libav_input.hpp"
#include "microswarm/formats/media/libav_output.hpp"
#include "microswarm/formats/media/media.hpp"

namespace microswarm::formats {
namespace {

namespace fs = std::filesystem;

int fourcc(VideoCodec codec) {
  switch (codec) {
    case VideoCodec::h264:
      return cv::VideoWriter::fourcc('a', 'v', 'c', '1');
    case VideoCodec::mpeg4:
      return cv::VideoWriter::fourcc('m', 'p', '4', 'v');
    case VideoCodec::huffyuv:
      return cv::VideoWriter::fourcc('H', 'F', 'Y', 'U');
    case VideoCodec::ffv1:
      return cv::VideoWriter::fourcc('F', 'F', 'V', '1');
  }
  return 0;
}

class OpenCvOutput : public VideoOutput {
 public:
  OpenCvOutput(const cv::VideoWriter& video, fs::path file)
      : video_(video), file_(std::move(file)) {}
  void write(const cv::Mat& picture) override {
    video_.write(picture);
    ++pictures_;
  }
  /// videoio reports no error, so the file's pictures are counted.
  int finish() override {
    video_.release();
    return count_libav_packets(file_) < pictures_ ? EIO : 0;
  }

 private:
  cv::VideoWriter video_;
  fs::path file_;
  int pictures_ = 0;
};

class OpenCvMedia : public Media {
 public:
  Photograph decode(std::span<const std::byte> bytes) const override {
    try {
      const cv::Mat raw(1, static_cast<int>(bytes.size()), CV_8UC1,
                        const_cast<std::byte*>(bytes.data()));
      const cv::Mat pixels = cv::imdecode(raw, cv::IMREAD_ANYCOLOR | cv::IMREAD_IGNORE_ORIENTATION);
      Photograph photograph{pixels.cols, pixels.rows, pixels.channels(), {}};
      photograph.samples.resize(pixels.total() * pixels.elemSize());
      cv::Mat out(pixels.rows, pixels.cols, pixels.type(), photograph.samples.data());
      if (photograph.channels == 3)
        cv::cvtColor(pixels, out, cv::COLOR_BGR2RGB);
      else
        pixels.copyTo(out);
      return photograph;
    } catch (const cv::Exception&) {
      return {};
    }
  }

  std::unique_ptr<VideoInput> open(const fs::path& file) const override { return open_libav(file); }

  std::unique_ptr<VideoOutput> create(const fs::path& file, const VideoForm& form) const override {
    if (form.codec == VideoCodec::h264 && form.colours) return create_h264(file, form);
    cv::VideoWriter video;
    if (!video.open(fs::absolute(file).string(), cv::CAP_FFMPEG, fourcc(form.codec), form.rate,
                    {form.width, form.height},
                    {cv::VIDEOWRITER_PROP_IS_COLOR, form.colours ? 1 : 0}))
      return nullptr;
    return std::make_unique<OpenCvOutput>(video, file);
  }

  int count_pictures(const fs::path& file) const override { return count_libav_packets(file); }
};

}  // namespace
}  // namespace microswarm::formats

/// Symbol that media() looks up.
extern "C" const microswarm::formats::Media* microswarm_media() {
  static const microswarm::formats::OpenCvMedia only;
  return &only;
}
