// SPDX-License-Identifier: Apache-2.0
#include "microswarm/vision/camera/picture_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/vision/camera/name_parts.hpp"

namespace microswarm::vision {
namespace {

namespace fs = std::filesystem;

using name_parts::first_run;
using name_parts::is_digit;
using name_parts::lower;
using name_parts::NamePart;
using name_parts::NameParts;
using name_parts::parts_of;
using name_parts::without_zeros;

/// Below, above or at 0 as a is before, after or like b.
int compare(const NamePart& a, const NamePart& b) {
  if (a.text != b.text) return a.text < b.text ? -1 : 1;
  if (a.digits.empty() || b.digits.empty())
    return static_cast<int>(!a.digits.empty()) - static_cast<int>(!b.digits.empty());
  if (a.is_negative != b.is_negative) return a.is_negative ? -1 : 1;
  const int sign = a.is_negative ? -1 : 1;
  const std::string_view m = without_zeros(a.digits), n = without_zeros(b.digits);
  if (m.size() != n.size()) return m.size() < n.size() ? -sign : sign;
  if (m != n) return m < n ? -sign : sign;
  if (a.fraction != b.fraction) return a.fraction < b.fraction ? -sign : sign;
  return 0;
}

/// The only part in whose number names of as many parts differ.
std::optional<std::size_t> varying_part(const std::vector<NameParts>& names) {
  std::optional<std::size_t> varying;
  for (const NameParts& name : names) {
    if (name.size() != names.front().size()) return std::nullopt;
    for (std::size_t i = 0; i < name.size(); ++i) {
      if (name[i] == names.front()[i]) continue;
      if (name[i].text != names.front()[i].text || varying.value_or(i) != i) return std::nullopt;
      varying = i;
    }
  }
  return varying;
}

bool is_letter(char c) { return c >= 'a' && c <= 'z'; }

/// The word before a number: letters at the end of its text.
std::string_view word_before(const NamePart& part) {
  std::size_t begin = part.text.size();
  while (begin > 0 && is_letter(part.text[begin - 1])) --begin;
  return std::string_view(part.text).substr(begin);
}

/// A name without number i and what is called after it, such as GFP in w2GFP.
std::string without_number(const NameParts& name, std::size_t i) {
  std::string rest;
  for (std::size_t k = 0; k < name.size(); ++k) {
    std::string_view text = name[k].text;
    while (k == i + 1 && !text.empty() && is_letter(text.front())) text.remove_prefix(1);
    rest += std::string(text) + '/';
    if (k != i) rest += (name[k].is_negative ? "-" : "") + name[k].digits + '.' + name[k].fraction;
  }
  return rest;
}

/// An axis in names: there are pictures of several of its values at the same other numbers.
struct NamedAxis {
  std::size_t part = 0;
  std::vector<std::string> labels;           ///< ascending
  std::vector<std::string> label_of_file{};  ///< of each
};

std::optional<NamedAxis> axis_in(const std::vector<NameParts>& names,
                                 const std::set<std::string_view>& words) {
  for (std::size_t i = 0; i < names.front().size(); ++i) {
    std::map<std::string, std::set<std::string>> at;  // labels at the other numbers
    std::set<std::pair<std::size_t, std::string>> labels;
    NamedAxis axis{.part = i, .labels = {}};
    for (const NameParts& name : names) {
      if (name.size() != names.front().size() || name[i].digits.empty() ||
          !words.contains(word_before(name[i])))
        break;
      const std::string digits(without_zeros(name[i].digits));
      labels.emplace(digits.size(), digits);
      at[without_number(name, i)].insert(digits);
      axis.label_of_file.push_back(digits);
    }
    if (axis.label_of_file.size() != names.size() || labels.size() < 2 || at.size() < 2) continue;
    const auto repeats = [](const auto& k) { return k.second.size() > 1; };
    if (!std::ranges::any_of(at, repeats)) continue;
    for (const auto& [length, digits] : labels) axis.labels.push_back(digits);
    return axis;
  }
  return std::nullopt;
}

/// Keeps the files of one place of an axis that their names hold.
void choose_along(std::vector<fs::path>& files, const std::set<std::string_view>& words,
                  std::string_view what, std::string_view key, std::optional<int> given,
                  const std::string& folder) {
  const std::vector<NameParts> names = parts_of(files);
  const std::optional<NamedAxis> axis = axis_in(names, words);
  const int size = axis ? static_cast<int>(axis->labels.size()) : 1;
  if (given && (*given < 1 || *given > size))
    throw InputError(folder, fmt::format("{} is {}, the names state {} {}{}", key, *given, size,
                                         what, size == 1 ? "" : "s"));
  if (!axis) return;
  if (!given)
    throw InputError(
        folder,
        fmt::format(
            "names such as {} state {} {}s of {} pictures in all: choose one with {}, 1 to {}",
            files.front().filename().string(), size, what, files.size(), key, size));
  const std::string& label = axis->labels[static_cast<std::size_t>(*given - 1)];
  std::vector<fs::path> kept;
  for (std::size_t k = 0; k < files.size(); ++k)
    if (axis->label_of_file[k] == label) kept.push_back(files[k]);
  files = kept;
}

/// Place of a kind of file among those that hold the same picture: without loss first.
int rank_of(const fs::path& file) {
  const std::string extension = lower_extension(file);
  if (extension == ".tif" || extension == ".tiff") return 0;
  if (extension == ".png") return 1;
  return extension == ".jpg" || extension == ".jpeg" ? 3 : 2;
}

/// Keeps one of the files that have a name in common.
void drop_twins(std::vector<fs::path>& files, std::vector<std::string>& notes) {
  std::map<std::string, fs::path> best;
  for (const fs::path& file : files) {
    const auto [at, is_new] = best.try_emplace(file.stem().string(), file);
    if (!is_new && std::pair(rank_of(file), file) < std::pair(rank_of(at->second), at->second))
      at->second = file;
  }
  if (best.size() == files.size()) return;
  const auto twin = std::ranges::find_if(
      files, [&](const fs::path& file) { return best.at(file.stem().string()) != file; });
  notes.push_back(
      fmt::format("{} of {} pictures have the name of another: of {} and {} the first is "
                  "read, and so on",
                  files.size() - best.size(), files.size(),
                  best.at(twin->stem().string()).filename().string(), twin->filename().string()));
  std::erase_if(files, [&](const fs::path& file) { return best.at(file.stem().string()) != file; });
}

/// The words of a name without its numbers, which files of one series have in common.
std::string words_of(const NameParts& name) {
  std::string words;
  for (const NamePart& part : name) words += part.text + (part.digits.empty() ? "/" : "#/");
  return words;
}

std::string numbers_of(const NameParts& name) {
  std::string numbers;
  for (const NamePart& part : name)
    if (!part.digits.empty())
      numbers += (part.is_negative ? "-" : "") + part.digits + '.' + part.fraction + '/';
  return numbers;
}

/// Whether a name without numbers begins those of a series, as `img` does `img (1)`.
bool begins(const NameParts& name, const NameParts& series) {
  if (name.size() != 1 || !name.front().digits.empty()) return false;
  std::string_view text = series.front().text;
  while (!text.empty() && !is_letter(text.back())) text.remove_suffix(1);
  return text == name.front().text;
}

/// Leaves out files of other words than the great majority, each of which is the only one with its
/// words, as a background or a mask among numbered pictures.
void drop_strays(std::vector<fs::path>& files, std::vector<std::string>& notes) {
  constexpr std::size_t enough = 3;  // of a series
  const std::vector<NameParts> names = parts_of(files);
  std::map<std::string, std::vector<std::size_t>> kinds;
  for (std::size_t k = 0; k < names.size(); ++k) kinds[words_of(names[k])].push_back(k);
  const auto size = [](const auto& kind) { return kind.second.size(); };
  const auto most = std::ranges::max_element(kinds, {}, size);
  const std::vector<std::size_t> series = most->second;
  const auto is_other = [&](const auto& kind) { return kind.first != most->first; };
  const auto is_alone = [&](const auto& kind) { return !is_other(kind) || size(kind) == 1; };
  if (series.size() < enough || kinds.size() < 2 || 2 * (kinds.size() - 1) > series.size() ||
      most->first.find('#') == std::string::npos || !std::ranges::all_of(kinds, is_alone))
    return;
  std::set<std::size_t> strays;
  std::string list;
  for (const auto& kind : kinds) {
    const std::size_t k = kind.second.front();
    if (!is_other(kind) || begins(names[k], names[series.front()])) continue;
    strays.insert(k);
    list += (list.empty() ? "" : ", ") + files[k].filename().string();
  }
  if (strays.empty()) return;
  notes.push_back(
      fmt::format("{} {} left out: the names of the other {} pictures, such as {}, "
                  "differ in numbers only",
                  list, strays.size() == 1 ? "is" : "are", files.size() - strays.size(),
                  files[series.front()].filename().string()));
  std::vector<fs::path> kept;
  for (std::size_t k = 0; k < files.size(); ++k)
    if (!strays.contains(k)) kept.push_back(files[k]);
  files = kept;
}

/// Notes names that differ in words at the same numbers, as colours do.
void note_words(const std::vector<fs::path>& files, std::vector<std::string>& notes) {
  const std::vector<NameParts> names = parts_of(files);
  std::map<std::string, std::vector<std::size_t>> at;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const std::string numbers = numbers_of(names[k]);
    if (!numbers.empty()) at[numbers].push_back(k);
  }
  const auto repeats = [](const auto& k) { return k.second.size() > 1; };
  if (std::ranges::count_if(at, repeats) < 2) return;
  const auto& first = std::ranges::find_if(at, repeats)->second;
  notes.push_back(
      fmt::format("names such as {} and {} have the same numbers: all are taken as times, in the "
                  "order of their "
                  "names; if they are channels, put each into a folder of its own",
                  files[first[0]].filename().string(), files[first[1]].filename().string()));
}

/// A name without number i.
std::string around_number(const NameParts& name, std::size_t i) {
  std::string rest;
  for (std::size_t k = 0; k < name.size(); ++k) {
    rest += name[k].text + '/';
    if (k != i) rest += (name[k].is_negative ? "-" : "") + name[k].digits + '.' + name[k].fraction;
  }
  return rest;
}

/// Files whose names differ in number i only, of which there are two somewhere; nothing if there
/// are none.
std::optional<std::pair<std::size_t, std::size_t>> alike_but(const std::vector<NameParts>& names,
                                                             std::size_t i) {
  std::map<std::string, std::size_t> first;
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (i >= names[k].size() || names[k][i].digits.empty()) continue;
    const auto [at, is_new] = first.try_emplace(around_number(names[k], i), k);
    if (!is_new) return std::pair(at->second, k);
  }
  return std::nullopt;
}

