// SPDX-License-Identifier: Apache-2.0
#include "microswarm/report/plot.hpp"
#include "microswarm/core/execution/descriptor.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <limits>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/maths/maths.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/text.hpp"

extern char** environ;

namespace microswarm::report {
namespace {

constexpr std::array<const char*, 8> palette{"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                             "#E69F00", "#56B4E9", "#333333", "#7A5C3E"};

constexpr std::ptrdiff_t max_upright_letters = 4;  // longer labels are rotated
constexpr const char* band_colour = "#ececec";
constexpr std::array<int, 7> markers{7, 5, 9, 11, 13, 8, 4};  // gnuplot point types

/// Quotes a text for gnuplot, which would execute text between back quotes.
std::string in_quotes(std::string_view s) {
  std::string out = "\"";
  for (char c : printable(s)) {
    if (c == '\n') continue;
    if (c == '`') c = '\'';
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

bool has_intervals(const Series& s) {
  return !s.low.empty() && s.low.size() == s.y.size() && s.high.size() == s.y.size();
}

std::string data_block(std::size_t plot, std::size_t series, const Series& s) {
  std::string out = fmt::format("$d{}_{} << EOD\n", plot, series);
  const bool intervals = has_intervals(s);
  for (std::size_t i = 0; i < std::min(s.x.size(), s.y.size()); ++i) {
    out += fmt::format("{:.9g} {:.9g}", s.x[i], s.y[i]);
    out += intervals ? fmt::format(" {:.9g} {:.9g}\n", s.low[i], s.high[i]) : "\n";
  }
  return out + "EOD\n";
}

std::string drawn(std::size_t plot, std::size_t series, const Series& s) {
  const std::string data = fmt::format("$d{}_{}", plot, series);
  const std::string colour = palette[s.colour.value_or(series) % palette.size()];
  const std::string title = s.label.empty() ? "notitle" : "title " + in_quotes(s.label);
  switch (s.style) {
    case PlotStyle::line:
      return fmt::format("{} using 1:2 with lines lw 2 lc rgb '{}' {}", data, colour, title);
    case PlotStyle::marked:
      return fmt::format("{} using {} lw 2 pt {} ps 0.7 lc rgb '{}' {}", data,
                         has_intervals(s) ? "1:2:3:4 with yerrorlines" : "1:2 with linespoints",
                         markers[series % markers.size()], colour, title);
    case PlotStyle::rings:
      return fmt::format("{} using 1:2 with points pt 6 ps 1.2 lc rgb '{}' {}", data, colour,
                         title);
    case PlotStyle::points:
      return fmt::format("{} using {} pt 7 ps 0.7 lc rgb '{}' {}", data,
                         has_intervals(s) ? "1:2:3:4 with yerrorbars lw 1.5" : "1:2 with points",
                         colour, title);
    case PlotStyle::published:
      return fmt::format("{} using 1:2 with points pt 12 ps 1.3 lw 2 lc rgb '{}' {}", data, colour,
                         title);
    case PlotStyle::filled:
      return fmt::format(
          "{0} using 1:2 with filledcurves closed fc rgb '{1}' fs transparent solid 0.35 border "
          "rgb "
          "'{1}' {2}",
          data, colour, title);
    case PlotStyle::bars:
      return fmt::format("{} using 1:2 with boxes fs solid 0.7 lc rgb '{}' {}", data, colour,
                         title);
    case PlotStyle::box:
      return fmt::format("{} using ({}):2:(0.5) with boxplot fs solid 0.3 lc rgb '{}' notitle",
                         data, s.x.empty() ? 0.0 : s.x[0], colour);
  }
  return {};
}

std::string listed(const std::vector<AxisTick>& ticks) {
  std::vector<std::string> out;
  out.reserve(ticks.size());
  for (const AxisTick& tick : ticks)
    out.push_back(fmt::format("{} {:.9g}", in_quotes(tick.label), tick.at));
  return fmt::format("({})", fmt::join(out, ", "));
}

/// Ticks at 1, 2, 5, 10, … over the data; empty if the range is empty or too large.
std::vector<AxisTick> log_ticks(const Plot& plot) {
  double least = plot.y_min.value_or(std::numeric_limits<double>::infinity());
  double most = plot.y_max.value_or(0);
  for (const Series& s : plot.series)
    for (const double y : s.y) {
      if (y <= 0) continue;
      if (!plot.y_min) least = std::min(least, y);
      if (!plot.y_max) most = std::max(most, y);
    }
  std::vector<AxisTick> out;
  if (!(least > 0) || !(most < 1e3 * least)) return out;
  const int last = static_cast<int>(std::ceil(maths::log10(most)));
  for (int power = static_cast<int>(std::floor(maths::log10(least))); power <= last; ++power)
    for (const double digit : {1, 2, 5}) {
      const double at = digit * maths::power(10, power);
      out.push_back({fmt::format("{:g}", at), at});
    }
  return out;
}

std::ptrdiff_t letter_count(const std::string& s) {
  return std::ranges::count_if(s, [](char c) { return (c & 0xC0) != 0x80; });
}

std::string axes(const Plot& plot) {
  const auto limit = [](std::optional<double> v) { return v ? fmt::format("{:g}", *v) : "*"; };
  std::string out = fmt::format("set xrange [{}:{}]\nset yrange [{}:{}]\n", limit(plot.x_min),
                                limit(plot.x_max), limit(plot.y_min), limit(plot.y_max));
  out += plot.equal_scale ? "set size ratio -1\n" : "set size noratio\n";
  out += "unset logscale\n";
  if (plot.log_x) out += "set logscale x\n";
  if (plot.log_y) out += "set logscale y\n";
  std::vector<AxisTick> names = plot.x_ticks;
  if (names.empty())
    for (const Series& s : plot.series)
      if (s.style == PlotStyle::box && !s.x.empty()) names.push_back({s.label, s.x[0]});
  const bool wide = std::ranges::any_of(
      names, [](const AxisTick& t) { return letter_count(t.label) > max_upright_letters; });
  out += names.empty()
             ? "set xtics norotate autojustify auto\n"
             : fmt::format("set xtics {} {}\n",
                           wide ? "rotate by 50 right" : "norotate autojustify", listed(names));
  const std::vector<AxisTick> ticks =
      plot.y_ticks.empty() && plot.log_y ? log_ticks(plot) : plot.y_ticks;
  out += ticks.empty() ? "set ytics auto\n" : fmt::format("set ytics {}\n", listed(ticks));
  return out;
}

/// Bands and marks; resets them first, because gnuplot keeps them from panel to panel.
std::string ground(const Plot& plot) {
  std::string out = "unset object\nunset arrow\nunset label\n";
  for (const Band& band : plot.bands)
    out += fmt::format(
        "set object rectangle from {:.9g}, graph 0 to {:.9g}, graph 1 behind fc rgb '{}' fs solid "
        "noborder\n",
        band.from, band.to, band_colour);
  for (const Mark& mark : plot.marks)
    out += fmt::format(
        "set arrow from {0:.9g}, graph 0 to {0:.9g}, graph 1 nohead dt 3 lc rgb '#666666'\n"
        "set label {1} at {0:.9g}, graph 0.98 rotate by 90 right offset -0.6,0 font ',9' tc rgb "
        "'#444444'\n",
        mark.x, in_quotes(mark.label));
  return out;
}

std::string panel(const Plot& plot, std::size_t index) {
  std::string out =
      fmt::format("set title {}\nset xlabel {} offset 0,{}\nset ylabel {}\n", in_quotes(plot.title),
                  in_quotes(plot.x_label), plot.key_below ? 0.6 : 0.0, in_quotes(plot.y_label));
  out += axes(plot) + ground(plot);
  out += plot.key_below ? "set key outside below center height 0.5 samplen 2.5\n"
                        : "set key inside top right height 0 samplen 4\n";
  std::vector<std::string> items;
  for (std::size_t i = 0; i < plot.series.size(); ++i)
    if (!plot.series[i].x.empty()) items.push_back(drawn(index, i, plot.series[i]));
  for (std::size_t i = 0; i < plot.levels.size(); ++i)
    items.push_back(fmt::format("{:.9g} with lines dt 2 lw 1.5 lc rgb '{}' title {}",
                                plot.levels[i].y, i == 0 ? "#444444" : "#888888",
                                in_quotes(plot.levels[i].label)));
  if (!plot.bands.empty() && !plot.band_label.empty())
    items.push_back(fmt::format("keyentry with boxes fs solid noborder lc rgb '{}' title {}",
                                band_colour, in_quotes(plot.band_label)));
  if (items.empty()) items.emplace_back("0 notitle");
  return out + fmt::format("plot {}\n", fmt::join(items, ", \\\n  "));
}

std::string terminal(const std::string& kind, std::size_t panels) {
  const std::size_t width = 640 * panels;
  if (kind == ".png") return fmt::format("pngcairo noenhanced size {},460 font 'sans,11'", width);
  if (kind == ".svg")
    return fmt::format("svg noenhanced size {},460 font 'sans,13' background 'white'", width);
  return fmt::format("pdfcairo noenhanced size {:g}in,4.2in font 'sans,11'",
                     5.8 * static_cast<double>(panels));
}

/// The stdout of gnuplot for a script; empty if it cannot be started or fails.
std::optional<std::string> drawn_by_gnuplot(const std::filesystem::path& script) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return std::nullopt;
  const Descriptor out(ends[0]);
  Descriptor in(ends[1]);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, in.get(), STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawnattr_t attributes;  // own process group, so Ctrl-C does not reach it
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  std::string program = "gnuplot";
  std::string argument =
      std::filesystem::absolute(script).string();  // an absolute path cannot look like an option
  char* const arguments[] = {program.data(), argument.data(), nullptr};
  pid_t child = 0;
  const int error = posix_spawnp(&child, "gnuplot", &actions, &attributes, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  in.close();
  std::string bytes;
  std::array<char, 1 << 16> buffer;
  for (;;) {  // ends when gnuplot does
    const ssize_t n = ::read(out.get(), buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    bytes.append(buffer.data(), static_cast<std::size_t>(n));
  }
  int status = 0;
  if (error != 0) return std::nullopt;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || bytes.empty()) return std::nullopt;
  return bytes;
}

}  // namespace

void write_plots(const std::vector<Plot>& plots, const std::filesystem::path& path) {
  const std::string kind = path.extension().string();
  if (kind != ".png" && kind != ".svg" && kind != ".pdf")
    throw InputError(path.string(), "a plot is .png, .svg or .pdf");
  std::string script = fmt::format("set terminal {}\n", terminal(kind, plots.size()));
  script +=
      "set grid xtics ytics lt 1 lc rgb '#e4e4e4'\nset style boxplot outliers pointtype 7\n"
      "set boxwidth 0.8 relative\n";
  for (std::size_t i = 0; i < plots.size(); ++i)
    for (std::size_t j = 0; j < plots[i].series.size(); ++j)
      script += data_block(i, j, plots[i].series[j]);
  script += fmt::format("set multiplot layout 1,{}\n", plots.size());
  for (std::size_t i = 0; i < plots.size(); ++i) script += panel(plots[i], i);
  script += "unset multiplot\nset output\n";

  std::filesystem::path beside = path;
  const StagedFile script_file(beside.replace_extension(".gnuplot"));  // never committed
  write_file_atomically(script_file.path(), script);
  const std::optional<std::string> picture = drawn_by_gnuplot(script_file.path());
  if (!picture) throw InputError(path.string(), "cannot plot: gnuplot is missing or failed");
  write_file_atomically(path, *picture);
}

void write_plots_everywhere(const std::vector<Plot>& plots, const std::filesystem::path& stem) {
  for (const char* kind : {".png", ".svg", ".pdf"}) write_plots(plots, stem.string() + kind);
}

}  // namespace microswarm::report
