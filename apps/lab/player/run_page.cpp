// SPDX-License-Identifier: Apache-2.0
#include "lab/player/run_page.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "lab/net/assets.hpp"
#include "lab/stream/publisher.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/file.hpp"
#include "microswarm/core/text/text.hpp"
#include "microswarm/core/version.hpp"
#include "microswarm/report/html.hpp"

namespace microswarm::lab {
namespace {

using Json = nlohmann::json;

constexpr double packing_share = 0.8;        // of the progress; the rest is compression
constexpr std::size_t fewest_frames = 20;    // of a page of a longer record
constexpr std::size_t max_clearance = 8000;  // cells

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = three << 8U | (k < count ? static_cast<std::uint8_t>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += k <= count ? digits[three >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

/// The bytes as gzip; nothing if the caller stopped it.
std::optional<std::string> gzip(std::string_view bytes, const Stop& stop,
                                const std::function<void(double share)>& show) {
  constexpr int with_header = 15 + 16;
  constexpr std::size_t part = 1 << 20;
  z_stream to{};
  if (::deflateInit2(&to, Z_BEST_COMPRESSION, Z_DEFLATED, with_header, 9, Z_DEFAULT_STRATEGY) !=
      Z_OK)
    throw std::runtime_error("there is no memory to compress the page");
  std::string packed(::deflateBound(&to, bytes.size()), '\0');
  to.next_out = reinterpret_cast<Bytef*>(packed.data());
  to.avail_out = static_cast<uInt>(packed.size());
  for (std::size_t i = 0; i < bytes.size() && !stop(); i += part) {
    const std::size_t count = std::min(part, bytes.size() - i);
    to.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data() + i));
    to.avail_in = static_cast<uInt>(count);
    ::deflate(&to, i + count == bytes.size() ? Z_FINISH : Z_NO_FLUSH);
    show(static_cast<double>(i + count) / static_cast<double>(bytes.size()));
  }
  packed.resize(to.total_out);
  ::deflateEnd(&to);
  if (stop()) return std::nullopt;
  return packed;
}

Json binary(const MessagePtr& message) {
  return Json::binary({message->bytes.begin(), message->bytes.end()});
}

/// The messages of a record's playback, with every n-th frame.
class Messages {
 public:
  Messages(const experiment::Record& record, const RunPageOptions& options)
      : session_(experiment::Record(record)), options_(options) {}

  std::size_t frames() const { return record().frames.size(); }
  std::size_t bytes() const { return bytes_; }

  /// Packs them; the share of the frames that was packed until they were too many bytes.
  double pack(std::size_t every, const Stop& stop, const Progress& progress) {
    bytes_ = 0;
    told_plans_ = told_changes_ = 0;
    told_nodes_.clear();
    std::vector<experiment::Frame> kept;
    json_ = {{"frames", Json::array()}};
    for (const char* name : {"plan", "scenario", "aggregation"}) json_[name] = Json::array();
    json_["hello"] = add(hello());
    json_["clearance"] = add(clearance_message(session_.map(), max_clearance));
    for (std::size_t number = 0; number < frames(); number += every) {
      add_frame(number);
      const std::size_t last = frames() - 1;
      if (number < last && number + every > last) add_frame(last);
      const double share = static_cast<double>(number + 1) / static_cast<double>(frames());
      if (bytes_ > options_.max_bytes || stop()) return share;
      progress.update(packing_share * share);
    }
    add_rows(every);
    return 1;
  }

  const Json& json() const { return json_; }

 private:
  const experiment::Record& record() const { return session_.record(); }

  Json add(const MessagePtr& message) {
    bytes_ += message->bytes.size();
    return binary(message);
  }

  MessagePtr hello() const {
    Json hello = hello_json(session_, {.file = options_.name});
    if (!options_.photo_jpeg.empty())
      hello["photo"] = {{"file", "data:image/jpeg;base64," + base64(options_.photo_jpeg)},
                        {"um_per_px", options_.um_per_px}};
    return make_message(hello);
  }

