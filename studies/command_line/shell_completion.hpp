// completion: What lets a shell complete commands, keys and their words.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nlcwfs {

/// The shells that there is a completion for.
const std::vector<std::string>& completed_shells();

/// A script that lets a shell complete commands, the options and keys that each takes, the words
/// that a key may have, and the names of files and folders.
/// @param shell  one of completed_shells()
std::string shell_completion(std::string_view shell);

}  // namespace nlcwfs
