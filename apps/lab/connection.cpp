// SPDX-License-Identifier: Apache-2.0
#include "lab/connection.hpp"

#include <fmt/format.h>

#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <charconv>
#include <chrono>

#include "lab/assets.hpp"
#include "lab/download.hpp"
#include "lab/http.hpp"
#include "lab/page_stream.hpp"
#include "lab/photograph.hpp"
#include "lab/run_export.hpp"
#include "microswarm/core/errors/error.hpp"

namespace microswarm::lab {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;
using Tcp = boost::asio::ip::tcp;
using Json = nlohmann::json;

constexpr std::uint32_t max_header = 16 * 1024;    // bytes
constexpr std::uint64_t slowest_reader = 100'000;  // bytes a second
constexpr std::uint64_t max_body = max_request_size;
constexpr std::size_t scrap = 64 * 1024;  // bytes read and discarded at a time
constexpr std::string_view uploads_path = "/api/uploads";
constexpr std::string_view sessions_path = "/api/sessions/";
constexpr std::string_view stream_path = "/api/stream/";

std::optional<std::uint64_t> number_in(std::string_view text) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// Handles the requests of one connection in sequence.
class HttpConnection : public std::enable_shared_from_this<HttpConnection> {
 public:
  HttpConnection(Tcp::socket socket, const Shared& shared)
      : stream_(std::move(socket)), shared_(shared) {
    ++shared_.connections;
    beast::error_code error;
    const auto local = stream_.socket().local_endpoint(error);
    if (!error) local_ = url_host(local.address());
    stream_.socket().set_option(Tcp::no_delay(true), error);  // small messages leave at once
  }
  ~HttpConnection() { --shared_.connections; }
  HttpConnection(const HttpConnection&) = delete;
  HttpConnection& operator=(const HttpConnection&) = delete;

  void read() {
    parser_.emplace();
    parser_->header_limit(max_header);
    parser_->body_limit(max_upload);
    stream_.expires_after(shared_.hub.limits().patience);
    http::async_read_header(stream_, buffer_, *parser_,
                            [self = shared_from_this()](beast::error_code error, std::size_t) {
                              if (error) return self->take(error);
                              self->read_body();
                            });
  }

 private:
  /// Reads the body; a file may be large if the sender has the token.
  void read_body() {
    const auto& header = parser_->get();
    const bool is_upload = header.method() == http::verb::post &&
                           path_of(view(header.target())) == uploads_path &&
                           refusal_of(header).empty();
    if (is_upload) {
      stream_.expires_after(shared_.hub.limits().patience +
                            std::chrono::seconds(max_upload / slowest_reader));
    } else {
      // The parser compares Content-Length with its limit only before this.
      if (parser_->content_length().value_or(0) > max_body)
        return take(make_error_code(http::error::body_limit));
      parser_->body_limit(max_body);
    }
    http::async_read(
        stream_, buffer_, *parser_,
        [self = shared_from_this()](beast::error_code error, std::size_t) { self->take(error); });
  }

  std::string refusal_of(const HttpRequest& request) const {
    if (request.count(http::field::host) > 1) return "the host is named twice";
    const std::string token = query_of(view(request.target()), "token");
    return shared_.access.refusal({view(request[http::field::host]),
                                   view(request[http::field::origin]),
                                   view(request[http::field::cookie]), token, local_});
  }

  void take(beast::error_code error) {
    if (!error) {
      request_ = parser_->release();
      serve();
    } else if (error == http::error::header_limit) {
      refuse_and_close(http::status::request_header_fields_too_large, "the header is too large");
    } else if (error == http::error::body_limit) {
      refuse_and_close(http::status::payload_too_large, "the body is larger than is allowed");
    } else if (error.category() == make_error_code(http::error::bad_method).category() &&
               error != http::error::end_of_stream && error != http::error::partial_message) {
      refuse_and_close(http::status::bad_request, "this is not HTTP");
    }
  }

  void refuse_and_close(http::status status, const std::string& why) {
    request_ = {};
    request_.keep_alive(false);
    refuse(status, why);
  }

  void refuse(http::status status, const std::string& why) {
    if (beast::websocket::is_upgrade(request_)) request_.keep_alive(false);
    write(lab::refuse(request_, status, why));
  }

  void serve() {
    try {
      route(path_of(view(request_.target())));
    } catch (const InputError& error) {
      refuse(http::status::bad_request, error.what());
    }
  }

  void route(std::string_view path) {
    if (const std::string why = refusal_of(request_); !why.empty())
      return refuse(http::status::forbidden, why);
    const std::string token = query_of(view(request_.target()), "token");
    if (beast::websocket::is_upgrade(request_)) return upgrade(path);
    if (request_.method() == http::verb::get) return get(path, !token.empty());
    if (request_.method() == http::verb::post && path == "/api/sessions") return open();
    if (request_.method() == http::verb::post && path == uploads_path) return take_upload();
    if (request_.method() == http::verb::post && path == "/api/vessels") return search();
    if (request_.method() == http::verb::post && path == "/api/photographs") return make_scenario();
    if (request_.method() == http::verb::delete_ && path.starts_with(sessions_path))
      return close(path.substr(sessions_path.size()));
    nothing();
  }

