// SPDX-License-Identifier: Apache-2.0
#include "lab/net/api.hpp"

#include <fmt/format.h>

#include "lab/files/download.hpp"
#include "lab/files/photograph.hpp"
#include "lab/net/assets.hpp"
#include "lab/net/run_export.hpp"
#include "lab/net/session_number.hpp"
#include "microswarm/config/write.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/rig/queue/queue_state.hpp"

namespace microswarm::lab {
namespace {

namespace http = boost::beast::http;
using Json = nlohmann::json;

HttpResponse json_text(const Exchange& e, std::string json) {
  return respond(e.request(), http::status::ok, "application/json", std::move(json));
}

void list(Exchange& e, std::string_view) {
  e.later([&e] {
    Json list = Json::array();
    for (const Entry& entry : e.shared().library.entries())
      list.push_back({{"file", entry.file},
                      {"name", entry.name},
                      {"description", entry.description},
                      {"record", entry.record},
                      {"navigator", entry.navigator},
                      {"outcome", entry.outcome},
                      {"written", entry.written},
                      {"trouble", entry.trouble}});
    Json json{{"scenarios", std::move(list)}, {"lab", e.shared().hub.lab()}};
    if (e.shared().opening) json["open"] = true;
    if (!e.shared().queue.empty()) json["queue"] = true;
    return respond(e.request(), json);
  });
}

/// GET /api/queue: the state of a rig's queue, as `microswarm rig queue --status --json` prints it.
void write_queue(Exchange& e, std::string_view) {
  if (e.shared().queue.empty()) return e.nothing();
  e.later([&e] {
    const std::filesystem::path& folder = e.shared().queue;
    std::error_code none;
    if (!std::filesystem::exists(rig::queue_state_file(folder), none))
      return json_text(e, to_json_text(rig::QueueState{.doing = "no queue has begun here yet"}));
    return json_text(e, to_json_text(rig::show_queue_state(folder)));
  });
}

void draw_thumbnail(Exchange& e, std::string_view) {
  e.later([&e, file = e.query("file")] {
    return respond(e.request(), http::status::ok, "image/svg+xml",
                   e.shared().thumbnails.of(e.shared().library.find(file)));
  });
}

void write_schema(Exchange& e, std::string_view) {
  e.write(json_text(e, experiment::scenario_schema()));
}

void write_vessel_schema(Exchange& e, std::string_view) { e.write(json_text(e, vessel_schema())); }

/// POST ?name=NAME with the file as body.
void take_upload(Exchange& e, std::string_view) {
  e.later([&e] {
    const Upload made =
        e.shared().uploads.keep(e.query("name"), e.request().body(), e.shared().library);
    return respond(e.request(), {{"file", made.file},
                                 {"kind", enum_name(made.kind)},
                                 {"width_px", made.width},
                                 {"height_px", made.height}});
  });
}

/// POST {"file": …, "settings": […]}: the photograph with its vessels.
void search_vessels(Exchange& e, std::string_view) {
  e.later([&e, asked = read_photo_request(e.request().body())] {
    FoundVessels found = e.shared().vessels.find(e.shared().library.find(asked.file), asked);
    HttpResponse response =
        respond(e.request(), http::status::ok, "image/png", std::move(found.png));
    response.set("Microswarm-Vessels", found.json);
    return response;
  });
}

void make_scenario(Exchange& e, std::string_view) {
  e.later([&e, asked = read_photo_request(e.request().body())] {
    const auto made = e.shared().vessels.make_scenario(e.shared().library.find(asked.file), asked,
                                                       e.shared().uploads);
    return respond(e.request(), {{"file", made.string()}});
  });
}

/// Opening that a page asks for; without a file that of the command line.
Opening to_opening(const OpenRequest& asked, const Shared& shared) {
  Opening opening;
  if (asked.file)
    opening.file = shared.library.find(*asked.file);
  else if (shared.opening)
    opening = *shared.opening;
  else
    throw InputError("message: \"file\" is missing");
  opening.check = [&library = shared.library, file = opening.file,
                   trusted = opening.options.settings](const auto& settings) {
    library.check(file, settings, trusted);
  };
  if (asked.photo)
    opening.photo =
        BackgroundPhoto{.file = shared.library.find(*asked.photo), .um_per_px = asked.um_per_px};
  Settings& settings = opening.options.settings;
  const Settings more(asked.settings, "");
  settings.list.insert(settings.list.end(), more.list.begin(), more.list.end());
  settings.option.clear();  // the page gave no option
  return opening;
}

void open_and_answer(const std::shared_ptr<Exchange>& e, Opening opening) {
  const bool live = opening.live.has_value();
  e->shared().hub.open(std::move(opening), [self = e, live](const Outcome<std::uint64_t>& opened) {
    if (opened.trouble.empty())
      self->write(respond(self->request(), {{"session", opened.value}, {"live", live}}));
    else
      self->refuse(http::status::bad_request, opened.trouble);
  });
}

using RecordPtr = std::shared_ptr<const experiment::Record>;

RecordPtr copy_record(const experiment::Session& of) {
  return std::make_shared<const experiment::Record>(experiment::Record(of.record()));
}

/// Opens a run of a session again, repeated up to a frame.
void open_branch(Exchange& e, const OpenRequest& asked) {
  if (!e.shared().hub.has(*asked.branch)) throw InputError("message: there is no such session");
  const Opening& of = e.shared().hub.find_opening(*asked.branch);
  if (of.live) throw InputError("message: a run on a rig cannot be repeated");
  Opening opening{.file = of.file, .photo = of.photo};
  opening.options.settings = Settings(asked.settings, "");
  opening.check = of.check;
  opening.branch = Branch{.frame = asked.frame, .changes = asked.changes};
  e.wait();
  e.shared().hub.fetch<RecordPtr>(
      *asked.branch, copy_record,
      [self = e.shared_from_this(), opening](const Outcome<RecordPtr>& copied) mutable {
        if (!copied.trouble.empty()) return self->refuse(http::status::bad_request, copied.trouble);
        opening.branch->record = copied.value;
        open_and_answer(self, std::move(opening));
      });
}

/// POST {"file": …, "settings": […]} or {"branch": …, "frame": …, "changes": […]}
void open_session(Exchange& e, std::string_view) {
  const OpenRequest asked = read_open_request(e.request().body());
  if (asked.branch) return open_branch(e, asked);
  Opening opening = to_opening(asked, e.shared());
  e.wait();
  open_and_answer(e.shared_from_this(), std::move(opening));
}

Json describe(const Hub::Open& one) {
  return {{"session", one.session}, {"name", one.file},       {"t_s", one.newest},
          {"watched", one.watched}, {"changed", one.changed}, {"live", one.live}};
}

/// GET /api/sessions
void list_sessions(Exchange& e, std::string_view) {
  Json list = Json::array();
  for (const Hub::Open& one : e.shared().hub.open_sessions()) list.push_back(describe(one));
  e.write(respond(e.request(), {{"sessions", std::move(list)}}));
}

/// Refuses what is asked of a session that is not open.
void miss(Exchange& e, std::optional<std::uint64_t> session) {
  if (!session || e.shared().hub.is_own(*session)) return e.nothing();
  e.refuse(http::status::gone, "this session was of a lab that has ended");
}

/// DELETE /api/sessions/ID
void close_session(Exchange& e, std::string_view session) {
  const auto number = session_number(session);
  if (!number || !e.shared().hub.has(*number)) return miss(e, number);
  e.shared().hub.close(*number);
  e.write(respond(e.request(), Json::object()));
}

void send(Exchange& e, const std::string& name, Outcome<Download> made) {
  if (!made.trouble.empty()) return e.refuse(http::status::internal_server_error, made.trouble);
  const auto name_it = [&](http::fields& headers) {
    headers.set(http::field::content_disposition, fmt::format("attachment; filename=\"{}\"", name));
  };
  if (!made.value.file) {
    HttpResponse response =
        respond(e.request(), http::status::ok, find_media_type(name), std::move(made.value.bytes));
    name_it(response);
    return e.write(std::move(response));
  }
  http::response<http::file_body> response{http::status::ok, e.request().version()};
  boost::beast::error_code error;
  response.body().open(made.value.file->path().c_str(), boost::beast::file_mode::scan, error);
  if (error) return e.refuse(http::status::internal_server_error, error.message());
  set_headers(response, find_media_type(name));
  name_it(response);
  response.keep_alive(e.request().keep_alive());
  response.prepare_payload();
  e.write(std::move(response));
}

/// Makes an export in its thread and sends it.
void make_export(const std::shared_ptr<Exchange>& exchange, std::shared_ptr<std::atomic<bool>> gone,
                 std::uint64_t session, const std::string& name, const RunExport& wanted,
                 std::shared_ptr<const experiment::Record> record) {
  exchange->shared().export_(
      std::move(gone), [self = exchange, session, name, wanted,
                        record = std::move(record)](const Stop& stop) mutable {
        const auto made = std::make_shared<Outcome<Download>>();
        ExportProgress& progress = self->shared().progress;
        progress.share = 0;
        progress.session = session;
        try {
          made->value =
              make_run_export(wanted, *record, stop, [&](double share) { progress.share = share; });
        } catch (const std::exception& error) {
          made->trouble = error.what();
        }
        progress.session = 0;
        // The connection must be destroyed in the thread of input and output.
        const auto post = self->shared().post;
        post([self = std::move(self), name, made] {
          if (!made->trouble.empty())
            self->refuse(http::status::bad_request, made->trouble);
          else
            send(*self, name, std::move(*made));
        });
      });
}

/// Copies the record in the session's thread, and makes the video or picture in another one.
void export_run(Exchange& e, std::uint64_t session, const std::string& name,
                const RunExport& wanted) {
  auto gone = e.wait();
  e.shared().hub.fetch<RecordPtr>(session, copy_record,
                                  [self = e.shared_from_this(), gone = std::move(gone), session,
                                   name, wanted](const Outcome<RecordPtr>& copied) {
                                    if (!copied.trouble.empty())
                                      self->refuse(http::status::internal_server_error,
                                                   copied.trouble);
                                    else
                                      make_export(self, gone, session, name, wanted, copied.value);
                                  });
}

/// GET /api/sessions/ID
void describe_session(Exchange& e, std::uint64_t session) {
  for (const Hub::Open& one : e.shared().hub.open_sessions())
    if (one.session == session) return e.write(respond(e.request(), describe(one)));
  e.nothing();
}

/// GET /api/sessions/ID/NAME, or /api/sessions/ID for the session itself.
void send_download(Exchange& e, std::string_view path) {
  const std::size_t slash = std::min(path.find('/'), path.size());
  const auto number = session_number(path.substr(0, slash));
  if (!number || !e.shared().hub.has(*number)) return miss(e, number);
  if (slash == path.size()) return describe_session(e, *number);
  const std::string name(path.substr(slash + 1));
  if (e.shared().hub.drives(*number))
    return e.refuse(http::status::conflict, "the coils are driven: stop the run first");
  const Opening& opening = e.shared().hub.find_opening(*number);
  if (name == "photo.jpg" && opening.photo)
    return e.later([&e, file = opening.photo->file] {
      return respond(e.request(), http::status::ok, "image/jpeg", to_jpeg(file));
    });
  if (auto wanted = read_run_export(name, view(e.request().target()))) {
    wanted->photo = opening.photo;
    return export_run(e, *number, name, *wanted);
  }
  if (name == "export") {
    const ExportProgress& progress = e.shared().progress;
    const bool is_own = progress.session == *number;
    return e.write(
        respond(e.request(), {{"share", is_own ? Json(progress.share.load()) : Json()}}));
  }
  auto make = download(name, opening.file.parent_path());
  if (!make) return e.nothing();
  e.wait();
  e.shared().hub.fetch<Download>(*number, std::move(make),
                                 [self = e.shared_from_this(), name](Outcome<Download> made) {
                                   send(*self, name, std::move(made));
                                 });
}

void write_asset(Exchange& e, std::string_view) {
  const auto file = asset(target_path(view(e.request().target())));
  if (!file) return e.nothing();
  const bool packed =
      !file->gzip.empty() && accepts(view(e.request()[http::field::accept_encoding]), "gzip");
  HttpResponse response = respond(e.request(), http::status::ok, file->media_type,
                                  std::string(packed ? file->gzip : file->bytes));
  if (packed) response.set(http::field::content_encoding, "gzip");
  if (!file->gzip.empty()) response.set(http::field::vary, "Accept-Encoding");
  if (!e.query("token").empty()) response.set(http::field::set_cookie, e.shared().access.cookie());
  e.write(std::move(response));
}

/// Requests with this method and path, or a path that begins so if it ends with '/', are handled by
/// `handle`, which gets the rest of the path.
struct Route {
  http::verb method;
  std::string_view path;
  void (*handle)(Exchange& exchange, std::string_view rest);

