// Where the build has put what tests need.
#pragma once

#include <filesystem>
#include <string>

namespace nlcwfs {

// Where the build has put what tests need. Compiled once, so that a checkout's place does not
// enter every test.

/// The checkout.
std::filesystem::path source_folder();

/// The folder tests/reference.
std::string test_reference_folder();

/// The folder results/reference/letchev-2022.
std::string reference_run_folder();

/// The program nlcwfs.
std::string program_path();

}  // namespace nlcwfs
