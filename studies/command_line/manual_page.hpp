// manual: The manual page nlcwfs(1).
#pragma once

#include <string>

namespace nlcwfs {

/// The manual page nlcwfs(1), for man: every command, option and key from the tables that the
/// program itself follows.
std::string manual_page();

}  // namespace nlcwfs
