// SPDX-License-Identifier: Apache-2.0
#include "lab/server.hpp"

#include <fmt/format.h>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ip/v6_only.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>

#include "lab/access.hpp"
#include "lab/connection.hpp"
#include "lab/hub.hpp"
#include "lab/library.hpp"
#include "microswarm/core/errors/error.hpp"

namespace microswarm::lab {
namespace {

namespace asio = boost::asio;
using Tcp = asio::ip::tcp;
using namespace std::chrono_literals;

}  // namespace

class Server::Impl {
 public:
  explicit Impl(ServerOptions options)
      : options_(std::move(options)),
        hub_([this](std::function<void()> work) { asio::post(io_, std::move(work)); },
             options_.max_sessions, options_.max_pages),
        library_(options_.folders),
        clock_(io_) {
    listen();
    access_.emplace(new_token(), hosts(), port_);
  }

  std::string url() const {
    const std::string host = options_.listen.empty() ? "127.0.0.1" : literal(options_.listen);
    return fmt::format("http://{}:{}/?token={}", host, port_, access_->token());
  }

  void run(const Stop& stop) {
    for (Tcp::acceptor& acceptor : acceptors_) accept(acceptor);
    tick(stop);
    io_.run();
  }

 private:
  static std::string literal(const std::string& address) {
    return address.find(':') == std::string::npos ? address : "[" + address + "]";
  }

  std::vector<std::string> hosts() const {
    std::vector<std::string> names{"127.0.0.1", "localhost", "[::1]"};
    if (!options_.listen.empty()) names.push_back(literal(options_.listen));
    for (std::string& name : names) name += fmt::format(":{}", port_);
    return names;
  }

  void listen() {
    port_ = options_.port;
    if (!options_.listen.empty()) {
      listen_at(options_.listen);
      return;
    }
    listen_at("127.0.0.1");
    try {
      listen_at("::1");
    } catch (const InputError&) {
      // A computer without IPv6 is reached by the other address.
    }
  }

  void listen_at(const std::string& text) {
    boost::system::error_code error;
    const auto address = asio::ip::make_address(text, error);
    if (error) throw InputError(fmt::format("--listen: {} is not an address", text));
    Tcp::acceptor acceptor(io_);
    const auto attempt = [&](const auto& act) {
      if (!error) act();
    };
    attempt([&] { acceptor.open(address.is_v6() ? Tcp::v6() : Tcp::v4(), error); });
    attempt([&] { acceptor.set_option(asio::socket_base::reuse_address(true), error); });
    attempt([&] {
      if (address.is_v6()) acceptor.set_option(asio::ip::v6_only(true), error);
    });
    attempt([&] { acceptor.bind({address, port_}, error); });
    attempt([&] { acceptor.listen(asio::socket_base::max_listen_connections, error); });
    if (error)
      throw InputError(fmt::format("{}: port {}: {}", text, port_, error.message()));
    port_ = acceptor.local_endpoint().port();
    acceptors_.push_back(std::move(acceptor));
  }

  void accept(Tcp::acceptor& acceptor) {
    acceptor.async_accept([this, &acceptor](boost::system::error_code error, Tcp::socket socket) {
      if (!acceptor.is_open()) return;
      if (!error) serve_connection(std::move(socket), {*access_, hub_, library_, options_.opening});
      accept(acceptor);
    });
  }

  void tick(const Stop& stop) {
    clock_.expires_after(50ms);
    clock_.async_wait([this, &stop](boost::system::error_code) {
      if (stop()) {
        io_.stop();
        return;
      }
      if (++ticks_ % 200 == 0) hub_.sweep();
      tick(stop);
    });
  }

  ServerOptions options_;
  asio::io_context io_{1};
  Hub hub_;
  Library library_;
  asio::steady_timer clock_;
  std::vector<Tcp::acceptor> acceptors_;
  std::uint16_t port_ = 0;
  std::optional<Access> access_;
  std::uint64_t ticks_ = 0;
};

Server::Server(ServerOptions options) : impl_(std::make_unique<Impl>(std::move(options))) {}
Server::~Server() = default;
std::string Server::url() const { return impl_->url(); }
void Server::run(const Stop& stop) { impl_->run(stop); }

}  // namespace microswarm::lab
