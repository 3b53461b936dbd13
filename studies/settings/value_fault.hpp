// Why a key does not take a value, in a few words.
#pragma once

#include "studies/settings/configuration_key.hpp"

#include <string>
#include <string_view>

namespace nlcwfs {

/// Why a key does not accept a value, where that can be told in a few words: "the minimum is not
/// below the maximum". Empty otherwise.
std::string fault_of(const ConfigurationKey& key, std::string_view value);

/// What a list of things that are tried one by one has twice, as it is typed; empty where each is
/// there once, and for lists that may repeat, as planes may.
/// @pre the key accepts the value
std::string repeated_part(const ConfigurationKey& key, std::string_view value);

}  // namespace nlcwfs
