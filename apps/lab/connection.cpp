// SPDX-License-Identifier: Apache-2.0
#include "lab/connection.hpp"

#include <fmt/format.h>

#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <charconv>
#include <chrono>
#include <deque>
#include <nlohmann/json.hpp>

#include "lab/assets.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/text/text.hpp"

namespace microswarm::lab {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using Tcp = boost::asio::ip::tcp;
using HttpRequest = http::request<http::string_body>;
using HttpResponse = http::response<http::string_body>;
using Json = nlohmann::json;
using namespace std::chrono_literals;

constexpr auto patience = 30s;                            ///< with a request or a silent page
constexpr std::size_t max_header = 16 * 1024;             // bytes
constexpr std::size_t max_body = 1024 * 1024;             // bytes
constexpr std::size_t max_waiting = 64 * 1024 * 1024;     // bytes that a page may leave unread
constexpr std::string_view stream_prefix = "/api/stream/";

std::string_view view(beast::string_view text) { return {text.data(), text.size()}; }

/// Path of a target, and the value of a key of its query; keys and values are not decoded.
std::string_view path_of(std::string_view target) { return target.substr(0, target.find('?')); }
std::string_view query_of(std::string_view target, std::string_view key) {
  std::size_t at = target.find('?');
  while (at != std::string_view::npos) {
    target.remove_prefix(at + 1);
    at = target.find('&');
    const std::string_view pair = target.substr(0, at);
    if (pair.size() > key.size() && pair.starts_with(key) && pair[key.size()] == '=')
      return pair.substr(key.size() + 1);
  }
  return {};
}

std::optional<std::uint64_t> number_in(std::string_view text) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

Origins origins_of(const HttpRequest& request) {
  return {view(request[http::field::host]), view(request[http::field::origin]),
          view(request[http::field::cookie]), query_of(view(request.target()), "token")};
}

HttpResponse respond(const HttpRequest& request, http::status status, std::string_view media_type,
                     std::string body) {
  HttpResponse response{status, request.version()};
  response.set(http::field::content_type, beast::string_view(media_type.data(), media_type.size()));
  response.set(http::field::cache_control, "no-store");
  response.set("Content-Security-Policy",
               "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; "
               "connect-src 'self'; worker-src 'self' blob:; base-uri 'none'; form-action 'none'; "
               "frame-ancestors 'none'");
  response.set("X-Content-Type-Options", "nosniff");
  response.set("Referrer-Policy", "no-referrer");
  response.set("Cross-Origin-Opener-Policy", "same-origin");
  response.set("Cross-Origin-Resource-Policy", "same-origin");
  response.keep_alive(request.keep_alive());
  response.body() = std::move(body);
  response.prepare_payload();
  return response;
}

HttpResponse respond(const HttpRequest& request, const Json& json,
                     http::status status = http::status::ok) {
  return respond(request, status, "application/json",
                 json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

HttpResponse refuse(const HttpRequest& request, http::status status, const std::string& why) {
  return respond(request, {{"error", why}}, status);
}

/// A page's stream. Frames that it cannot take in time are left out, other messages never: a page
/// that leaves too many unread is closed.
class PageStream : public Page, public std::enable_shared_from_this<PageStream> {
 public:
  PageStream(Tcp::socket socket, const Shared& shared, std::uint64_t session)
      : stream_(std::move(socket)), shared_(shared), session_(session) {}
  ~PageStream() override { shared_.hub.leave(number_); }

  void accept(const HttpRequest& request) {
    stream_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    stream_.read_message_max(max_request_size);
    stream_.binary(true);
    stream_.async_accept(request, [self = shared_from_this()](beast::error_code error) {
      if (error || !self->shared_.hub.has(self->session_)) return;
      self->number_ = self->shared_.hub.join(self->session_, *self);
      self->read();
    });
  }

  void send(const MessagePtr& message) override {
    if (message->is_frame) {
      frame_ = message;
    } else {
      waiting_.push_back(message);
      waiting_size_ += message->bytes.size();
    }
    if (waiting_size_ > max_waiting)
      beast::get_lowest_layer(stream_).close();
    else if (!writes_)
      write();
  }

 private:
  void read() {
    stream_.async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error) {
        self->shared_.hub.leave(self->number_);
        return;
      }
      self->take(beast::buffers_to_string(self->buffer_.data()));
      self->buffer_.clear();
      self->read();
    });
  }

  void take(const std::string& text) {
    try {
      shared_.hub.ask(number_, read_request(text));
    } catch (const InputError& error) {
      Issues issues;
      issues.add({}, error.what());
      send(answer_message(0, issues));
    }
  }

  /// Messages keep their order; a frame goes when nothing else waits.
  void write() {
    if (!waiting_.empty()) {
      written_ = std::move(waiting_.front());
      waiting_.pop_front();
      waiting_size_ -= written_->bytes.size();
    } else {
      written_ = std::move(frame_);
    }
    frame_ = written_ && written_->is_frame ? nullptr : std::move(frame_);
    writes_ = written_ != nullptr;
    if (!writes_) return;
    stream_.async_write(
        boost::asio::buffer(written_->bytes),
        [self = shared_from_this()](beast::error_code error, std::size_t) {
          if (error)
            self->shared_.hub.leave(self->number_);
          else
            self->write();
        });
  }

