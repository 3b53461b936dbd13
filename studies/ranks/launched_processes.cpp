// How many processes a launcher has started.
#include "studies/ranks/launched_processes.hpp"

#include "studies/settings/units.hpp"

#include <cstdlib>

namespace nlcwfs {

int launched_processes() {
  // Of Open MPI's mpirun, of MPICH's and those like it, and of srun: an mpirun inside of a step of
  // Slurm has started them itself.
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"}) {
    if (const char* size = std::getenv(name)) return parse_integer(size).value_or(1);
  }
  return 1;
}

}  // namespace nlcwfs
