// Holds every place that names the program's version against the one of CMakeLists.txt.
#include "studies/run/version.hpp"

#include "studies/command_line/manual_page.hpp"
#include "tests/paths.hpp"
#include "tests/scratch_folder.hpp"

#include <regex>

#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

/// What the pattern's groups take from the text, at its first match.
std::vector<std::string> found_in(const std::string& text, const std::string& pattern) {
  std::smatch match;
  if (!std::regex_search(text, match, std::regex(pattern))) return {};
  return {match.begin() + 1, match.end()};
}

/// The version's date, which the build gives to the manual page.
std::string version_date() {
  const auto date = found_in(manual_page(), "\\.TH NLCWFS 1 \"([0-9]{4}-[0-9]{2}-[0-9]{2})\"");
  return date.empty() ? "" : date.front();
}

TEST(Version, IsThatOfTheCitation) {
  const std::string citation = contents(source_folder() / "CITATION.cff");
  EXPECT_THAT(found_in(citation, "\nversion: (.*)\n"), ElementsAre(version()));
  EXPECT_THAT(found_in(citation, "\ndate-released: (.*)\n"), ElementsAre(version_date()));
}

TEST(Version, IsTheNewestOfTheChanges) {
  const std::string changes = contents(source_folder() / "CHANGELOG.md");
  EXPECT_THAT(changes, HasSubstr("\n## [Unreleased]\n"));
  EXPECT_THAT(found_in(changes, "\n## \\[([0-9.]+)\\] - (.*)\n"),
              ElementsAre(version(), version_date()));
}

TEST(Version, IsWhatOtherProjectsAreToldToAskFor) {
  const std::string asked = "find_package\\(nlcwfs ([0-9]+\\.[0-9]+) REQUIRED\\)";
  for (const char* file : {"README.md", "examples/design_check/CMakeLists.txt"}) {
    const auto version_of_file = found_in(contents(source_folder() / file), asked);
    ASSERT_THAT(version_of_file, SizeIs(1)) << file;
    EXPECT_TRUE(version().starts_with(version_of_file.front() + '.')) << file;
  }
}

}  // namespace
}  // namespace nlcwfs