  bool is_request_for(const HttpRequest& request, std::string_view target) const {
    return request.method() == method &&
           (path.ends_with('/') ? target.starts_with(path) : target == path);
  }
};

/// The first that fits is taken.
constexpr std::array<Route, 13> routes{
    {{http::verb::get, "/api/scenarios", list},
     {http::verb::get, "/api/queue", write_queue},
     {http::verb::get, "/api/thumbnail", draw_thumbnail},
     {http::verb::get, "/api/schema", write_schema},
     {http::verb::get, "/api/vessel-schema", write_vessel_schema},
     {http::verb::get, "/api/sessions", list_sessions},
     {http::verb::get, "/api/sessions/", send_download},
     {http::verb::get, "/", write_asset},
     {http::verb::post, "/api/sessions", open_session},
     {http::verb::post, uploads_path, take_upload},
     {http::verb::post, "/api/vessels", search_vessels},
     {http::verb::post, "/api/photographs", make_scenario},
     {http::verb::delete_, "/api/sessions/", close_session}}};

}  // namespace

void handle(Exchange& exchange) {
  const std::string_view path = target_path(view(exchange.request().target()));
  for (const Route& route : routes)
    if (route.is_request_for(exchange.request(), path))
      return route.handle(exchange,
                          path.substr(route.path.ends_with('/') ? route.path.size() : path.size()));
  exchange.nothing();
}

}  // namespace microswarm::lab
