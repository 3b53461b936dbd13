// Errors of the physics name values as the user has typed them.
#pragma once

#include "model/input_error.hpp"
#include "studies/settings/configuration.hpp"

namespace nlcwfs {

/// The physics knows numbers in SI, the user what stands in the configuration: the same error with
/// its key's value as that is written there, 180km for 180000. Of a list it is the element at
/// fault. An error about something else stays as it is.
InputError as_typed(const InputError& error, const Configuration& configuration);

}  // namespace nlcwfs
