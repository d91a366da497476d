// SPDX-License-Identifier: Apache-2.0
#include "options.hpp"

#include <charconv>
#include <sstream>

#include "microswarm/core/error.hpp"
#include "microswarm/core/text.hpp"
#include "microswarm/formats/image.hpp"

namespace microswarm::cli {

CLI::App* add_command(CLI::App& parent, const char* name, const char* doc, const char* example) {
  CLI::App* command = parent.add_subcommand(name, doc);
  command->footer(std::string("Example:\n  microswarm ") + example);
  return command;
}

CLI::Validator number(double lo, double hi) {
  return {[lo, hi](std::string& text) -> std::string {
            const std::optional<double> value = parse_number(text);
            if (!value) return "must be a number, not " + quote(text);
            if (*value >= lo && *value <= hi) return {};
            return fmt::format("is {}, allowed {}..{}", text, number_text(lo), number_text(hi));
          },
          ""};
}

CLI::Validator whole(std::uint64_t lo, std::uint64_t hi) {
  return {
      [lo, hi](std::string& text) -> std::string {
        std::uint64_t value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error == std::errc{} && end == text.data() + text.size() && value >= lo && value <= hi)
          return {};
        return fmt::format("must be a whole number {}..{}, not {}", lo, hi, quote(text));
      },
      ""};
}

void add_um_per_px(CLI::App* command, std::optional<double>& value, const char* doc) {
  command->add_option("--um-per-px", value, doc)->type_name("NUMBER")->check(number(1e-6, 1e6));
}

void add_settings(CLI::App* command, std::vector<std::string>& values, const char* doc) {
  command->add_option("--set", values, doc)
      ->type_name("KEY=VALUE")
      ->take_all()
      ->allow_extra_args(false);
}

void add_json(CLI::App* command, bool& value) {
  command->add_flag("--json", value, "Print the result as JSON");
}

void add_photo(CLI::App* command, PhotoOptions& options) {
  command->add_option("--photo", options.file, "Photograph to lay under the pictures")
      ->type_name("FILE");
  add_um_per_px(command, options.um_per_px, "µm per pixel of the photograph, 1e-6..1e6");
  command->get_option("--um-per-px")->needs("--photo");
}

ReportOptions report_options(const PhotoOptions& options) {
  if (options.file.empty()) return {};
  if (!options.um_per_px)
    throw InputError(options.file + ": µm per px is missing: give --um-per-px");
  return {read_image(options.file), *options.um_per_px};
}

std::vector<double> numbers(const std::string& text) {
  std::vector<double> values;
  std::istringstream words(text + ",");
  for (std::string word; std::getline(words, word, ',');) {
    const std::optional<double> value = parse_number(word);
    if (!value) return {};
    values.push_back(*value);
  }
  return values;
}

CLI::Validator place(std::size_t most, const char* form) {
  return {[most, form](std::string& text) -> std::string {
            const std::size_t count = numbers(text).size();
            if (count >= 2 && count <= most) return {};
            return fmt::format("must be {}, not {}", form, quote(text));
          },
          ""};
}

}  // namespace microswarm::cli
