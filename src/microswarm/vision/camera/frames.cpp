// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/camera/frames.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/formats/images/codecs.hpp"
#include "microswarm/formats/images/samples.hpp"
#include "microswarm/formats/images/tiff.hpp"
#include "microswarm/formats/media/media.hpp"
#include "microswarm/vision/image/mat.hpp"

namespace microswarm::vision {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& source, const std::string& why) {
  throw InputError(source.string() + ": " + why);
}

/// Base of all sources: indices, times, one size.
class Source : public FrameSource {
 public:
  Source(fs::path name, std::optional<double> rate) : name_(std::move(name)), rate_(rate) {}
  std::optional<double> rate() const override { return rate_; }
  bool next(VideoFrame& frame) final {
    if (!why_ended_.empty()) return false;
    try {
      return read(frame);
    } catch (const InputError& error) {
      if (next_ == 0) throw;
      why_ended_ = error.what();
      return false;
    }
  }
  std::string why_ended() const override { return why_ended_; }

 protected:
  /// The next picture; false at the end. Throws InputError.
  virtual bool read(VideoFrame& frame) = 0;
  const fs::path& name() const { return name_; }
  void set_rate(double rate) {
    if (!rate_ && std::isfinite(rate) && rate > 0 && rate < 1e6) rate_ = rate;
  }
  /// Numbers a picture and checks its size; `file` is where it came from.
  void number(VideoFrame& frame, const fs::path& file) {
    const formats::Image& p = frame.picture;
    if (next_ == 0) {
      width_ = p.width;
      height_ = p.height;
    }
    if (p.width != width_ || p.height != height_)
      fail(file, size_text(p.width, p.height) + " pixels, the first picture has " +
                     size_text(width_, height_));
    frame.index = next_++;
    frame.t = frame.index / rate_.value_or(1);
  }
  int given() const { return next_; }

 private:
  static std::string size_text(int width, int height) {
    return std::to_string(width) + "x" + std::to_string(height);
  }

  fs::path name_;
  std::optional<double> rate_;
  std::string why_ended_;
  int next_ = 0;
  int width_ = 0;
  int height_ = 0;
};

/// The last run of digits in a name, without leading zeros; "" without digits.
std::string last_number(const fs::path& file) {
  const std::string stem = file.stem().string();
  const auto is_digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  const auto end = std::find_if(stem.rbegin(), stem.rend(), is_digit);
  const auto begin = std::find_if_not(end, stem.rend(), is_digit);
  std::string digits(begin.base(), end.base());
  digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size()));
  return digits;
}

bool is_tiff(const fs::path& file) {
  const std::string extension = lower_extension(file);
  return extension == ".tif" || extension == ".tiff";
}

/// Reads the next page; the first page that needs a depth sets it.
void take_page(formats::TiffPages& pages, std::optional<int>& depth, formats::Image& picture) {
  formats::DecodedImage page = pages.next();
  const auto* deep = std::get_if<formats::DeepImage>(&page);
  if (!depth && deep) depth = formats::used_depth(deep->samples);
  formats::take_pixels(std::move(page), depth.value_or(16), picture);
}

/// Reads the only picture of a TIFF; in a folder a file holds one picture.
void read_only_page(const fs::path& file, std::optional<int>& depth, formats::Image& picture) {
  formats::TiffPages pages(file);
  if (pages.count() > 1)
    fail(file,
         "holds " + std::to_string(pages.count()) + " pictures: name the file, not its folder");
  take_page(pages, depth, picture);
}

class Pictures : public Source {
 public:
  Pictures(const fs::path& name, std::vector<fs::path> files, std::optional<double> rate,
           std::optional<int> depth)
      : Source(name, rate), files_(std::move(files)), depth_(depth) {}
  bool read(VideoFrame& frame) override {
    const auto at = static_cast<std::size_t>(given());
    if (at >= files_.size()) return false;
    if (is_tiff(files_[at])) {
      read_only_page(files_[at], depth_, frame.picture);
    } else {
      if (!depth_) depth_ = formats::sample_depth(files_[at]).value_or(16);
      frame.picture = formats::read_image(files_[at], *depth_);
    }
    number(frame, files_[at]);
    return true;
  }
  std::optional<int> count() const override { return static_cast<int>(files_.size()); }

