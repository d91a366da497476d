// SPDX-License-Identifier: Apache-2.0
#include "microswarm/navigation/following/follower_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/angles.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm::navigation {

std::optional<std::array<double, feature_count>> FollowerModel::scaled(
    std::array<double, feature_count> features) const {
  for (std::size_t i = 0; i < feature_count; ++i) {
    double& x = features[i];
    if (!(x >= lowest[i] && x <= highest[i])) return std::nullopt;
    x = 2 * (x - lowest[i]) / (highest[i] - lowest[i]) - 1;
  }
  return features;
}

std::optional<Command> FollowerModel::command(const FollowerQuery& query) const {
  const FollowerFeatures seen = to_features(query);
  const auto features = scaled(seen.features);
  if (!features) return std::nullopt;
  std::array<double, 2> answer{};
  network.evaluate(*features, answer);
  const double off = std::clamp(answer[0], -pi, pi);
  return Command{wrap(seen.bearing + off),
                 std::clamp(answer[1], min_speed_share, 1.0) * query.speed};
}

namespace {

constexpr std::string_view version = "1";
constexpr std::size_t max_layers = 6;
constexpr double max_magnitude = 1e6;  // of a weight or a feature
constexpr std::size_t max_text = 4096;

template <class Values>
std::string list_text(const Values& values) {
  std::string text = "[";
  for (const auto& value : values) {
    if (text.size() > 1) text += ", ";
    text += number_text(static_cast<double>(value));
  }
  return text + "]\n";
}

/// Reads a model line by line; skips blank lines and comments. Before the first line that is one of
/// a model, messages do not quote the file: it may be another one, named by mistake or malice.
class Reader {
 public:
  Reader(std::string_view text, std::string_view name) : rest_(text), name_(name) {}

  [[noreturn]] void fail(const std::string& why) const { throw InputError(name_, line_, 0, why); }

  /// Rest of the next line, which must start with `begin`.
  std::string_view after(std::string_view begin) {
    const std::string_view line = next();
    if (!line.starts_with(begin)) fail(fmt::format("{} must stand here", quote(begin)));
    return line.substr(begin.size());
  }

  /// Between `least` and `max_many` numbers in brackets.
  std::vector<double> numbers(std::string_view begin, std::size_t least, std::size_t max_many) {
    std::string_view list = after(begin);
    if (list.size() < 2 || list.front() != '[' || list.back() != ']')
      fail(fmt::format("{} must be numbers in brackets", quote(begin)));
    list = list.substr(1, list.size() - 2);
    std::vector<double> values;
    values.reserve(max_many);
    for (bool more = true; more;) {
      const auto comma = list.find(", ");
      more = comma != std::string_view::npos;
      const auto value = parse_number(list.substr(0, comma));
      if (!value || std::abs(*value) > max_magnitude)
        fail(
            fmt::format("{} is no number within ±{}", quote(list.substr(0, comma)), max_magnitude));
      values.push_back(*value);
      if (more) list.remove_prefix(comma + 2);
      if (more && values.size() == max_many) fail(fmt::format("more than {} numbers", max_many));
    }
    if (values.size() < least) fail(fmt::format("{} numbers, must be {}", values.size(), least));
    return values;
  }

  void end() {
    if (const std::string_view line = next(); !line.empty()) fail("the model must end here");
  }

 private:
  std::string_view next() {
    while (!rest_.empty()) {
      const auto end = std::min(rest_.find('\n'), rest_.size());
      const std::string_view line = rest_.substr(0, end);
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      ++line_;
      if (!line.empty() && line.front() != '#') return line;
    }
    return {};
  }

  std::string_view rest_;
  std::string name_;
  int line_ = 0;
};

std::vector<std::size_t> read_layers(Reader& in) {
  std::vector<std::size_t> layers;
  layers.reserve(max_layers);
  for (const double width : in.numbers("layers: ", 2, max_layers)) {
    if (!(width >= 1 && width <= MultilayerPerceptron::max_width) || width != std::floor(width))
      in.fail(fmt::format("a layer of {}, allowed 1..{}", number_text(width),
                          MultilayerPerceptron::max_width));
    layers.push_back(static_cast<std::size_t>(width));
  }
  if (layers.front() != feature_count)
    in.fail(fmt::format("{} inputs, must be {}", layers.front(), feature_count));
  if (layers.back() != 2) in.fail(fmt::format("{} outputs, must be 2", layers.back()));
  return layers;
}

std::uint64_t read_seed(Reader& in) {
  const std::string_view text = in.after("seed: ");
  std::uint64_t seed = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (error != std::errc() || end != text.data() + text.size())
    in.fail("seed is " + quote(text) + ", must be a whole number");
  return seed;
}

}  // namespace

std::string follower_model_text(const FollowerModel& model) {
  std::string text = "# A learned follower of microswarm: docs/explanation/learned-follower.md\n";
  text += fmt::format("version: {}\nseed: {}\ntraining: {}\n", version, model.seed, model.training);
  text += "layers: " + list_text(model.network.layers);
  text += "lowest: " + list_text(model.lowest);
  text += "highest: " + list_text(model.highest);
  text += "# One row an output of a layer: the weights of its inputs, then its bias.\nweights:\n";
  const double* w = model.network.weights.data();
  const auto& layers = model.network.layers;
  for (std::size_t k = 0; k + 1 < layers.size(); ++k)
    for (std::size_t o = 0; o < layers[k + 1]; ++o, w += layers[k] + 1)
      text += "  - " + list_text(std::span(w, layers[k] + 1));
  return text;
}

FollowerModel parse_follower_model(std::string_view text, std::string_view name) {
  Reader in(text, name);
  FollowerModel model;
  if (const auto v = in.after("version: "); v != version)
    in.fail(fmt::format("version is {}, must be {}", quote(v), version));
  model.seed = read_seed(in);
  model.training = in.after("training: ");
  if (model.training.size() > max_text || model.training != one_line(model.training, max_text))
    in.fail(fmt::format("training must be at most {} plain characters", max_text));
  model.network.layers = read_layers(in);
  const auto lowest = in.numbers("lowest: ", feature_count, feature_count);
  const auto highest = in.numbers("highest: ", feature_count, feature_count);
  std::copy(lowest.begin(), lowest.end(), model.lowest.begin());
  std::copy(highest.begin(), highest.end(), model.highest.begin());
  for (std::size_t i = 0; i < feature_count; ++i)
    if (!(lowest[i] < highest[i]))
      in.fail(fmt::format("feature {}: highest is {}, must be above the lowest, {}", i + 1,
                          number_text(highest[i]), number_text(lowest[i])));
  if (!in.after("weights:").empty()) in.fail("the weights begin on the next line");
  const auto& layers = model.network.layers;
  model.network.weights.reserve(MultilayerPerceptron::weight_count(layers));
  for (std::size_t k = 0; k + 1 < layers.size(); ++k)
    for (std::size_t o = 0; o < layers[k + 1]; ++o) {
      const auto row = in.numbers("  - ", layers[k] + 1, layers[k] + 1);
      model.network.weights.insert(model.network.weights.end(), row.begin(), row.end());
    }
  in.end();
  return model;
}

}  // namespace microswarm::navigation
