// Runs the real program in tests.
#pragma once

#include "results/archive/output_folder.hpp"
#include "studies/commands/commands.hpp"
#include "tests/paths.hpp"
#include "tests/scratch_folder.hpp"

#include <cstdlib>
#include <string>
#include <sys/wait.h>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace nlcwfs {

/// What a run of the program left behind, apart from its folder.
struct ProgramRun {
  int exit_code;  ///< -1 where a signal ended it
  std::string output;
  std::string errors;
};

/// Runs the real program in a folder of the test's own.
class Program : public ScratchFolder {
 protected:
  using Arguments = std::vector<std::string>;

  /// A configuration that is simulated in milliseconds.
  void SetUp() override {
    ScratchFolder::SetUp();
    std::ofstream("tiny.cfg") << "[detector]\npupil_pixels = 16\nwindow = 2\n"
                                 "[reconstruction]\nwindow = 4\n"
                                 "[simulation]\npupil_samples = 32\n"
                                 "[screens]\ncount = 2\n"
                                 "[verify]\nscreens = 2\n"
                                 "[search]\nbudget = 6\n"
                                 "[trade]\nbudget = 48\n"
                                 "[law]\nd_over_r0 = 3,4,5,6\n"
                                 "[sweep]\nz_near = 30km,60km\n";
  }

  /// @param shell  what stands before the program in the shell's command
  static ProgramRun run(const Arguments& arguments, const std::string& shell = "") {
    std::string command = shell + quoted(program_path());
    for (const std::string& argument : arguments) command += ' ' + quoted(argument);
    const int status = std::system((command + " > output.txt 2> errors.txt").c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents("output.txt"),
            contents("errors.txt")};
  }

  /// `command --config tiny.cfg --output folder more...`, which must succeed and print nothing but
  /// text.
  static ProgramRun done(const std::string& command, const std::string& folder,
                         const Arguments& more = {}) {
    Arguments arguments{command, "--config", "tiny.cfg", "--output", folder};
    arguments.insert(arguments.end(), more.begin(), more.end());
    ProgramRun finished = run(arguments);
    EXPECT_EQ(finished.exit_code, 0) << finished.errors;
    // On a slow machine it says once a minute how far it is.
    const std::string progress = "[0-9-]+ [0-9:.]+ [^\n]*: [^\n]* (left|of [0-9]+)[^\n]*\n";
    EXPECT_THAT(finished.errors, testing::MatchesRegex("(" + progress + ")*"));
    for (const char character : finished.output) {
      const bool is_text = character == '\n' || (character >= ' ' && character <= '~');
      EXPECT_TRUE(is_text) << "control character " << int(character);
    }
    expect_known_files(command, folder);
    return finished;
  }

  /// These names and those of the files of a closer look at a design.
  static std::vector<std::string> with_closer_look(std::vector<std::string> names) {
    names.emplace_back("loops.csv");
    for (const char* picture :
         {"design", "loops", "typical-images", "typical-phases", "worst-images", "worst-phases"}) {
      for (const char* kind : {".png", ".svg"}) names.push_back(std::string(picture) + kind);
    }
    for (const char* cube : {"typical-images", "typical-phases", "worst-images", "worst-phases"}) {
      names.push_back(std::string(cube) + ".fits");
    }
    return names;
  }

  static nlohmann::json summary(const std::string& folder) {
    return nlohmann::json::parse(contents(folder + "/summary.json"));
  }

  /// The summary without what a clock measured.
  static nlohmann::json repeatable_summary(const std::string& folder) {
    nlohmann::json json = summary(folder);
    erase_times(json);
    return json;
  }

  /// What a run of the command may leave.
  static void expect_known_files(const std::string& command, const std::string& folder) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      const std::string name = entry.path().filename().string();
      if (entry.is_directory()) continue;
      EXPECT_TRUE(is_named(name, common_files()) || is_named(name, command_of(command).files))
          << name << " is not known as a file of " << command;
    }
  }

 private:
  static std::string quoted(const std::string& word) {
    std::string text = "'";
    for (const char character : word) {
      text += character == '\'' ? "'\\''" : std::string(1, character);
    }
    return text + "'";
  }

  static void erase_times(nlohmann::json& json) {
    if (json.is_object()) {
      for (const char* name : {"seconds", "wall_seconds", "search_seconds", "timing"})
        json.erase(name);
    }
    for (auto& element : json) {
      if (element.is_structured()) erase_times(element);
    }
  }
};

}  // namespace nlcwfs