  void nothing() { refuse(http::status::not_found, "there is nothing here"); }

  void get(std::string_view path, bool has_token) {
    if (path == "/api/scenarios") return list();
    if (path == "/api/thumbnail") return draw(query_of(view(request_.target()), "file"));
    if (path == "/api/schema")
      return write(respond(request_, http::status::ok, "application/json", scenario_schema()));
    if (path == "/api/vessel-schema")
      return write(respond(request_, http::status::ok, "application/json", vessel_schema()));
    if (path.starts_with(sessions_path)) return download(path.substr(sessions_path.size()));
    const auto file = asset(path);
    if (!file) return nothing();
    HttpResponse response =
        respond(request_, http::status::ok, file->media_type, std::string(file->bytes));
    if (has_token) response.set(http::field::set_cookie, shared_.access.cookie());
    write(std::move(response));
  }

  /// Answers with the result of `make`, which is called in another thread.
  void later(std::function<HttpResponse()> make) {
    stream_.expires_never();
    shared_.work([self = shared_from_this(), make = std::move(make)]() mutable {
      HttpResponse response;
      try {
        response = make();
      } catch (const std::exception& error) {
        response = lab::refuse(self->request_, http::status::bad_request, error.what());
      }
      const auto post = self->shared_.post;
      post([self = std::move(self), response = std::move(response)]() mutable {
        self->write(std::move(response));
      });
    });
  }

  void list() {
    later([this] {
      Json list = Json::array();
      for (const Entry& entry : shared_.library.entries())
        list.push_back(
            {{"file", entry.file}, {"name", entry.name}, {"description", entry.description}});
      Json json{{"scenarios", std::move(list)}};
      if (shared_.opening) json["open"] = true;
      return respond(request_, json);
    });
  }

  void draw(const std::string& file) {
    later([this, file] {
      return respond(request_, http::status::ok, "image/svg+xml",
                     shared_.thumbnails.of(shared_.library.find(file)));
    });
  }

  /// POST ?name=NAME with the file as body.
  void take_upload() {
    later([this] {
      const Upload made = shared_.uploads.keep(query_of(view(request_.target()), "name"),
                                               request_.body(), shared_.library);
      return respond(request_, {{"file", made.file},
                                {"kind", enum_name(made.kind)},
                                {"width_px", made.width},
                                {"height_px", made.height}});
    });
  }

  /// POST {"file": …, "settings": […]}: the photograph with its vessels.
  void search() {
    later([this, asked = read_photo_request(request_.body())] {
      FoundVessels found = find_vessels(shared_.library.find(asked.file), asked);
      HttpResponse response =
          respond(request_, http::status::ok, "image/png", std::move(found.png));
      response.set("Microswarm-Vessels", found.json);
      return response;
    });
  }

  void make_scenario() {
    later([this, asked = read_photo_request(request_.body())] {
      const auto made =
          make_photo_scenario(shared_.library.find(asked.file), asked, shared_.uploads);
      return respond(request_, {{"file", made.string()}});
    });
  }

  /// POST {"file": …, "settings": […]}; without a file the experiment of the command line.
  void open() {
    const OpenRequest asked = read_open_request(request_.body());
    Opening opening;
    if (asked.file)
      opening.file = shared_.library.find(*asked.file);
    else if (shared_.opening)
      opening = *shared_.opening;
    else
      throw InputError("message: \"file\" is missing");
    opening.check = [&library = shared_.library, file = opening.file,
                     trusted = opening.options.settings](const auto& settings) {
      library.check(file, settings, trusted);
    };
    if (asked.photo)
      opening.photo =
          BackgroundPhoto{.file = shared_.library.find(*asked.photo), .um_per_px = asked.um_per_px};
    Settings& settings = opening.options.settings;
    const Settings more(asked.settings, "");
    settings.list.insert(settings.list.end(), more.list.begin(), more.list.end());
    settings.option.clear();  // the page gave no option
    stream_.expires_never();
    const bool live = opening.live.has_value();
    shared_.hub.open(std::move(opening), [self = shared_from_this(),
                                          live](const Outcome<std::uint64_t>& opened) {
      self->write(opened.trouble.empty()
                      ? respond(self->request_, {{"session", opened.value}, {"live", live}})
                      : lab::refuse(self->request_, http::status::bad_request, opened.trouble));
    });
  }

  void close(std::string_view session) {
    const auto number = number_in(session);
    if (!number || !shared_.hub.has(*number)) return nothing();
    shared_.hub.close(*number);
    write(respond(request_, Json::object()));
  }

