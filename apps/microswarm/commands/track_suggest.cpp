// SPDX-License-Identifier: Apache-2.0
#include "commands/track_suggest.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "commands/track_output.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/maths.hpp"
#include "microswarm/report/plot.hpp"
#include "microswarm/vision/tracking/particle_suggestion.hpp"
#include "support/cli.hpp"

namespace microswarm::cli {
namespace {

constexpr int max_read = 200;         // pictures read from the beginning of a video
constexpr std::size_t max_used = 20;  // of these, evenly spread

std::vector<formats::Image> sample(vision::FrameSource& source, vision::VideoChannel channel,
                                   const Stop& stop) {
  const int all = std::min(source.count().value_or(max_read), max_read);
  const int step = std::max(1, all / static_cast<int>(max_used));
  std::vector<formats::Image> pictures;
  vision::VideoFrame frame;
  int read = 0;
  for (; !stop() && pictures.size() < max_used && source.next(frame); ++read)
    if (frame.index % step == 0)
      vision::take_channel(frame.picture, channel, pictures.emplace_back());
  if (const std::string why = source.why_ended(); !why.empty())
    note("note: the pictures end at picture {}: {}\n", read, why);
  note_each(source.notes());
  return pictures;
}

/// Rounded to two digits, as text.
std::string typed(double mass) {
  const double unit = maths::pow(10, std::floor(maths::log10(mass)) - 1);
  return fmt::format("{:.6g}", std::round(mass / unit) * unit);
}

/// The suggested options; empty if the given settings are kept.
std::string to_options(const vision::ParticleSuggestion& s, const vision::ParticleParams& given) {
  std::string text;
  const auto add = [&](const std::string& setting) {
    text += (text.empty() ? "--set find." : " --set find.") + setting;
  };
  if (s.kinds.gap) add("min_mass=" + typed(s.params.min_mass));
  if (s.params.diameter != given.diameter) add(fmt::format("diameter_px={}", s.params.diameter));
  if (s.params.tone != given.tone) add(fmt::format("tone={}", enum_name(s.params.tone)));
  return text;
}

void tell(const vision::ParticleSuggestion& s, const vision::ParticleParams& given) {
  print("{} picture{}, {:.1f} features in each without a minimum mass\n", s.pictures,
        s.pictures == 1 ? "" : "s", s.heavier_than(0));
  if (s.kinds.gap) {
    const double robots = s.heavier_than(s.kinds.gap->min_mass());
    print("  noise     {:.1f} in each, of masses to {:.0f}\n", s.heavier_than(0) - robots,
          s.kinds.gap->noise_to);
    print("  robots    {:.1f} in each, of masses from {:.0f}\n", robots, s.kinds.gap->robots_from);
  } else {
    print("  {}: find.min_mass stays {:.6g}, which {:.1f} features in each picture exceed\n",
          s.kinds.has_noise ? "no gap between the masses of noise and robots"
                            : "no noise, the features are of one kind",
          given.min_mass, s.heavier_than(given.min_mass));
  }
  if (s.knows_diameter)
    print("  diameter  {} px, where a robot's mean picture ends\n", s.params.diameter);
  else
    print("  diameter  not seen in the pictures: find.diameter_px stays {}\n", given.diameter);
  const std::string options = to_options(s, given);
  print("{}\n", options.empty() ? "nothing better is suggested" : options);
}

nlohmann::ordered_json to_json(const vision::ParticleSuggestion& s,
                               const vision::ParticleParams& given) {
  nlohmann::ordered_json json{
      {"pictures", s.pictures},
      {"features", s.heavier_than(0)},
      {"robots", s.heavier_than(s.kinds.gap ? s.kinds.gap->min_mass() : given.min_mass)},
      {"gap", nullptr},
      {"diameter_is_seen", s.knows_diameter},
      {"min_mass", s.kinds.gap ? std::stod(typed(s.params.min_mass)) : given.min_mass},
      {"diameter_px", s.params.diameter},
      {"tone", enum_name(s.params.tone)},
      {"options", to_options(s, given)}};
  if (s.kinds.gap) json["gap"] = {s.kinds.gap->noise_to, s.kinds.gap->robots_from};
  return json;
}

/// Histogram of the logarithms of masses, as a line of steps.
report::Series histogram(const std::string& label, const std::vector<double>& masses,
                         int pictures) {
  constexpr double bin = 0.05;  // [decades]
  std::map<int, double> counts;
  for (const double mass : masses)
    if (mass > 0) counts[static_cast<int>(std::floor(maths::log10(mass) / bin))] += 1.0 / pictures;
  report::Series series{.label = label, .x = {}, .y = {}};
  if (counts.empty()) return series;
  for (int k = counts.begin()->first - 1; k <= counts.rbegin()->first + 1; ++k)
    for (const int edge : {k, k + 1}) {
      series.x.push_back(maths::pow(10, bin * edge));
      series.y.push_back(counts.contains(k) ? counts[k] : 0);
    }
  return series;
}

void draw(const vision::ParticleSuggestion& s, const std::filesystem::path& file) {
  const vision::ParticleTone other = s.params.tone == vision::ParticleTone::dark
                                         ? vision::ParticleTone::bright
                                         : vision::ParticleTone::dark;
  report::Plot plot{.title = fmt::format("masses of features, diameter {} px", s.params.diameter),
                    .x_label = "mass [sum of greys]",
                    .y_label = "features in a picture",
                    .series = {histogram(fmt::format("{} features", enum_name(s.params.tone)),
                                         s.masses, s.pictures),
                               histogram(fmt::format("{} features", enum_name(other)),
                                         s.other_masses, s.pictures)},
                    .levels = {},
                    .marks = {},
                    .bands = {},
                    .band_label = {},
                    .x_ticks = {},
                    .y_ticks = {},
                    .log_x = true,
                    .key_below = true,
                    .x_min = {},
                    .x_max = {},
                    .y_min = 0,
                    .y_max = {}};
  plot.marks.push_back({s.kinds.gap ? "suggested" : "find.min_mass", s.params.min_mass});
  if (s.kinds.gap) {
    plot.bands.push_back({s.kinds.gap->noise_to, s.kinds.gap->robots_from});
    plot.band_label = "gap";
  }
  report::write_plots({plot}, file);
}

}  // namespace

int suggest_tracking(const std::string& source, const vision::TrackSettings& settings,
                     const std::filesystem::path& out, bool json, const Stop& stop) {
  const auto frames = vision::open_frames(source, vision::frame_options(settings));
  const std::vector<formats::Image> pictures = sample(*frames, settings.channel, stop);
  if (stop.requested()) return not_reached;
  if (pictures.empty()) throw InputError(source, "has no pictures");
  const vision::ParticleSuggestion s = vision::suggest_particles(pictures, settings.find);
  std::string wrote;
  if (!out.empty()) {
    keep_track_input(out, source);
    const OutFolder hold(out);
    draw(s, out / "masses.png");
    wrote = (out / "masses.png").string();
  }
  if (json)
    print("{}\n", to_json(s, settings.find).dump(2));
  else
    tell(s, settings.find);
  if (!json && !wrote.empty()) print("wrote {}\n", wrote);
  return ok;
}

}  // namespace microswarm::cli
