// The program's version.
#include "studies/run/version.hpp"

namespace nlcwfs {

std::string_view version() { return NLCWFS_VERSION; }

}  // namespace nlcwfs
