// SPDX-License-Identifier: Apache-2.0
#include "microswarm/report/plot.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>

#include "microswarm/core/error.hpp"
#include "microswarm/core/file.hpp"

extern char** environ;

namespace microswarm {
namespace {

constexpr std::array<const char*, 7> palette{"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                             "#E69F00", "#56B4E9", "#333333"};

std::string in_quotes(std::string_view s) {
  std::string out = "\"";
  for (char c : s) {
    if (c == '\n') continue;
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

std::string data_block(std::size_t plot, std::size_t series, const Series& s) {
  std::string out = fmt::format("$d{}_{} << EOD\n", plot, series);
  for (std::size_t i = 0; i < std::min(s.x.size(), s.y.size()); ++i)
    out += fmt::format("{:.9g} {:.9g}\n", s.x[i], s.y[i]);
  return out + "EOD\n";
}

std::string drawn(std::size_t plot, std::size_t series, const Series& s) {
  const std::string data = fmt::format("$d{}_{}", plot, series);
  const std::string colour = palette[series % palette.size()];
  const std::string title = s.label.empty() ? "notitle" : "title " + in_quotes(s.label);
  switch (s.style) {
    case PlotStyle::line:
      return fmt::format("{} using 1:2 with lines lw 2 lc rgb '{}' {}", data, colour, title);
    case PlotStyle::points:
      return fmt::format("{} using 1:2 with points pt 7 ps 0.6 lc rgb '{}' {}", data, colour,
                         title);
    case PlotStyle::bars:
      return fmt::format("{} using 1:2 with boxes fs solid 0.7 lc rgb '{}' {}", data, colour,
                         title);
    case PlotStyle::box:
      return fmt::format("{} using ({}):2:(0.5) with boxplot fs solid 0.3 lc rgb '{}' notitle",
                         data, s.x.empty() ? 0.0 : s.x[0], colour);
  }
  return {};
}

std::string panel(const Plot& plot, std::size_t index) {
  std::string out =
      fmt::format("set title {}\nset xlabel {}\nset ylabel {}\n", in_quotes(plot.title),
                  in_quotes(plot.x_label), in_quotes(plot.y_label));
  out += plot.log_y ? "set logscale y\n" : "unset logscale\n";
  const auto limit = [](std::optional<double> y) { return y ? fmt::format("{:g}", *y) : "*"; };
  out += fmt::format("set yrange [{}:{}]\n", limit(plot.y_min), limit(plot.y_max));
  std::vector<std::string> tics;
  std::vector<std::string> items;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const Series& s = plot.series[i];
    if (s.x.empty()) continue;
    if (s.style == PlotStyle::box)
      tics.push_back(fmt::format("{} {:g}", in_quotes(s.label), s.x[0]));
    items.push_back(drawn(index, i, s));
  }
  for (std::size_t i = 0; i < plot.levels.size(); ++i)
    items.push_back(fmt::format("{:.9g} with lines dt 2 lw 1.5 lc rgb '{}' title {}",
                                plot.levels[i].y, i == 0 ? "#444444" : "#888888",
                                in_quotes(plot.levels[i].label)));
  out += tics.empty() ? "set xtics auto\n"
                      : fmt::format("set xtics ({}) rotate by -20\n", fmt::join(tics, ", "));
  if (items.empty()) items.push_back("0 notitle");
  return out + fmt::format("plot {}\n", fmt::join(items, ", \\\n  "));
}

std::string terminal(const std::string& kind, std::size_t panels) {
  const std::size_t width = 640 * panels;
  if (kind == ".png") return fmt::format("pngcairo size {},460 font 'sans,11'", width);
  if (kind == ".svg")
    return fmt::format("svg size {},460 font 'sans,13' background 'white'", width);
  return fmt::format("pdfcairo size {:g}in,4.2in font 'sans,11'",
                     5.8 * static_cast<double>(panels));
}

/// What gnuplot draws, as it writes it to its stdout; nothing when it cannot be started or fails.
std::optional<std::string> drawn_by_gnuplot(const std::filesystem::path& script) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return std::nullopt;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawnattr_t attributes;  // in a group of its own, Ctrl-C does not reach it
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  std::string program = "gnuplot";
  std::string argument = script.string();
  char* const arguments[] = {program.data(), argument.data(), nullptr};
  pid_t child = 0;
  const int error = posix_spawnp(&child, "gnuplot", &actions, &attributes, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  ::close(ends[1]);
  std::string bytes;
  std::array<char, 1 << 16> buffer;
  for (;;) {  // ends when gnuplot does
    const ssize_t n = ::read(ends[0], buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    bytes.append(buffer.data(), static_cast<std::size_t>(n));
  }
  ::close(ends[0]);
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
    throw InputError(path.string() + ": a plot is .png, .svg or .pdf");
  std::string script = fmt::format("set terminal {}\n", terminal(kind, plots.size()));
  script +=
      "set grid lc rgb '#dddddd'\nset key top right\nset style boxplot outliers pointtype 7\n"
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
  if (!picture) throw InputError(path.string() + ": cannot plot: gnuplot is missing or failed");
  write_file_atomically(path, *picture);
}

}  // namespace microswarm
