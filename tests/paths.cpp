// Where the build has put what tests need.
#include "tests/paths.hpp"

namespace nlcwfs {

std::filesystem::path source_folder() { return NLCWFS_SOURCE_DIR; }

std::string test_reference_folder() { return NLCWFS_SOURCE_DIR "/tests/reference"; }

std::string reference_run_folder() { return NLCWFS_SOURCE_DIR "/results/reference/letchev-2022"; }

std::string program_path() { return NLCWFS_PROGRAM; }

}  // namespace nlcwfs