  websocket::stream<beast::tcp_stream> stream_;
  Shared shared_;
  std::uint64_t session_;
  std::uint64_t number_ = 0;
  beast::flat_buffer buffer_;
  std::deque<MessagePtr> waiting_;
  std::size_t waiting_size_ = 0;
  MessagePtr frame_;
  MessagePtr written_;
  bool writes_ = false;
};

/// Requests of one connection, one after the other.
class HttpConnection : public std::enable_shared_from_this<HttpConnection> {
 public:
  HttpConnection(Tcp::socket socket, const Shared& shared)
      : stream_(std::move(socket)), shared_(shared) {}

  void read() {
    parser_.emplace();
    parser_->header_limit(max_header);
    parser_->body_limit(max_body);
    stream_.expires_after(patience);
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](beast::error_code error, std::size_t) {
                       if (!error) self->serve(self->parser_->release());
                     });
  }

 private:
  void serve(const HttpRequest& request) {
    try {
      route(request);
    } catch (const InputError& error) {
      write(refuse(request, http::status::bad_request, error.what()));
    }
  }

  void route(const HttpRequest& request) {
    const std::string_view target = view(request.target());
    const std::string_view path = path_of(target);
    const Origins origins = origins_of(request);
    if (const std::string why = shared_.access.refusal(origins); !why.empty())
      return write(refuse(request, http::status::forbidden, why));
    if (websocket::is_upgrade(request)) return upgrade(request, path);
    if (request.method() == http::verb::get) {
      if (path == "/api/scenarios") return write(respond(request, listing()));
      if (path == "/api/schema")
        return write(respond(request, http::status::ok, "application/json", session_schema()));
      if (const auto file = asset(path)) {
        HttpResponse response = respond(request, http::status::ok, file->media_type,
                                        std::string(file->bytes));
        if (!origins.token.empty()) response.set(http::field::set_cookie, shared_.access.cookie());
        return write(std::move(response));
      }
    }
    if (request.method() == http::verb::post && path == "/api/sessions") return open(request);
    write(refuse(request, http::status::not_found, "there is nothing here"));
  }

  Json listing() const {
    Json list = Json::array();
    for (const Entry& entry : shared_.library.entries())
      list.push_back(
          {{"file", entry.file}, {"name", entry.name}, {"description", entry.description}});
    Json json{{"scenarios", std::move(list)}};
    if (shared_.opening) json["open"] = true;
    return json;
  }

  /// POST {"file": …, "settings": […]}; without a file what the program was started with.
  void open(const HttpRequest& request) {
    const Json json = Json::parse(request.body(), nullptr, false);
    Opening opening;
    if (!json.is_object()) throw InputError("request: not a JSON object");
    if (json.contains("file") && json["file"].is_string()) {
      opening.file = shared_.library.find(json["file"].get<std::string>());
    } else if (shared_.opening) {
      opening = *shared_.opening;
    } else {
      throw InputError("request: \"file\" is missing");
    }
    if (json.contains("settings")) {
      if (!json["settings"].is_array()) throw InputError("request: \"settings\" is not a list");
      for (const Json& one : json["settings"]) {
        if (!one.is_string()) throw InputError("request: \"settings\" has no texts");
        opening.options.settings.push_back(one.get<std::string>());
      }
    }
    stream_.expires_never();
    shared_.hub.open(std::move(opening), [self = shared_from_this(), request](
                                             std::uint64_t session, const std::string& trouble) {
      self->write(trouble.empty()
                      ? respond(request, {{"session", session}})
                      : refuse(request, http::status::bad_request, trouble));
    });
  }

  void upgrade(const HttpRequest& request, std::string_view path) {
    const auto session = path.starts_with(stream_prefix)
                             ? number_in(path.substr(stream_prefix.size()))
                             : std::nullopt;
    if (request[http::field::origin].empty())
      return write(refuse(request, http::status::forbidden, "the origin is missing"));
    if (!session || !shared_.hub.has(*session))
      return write(refuse(request, http::status::not_found, "there is no such session"));
    if (shared_.hub.is_full())
      return write(refuse(request, http::status::service_unavailable, "too many pages are open"));
    stream_.expires_never();
    std::make_shared<PageStream>(stream_.release_socket(), shared_, *session)->accept(request);
  }

  void write(HttpResponse response) {
    response_ = std::move(response);
    stream_.expires_after(patience);
    http::async_write(stream_, response_,
                      [self = shared_from_this()](beast::error_code error, std::size_t) {
                        if (!error && !self->response_.need_eof())
                          self->read();
                        else
                          self->stream_.socket().shutdown(Tcp::socket::shutdown_send, error);
                      });
  }

  beast::tcp_stream stream_;
  Shared shared_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::string_body>> parser_;
  HttpResponse response_;
};

}  // namespace

void serve_connection(Tcp::socket socket, const Shared& shared) {
  std::make_shared<HttpConnection>(std::move(socket), shared)->read();
}

}  // namespace microswarm::lab
