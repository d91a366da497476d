// SPDX-License-Identifier: Apache-2.0
#include "lab/net/connection.hpp"

#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <chrono>

#include "lab/net/api.hpp"
#include "lab/net/page_stream.hpp"
#include "lab/net/session_number.hpp"
#include "microswarm/core/errors/error.hpp"

namespace microswarm::lab {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;
using Tcp = boost::asio::ip::tcp;

constexpr std::uint32_t max_header = 16 * 1024;    // bytes
constexpr std::uint64_t slowest_reader = 100'000;  // bytes a second
constexpr std::uint64_t max_body = max_request_size;
constexpr std::size_t scrap = 64 * 1024;  // bytes read and discarded at a time
constexpr std::string_view stream_path = "/api/stream/";

/// Handles the requests of one connection in sequence.
class HttpConnection : public Exchange {
 public:
  HttpConnection(Tcp::socket socket, const Shared& shared)
      : Exchange(shared), stream_(std::move(socket)) {
    ++shared_.connections;
    beast::error_code error;
    const auto local = stream_.socket().local_endpoint(error);
    if (!error) local_ = url_host(local.address());
    stream_.socket().set_option(Tcp::no_delay(true), error);  // small messages leave at once
  }
  ~HttpConnection() override { --shared_.connections; }
  HttpConnection(const HttpConnection&) = delete;
  HttpConnection& operator=(const HttpConnection&) = delete;

  void write(HttpResponse response) override { write_any(std::move(response)); }
  void write(http::response<http::file_body> response) override { write_any(std::move(response)); }
  void refuse(http::status status, const std::string& why) override {
    if (beast::websocket::is_upgrade(request_)) request_.keep_alive(false);
    write(lab::refuse(request_, status, why));
  }
  std::shared_ptr<std::atomic<bool>> wait() override {
    stream_.expires_never();
    auto gone = std::make_shared<std::atomic<bool>>(false);
    // Readable without bytes: the other side has closed it. Bytes are the next request.
    stream_.socket().async_wait(Tcp::socket::wait_read,
                                [self = self(), gone](beast::error_code error) {
                                  beast::error_code unknown;
                                  *gone = !error && self->stream_.socket().available(unknown) == 0;
                                });
    return gone;
  }

  void read() {
    parser_.emplace();
    parser_->header_limit(max_header);
    parser_->body_limit(max_upload);
    stream_.expires_after(shared_.hub.limits().patience);
    http::async_read_header(stream_, buffer_, *parser_,
                            [self = self()](beast::error_code error, std::size_t) {
                              if (error) return self->take(error);
                              self->read_body();
                            });
  }

 private:
  /// Reads the body; a file may be large if the sender has the token.
  void read_body() {
    const auto& header = parser_->get();
    const bool is_upload = header.method() == http::verb::post &&
                           target_path(view(header.target())) == uploads_path &&
                           refusal_reason(header).empty();
    if (is_upload) {
      stream_.expires_after(shared_.hub.limits().patience +
                            std::chrono::seconds(max_upload / slowest_reader));
    } else {
      // The parser compares Content-Length with its limit only before this.
      if (parser_->content_length().value_or(0) > max_body)
        return take(make_error_code(http::error::body_limit));
      parser_->body_limit(max_body);
    }
    http::async_read(stream_, buffer_, *parser_,
                     [self = self()](beast::error_code error, std::size_t) { self->take(error); });
  }

  std::string refusal_reason(const HttpRequest& request) const {
    if (request.count(http::field::host) > 1) return "the host is named twice";
    const std::string token = query_value(view(request.target()), "token");
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

  void serve() {
    const std::string_view path = target_path(view(request_.target()));
    if (const std::string why = refusal_reason(request_); !why.empty())
      return refuse(http::status::forbidden, why);
    if (beast::websocket::is_upgrade(request_)) return upgrade(path);
    try {
      handle(*this);
    } catch (const InputError& error) {
      refuse(http::status::bad_request, error.what());
    }
  }

  void upgrade(std::string_view path) {
    const auto session = path.starts_with(stream_path)
                             ? session_number(path.substr(stream_path.size()))
                             : std::nullopt;
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
  void write_any(http::response<Body> made) {
    const auto response = std::make_shared<http::response<Body>>(std::move(made));
    const std::chrono::seconds slow(response->payload_size().value_or(0) / slowest_reader);
    stream_.expires_after(shared_.hub.limits().patience + slow);
    http::async_write(stream_, *response,
                      [self = self(), response](beast::error_code error, std::size_t) {
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
    stream_.async_read_some(buffer_.prepare(scrap),
                            [self = self(), most](beast::error_code error, std::size_t size) {
                              if (!error && size < most) self->drain(most - size);
                            });
  }

  std::shared_ptr<HttpConnection> self() {
    return std::static_pointer_cast<HttpConnection>(shared_from_this());
  }

  beast::tcp_stream stream_;
  std::string local_;  ///< address
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::string_body>> parser_;
};

}  // namespace

void serve_connection(Tcp::socket socket, const Shared& shared) {
  if (shared.connections >= shared.hub.limits().connections) return;
  std::make_shared<HttpConnection>(std::move(socket), shared)->read();
}

}  // namespace microswarm::lab
