// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/camera/frames.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/errors/input_names.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/formats/images/codecs.hpp"
#include "microswarm/formats/images/samples.hpp"
#include "microswarm/formats/images/tiff.hpp"
#include "microswarm/formats/media/media.hpp"
#include "microswarm/vision/camera/frame_times.hpp"
#include "microswarm/vision/camera/picture_names.hpp"
#include "microswarm/vision/camera/stack_pages.hpp"
#include "microswarm/vision/camera/video_recorder.hpp"
#include "microswarm/vision/image/mat.hpp"

namespace microswarm::vision {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& source, const std::string& why) {
  throw InputError(source.string(), why);
}

/// Times that are given beforehand, one a picture.
struct GivenTimes {
  std::vector<double> times;  ///< [s]
  std::string name;           ///< of their file; empty if they are of the source itself
  bool asked = false;         ///< the user named the file
};

/// Base of all sources: indices, times, one size, one scale of grey.
class Source : public FrameSource {
 public:
  Source(fs::path name, const FrameOptions& options)
      : name_(std::move(name)), rate_(options.rate), depth_(options.depth) {}
  std::optional<double> rate() const override { return rate_; }
  bool next(VideoFrame& frame) final {
    if (!why_ended_.empty()) return false;
    try {
      const bool read_one = read(frame);
      if (!read_one && !at_end_) note_surplus_times();
      at_end_ = !read_one;
      return read_one;
    } catch (const InputError& error) {
      if (next_ == 0 || times_are_short_) throw;
      why_ended_ = error.what();
      return false;
    }
  }
  std::string why_ended() const override { return why_ended_; }
  std::vector<std::string> notes() const override {
    std::vector<std::string> lines = notes_;
    if (beyond_ > 0)
      lines.push_back(
          fmt::format("{}: {} of {} pictures have samples beyond the first's scale, "
                      "which are cut",
                      name_.string(), beyond_, next_));
    return lines;
  }
  /// Whether `count` is what can be read, if nothing is damaged; a video's header may err.
  virtual bool count_is_certain() const { return true; }
  void set_times(GivenTimes given) {
    given_ = std::move(given);
    const std::vector<double>& t = given_->times;
    if (given_->asked) compare_times();
    if (t.size() > 1) rate_ = static_cast<double>(t.size() - 1) / (t.back() - t.front());
  }
  /// Checks a number of times against a number of pictures that is certain.
  void require_times(std::size_t pictures) const {
    if (given_ && given_->asked && given_->times.size() != pictures)
      fail(given_->name,
           fmt::format("{} times, there are {} pictures", given_->times.size(), pictures));
  }

 protected:
  /// The next picture; false at the end. Throws InputError.
  virtual bool read(VideoFrame& frame) = 0;
  const fs::path& name() const { return name_; }
  void note(const std::string& what) { notes_.push_back(name_.string() + ": " + what); }
  void end(const std::string& why) { why_ended_ = why; }
  bool has_times() const { return given_.has_value(); }
  void set_rate(double rate) {
    if (!rate_ && std::isfinite(rate) && rate > 0 && rate < 1e6) rate_ = rate;
  }
  /// Scales a picture as the first one that is not of 8 bits.
  void take(formats::DecodedImage decoded, formats::Image& picture) {
    if (!scale_ && !std::holds_alternative<formats::Image>(decoded)) {
      scale_ = formats::scale_of(decoded);
      if (depth_ && std::holds_alternative<formats::DeepImage>(decoded))
        scale_ = formats::GreyScale::of_depth(*depth_);
      else if (const std::string text = formats::scale_note(decoded, *scale_); !text.empty())
        note(text);
    }
    beyond_ += formats::take_pixels(std::move(decoded), scale_.value_or(formats::GreyScale{}),
                                    picture) > 0;
  }
  /// Numbers a picture and checks its size; `file` is where it came from, `t` its time, if the
  /// source knows it.
  void number(VideoFrame& frame, const fs::path& file, std::optional<double> t = std::nullopt) {
    const formats::Image& p = frame.picture;
    if (next_ == 0) {
      width_ = p.width;
      height_ = p.height;
    }
    if (p.width != width_ || p.height != height_)
      fail(file, size_text(p.width, p.height) + " pixels, the first picture has " +
                     size_text(width_, height_));
    frame.index = next_;
    frame.t = given_ ? given_time() : t.value_or(frame.index / rate_.value_or(1));
    ++next_;
  }
  int given() const { return next_; }