  void add_frame(std::size_t number) {
    session_.seek(number);
    experiment::SessionView view = session_.view();
    const Diagnostics& shown = session_.diagnostics();
    const std::size_t place = json_["frames"].size();
    const auto note = [&](const char* name, const MessagePtr& message) {
      json_[name].push_back({place, add(message)});
    };
    const auto changes = static_cast<std::size_t>(std::ranges::count_if(
        record().changes, [&](const auto& change) { return change.frame <= number; }));
    if (place == 0 || changes != told_changes_)
      note("scenario", scenario_message(session_.scenario()));
    if (place == 0 || view.plans != told_plans_) note("plan", plan_message(view));
    if (const auto* plan = std::get_if<AggregationDiagnostics>(&shown);
        plan && plan->nodes != told_nodes_) {
      note("aggregation", aggregation_message(*plan));
      told_nodes_ = plan->nodes;
    }
    told_changes_ = changes;
    told_plans_ = view.plans;
    view.number = place;
    json_["frames"].push_back(add(frame_message(view, shown)));
  }

  void add_rows(std::size_t every) {
    const auto& steps = record().result.timing.steps;
    std::vector<Row> rows;
    for (std::size_t i = 0; i < frames(); ++i)
      if (i % every == 0 || i + 1 == frames())
        rows.push_back(
            to_row({.frame = record().frames[i], .step_time = i < steps.size() ? steps[i] : 0}));
    json_["rows"] = add(rows_message(rows, record().events, true));
    Publisher publisher([](std::uint64_t, const MessagePtr&) {});
    publisher.take(record());
    publisher.standing.frames = rows.size();
    json_["standing"] = add(standing_message(publisher.standing, record().result));
    json_["every"] = every;
    json_["version"] = record().version;
    json_["hash"] = record().hash();
  }

  experiment::Session session_;
  const RunPageOptions& options_;
  Json json_;
  std::size_t bytes_ = 0;
  std::size_t told_changes_ = 0;
  std::uint64_t told_plans_ = 0;
  std::vector<AggregationNode> told_nodes_;
};

std::string html(const std::string& title, std::string_view run) {
  // The page makes no request, for any data in it.
  constexpr std::string_view policy =
      "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; "
      "img-src data: blob:; base-uri 'none'; form-action 'none'";
  return fmt::format(R"(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="{}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="generator" content="microswarm {}">
<title>{} – microswarm</title>
<link rel="icon" href="data:,">
<style>{}</style>
</head>
<body>
<main id="page"></main>
<noscript>This run is played by a script: allow JavaScript.</noscript>
<script type="text/plain" id="run">{}</script>
<script type="module">{}</script>
</body>
</html>
)",
                     policy, version, report::html_text(title), asset("/app.css")->bytes, run,
                     asset("/app.js")->bytes);
}

}  // namespace

RunPage write_run_page(const experiment::Record& record, const std::filesystem::path& file,
                       const RunPageOptions& options, const Stop& stop) {
  if (record.frames.empty()) throw InputError("the record has no frames to show");
  const Progress progress(options.progress, "page");
  Messages messages(record, options);
  RunPage page;
  for (;;) {
    const double share = messages.pack(page.every, stop, progress);
    if (stop()) return {.stopped = true};
    const double limit = static_cast<double>(options.max_bytes);
    const double whole = static_cast<double>(messages.bytes()) / share;
    if (share == 1 && messages.bytes() <= options.max_bytes) break;
    const auto more = static_cast<std::size_t>(
        std::ceil(static_cast<double>(page.every) * std::max(1.05, whole / limit)));
    page.every = std::max(page.every + 1, more);
    if (messages.frames() / page.every < std::min(fewest_frames, messages.frames()))
      throw InputError(file.string(),
                       fmt::format("the run has {:.0f} MB, of which not even {} frames are within "
                                   "the limit of {:.0f} MB for a page",
                                   whole / 1e6, fewest_frames, limit / 1e6));
  }
  page.frames = messages.json()["frames"].size();
  std::string bytes;
  Json::to_cbor(messages.json(), bytes);
  const auto packed = gzip(bytes, stop, [&](double share) {
    progress.update(packing_share + (1 - packing_share) * share);
  });
  if (!packed) return {.stopped = true};
  const std::string& name = record.scene.scenario.name;
  const std::string text = html(name.empty() ? options.name : name, base64(*packed));
  write_file_atomically(file, text);
  page.bytes = text.size();
  return page;
}

}  // namespace microswarm::lab
