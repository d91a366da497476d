// SPDX-License-Identifier: Apache-2.0
// libmicroswarm_mpi.so, the only part that is linked with MPI.
#include <mpi.h>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/sweep/ranks.hpp"

namespace microswarm::sweep {
namespace {

class MpiMessages : public RankMessages {
 public:
  MpiMessages() {
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    if (provided < MPI_THREAD_FUNNELED) throw InputError("mpirun: this MPI does not allow threads");
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &count_);
  }
  ~MpiMessages() override { MPI_Finalize(); }
  MpiMessages(const MpiMessages&) = delete;
  MpiMessages& operator=(const MpiMessages&) = delete;

  int rank() const override { return rank_; }
  int count() const override { return count_; }

  void send(int to, const std::string& bytes) const override {
    MPI_Send(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, to, 0, MPI_COMM_WORLD);
  }

  std::optional<RankMessage> receive() const override {
    int waits = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, 0, MPI_COMM_WORLD, &waits, &status);
    if (!waits) return std::nullopt;
    int size = 0;
    MPI_Get_count(&status, MPI_BYTE, &size);
    RankMessage message{status.MPI_SOURCE, std::string(static_cast<std::size_t>(size), '\0')};
    MPI_Recv(message.bytes.data(), size, MPI_BYTE, status.MPI_SOURCE, 0, MPI_COMM_WORLD,
             MPI_STATUS_IGNORE);
    return message;
  }

 private:
  int rank_ = 0;
  int count_ = 1;
};

}  // namespace
}  // namespace microswarm::sweep

/// Symbol that Ranks looks up; the caller owns the object. Throws InputError.
extern "C" microswarm::sweep::RankMessages* microswarm_mpi() {
  return new microswarm::sweep::MpiMessages;
}
