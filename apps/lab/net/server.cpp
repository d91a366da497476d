// SPDX-License-Identifier: Apache-2.0
#include "lab/net/server.hpp"

#include <fmt/format.h>

#include <atomic>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ip/v6_only.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/thread_pool.hpp>
#include <thread>

#include "lab/files/library.hpp"
#include "lab/files/thumbnail.hpp"
#include "lab/net/access.hpp"
#include "lab/net/connection.hpp"
#include "lab/net/http.hpp"
#include "lab/sessions/hub.hpp"
#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/execution/priority.hpp"

namespace microswarm::lab {
namespace {

namespace asio = boost::asio;
using Tcp = asio::ip::tcp;
using Clock = Stop::Clock;
using namespace std::chrono_literals;

constexpr auto tick_period = 50ms;
constexpr auto longest_end = 500ms;

std::vector<std::filesystem::path> with(std::vector<std::filesystem::path> folders,
                                        std::filesystem::path more) {
  folders.push_back(std::move(more));
  return folders;
}

}  // namespace

class Server::Impl {
 public:
  explicit Impl(ServerOptions options)
      : options_(std::move(options)),
        library_(with(options_.folders, uploads_.folder())),
        hub_([this](std::function<void()> work) { asio::post(io_, std::move(work)); },
             options_.limits, new_lab_number(Hub::max_lab)),
        clock_(io_) {
    remove_left_folders();
    listen();
    access_.emplace(new_token(), port_);
  }

  ~Impl() {
    end();
    worker_.join();
    exporter_.join();
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  std::string url() const {
    const auto address = acceptors_.front().local_endpoint().address();
    const std::string host = address.is_unspecified() ? "localhost" : url_host(address);
    return fmt::format("http://{}:{}/?token={}", host, port_, access_->token());
  }

  void stop_rigs(const std::string& why) {
    asio::post(io_, [this, why] { hub_.stop(why); });
  }

  bool run(const Stop& stop) {
    const RealtimePriority priority(options_.priority, RealtimePriority::Inherited::no);
    for (Tcp::acceptor& acceptor : acceptors_) accept(acceptor);
    tick(stop);
    io_.run();
    end();
    const auto latest = Clock::now() + longest_end;
    while (!has_ended() && Clock::now() < latest) std::this_thread::sleep_for(5ms);
    return has_ended();
  }

 private:
  bool has_ended() const { return hub_.has_ended() && !works_; }

  void end() {
    for (const auto& one : exports_)
      if (const auto gone = one.lock()) *gone = true;
    hub_.end();
    worker_.stop();
    exporter_.stop();
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
      // Without IPv6 the other address is used.
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
    if (error) throw InputError(fmt::format("{}: port {}: {}", text, port_, error.message()));
    port_ = acceptor.local_endpoint().port();
    acceptors_.push_back(std::move(acceptor));
  }

  void accept(Tcp::acceptor& acceptor) {
    acceptor.async_accept([this, &acceptor](boost::system::error_code error, Tcp::socket socket) {
      if (error) {
        refused_.push_back(&acceptor);  // too many open files; retried at the next tick
        return;
      }
      serve_connection(std::move(socket), shared());
      accept(acceptor);
    });
  }

  Shared shared() {
    return {
        .access = *access_,
        .hub = hub_,
        .library = library_,
        .thumbnails = thumbnails_,
        .uploads = uploads_,
        .vessels = vessels_,
        .opening = options_.opening,
        .queue = options_.queue,
        .connections = connections_,
        .work =
            [this](std::function<void()> work) {
              asio::post(worker_, [this, work = std::move(work)] {
                works_ = true;
                work();
                works_ = false;
              });
            },
        .post = [this](std::function<void()> work) { asio::post(io_, std::move(work)); },
        .export_ =
            [this](std::shared_ptr<std::atomic<bool>> gone, std::function<void(const Stop&)> work) {
              std::erase_if(exports_, [](const auto& one) { return one.expired(); });
              exports_.push_back(gone);
              asio::post(exporter_, [gone = std::move(gone), work = std::move(work)] {
                work(Stop(gone.get()));
              });
            },
        .progress = progress_};
  }

  void tick(const Stop& stop) {
    clock_.expires_after(tick_period);
    clock_.async_wait([this, &stop](boost::system::error_code) {
      if (stop()) {
        io_.stop();
        return;
      }
      options_.lives();
      hub_.reap();
      for (Tcp::acceptor* acceptor : std::exchange(refused_, {})) accept(*acceptor);
      if (Clock::now() >= swept_ + options_.limits.sweep_period) {
        hub_.sweep();
        swept_ = Clock::now();
      }
      tick(stop);
    });
  }

  // Members used by connections must precede `io_`, with which connections are destroyed.
  ServerOptions options_;
  Uploads uploads_;  ///< of the worker
  Library library_;
  Thumbnails thumbnails_;  ///< of the worker
  VesselSearch vessels_;   ///< of the worker
  std::optional<Access> access_;
  std::size_t connections_ = 0;
  std::atomic<bool> works_ = false;
  std::vector<std::weak_ptr<std::atomic<bool>>> exports_;  ///< flags that stop them
  ExportProgress progress_;
  asio::io_context io_{1};
  Hub hub_;
  asio::thread_pool worker_{1};
  asio::thread_pool exporter_{1};
  asio::steady_timer clock_;
  std::vector<Tcp::acceptor> acceptors_;
  std::vector<Tcp::acceptor*> refused_;
  std::uint16_t port_ = 0;
  Clock::time_point swept_ = Clock::now();
};

Server::Server(ServerOptions options) : impl_(std::make_unique<Impl>(std::move(options))) {}
Server::~Server() = default;
std::string Server::url() const { return impl_->url(); }
bool Server::run(const Stop& stop) { return impl_->run(stop); }
void Server::stop_rigs(const std::string& why) { impl_->stop_rigs(why); }

}  // namespace microswarm::lab