 private:
  static std::string size_text(int width, int height) {
    return std::to_string(width) + "x" + std::to_string(height);
  }
  double given_time() {
    const auto at = static_cast<std::size_t>(next_);
    if (at < given_->times.size()) return given_->times[at];
    times_are_short_ = given_->asked;
    fail(given_->name, fmt::format("{} times, {} has more pictures", at, name_.string()));
  }
  /// Notes times that go far from the source's own.
  void compare_times() {
    constexpr double far = 2;  // times the source's own
    const std::vector<double>& t = given_->times;
    if (!rate_ || t.size() < 2) return;
    const double apart = (t.back() - t.front()) / static_cast<double>(t.size() - 1);
    const double ratio = apart * *rate_;
    if (ratio > far || ratio < 1 / far)
      note(
          fmt::format("the times of {} are {:.4g} s apart, those in the file {:.4g} s: are they "
                      "in seconds?",
                      given_->name, apart, 1 / *rate_));
  }
  void note_surplus_times() {
    if (given_ && given_->times.size() > static_cast<std::size_t>(next_))
      note(fmt::format("{} holds {} times, there are {} pictures",
                       given_->name.empty() ? "it" : given_->name, given_->times.size(), next_));
  }

  fs::path name_;
  std::optional<double> rate_;
  std::optional<int> depth_;
  std::optional<formats::GreyScale> scale_;
  std::optional<GivenTimes> given_;
  std::string why_ended_;
  std::vector<std::string> notes_;
  bool times_are_short_ = false;
  bool at_end_ = false;
  int beyond_ = 0;
  int next_ = 0;
  int width_ = 0;
  int height_ = 0;
};

bool is_tiff(const fs::path& file) {
  const std::string extension = lower_extension(file);
  return extension == ".tif" || extension == ".tiff";
}

/// Whether a PNG holds several pictures: a chunk acTL before those of pixels.
bool is_animated_png(const fs::path& file) {
  constexpr int max_chunks = 1000;
  if (lower_extension(file) != ".png") return false;
  std::ifstream in(file, std::ios::binary);
  std::array<unsigned char, 8> head{};
  in.seekg(head.size());  // behind the signature
  for (int k = 0; k < max_chunks && in.read(reinterpret_cast<char*>(head.data()), head.size());
       ++k) {
    const std::string_view type(reinterpret_cast<const char*>(&head[4]), 4);
    if (type == "acTL") return true;
    if (type == "IDAT" || type == "IEND") return false;
    const std::uint32_t length =
        static_cast<std::uint32_t>(head[0]) << 24U | head[1] << 16U | head[2] << 8U | head[3];
    in.seekg(std::streamoff{length} + 4, std::ios::cur);
  }
  return false;
}

/// Reads the only picture of a TIFF; in a folder a file holds one picture.
formats::DecodedImage read_only_page(const fs::path& file) {
  formats::TiffPages pages(file);
  if (pages.count() > 1)
    fail(file,
         "holds " + std::to_string(pages.count()) + " pictures: name the file, not its folder");
  if (const int channels = pages.description().pixel_channels; channels > 1)
    fail(file, "its pixels have " + std::to_string(channels) +
                   " channels that are no colours: save one of them in each file");
  return pages.next();
}

