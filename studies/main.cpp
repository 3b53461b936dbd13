// The program: a request is read and its command run.
#include "model/input_error.hpp"
#include "results/archive/output_folder.hpp"
#include "studies/command_line/as_typed.hpp"
#include "studies/command_line/command_line.hpp"
#include "studies/command_line/help_text.hpp"
#include "studies/ranks/ranks.hpp"
#include "studies/run/command.hpp"
#include "studies/run/interrupt.hpp"
#include "studies/run/log.hpp"
#include "studies/run/page_data.hpp"
#include "studies/run/run_record.hpp"
#include "studies/run/version.hpp"
#include "studies/settings/setup.hpp"
#include "studies/settings/text.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <system_error>

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

namespace {

enum ExitCode { done = 0, run_failed = 1, bad_input = 2, interrupted = 3 };

/// Designs that wait at once for the ranks that simulate them: each has a thread, and where there
/// are more ranks these share designs.
constexpr int designs_in_flight = 128;

/// Runs a command, or prints its configuration.
void run(nlcwfs::Request& request, const nlcwfs::Ranks& ranks) {
  using namespace nlcwfs;
  scale_default_planes(request.configuration);
  if (request.command->set_defaults != nullptr) {
    request.command->set_defaults(request.configuration);
  }
  if (request.dump_config) {
    fmt::print("{}", request.configuration.dump());
    return;
  }
  start_log(request.log_level);
  if (request.output) OutputFolder::require_free(*request.output);
  if (request.resume && is_complete(*request.resume)) {
    // The page comes last.
    if (!std::filesystem::exists(*request.resume / "report.html")) {
      write_page(*request.resume, *request.command);
    }
    fmt::print("{} is complete, nothing is left to do.\n", request.resume->string());
    return;
  }
  const int wanted = request.threads > 0 ? request.threads : ranks.cores();
  const int threads = std::min(wanted, tbb::this_task_arena::max_concurrency());
  // Before the runner's threads, with which TBB would settle for fewer.
  const tbb::global_control limit(
      tbb::global_control::max_allowed_parallelism,
      static_cast<std::size_t>(ranks.count() > 1 ? threads + designs_in_flight : threads));
  request.runner = ranks.runner(request.threads);
  // What is not a trial has no more threads than without ranks.
  tbb::task_arena arena(threads);
  arena.execute([&] { request.command->run(request); });
}

void run(int argc, const char* const* argv, const nlcwfs::Ranks& ranks) {
  using namespace nlcwfs;
  Request request = parse_command_line(argc, argv);
  if (request.version) {
    fmt::print("nlcwfs {}\n", version());
    return;
  }
  if (request.help) {
    fmt::print("{}", request.command == nullptr ? program_help() : command_help(*request.command));
    return;
  }
  try {
    run(request, ranks);
  } catch (const InputError& error) {
    throw as_typed(error, request.configuration);
  }
}

}  // namespace

int main(int argc, char** argv) {
  using nlcwfs::print_error;
  nlcwfs::occupy_standard_streams();
  try {
    nlcwfs::Ranks ranks;
    ranks.rank() == 0 ? run(argc, argv, ranks) : ranks.serve();
    if (std::fflush(stdout) != 0) {
      throw std::system_error(errno, std::generic_category(), "cannot write to standard output");
    }
    return done;
  } catch (const nlcwfs::RunInterrupted& what) {
    std::fflush(stdout);
    if (*what.what() != 0) print_error(fmt::format("nlcwfs: interrupted: {}\n", what.what()));
    return interrupted;
  } catch (const nlcwfs::InputError& error) {
    print_error(fmt::format("nlcwfs: {}\n", nlcwfs::without_controls(error.what())));
    return bad_input;
  } catch (const std::bad_alloc&) {
    print_error(
        "nlcwfs: failed: there is not enough memory; ask for fewer screens, or smaller windows of "
        "fewer samples\n");
    return run_failed;
  } catch (const std::exception& error) {
    print_error(fmt::format("nlcwfs: failed: {}\n", nlcwfs::without_controls(error.what())));
    return run_failed;
  }
}