/// Whether a word stands before a number, which is no unit of the number before, as in 10h59m54s.
bool has_label(const NamePart& part) {
  return !word_before(part).empty() && part.text != "h" && part.text != "m" && part.text != "min" &&
         part.text != "t";
}

/// Refuses names with two numbers of which each takes several values at one of the other, as
/// cameras, positions and wells do: which of them is time is not known. Numbers without words,
/// such as dates, are read in their order.
void require_one_series(const std::vector<fs::path>& files, const std::string& folder) {
  const std::vector<NameParts> names = parts_of(files);
  std::size_t most = 0;
  for (const NameParts& name : names) most = std::max(most, name.size());
  std::vector<std::size_t> grid;  // numbers that vary alone
  std::optional<std::pair<std::size_t, std::size_t>> fewest_pair;
  std::size_t fewest = files.size() + 1;
  bool labelled = false;
  for (std::size_t i = 0; i < most; ++i) {
    const auto pair = alike_but(names, i);
    if (!pair) continue;
    std::set<std::string> values;
    for (const NameParts& name : names)
      if (i < name.size()) {
        values.insert(name[i].digits);
        labelled = labelled || has_label(name[i]);
      }
    grid.push_back(values.size());
    if (values.size() < fewest) {
      fewest = values.size();
      fewest_pair = pair;
    }
  }
  if (grid.size() < 2 || !labelled) return;
  throw InputError(
      folder,
      fmt::format("names such as {} and {} differ in two numbers, of {} values each: cameras, "
                  "positions and "
                  "the like are no times; put each series of pictures into a folder of its own",
                  files[fewest_pair->first].filename().string(),
                  files[fewest_pair->second].filename().string(), fmt::join(grid, " and ")));
}

}  // namespace

