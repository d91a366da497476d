// SPDX-License-Identifier: Apache-2.0
#include "microswarm/sweep/ranks.hpp"

#include <cstdlib>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/core/execution/module.hpp"

namespace microswarm::sweep {
namespace {

/// Whether Open MPI's mpirun or a launcher with a compatible interface started this process.
bool started_together() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"})
    if (std::getenv(name)) return true;
  return false;
}

}  // namespace

Ranks::Ranks() {
  if (!started_together()) return;
#ifdef MICROSWARM_HAS_MPI
  messages_.reset(
      reinterpret_cast<RankMessages* (*)()>(load_module("mpi", "sweeps under mpirun"))());
#else
  throw InputError(
      "started under mpirun, but this program was built without MPI (MICROSWARM_MPI=OFF)");
#endif
}

void Ranks::send(int to, const std::string& bytes) const {
  if (messages_) messages_->send(to, bytes);
}

std::optional<RankMessage> Ranks::receive() const {
  return count() == 1 ? std::nullopt : messages_->receive();
}

}  // namespace microswarm::sweep
