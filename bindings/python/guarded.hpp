// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "microswarm/core/errors/error.hpp"

namespace microswarm::python {

/// A resource that one thread at a time may use, until it is closed.
template <class T>
class Guarded {
 public:
  Guarded(std::unique_ptr<T> held, const char* kind) : held_(std::move(held)), kind_(kind) {}

  template <class Work>
  auto use(Work&& work) {
    if (in_use_.exchange(true))
      throw InputError("the " + std::string(kind_) +
                       " is in use, by another thread or around this call");
    const struct Leave {
      std::atomic<bool>& in_use;
      ~Leave() { in_use = false; }
    } leave{in_use_};
    if (!held_) throw InputError("the " + std::string(kind_) + " is closed");
    return work(*held_);
  }
  void close() {
    if (in_use_.exchange(true)) throw InputError(std::string("the ") + kind_ + " is in use");
    held_.reset();
    in_use_ = false;
  }

 protected:
  /// Destroys it, once no other thread can use it.
  void end() { held_.reset(); }

 private:
  std::unique_ptr<T> held_;
  const char* kind_;
  std::atomic<bool> in_use_ = false;
};

}  // namespace microswarm::python