bool naturally_before(std::string_view a, std::string_view b) {
  while (!a.empty() && !b.empty()) {
    const std::string_view p = first_run(a), q = first_run(b);
    if (is_digit(p.front()) && is_digit(q.front())) {
      const std::string_view m = without_zeros(p), n = without_zeros(q);
      if (m.size() != n.size()) return m.size() < n.size();
      if (m != n) return m < n;
    } else if (lower(p) != lower(q)) {
      return lower(p) < lower(q);
    }
    a.remove_prefix(p.size());
    b.remove_prefix(q.size());
  }
  return a.size() < b.size();
}

void sort_naturally(std::vector<fs::path>& files) {
  const std::vector<NameParts> names = parts_of(files);
  std::vector<std::size_t> order(files.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const NameParts &p = names[a], &q = names[b];
    for (std::size_t i = 0; i < std::min(p.size(), q.size()); ++i)
      if (const int c = compare(p[i], q[i]); c != 0) return c < 0;
    if (p.size() != q.size()) return p.size() < q.size();
    return files[a] < files[b];
  });
  std::vector<fs::path> sorted;
  sorted.reserve(files.size());
  for (const std::size_t k : order) sorted.push_back(files[k]);
  files = std::move(sorted);
}

std::vector<std::string> choose_pictures(std::vector<fs::path>& files,
                                         std::optional<int> stack_channel, std::optional<int> slice,
                                         const std::string& folder) {
  std::vector<std::string> notes;
  if (files.empty()) return notes;
  sort_naturally(files);
  drop_twins(files, notes);
  drop_strays(files, notes);
  choose_along(files, {"c", "ch", "chan", "channel", "w"}, "channel", "stack_channel",
               stack_channel, folder);
  choose_along(files, {"z", "slice"}, "slice", "slice", slice, folder);
  require_one_series(files, folder);
  note_words(files, notes);
  return notes;
}

