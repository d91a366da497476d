// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <sstream>

#include "microswarm/config/yaml.hpp"
#include "microswarm/core/error.hpp"
#include "microswarm/core/file.hpp"
#include "microswarm/experiment/record/hdf5_image.hpp"
#include "microswarm/experiment/record/record.hpp"
#include "microswarm/experiment/record/record_layout.hpp"
#include "microswarm/experiment/record/record_scene.hpp"

namespace microswarm {

namespace {

constexpr std::string_view record_format_name = "microswarm record";
constexpr std::int64_t record_format_version = 4;
constexpr std::int64_t unchanged_format_version = 3;  // of a record in which nothing was changed
constexpr const char* words_attribute = "words";      // joined by spaces, indexed from 0

std::vector<std::string> split(std::string_view words) {
  std::vector<std::string> list;
  for (std::size_t begin = 0; begin < words.size();) {
    const std::size_t end = std::min(words.find(' ', begin), words.size());
    list.emplace_back(words.substr(begin, end - begin));
    begin = end + 1;
  }
  return list;
}

struct TableWriter {
  Hdf5Writer& file;

  template <class Rows>
  void table(const std::string& group, const Rows& rows) {
    using Row = typename Rows::value_type;
    std::vector<const Row*> all;
    all.reserve(rows.size());
    for (const Row& row : rows) all.push_back(&row);
    write(group, all);
  }
  template <class Rows, class Part>
  void parts(const std::string& group, const Rows& rows, Part part) {
    using Row = typename std::remove_cvref_t<decltype(part(rows.front()))>::value_type;
    std::vector<const Row*> all;
    std::vector<std::int64_t> offsets{0};
    for (const auto& row : rows) {
      for (const Row& one : part(row)) all.push_back(&one);
      offsets.push_back(static_cast<std::int64_t>(all.size()));
    }
    write(group, all);
    file.dataset(group + "/offset", offsets);
    file.attribute(group + "/offset", "description",
                   "Row i of the table above owns offset[i] to offset[i + 1] - 1, counted from 0.");
  }

 private:
  template <class Row>
  void write(const std::string& group, const std::vector<const Row*>& rows) {
    for (const Column<Row>& column : columns_of(static_cast<const Row*>(nullptr))) {
      const std::string path = group + "/" + column.key;
      if (column.kind == ColumnKind::real)
        write_reals(path, column, rows);
      else
        write_integers(path, column, rows);
      file.attribute(path, "unit", unit_symbol(column.unit));
      file.attribute(path, "description", column.doc);
    }
  }
  template <class Row>
  void write_reals(const std::string& path, const Column<Row>& column,
                   const std::vector<const Row*>& rows) {
    std::vector<double> values;
    values.reserve(rows.size());
    for (const Row* row : rows) values.push_back(column.number(*row));
    file.dataset(path, values);
  }
  template <class Row>
  void write_integers(const std::string& path, const Column<Row>& column,
                      const std::vector<const Row*>& rows) {
    std::vector<std::int64_t> values;
    values.reserve(rows.size());
    std::vector<std::string> words;
    for (const Row* row : rows)
      values.push_back(column.kind == ColumnKind::word
                           ? index_of(column.word(*row), words)
                           : static_cast<std::int64_t>(column.number(*row)));
    file.dataset(path, values);
    if (column.kind != ColumnKind::word) return;
    std::string joined;
    for (const std::string& word : words) joined += (joined.empty() ? "" : " ") + word;
    file.attribute(path, words_attribute, joined);
  }
  static std::int64_t index_of(const std::string& word, std::vector<std::string>& words) {
    auto found = std::find(words.begin(), words.end(), word);
    if (found == words.end()) found = words.insert(words.end(), word);
    return found - words.begin();
  }
};

struct TableReader {
  const Hdf5Reader& file;

  template <class Rows>
  void table(const std::string& group, Rows& rows) {
    using Row = typename Rows::value_type;
    bool first = true;
    for (const Column<Row>& column : columns_of(static_cast<const Row*>(nullptr))) {
      const std::string path = group + "/" + column.key;
      const auto set = column.kind == ColumnKind::real      ? reals(path, column)
                       : column.kind == ColumnKind::integer ? integers(path, column)
                                                            : words(path, column);
      if (first) rows.resize(set.size);
      first = false;
      if (set.size != rows.size()) file.fail(path + " is not as long as its table");
      for (std::size_t i = 0; i < rows.size(); ++i) set.into(rows[i], i);
    }
  }
  template <class Rows, class Part>
  void parts(const std::string& group, Rows& rows, Part part) {
    std::remove_cvref_t<decltype(part(rows.front()))> all;
    table(group, all);
    const std::vector<std::int64_t> offsets = file.integers(group + "/offset");
    if (offsets.size() != rows.size() + 1 || offsets.front() != 0 ||
        offsets.back() != static_cast<std::int64_t>(all.size()) ||
        !std::is_sorted(offsets.begin(), offsets.end()))
      file.fail(group + "/offset does not fit its table");
    for (std::size_t i = 0; i < rows.size(); ++i)
      part(rows[i]).assign(all.begin() + offsets[i], all.begin() + offsets[i + 1]);
  }