class Pictures : public Source {
 public:
  Pictures(const fs::path& name, std::vector<fs::path> files, const FrameOptions& options)
      : Source(name, options), files_(std::move(files)) {
    const auto notes = choose_pictures(files_, options.stack_channel, options.slice, name.string());
    for (const std::string& text : notes) note(text);
    numbers_ = numbers_in(files_);
    if (!numbers_ && options.times.empty() && differ_in_several(files_))
      note(
          fmt::format("names such as {} differ in more than one number: the pictures are read in "
                      "their order, evenly in time; gaps need {}",
                      files_.front().filename().string(), input_name("times")));
    if (numbers_ && numbers_->gaps > 0 && options.times.empty())
      note(fmt::format("numbers in the names have {} gap{}, first between {}: gaps in time",
                       numbers_->gaps, numbers_->gaps == 1 ? "" : "s", numbers_->first_gap));
  }
  bool read(VideoFrame& frame) override {
    const auto at = static_cast<std::size_t>(given());
    if (at >= files_.size()) return false;
    if (is_tiff(files_[at]))
      take(read_only_page(files_[at]), frame.picture);
    else if (files_.size() > 1 && is_animated_png(files_[at]))
      fail(files_[at], "holds several pictures: name the file, not its folder");
    else
      take(formats::read_stored(files_[at]), frame.picture);
    std::optional<double> t;
    if (numbers_ && numbers_->gaps > 0) t = numbers_->steps[at] / rate().value_or(1);
    number(frame, files_[at], t);
    return true;
  }
  std::optional<int> count() const override { return static_cast<int>(files_.size()); }

 private:
  std::vector<fs::path> files_;
  std::optional<NumberedNames> numbers_;
};

std::vector<fs::path> pictures_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (formats::has_image_extension(entry.path()) && entry.path().filename().string()[0] != '.')
      files.push_back(entry.path());
  if (files.empty()) fail(folder, "no pictures in this folder (PNG, JPEG, BMP, TIFF, PGM or PPM)");
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
  TiffStack(const fs::path& file, const FrameOptions& options)
      : Source(file, options),
        pages_(file),
        chosen_(choose_pages(pages_.description(), pages_.count(), options, file.string())) {
    const formats::TiffDescription& told = pages_.description();
    for (const std::string& text : chosen_.notes) note(text);
    for (const std::string& text : pages_.notes()) note(text);
    pages_.take_channel(chosen_.pixel_channel);
    if (told.um_per_px && told.um_per_px_y &&
        std::abs(*told.um_per_px - *told.um_per_px_y) > 1e-3 * *told.um_per_px)
      note(fmt::format("pixels of {:.6g} × {:.6g} µm are not square", *told.um_per_px,
                       *told.um_per_px_y));
    if (options.rate) return;
    if (!options.times.empty()) {
      const std::vector<double>& own = chosen_.times;
      if (own.size() > 1)
        set_rate(static_cast<double>(own.size() - 1) / (own.back() - own.front()));
      else if (told.interval)
        set_rate(1 / *told.interval);
      return;
    }
    if (chosen_.times.size() > 1) {
      note(fmt::format("the times are those that {} states", told.software));
      const double zero = chosen_.times.front();
      for (double& t : chosen_.times) t -= zero;
      set_times({chosen_.times, {}, false});
    } else if (told.interval) {
      note(fmt::format("pictures are {:.6g} s apart, as {} says", *told.interval, told.software));
      set_rate(1 / *told.interval);
    }
  }
  bool read(VideoFrame& frame) override {
    const auto at = static_cast<std::size_t>(given());
    if (at >= chosen_.pages.size()) {
      end(pages_.why_fewer());
      return false;
    }
    pages_.go_to(chosen_.pages[at]);
    take(pages_.next(), frame.picture);
    std::optional<double> t;
    if (chosen_.has_gaps) t = chosen_.steps[at] / rate().value_or(1);
    number(frame, name(), t);
    return true;
  }
  std::optional<int> count() const override { return static_cast<int>(chosen_.pages.size()); }
  bool count_is_certain() const override { return pages_.why_fewer().empty(); }
  std::optional<double> um_per_px() const override { return pages_.description().um_per_px; }

 private:
  formats::TiffPages pages_;
  StackPages chosen_;
};