 private:
  std::vector<fs::path> files_;
  std::optional<int> depth_;
};

std::vector<fs::path> pictures_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (formats::has_image_extension(entry.path()) && entry.path().filename().string()[0] != '.')
      files.push_back(entry.path());
  if (files.empty()) fail(folder, "no pictures in this folder (PNG, JPEG, BMP, TIFF, PGM or PPM)");
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    const std::string p = last_number(a);
    const std::string q = last_number(b);
    if (p.size() != q.size()) return p.size() < q.size();
    return p != q ? p < q : a < b;
  });
  return files;
}

bool fits(const cv::Size& size) {
  return size.width >= 1 && size.height >= 1 && size.width <= formats::max_image_side &&
         size.height <= formats::max_image_side &&
         std::int64_t{size.width} * size.height <= formats::max_image_pixels;
}

void require_fit(const fs::path& source, const cv::Size& size) {
  if (!fits(size))
    fail(source, std::to_string(size.width) + "x" + std::to_string(size.height) +
                     " pixels, allowed up to " + std::to_string(formats::max_image_side) +
                     " a side and " + std::to_string(formats::max_image_pixels) + " in all");
}

class TiffStack : public Source {
 public:
  TiffStack(const fs::path& file, std::optional<double> rate, std::optional<int> depth)
      : Source(file, rate), pages_(file), depth_(depth) {}
  bool read(VideoFrame& frame) override {
    if (given() >= pages_.count()) return false;
    take_page(pages_, depth_, frame.picture);
    number(frame, name());
    return true;
  }
  std::optional<int> count() const override { return pages_.count(); }

 private:
  formats::TiffPages pages_;
  std::optional<int> depth_;
};

class VideoFile : public Source {
 public:
  VideoFile(const fs::path& file, std::optional<double> rate)
      : Source(file, rate), video_(formats::media().open(file)) {
    if (!video_) fail(file, "is no video that can be read");
    require_fit(file, {video_->width, video_->height});
    set_rate(video_->rate);
  }
  bool read(VideoFrame& frame) override {
    if (!video_->read(mat_)) {
      if (given() == 0) fail(name(), "holds no picture that can be read");
      return false;
    }
    take_picture(mat_, frame.picture);
    number(frame, name());
    return true;
  }
  std::optional<int> count() const override {
    const double told = video_->picture_count;
    if (!(told >= 1 && told < 1e9)) return std::nullopt;
    return static_cast<int>(told);
  }

 private:
  std::unique_ptr<formats::VideoInput> video_;
  cv::Mat mat_;
};

}  // namespace

std::unique_ptr<FrameSource> open_frames(const fs::path& source, std::optional<double> rate,
                                         std::optional<int> depth) {
  std::error_code error;
  const fs::file_status status = fs::status(source, error);
  if (!fs::exists(status)) fail(source, "cannot read: No such file or directory");
  if (fs::is_directory(status))
    return std::make_unique<Pictures>(source, pictures_in(source), rate, depth);
  if (!fs::is_regular_file(status)) fail(source, "is neither a file nor a folder");
  if (fs::file_size(source) == 0) fail(source, "is empty");
  if (is_tiff(source)) return std::make_unique<TiffStack>(source, rate, depth);
  if (formats::has_image_extension(source))
    return std::make_unique<Pictures>(source, std::vector<fs::path>{source}, rate, depth);
  return std::make_unique<VideoFile>(source, rate);
}

void take_channel(const formats::Image& picture, VideoChannel channel, formats::Image& grey) {
  grey.width = picture.width;
  grey.height = picture.height;
  grey.channels = 1;
  grey.pixels.resize(static_cast<std::size_t>(picture.width) * picture.height);
  const cv::Mat in = as_mat(picture);
  cv::Mat out = as_mat(grey);
  if (picture.channels == 1)
    in.copyTo(out);
  else if (channel == VideoChannel::grey)
    cv::cvtColor(in, out, cv::COLOR_RGB2GRAY);
  else
    cv::extractChannel(in, out, static_cast<int>(channel) - static_cast<int>(VideoChannel::red));
}

}  // namespace microswarm::vision