 private:
  template <class Row>
  struct Values {
    std::size_t size;
    std::function<void(Row&, std::size_t)> into;
  };

  template <class Row>
  Values<Row> reals(const std::string& path, const Column<Row>& column) {
    std::vector<double> values = file.numbers(path);
    const std::size_t size = values.size();
    return {size, [set = column.set_number, values = std::move(values)](Row& row, std::size_t i) {
              set(row, values[i]);
            }};
  }
  template <class Row>
  Values<Row> integers(const std::string& path, const Column<Row>& column) {
    const std::vector<std::int64_t> stored = file.integers(path);
    std::vector<double> values;
    for (const std::int64_t value : stored) {
      values.push_back(static_cast<double>(value));
      if (value < 0 || values.back() > column.max) file.fail(path + " has a value out of range");
    }
    return {values.size(),
            [set = column.set_number, values](Row& row, std::size_t i) { set(row, values[i]); }};
  }
  template <class Row>
  Values<Row> words(const std::string& path, const Column<Row>& column) {
    const std::vector<std::string> known = split(file.text_attribute(path, words_attribute));
    std::vector<std::int64_t> values = file.integers(path);
    for (const std::int64_t value : values)
      if (value < 0 || value >= static_cast<std::int64_t>(known.size()))
        file.fail(path + " has a value without a word");
    const std::size_t size = values.size();
    return {size, [this, path, known, set = column.set_word, values = std::move(values)](
                      Row& row, std::size_t i) {
              if (!set(row, known[static_cast<std::size_t>(values[i])]))
                file.fail(path + " has an unknown word");
            }};
  }
};

// Angles stand in records as they are held.
std::string attribute_name(const std::string& prefix, const FieldInfo& info) {
  const Unit unit = info.unit == Unit::deg ? Unit::rad : info.unit;
  std::string name = prefix + std::string(info.name);
  if (unit != Unit::none) name.append("_").append(unit_suffix(unit));
  return name;
}

struct MetricsWriter {
  Hdf5Writer& file;
  std::string prefix;

  template <class T>
  void operator()(const T& value, const FieldInfo& info) {
    if constexpr (HasFields<T>)
      T::fields(value, MetricsWriter{file, prefix + std::string(info.name) + "_"});
    else if constexpr (std::is_floating_point_v<T>)
      file.attribute("/metrics", attribute_name(prefix, info).c_str(), value);
    else
      file.attribute("/metrics", attribute_name(prefix, info).c_str(),
                     static_cast<std::int64_t>(value));
  }
};

struct MetricsReader {
  const Hdf5Reader& file;
  std::string prefix;