bool differ_in_several(const std::vector<fs::path>& files) {
  const std::vector<NameParts> names = parts_of(files);
  std::set<std::size_t> varying;
  std::set<std::string> words, numbers;
  for (const NameParts& name : names) {
    words.insert(words_of(name));
    numbers.insert(numbers_of(name));
    for (std::size_t i = 0; i < std::min(name.size(), names.front().size()); ++i)
      if (name[i].digits != names.front()[i].digits) varying.insert(i);
  }
  const bool do_words_return = words.size() > 1 && words.size() < names.size();
  return varying.size() > 1 ||
         (do_words_return && !varying.empty() && numbers.size() == names.size());
}

std::optional<NumberedNames> numbers_in(const std::vector<fs::path>& files) {
  if (files.size() < 2) return std::nullopt;
  const std::vector<NameParts> names = parts_of(files);
  const std::optional<std::size_t> varying = varying_part(names);
  if (!varying) return std::nullopt;
  std::size_t places = 0;
  for (const NameParts& name : names) places = std::max(places, name[*varying].fraction.size());
  std::vector<std::int64_t> numbers, apart;
  for (const NameParts& name : names) {
    const std::optional<std::int64_t> number = name[*varying].value(places);
    if (!number) return std::nullopt;
    if (!numbers.empty()) apart.push_back(*number - numbers.back());
    if (!apart.empty() && apart.back() <= 0) return std::nullopt;
    numbers.push_back(*number);
  }
  std::vector<std::int64_t> sorted = apart;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>((sorted.size() - 1) / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  const std::int64_t step = *middle;
  NumberedNames found;
  for (std::size_t i = 0; i < files.size(); ++i) {
    found.steps.push_back(static_cast<double>(numbers[i] - numbers[0]) / static_cast<double>(step));
    if (i == 0 || apart[i - 1] == step) continue;
    if (found.gaps++ == 0)
      found.first_gap = files[i - 1].filename().string() + " and " + files[i].filename().string();
  }
  return found;
}

}  // namespace microswarm::vision
