// Performances become bytes and back, to the last bit.
#pragma once

#include "model/performance.hpp"

#include <cstdint>
#include <vector>

namespace nlcwfs {

/// Performances to the last bit, as CBOR: what an archive keeps and ranks tell each other. Of each
/// screen all but residual_after_loops.
std::vector<std::uint8_t> performance_record(const std::vector<Performance>& performances);

/// The inverse.
/// @throws std::runtime_error for bytes that are no such record
std::vector<Performance> performances_of(const std::vector<std::uint8_t>& record);

}  // namespace nlcwfs
