// Fuzzes JSON: law files and summaries.
#include "studies/commands/report.hpp"
#include "studies/run/page_data.hpp"
#include "studies/settings/law_file.hpp"
#include "tests/fuzz/fuzzer.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

using namespace nlcwfs;

namespace {

using Json = nlohmann::ordered_json;

void expect(bool condition) {
  if (!condition) std::abort();
}

/// A run's folder in which the summary changes; it is gone when the program ends.
class RunFolder {
 public:
  RunFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "nlcwfs-fuzz-XXXXXX").string();
    expect(mkdtemp(name.data()) != nullptr);
    path_ = name;
    std::ofstream(path_ / "config.cfg") << Configuration().dump();
  }
  ~RunFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;
  RunFolder(RunFolder&&) = delete;
  RunFolder& operator=(RunFolder&&) = delete;

  const std::filesystem::path& with_summary(std::string_view text) const {
    std::ofstream(path_ / "summary.json", std::ios::binary) << text;
    return path_;
  }

 private:
  std::filesystem::path path_;
};

void read_law(std::string_view text) {
  LawFile file;
  if (!is_accepted([&] { file = parse_law_file(text, "law.json"); })) return;
  const std::string written = to_json(file).dump();
  expect(to_json(parse_law_file(written, "law.json")).dump() == written);
}

void read_summary(std::string_view text) {
  static const RunFolder folder;
  is_accepted([&] {
    // As a page has it.
    page_data(folder.with_summary(text), command_of_run(folder.with_summary(text)))
        .dump(-1, ' ', false, Json::error_handler_t::replace);
  });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  read_law(text_of(data, size));
  read_summary(text_of(data, size));
  return 0;
}
