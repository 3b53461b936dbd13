// How many processes a launcher has started.
#pragma once

namespace nlcwfs {

/// How many processes a launcher (mpirun, srun) says that it has started together, this one among
/// them; 1 without a launcher.
int launched_processes();

}  // namespace nlcwfs
