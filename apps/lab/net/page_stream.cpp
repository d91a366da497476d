// SPDX-License-Identifier: Apache-2.0
#include "lab/net/page_stream.hpp"

#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>

#include "lab/net/outbox.hpp"
#include "microswarm/core/errors/error.hpp"

namespace microswarm::lab {
namespace {

namespace beast = boost::beast;
namespace websocket = beast::websocket;
using Tcp = boost::asio::ip::tcp;
using namespace std::chrono_literals;

constexpr auto handshake = 10s;

/// A page's stream. A page that leaves too much unread is closed. Requests are read at the rate at
/// which their answers are written.
class PageStream : public Page, public std::enable_shared_from_this<PageStream> {
 public:
  PageStream(Tcp::socket socket, Hub& hub, std::uint64_t session)
      : stream_(std::move(socket)), hub_(hub), session_(session) {}

  void accept(const HttpRequest& request) {
    auto timeout = websocket::stream_base::timeout::suggested(beast::role_type::server);
    timeout.handshake_timeout = handshake;
    timeout.idle_timeout = hub_.limits().patience;
    stream_.set_option(timeout);
    stream_.read_message_max(max_request_size);
    stream_.binary(true);
    stream_.async_accept(request, [self = shared_from_this()](beast::error_code error) {
      if (error || !self->hub_.has(self->session_) || self->hub_.is_full()) return;
      self->number_ = self->hub_.join(self->session_, self);
      self->read();
    });
  }

  void send(const MessagePtr& message) override {
    outbox_.add(message);
    if (outbox_.size() > hub_.limits().unread)
      close();
    else if (!written_)
      write();
  }

  void close() override { end(false); }

 private:
  void end(bool for_good) {
    beast::get_lowest_layer(stream_).close();
    hub_.leave(number_, for_good);
  }

  /// Whether the page closed the stream itself: browsers give "going away" as the reason of a
  /// reload and of a closed window.
  bool is_left(beast::error_code error) const {
    return error == websocket::error::closed &&
           stream_.reason().code != websocket::close_code::going_away;
  }

  void read() {
    reads_ = true;
    stream_.async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      self->reads_ = false;
      if (error) return self->end(self->is_left(error));
      const std::string text = beast::buffers_to_string(self->buffer_.data());
      self->buffer_.clear();
      ++self->unanswered_;
      self->take(text);
      self->read_on();
    });
  }

  void read_on() {
    if (!reads_ && unanswered_ < hub_.limits().unanswered) read();
  }

  void take(const std::string& text) {
    try {
      Request request = read_request(text);
      if (request.ask == Ask::ping) return send(answer_message(request.id, {}));
      if (request.ask == Ask::beat) --unanswered_;
      hub_.ask(number_, std::move(request));
    } catch (const InputError& error) {
      send(answer_message(id_in(text), error.issues()));
    }
  }

  void write() {
    written_ = outbox_.take();
    if (!written_) return;
    stream_.async_write(boost::asio::buffer(written_->bytes),
                        [self = shared_from_this()](beast::error_code error, std::size_t) {
                          if (error) return self->close();
                          if (self->written_->kind == Message::Kind::answer) --self->unanswered_;
                          self->write();
                          self->read_on();
                        });
  }

  websocket::stream<beast::tcp_stream> stream_;
  Hub& hub_;
  std::uint64_t session_;
  std::uint64_t number_ = 0;
  beast::flat_buffer buffer_;
  Outbox outbox_;
  MessagePtr written_;  ///< message being written
  bool reads_ = false;
  std::size_t unanswered_ = 0;  ///< number of requests
};

}  // namespace

void serve_stream(Tcp::socket socket, const HttpRequest& request, Hub& hub, std::uint64_t session) {
  std::make_shared<PageStream>(std::move(socket), hub, session)->accept(request);
}

}  // namespace microswarm::lab
