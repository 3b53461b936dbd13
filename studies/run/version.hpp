// The program's version.
#pragma once

#include <string_view>

namespace nlcwfs {

/// The program's version, as the build has it.
std::string_view version();

}  // namespace nlcwfs
