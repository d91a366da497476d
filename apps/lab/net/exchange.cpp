// SPDX-License-Identifier: Apache-2.0
#include "lab/net/exchange.hpp"

namespace microswarm::lab {

void Exchange::later(std::function<HttpResponse()> make) {
  wait();
  shared_.work([self = shared_from_this(), make = std::move(make)]() mutable {
    HttpResponse response;
    try {
      response = make();
    } catch (const std::exception& error) {
      response = lab::refuse(self->request_, boost::beast::http::status::bad_request, error.what());
    }
    const auto post = self->shared_.post;
    post([self = std::move(self), response = std::move(response)]() mutable {
      self->write(std::move(response));
    });
  });
}

}  // namespace microswarm::lab
