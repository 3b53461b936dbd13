// Holds the include lines of the project's folders against the table of CONTRIBUTING.md.
#include "tests/paths.hpp"
#include "tests/scratch_folder.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

/// By folder, what it may use besides itself; a folder stands for those in it too.
using Rules = std::map<std::string, std::set<std::string>>;
/// By name, what it uses.
using Graph = std::map<std::string, std::set<std::string>>;

/// The words in backquotes of a line.
std::vector<std::string> quoted_words(const std::string& line) {
  static const std::regex word("`([a-z_/]+)/?`");
  std::vector<std::string> words;
  for (std::sregex_iterator match(line.begin(), line.end(), word), end; match != end; ++match) {
    std::string name = (*match)[1];
    if (name.ends_with('/')) name.pop_back();
    words.push_back(name);
  }
  return words;
}

/// The table with this heading in a document: the first word in backquotes of each row, and those
/// of its last column.
Rules table_of(const fs::path& document, const std::string& heading) {
  std::ifstream lines(document);
  Rules rules;
  bool is_inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(heading)) {
      is_inside = true;
    } else if (is_inside && !line.starts_with('|')) {
      break;
    } else if (is_inside && line.starts_with("| `")) {
      const auto last = line.rfind('|', line.size() - 2);
      const std::vector<std::string> used = quoted_words(line.substr(last));
      rules[quoted_words(line).front()] = {used.begin(), used.end()};
    }
  }
  return rules;
}

Rules rules() { return table_of(source_folder() / "CONTRIBUTING.md", "| folder | may use |"); }

/// Of each source file below the folders of the rules, what it includes between quotes.
Graph includes_below(const fs::path& root, const Rules& folders) {
  static const std::regex include("#include \"([^\"]+)\"");
  std::set<fs::path> tops;
  for (const auto& [folder, used] : folders) tops.insert(*fs::path(folder).begin());
  Graph files;
  for (const fs::path& top : tops) {
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".cpp" && extension != ".hpp" && extension != ".in") continue;
      std::ifstream stream(entry.path());
      const std::string text(std::istreambuf_iterator<char>(stream), {});
      std::set<std::string>& used = files[entry.path().lexically_relative(root).string()];
      for (std::sregex_iterator match(text.begin(), text.end(), include), end; match != end;
           ++match) {
        used.insert((*match)[1]);
      }
    }
  }
  return files;
}

std::string folder_of(const std::string& file) { return fs::path(file).parent_path().string(); }

bool is_allowed(const std::string& user, const std::string& used, const Rules& rules) {
  if (user == used) return true;
  const auto rule = rules.find(user);
  return rule != rules.end() && std::ranges::any_of(rule->second, [&](const std::string& allowed) {
           return used == allowed || used.starts_with(allowed + '/');
         });
}

/// A line for each include that the rules do not allow.
std::vector<std::string> breaches(const Graph& files, const Rules& rules) {
  std::vector<std::string> found;
  for (const auto& [file, used] : files) {
    if (!rules.contains(folder_of(file))) found.push_back(file + " is in a folder without a rule");
    for (const std::string& other : used) {
      if (!is_allowed(folder_of(file), folder_of(other), rules)) {
        found.push_back(file + " may not include " + other);
      }
    }
  }
  return found;
}

/// The names around a way back to where it began; empty where there is none.
std::vector<std::string> cycle_in(const Graph& graph) {
  std::set<std::string> done;
  std::vector<std::string> path;
  const auto visit = [&](const auto& self, const std::string& name) -> bool {
    if (done.contains(name)) return false;
    const auto before = std::ranges::find(path, name);
    if (before != path.end()) {
      path.erase(path.begin(), before);
      return true;
    }
    path.push_back(name);
    const auto used = graph.find(name);
    if (used != graph.end()) {
      for (const std::string& next : used->second) {
        if (self(self, next)) return true;
      }
    }
    path.pop_back();
    done.insert(name);
    return false;
  };
  for (const auto& [name, used] : graph) {
    if (visit(visit, name)) return path;
  }
  return {};
}

/// A header and its source are one unit.
std::string unit_of(const std::string& file) { return file.substr(0, file.find('.')); }

Graph units_of(const Graph& files) {
  Graph units;
  for (const auto& [file, used] : files) {
    for (const std::string& other : used) {
      if (unit_of(other) != unit_of(file)) units[unit_of(file)].insert(unit_of(other));
    }
  }
  return units;
}

class Includes : public ScratchFolder {
 protected:
  static void write(const std::string& file, const std::string& text) {
    fs::create_directories(folder_of(file));
    std::ofstream(file) << text;
  }
};

TEST_F(Includes, AreAsTheTableAllows) {
  const Rules table = rules();
  ASSERT_THAT(table, SizeIs(testing::Ge(17U))) << "the table is not found, or read wrongly";
  const Graph files = includes_below(source_folder(), table);
  ASSERT_THAT(files, SizeIs(testing::Ge(200U)));
  EXPECT_THAT(breaches(files, table), IsEmpty());
}

