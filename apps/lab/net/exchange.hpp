// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <boost/beast/http.hpp>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "lab/files/library.hpp"
#include "lab/files/photograph.hpp"
#include "lab/files/thumbnail.hpp"
#include "lab/files/uploads.hpp"
#include "lab/net/access.hpp"
#include "lab/net/http.hpp"
#include "lab/sessions/hub.hpp"

namespace microswarm::lab {

/// The export in progress.
struct ExportProgress {
  std::atomic<std::uint64_t> session = 0;  ///< 0: none
  std::atomic<double> share = 0;           ///< completed
};

/// Data shared by connections; it outlives them.
struct Shared {
  const Access& access;
  Hub& hub;
  const Library& library;
  Thumbnails& thumbnails;  ///< used by the worker
  Uploads& uploads;        ///< used by the worker
  VesselSearch& vessels;   ///< used by the worker
  const std::optional<Opening>& opening;
  const std::filesystem::path& queue;  ///< folder of a rig's queue; empty without one
  std::size_t& connections;            ///< number of open connections, without streams
  /// Runs long work in another thread, which returns its result by post().
  std::function<void(std::function<void()>)> work;
  std::function<void(std::function<void()>)> post;
  /// Runs exports one by one in a separate thread. `gone` stops one; at the end all are stopped.
  std::function<void(std::shared_ptr<std::atomic<bool>> gone, std::function<void(const Stop&)>)>
      export_;
  ExportProgress& progress;
};

/// A request and its response, for the handler of the request. Call it in the thread of input and
/// output, and end each request with one write() or refuse().
class Exchange : public std::enable_shared_from_this<Exchange> {
 public:
  explicit Exchange(const Shared& shared) : shared_(shared) {}
  virtual ~Exchange() = default;

  const Shared& shared() const { return shared_; }
  const HttpRequest& request() const { return request_; }
  /// Decoded value of a key in the request's query; empty without it.
  std::string query(std::string_view key) const {
    return query_value(view(request_.target()), key);
  }

  virtual void write(HttpResponse response) = 0;
  virtual void write(boost::beast::http::response<boost::beast::http::file_body> response) = 0;
  /// Response {"error": why}.
  virtual void refuse(boost::beast::http::status status, const std::string& why) = 0;
  void nothing() { refuse(boost::beast::http::status::not_found, "there is nothing here"); }
  /// The response may take any time. The flag is set when the other side closes the connection
  /// before.
  virtual std::shared_ptr<std::atomic<bool>> wait() = 0;
  /// Responds with the result of `make`, which is called in another thread.
  void later(std::function<HttpResponse()> make);

 protected:
  Shared shared_;
  HttpRequest request_;
};

}  // namespace microswarm::lab
