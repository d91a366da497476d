// SPDX-License-Identifier: Apache-2.0
#include "lab/files/uploads.hpp"

#include <fmt/format.h>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/experiment/record/record.hpp"
#include "microswarm/experiment/scenario/experiment.hpp"
#include "microswarm/formats/images/image.hpp"

namespace microswarm::lab {
namespace {

namespace fs = std::filesystem;

constexpr int max_files = 200;
constexpr std::size_t max_total = 512 * 1024 * 1024;
constexpr std::size_t max_scenario = 2 * 1024 * 1024;  // read in 20 s at most

/// Removes a file in its destructor unless it is kept.
class Trial {
 public:
  explicit Trial(fs::path file) : file_(std::move(file)) {}
  ~Trial() {
    std::error_code ignored;
    if (!kept_) fs::remove(file_, ignored);
  }
  Trial(const Trial&) = delete;
  Trial& operator=(const Trial&) = delete;
  void keep() { kept_ = true; }

 private:
  fs::path file_;
  bool kept_ = false;
};

}  // namespace

fs::path Uploads::new_file(std::string_view extension) {
  if (count_ >= max_files) throw InputError("this lab has too many uploads: start it again");
  return folder() / fmt::format("upload-{}{}", ++count_, extension);
}

Upload Uploads::keep(std::string_view name, const std::string& bytes, const Library& library) {
  const std::string shown = one_line(name.substr(0, 200));
  std::string extension = lower_extension(name);
  if (extension == ".yml") extension = ".yaml";
  const bool is_picture = formats::has_image_extension(name);
  if (!is_picture && extension != ".yaml" && extension != ".h5")
    throw InputError(shown, "neither a photograph, a scenario (.yaml) nor a record (.h5)");
  if (extension == ".yaml" && bytes.size() > max_scenario)
    throw InputError(shown, fmt::format("a scenario of {:.1f} MiB, a page may send 2 MiB: put it "
                                        "into the lab's folder, or start the lab with it",
                                        static_cast<double>(bytes.size()) / (1024 * 1024)));
  if (size_ + bytes.size() > max_total)
    throw InputError("the uploads of this lab are too large together: start it again");
  const fs::path file = new_file(extension);
  Trial trial(file);
  write_file_atomically(file, bytes);
  Upload made{.file = file.string()};
  try {
    if (is_picture) {
      const formats::Image image = formats::read_photograph(file);
      made.kind = Upload::Kind::photograph;
      made.width = image.width;
      made.height = image.height;
    } else if (extension == ".yaml") {
      library.check_all(file);
      experiment::open_experiment(file);
      made.kind = Upload::Kind::scenario;
    } else {
      experiment::read_record(file);
    }
  } catch (const InputError& error) {
    throw_renamed(error, file, shown);
  }
  size_ += bytes.size();
  trial.keep();
  return made;
}

}  // namespace microswarm::lab