  /// GET /api/sessions/ID/NAME
  void download(std::string_view path) {
    const std::size_t slash = std::min(path.find('/'), path.size());
    const auto number = number_in(path.substr(0, slash));
    if (!number || !shared_.hub.has(*number) || slash == path.size()) return nothing();
    const std::string name(path.substr(slash + 1));
    if (shared_.hub.drives(*number))
      return refuse(http::status::conflict, "the coils are driven: stop the run first");
    const Opening& opening = shared_.hub.opening_of(*number);
    if (name == "photo.jpg" && opening.photo) return show(*opening.photo);
    if (auto wanted = read_run_export(name, view(request_.target()))) {
      wanted->photo = opening.photo;
      return export_run(*number, name, *wanted);
    }
    auto make = lab::download(name, opening.file.parent_path());
    if (!make) return nothing();
    stream_.expires_never();
    shared_.hub.fetch<Download>(*number, std::move(make),
                                [self = shared_from_this(), name](Outcome<Download> made) {
                                  self->send(name, std::move(made));
                                });
  }

  void show(const BackgroundPhoto& photo) {
    later([this, file = photo.file] {
      return respond(request_, http::status::ok, "image/jpeg", jpeg_of(file));
    });
  }

  /// Copies the record in the session's thread, and makes the video or picture in another one.
  void export_run(std::uint64_t session, const std::string& name, const RunExport& wanted) {
    stream_.expires_never();
    shared_.hub.fetch<std::shared_ptr<const Record>>(
        session,
        [](const Session& of) { return std::make_shared<const Record>(Record(of.record())); },
        [self = shared_from_this(), name,
         wanted](const Outcome<std::shared_ptr<const Record>>& copied) {
          if (!copied.trouble.empty())
            return self->refuse(http::status::internal_server_error, copied.trouble);
          self->shared_.export_(
              [self = self, name, wanted, record = copied.value](const Stop& stop) mutable {
                const auto made = std::make_shared<Outcome<Download>>();
                try {
                  made->value = make_run_export(wanted, *record, stop);
                } catch (const std::exception& error) {
                  made->trouble = error.what();
                }
                // The connection must be destroyed in the thread of input and output.
                const auto post = self->shared_.post;
                post([self = std::move(self), name, made] {
                  if (!made->trouble.empty())
                    self->refuse(http::status::bad_request, made->trouble);
                  else
                    self->send(name, std::move(*made));
                });
              });
        });
  }

  void send(const std::string& name, Outcome<Download> made) {
    if (!made.trouble.empty()) return refuse(http::status::internal_server_error, made.trouble);
    const auto name_it = [&](http::fields& headers) {
      headers.set(http::field::content_disposition,
                  fmt::format("attachment; filename=\"{}\"", name));
    };
    if (!made.value.file) {
      HttpResponse response =
          respond(request_, http::status::ok, media_type_of(name), std::move(made.value.bytes));
      name_it(response);
      return write(std::move(response));
    }
    http::response<http::file_body> response{http::status::ok, request_.version()};
    beast::error_code error;
    response.body().open(made.value.file->path().c_str(), beast::file_mode::scan, error);
    if (error) return refuse(http::status::internal_server_error, error.message());
    set_headers(response, media_type_of(name));
    name_it(response);
    response.keep_alive(request_.keep_alive());
    response.prepare_payload();
    write(std::move(response));
  }

  void upgrade(std::string_view path) {
    const auto session =
        path.starts_with(stream_path) ? number_in(path.substr(stream_path.size())) : std::nullopt;
    if (request_[http::field::origin].empty())
      return refuse(http::status::forbidden, "the origin is missing");
    if (!session || !shared_.hub.has(*session))
      return refuse(http::status::not_found, "there is no such session");
    if (shared_.hub.is_full())
      return refuse(http::status::service_unavailable, "too many pages are open");
    stream_.expires_never();
    serve_stream(stream_.release_socket(), request_, shared_.hub, *session);
  }

  template <class Body>
  void write(http::response<Body> made) {
    const auto response = std::make_shared<http::response<Body>>(std::move(made));
    const std::chrono::seconds slow(response->payload_size().value_or(0) / slowest_reader);
    stream_.expires_after(shared_.hub.limits().patience + slow);
    http::async_write(stream_, *response,
                      [self = shared_from_this(), response](beast::error_code error, std::size_t) {
                        if (error) return;
                        if (!response->need_eof()) return self->read();
                        self->stream_.socket().shutdown(Tcp::socket::shutdown_send, error);
                        self->stream_.expires_after(self->shared_.hub.limits().patience);
                        self->drain(max_upload);
                      });
  }

  /// Reads the rest of a request: a connection closed earlier would be reset, and the sender would
  /// not get the answer.
  void drain(std::size_t most) {
    buffer_.clear();
    stream_.async_read_some(buffer_.prepare(scrap), [self = shared_from_this(), most](
                                                        beast::error_code error, std::size_t size) {
      if (!error && size < most) self->drain(most - size);
    });
  }

  beast::tcp_stream stream_;
  Shared shared_;
  std::string local_;  ///< address
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::string_body>> parser_;
  HttpRequest request_;
};

}  // namespace

void serve_connection(Tcp::socket socket, const Shared& shared) {
  if (shared.connections >= shared.hub.limits().connections) return;
  std::make_shared<HttpConnection>(std::move(socket), shared)->read();
}

}  // namespace microswarm::lab