class VideoFile : public Source {
 public:
  VideoFile(const fs::path& file, const FrameOptions& options)
      : Source(file, options), video_(formats::media().open(file)) {
    if (!video_) fail(file, "is no video that can be read");
    require_fit(file, {video_->width, video_->height});
    set_rate(video_->rate);
    if (video_->pixel_aspect != 1)
      note(
          fmt::format("its pixels are {:.4g} times as wide as high: the pictures are stretched to "
                      "{}x{} square ones",
                      video_->pixel_aspect, video_->width, video_->height));
    if (!options.rate && options.times.empty()) {
      clock_.emplace(rate().value_or(1), video_->tick);
      take_recorded_times();
    }
  }
  bool read(VideoFrame& frame) override {
    if (!video_->read(mat_)) {
      if (given() == 0) fail(name(), "holds no picture that can be read");
      check_end();
      return false;
    }
    take_picture(mat_, frame.picture);
    in_file_ = video_->time.value_or(in_file_);
    std::optional<double> t;
    if (clock_) t = clock_->next(video_->time);
    number(frame, name(), t);
    return true;
  }
  std::optional<int> count() const override {
    const double told = video_->picture_count;
    if (!(told >= 1 && told < 1e9)) return std::nullopt;
    return static_cast<int>(told);
  }
  bool count_is_certain() const override { return false; }
  std::vector<std::string> notes() const override {
    std::vector<std::string> lines = Source::notes();
    if (clock_ && !has_times())
      for (const std::string& text : clock_->notes())
        lines.push_back(name().string() + ": " + text);
    return lines;
  }

 private:
  /// Times that VideoRecorder wrote beside its video.
  void take_recorded_times() {
    const fs::path table = VideoRecorder::times_file(name());
    std::error_code none;
    if (!fs::is_regular_file(table, none)) return;
    try {
      const std::string text = read_file(table);
      if (!is_recorded_table(text)) {
        if (has_times_column(text))
          note(
              fmt::format("the times of {} beside it are not used: it is no table of a recording; "
                          "give it as {}",
                          table.string(), input_name("times")));
        return;
      }
      set_times({parse_frame_times(text, table.string()), table.string(), false});
      note("the times are those of " + table.string() + ", which was recorded with it");
    } catch (const InputError& error) {
      note("the table beside it is not used: " + std::string(error.what()));
    }
  }
  /// A file without a number of pictures may say when they end.
  void check_end() {
    if (video_->is_cut) end(name().string() + ": is cut off");
    if (count() || !clock_ || video_->end <= 0) return;
    const double end_s = video_->end;
    if (in_file_ + 1.5 * clock_->widest() + 0.01 * end_s < end_s)
      end(fmt::format("{}: its pictures end at {:.4g} s, it says that it lasts {:.4g} s",
                      name().string(), in_file_, end_s));
  }

  std::unique_ptr<formats::VideoInput> video_;
  std::optional<ContainerClock> clock_;
  double in_file_ = 0;  ///< time of the last picture in the file [s]
  cv::Mat mat_;
};

std::unique_ptr<Source> open_source(const fs::path& source, const FrameOptions& options) {
  std::error_code error;
  const fs::file_status status = fs::status(source, error);
  if (!fs::exists(status)) fail(source, "cannot read: No such file or directory");
  if (fs::is_directory(status))
    return std::make_unique<Pictures>(source, pictures_in(source), options);
  if (!fs::is_regular_file(status)) fail(source, "is neither a file nor a folder");
  if (fs::file_size(source) == 0) fail(source, "is empty");
  if (is_tiff(source)) return std::make_unique<TiffStack>(source, options);
  if (is_animated_png(source)) return std::make_unique<VideoFile>(source, options);
  if (formats::has_image_extension(source))
    return std::make_unique<Pictures>(source, std::vector<fs::path>{source}, options);
  return std::make_unique<VideoFile>(source, options);
}

}  // namespace

std::unique_ptr<FrameSource> open_frames(const fs::path& source, const FrameOptions& options) {
  std::unique_ptr<Source> opened = open_source(source, options);
  if (!options.times.empty()) {
    opened->set_times({read_frame_times(options.times), options.times.string(), true});
    if (opened->count_is_certain())
      opened->require_times(static_cast<std::size_t>(opened->count().value_or(0)));
  }
  return opened;
}

std::unique_ptr<FrameSource> open_frames(const fs::path& source, std::optional<double> rate,
                                         std::optional<int> depth) {
  return open_frames(source, FrameOptions{.rate = rate, .depth = depth});
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