  template <class T>
  void operator()(T& value, const FieldInfo& info) {
    const std::string name = attribute_name(prefix, info);
    if constexpr (HasFields<T>) {
      T::fields(value, MetricsReader{file, prefix + std::string(info.name) + "_"});
    } else if constexpr (std::is_floating_point_v<T>) {
      value = file.number_attribute("/metrics", name.c_str());
    } else {
      const std::int64_t stored = file.integer_attribute("/metrics", name.c_str());
      if (!std::in_range<T>(stored)) file.fail("attribute " + name + " is out of range");
      value = static_cast<T>(stored);
    }
  }
};

void write_root(Hdf5Writer& out, const Record& record) {
  out.attribute("/", "format", record_format_name);
  out.attribute("/", "format_version",
                record.changes.empty() ? unchanged_format_version : record_format_version);
  out.attribute("/", "version", record.version);
  out.attribute("/", "name", record.scene.scenario.name);
  out.attribute("/", "status", to_string(record.result.status));
  out.attribute("/", "seed", record.scene.scenario.seed);
  out.attribute("/", "trial", static_cast<std::int64_t>(record.trial));
  if (!record.rig.empty()) out.attribute("/", "rig", record.rig);
  out.attribute("/", "input_hash", record.scene.hash());
  out.attribute("/", "record_hash", record.hash());
}

void write_times(Hdf5Writer& out, const std::string& path, const std::vector<double>& seconds,
                 std::string_view doc) {
  out.dataset(path, seconds);
  out.attribute(path, "unit", "s");
  out.attribute(path, "description", doc);
}

Status status_of(const Hdf5Reader& in, const std::string& word) {
  for (int i = 0; i <= static_cast<int>(Status::fault); ++i)
    if (to_string(static_cast<Status>(i)) == word) return static_cast<Status>(i);
  in.fail("attribute status is the unknown word '" + word + "'");
}

void write_changes(Hdf5Writer& out, const std::vector<Change>& changes) {
  if (changes.empty()) return;
  std::vector<double> times;
  std::vector<std::int64_t> frames;
  std::string settings;
  for (const Change& change : changes) {
    times.push_back(change.t);
    frames.push_back(static_cast<std::int64_t>(change.frame));
    settings += change.setting + "\n";
  }
  out.dataset("/changes/t_s", times);
  out.attribute("/changes/t_s", "unit", "s");
  out.attribute("/changes/t_s", "description", "Time of the frame that the change comes before.");
  out.dataset("/changes/frame", frames);
  out.attribute("/changes/frame", "description", "That frame, counted from 0.");
  out.text("/changes/settings", settings);
  out.attribute("/changes/settings", "description", "KEY=VALUE of the scenario, a line a change.");
}

std::vector<Change> read_changes(const Hdf5Reader& in) {
  const std::vector<double> times = in.numbers("/changes/t_s");
  const std::vector<std::int64_t> frames = in.integers("/changes/frame");
  std::istringstream settings(in.text("/changes/settings"));
  if (times.size() != frames.size()) in.fail("/changes/frame is not as long as its table");
  std::vector<Change> changes;
  for (std::size_t i = 0; i < times.size(); ++i) {
    Change change{times[i], static_cast<std::uint64_t>(frames[i]), {}};
    if (frames[i] < 0 || (i > 0 && frames[i] < frames[i - 1]))
      in.fail("/changes/frame does not ascend from 0");
    if (!std::getline(settings, change.setting))
      in.fail("/changes/settings is not as long as its table");
    changes.push_back(std::move(change));
  }
  return changes;
}

std::int64_t check_format(const Hdf5Reader& in) {
  if (in.text_attribute("/", "format") != record_format_name) in.fail("is no microswarm record");
  const std::int64_t written = in.integer_attribute("/", "format_version");
  if (written != record_format_version && written != unchanged_format_version)
    in.fail("has record format " + std::to_string(written) + ", this program reads formats " +
            std::to_string(unchanged_format_version) + " and " +
            std::to_string(record_format_version));
  return written;
}

}  // namespace

void write_record(const Record& record, const std::filesystem::path& file) {
  Hdf5Writer out;
  write_root(out, record);
  write_scene(out, record.scene);
  visit_tables(record, TableWriter{out});
  write_changes(out, record.changes);
  out.group("/metrics");
  Metrics::fields(record.result.metrics, MetricsWriter{out, ""});
  write_times(out, "/timing/step_s", record.result.timing.steps,
              "Wall-clock time of the navigator's step, one a tick.");
  write_times(out, "/timing/planning_s", record.result.timing.planning,
              "Wall-clock time of the steps in which it planned.");
  write_file_atomically(file, out.finish());
}

Record read_record(const std::filesystem::path& file) {
  const Hdf5Reader in(read_file(file), file.string());
  const std::int64_t format = check_format(in);
  Record record;
  record.version = in.text_attribute("/", "version");
  const std::int64_t trial = in.integer_attribute("/", "trial");
  if (!std::in_range<std::uint32_t>(trial)) in.fail("attribute trial is out of range");
  record.trial = static_cast<std::uint32_t>(trial);
  if (in.has_attribute("/", "rig")) record.rig = in.text_attribute("/", "rig");
  record.scene = read_scene(in);
  visit_tables(record, TableReader{in});
  if (format == record_format_version) record.changes = read_changes(in);
  record.result.status = status_of(in, in.text_attribute("/", "status"));
  Metrics::fields(record.result.metrics, MetricsReader{in, ""});
  record.stated_hash = in.text_attribute("/", "record_hash");
  record.result.timing = {in.numbers("/timing/step_s"), in.numbers("/timing/planning_s")};
  return record;
}

}  // namespace microswarm