TEST_F(Includes, NeverRunBackUp) {
  EXPECT_THAT(cycle_in(units_of(includes_below(source_folder(), rules()))), IsEmpty());
  EXPECT_THAT(cycle_in(rules()), IsEmpty());
}

TEST_F(Includes, ThatAreForbiddenAreFound) {
  write("model/light.hpp", "#pragma once\n");
  write("optimizer/search.cpp", "#include \"model/light.hpp\"\n");
  write("studies/run/log.cpp", "#include \"studies/run/log.hpp\"\n");
  write("studies/run/log.hpp", "#include \"studies/commands/sweep.hpp\"\n");
  write("studies/attic/old.cpp", "");
  const Rules table = rules();
  const std::vector<std::string> found =
      breaches(includes_below(".", {{"model", {}}, {"optimizer", {}}, {"studies", {}}}), table);
  EXPECT_THAT(found, SizeIs(3));
  EXPECT_THAT(found, Contains("optimizer/search.cpp may not include model/light.hpp"));
  EXPECT_THAT(found, Contains("studies/run/log.hpp may not include studies/commands/sweep.hpp"));
  EXPECT_THAT(found, Contains("studies/attic/old.cpp is in a folder without a rule"));
}

TEST_F(Includes, ThatRunBackUpAreFound) {
  write("model/a.hpp", "#include \"model/b.hpp\"\n");
  write("model/b.hpp", "");
  write("model/b.cpp", "#include \"model/b.hpp\"\n#include \"model/c.hpp\"\n");
  write("model/c.hpp", "");
  const Rules model{{"model", {}}};
  EXPECT_THAT(cycle_in(units_of(includes_below(".", model))), IsEmpty());
  write("model/c.cpp", "#include \"model/a.hpp\"\n");
  EXPECT_THAT(cycle_in(units_of(includes_below(".", model))),
              testing::UnorderedElementsAre("model/a", "model/b", "model/c"));
}

/// What a library of CMake links to, by its CMakeLists.txt.
std::set<std::string> linked_libraries(const std::string& library) {
  std::ifstream stream(source_folder() / library / "CMakeLists.txt");
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  const std::regex name("nlcwfs::([a-z]+)");
  const auto begin = text.find("nlcwfs_library(");
  const std::string call = text.substr(begin, text.find(')', text.find("PUBLIC", begin)) - begin);
  std::set<std::string> names;
  for (std::sregex_iterator match(call.begin(), call.end(), name), end; match != end; ++match) {
    if (fs::exists(source_folder() / (*match)[1].str())) names.insert((*match)[1]);
  }
  return names;
}

TEST_F(Includes, AreOfWhatTheLibrariesLinkToAsTheReadmeSays) {
  const Rules readme = table_of(source_folder() / "README.md", "| folder | what is in it |");
  for (const std::string library : {"model", "optimizer", "objectives", "results", "studies"}) {
    std::set<std::string> used;
    for (const auto& [folder, allowed] : rules()) {
      if (*fs::path(folder).begin() != library) continue;
      for (const std::string& other : allowed) used.insert(fs::path(other).begin()->string());
    }
    used.erase(library);
    EXPECT_EQ(linked_libraries(library), used) << library;
    ASSERT_TRUE(readme.contains(library)) << library;
    EXPECT_EQ(readme.at(library), used) << library;
  }
}

TEST_F(Includes, OfTestsStandInTheFoldersOfWhatTheyTest) {
  std::set<std::string> folders;
  for (const auto& [folder, allowed] : rules()) folders.insert(folder);
  for (const auto& entry : fs::recursive_directory_iterator(source_folder() / "tests")) {
    if (!entry.path().filename().string().ends_with("_test.cpp")) continue;
    const std::string folder =
        folder_of(entry.path().lexically_relative(source_folder() / "tests").string());
    EXPECT_TRUE(folders.contains(folder) || folder == "layout") << entry.path();
  }
}

TEST_F(Includes, OfTestsAreInTheListsOfSources) {
  std::ifstream stream(source_folder() / "tests/CMakeLists.txt");
  const std::string lists(std::istreambuf_iterator<char>(stream), {});
  for (const auto& entry : fs::recursive_directory_iterator(source_folder() / "tests")) {
    if (!entry.path().filename().string().ends_with("_test.cpp")) continue;
    const fs::path path = entry.path().lexically_relative(source_folder() / "tests");
    EXPECT_THAT(lists, HasSubstr(path.lexically_relative(*path.begin()).string())) << path;
  }
}

TEST_F(Includes, StandBelowASentenceThatSaysWhatHappensInTheFile) {
  for (const std::string top :
       {"model", "optimizer", "objectives", "results", "studies", "tests", "benchmarks"}) {
    for (const auto& entry : fs::recursive_directory_iterator(source_folder() / top)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".cpp" && extension != ".hpp" && extension != ".in") continue;
      std::ifstream stream(entry.path());
      std::string line;
      std::getline(stream, line);
      EXPECT_TRUE(line.starts_with("// ")) << entry.path() << " begins with: " << line;
    }
  }
}

}  // namespace
}  // namespace nlcwfs
