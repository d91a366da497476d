// SPDX-License-Identifier: Apache-2.0
#include "microswarm/sweep/ranks.hpp"

#include <cstdlib>

#include "microswarm/core/errors/error.hpp"

#ifdef MICROSWARM_HAS_MPI
#include <mpi.h>
#endif

namespace microswarm {
namespace {

/// Open MPI's mpirun, and what other launchers say by the interfaces that it understands.
bool started_together() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"})
    if (std::getenv(name)) return true;
  return false;
}

}  // namespace

#ifdef MICROSWARM_HAS_MPI

Ranks::Ranks() {
  if (!started_together()) return;
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  if (provided < MPI_THREAD_FUNNELED) throw InputError("mpirun: this MPI does not allow threads");
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &count_);
}

Ranks::~Ranks() {
  int begun = 0;
  MPI_Initialized(&begun);
  if (begun) MPI_Finalize();
}

void Ranks::send(int to, const std::string& bytes) const {
  MPI_Send(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, to, 0, MPI_COMM_WORLD);
}

std::optional<Ranks::Message> Ranks::receive() const {
  if (count_ == 1) return std::nullopt;
  int waits = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, 0, MPI_COMM_WORLD, &waits, &status);
  if (!waits) return std::nullopt;
  int size = 0;
  MPI_Get_count(&status, MPI_BYTE, &size);
  Message message{status.MPI_SOURCE, std::string(static_cast<std::size_t>(size), '\0')};
  MPI_Recv(message.bytes.data(), size, MPI_BYTE, status.MPI_SOURCE, 0, MPI_COMM_WORLD,
           MPI_STATUS_IGNORE);
  return message;
}

#else

Ranks::Ranks() {
  if (started_together())
    throw InputError(
        "started under mpirun, but this program was built without MPI (MICROSWARM_MPI=OFF)");
}

Ranks::~Ranks() = default;
void Ranks::send(int, const std::string&) const {}
std::optional<Ranks::Message> Ranks::receive() const { return std::nullopt; }

#endif

}  // namespace microswarm
