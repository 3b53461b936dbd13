// The words of a command line become a request.
#pragma once

#include "studies/run/request.hpp"

namespace nlcwfs {

/// Reads the command line and the files and the preset that it names; the command line's values
/// override the files', later files earlier ones, files the preset, the preset the defaults.
/// @throws InputError for what it cannot follow
Request parse_command_line(int argc, const char* const* argv);

}  // namespace nlcwfs
