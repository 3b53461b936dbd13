// export: A run's archive as flat tables.
#include "model/input_error.hpp"
#include "results/fits/fits_table.hpp"
#include "results/tables/evaluation_table.hpp"
#include "studies/run/command.hpp"
#include "studies/run/run_record.hpp"
#include "studies/run/verdict_text.hpp"
#include "studies/settings/text.hpp"

#include <map>

#include <boost/algorithm/string/split.hpp>
#include <fmt/ranges.h>

namespace nlcwfs {
namespace {

/// The evaluations of a run's folder or of an archive, see evaluation_list().
/// @throws InputError where it is neither
Json evaluations_of(const std::filesystem::path& run) {
  const auto refuse = [&](const std::string& why) {
    throw InputError("RUN", one_line(run.string()), why);
  };
  const bool is_folder = std::filesystem::is_directory(run);
  const std::filesystem::path path = is_folder ? run / "archive.sqlite" : run;
  if (!std::filesystem::is_regular_file(path)) {
    refuse(
        fmt::format("{}; name the folder of a run, such as results/optimize-1, or its "
                    "archive.sqlite",
                    is_folder ? "has no archive.sqlite" : "there is no such file"));
  }
  std::vector<ArchivedEvaluation> evaluations;
  try {
    evaluations = Archive::reopened(path).evaluations();
  } catch (const std::runtime_error&) {
    refuse(
        "is no archive of a run of this version; name the folder of a run, such as "
        "results/optimize-1");
  }
  try {
    return evaluation_list(evaluations);
  } catch (const std::runtime_error& error) {
    refuse(fmt::format("is no archive of evaluations: {}", one_line(error.what())));
    throw;
  }
}

/// The formats of export.formats.
std::set<std::string> formats_of(const Configuration& configuration) {
  const std::string& text = configuration.text("export.formats");
  std::vector<std::string> words;
  boost::split(words, text, [](char c) { return c == ','; });
  std::set<std::string> formats;
  for (const std::string& word : words) {
    const std::string format(trimmed(word));
    if (format != "csv" && format != "json" && format != "fits") {
      throw InputError("export.formats", one_line(text), "a list of csv, json and fits");
    }
    if (!formats.insert(format).second) {
      throw InputError("export.formats", one_line(text),
                       fmt::format("each value once, but {} is twice", format));
    }
  }
  return formats;
}

void run_export(const Request& request) {
  const std::set<std::string> formats = formats_of(request.configuration);
  const std::filesystem::path source = request.arguments.at(0);
  const Json list = evaluations_of(source);
  const FlatTable table = evaluation_table(list);
  RunRecord record(request);

  std::vector<std::string> files;
  for (const std::string& format : formats) {
    files.push_back(fmt::format("evaluations.{}", format));
    if (format == "fits") {
      write_fits_table(record.folder().file(files.back()), table, "EVALUATIONS");
    } else {
      // Texts of a failure need not be UTF-8, which JSON is.
      record.folder().write(files.back(),
                            format == "csv"
                                ? table.csv()
                                : list.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
    }
  }
  std::map<std::string, int> stages;
  int failed = 0;
  for (const Json& evaluation : list) {
    ++stages[evaluation.at("stage")];
    failed += evaluation.at("failure").is_null() ? 0 : 1;
  }
  record.write_summary({{"source", source.string()},
                        {"evaluations", list.size()},
                        {"stages", stages},
                        {"failed", failed},
                        {"columns", table.columns.size()},
                        {"files", files}});

  std::vector<std::string> counts;
  for (const auto& [stage, count] : stages)
    counts.push_back(fmt::format("{} {}", one_line(stage), count));
  record.print("{} evaluations of {}{}, {} of them failed\n", list.size(),
               one_line(source.string()),
               counts.empty() ? "" : fmt::format(" ({})", fmt::join(counts, ", ")), failed);
  record.print("{}: {} columns each\n\n", fmt::join(files, ", "), table.columns.size());
  record.close();
}

std::string of_export(const Json& summary) {
  return fmt::format("{} evaluations, {} of them failed.",
                     integer_from_json(summary.at("evaluations")),
                     integer_from_json(summary.at("failed")));
}

}  // namespace

Command export_command() {
  return {.name = "export",
          .group = "Results of a run",
          .description = "write a run's archive as flat tables: CSV, JSON, FITS",
          .about =
              "Takes the folder of a run, or its archive.sqlite, and writes a row for every design "
              "that was evaluated, with its planes, its properties and every metric with its "
              "standard error.",
          .keys = {"export"},
          .examples = {"nlcwfs export results/optimize-1 --export.formats csv,fits"},
          .run = run_export,
          .arguments = {{"RUN"}},
          .files = {{"evaluations.csv", FileRole::table, false},
                    {"evaluations.json"},
                    {"evaluations.fits"}},
          .verdict = of_export};
}

}  // namespace nlcwfs
