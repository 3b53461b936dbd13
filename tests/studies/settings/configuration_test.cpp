// Tests: Values of keys, layer upon layer: defaults, preset, files, command line.
#include "studies/settings/configuration.hpp"

#include "optimizer/nlopt_backend.hpp"
#include "tests/message_of.hpp"
#include "tests/scratch_folder.hpp"

#include <algorithm>
#include <fstream>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::Optional;
using testing::Pair;
using testing::StartsWith;

constexpr std::string_view here = "on the command line";

using ConfigurationTest = ScratchFolder;

Configuration read(std::string_view contents) {
  std::ofstream("my.cfg", std::ios::binary) << contents;
  Configuration configuration;
  configuration.read_file("my.cfg");
  return configuration;
}

std::string set_message(std::string_view key, std::string_view value) {
  return message_of([&] { Configuration().set(key, value, here); });
}

std::string file_message(std::string_view contents) {
  return message_of([&] { read(contents); });
}

TEST(ConfigurationKeys, AreUniqueDocumentedAndGroupedBySection) {
  std::set<std::string> names;
  std::vector<std::string> sections;
  for (const ConfigurationKey& key : configuration_keys()) {
    EXPECT_TRUE(names.insert(key.name).second) << key.name;
    EXPECT_EQ(std::ranges::count(key.name, '.'), 1) << key.name;
    EXPECT_THAT(key.description, AllOf(EndsWith("."), Not(HasSubstr("\n")))) << key.name;
    const std::string section = key.name.substr(0, key.name.find('.'));
    if (sections.empty() || sections.back() != section) sections.push_back(section);
  }
  EXPECT_EQ(std::set(sections.begin(), sections.end()).size(), sections.size());
}

TEST(ConfigurationKeys, NameEveryOptimizer) {
  const auto& keys = configuration_keys();
  const auto key = std::find_if(keys.begin(), keys.end(),
                                [](const auto& each) { return each.name == "search.optimizer"; });
  ASSERT_NE(key, keys.end());
  for (const std::string_view algorithm : nlopt_algorithms()) {
    EXPECT_THAT(key->description, testing::ContainsRegex(std::string(algorithm) + "[,;.]"));
  }
}

TEST(ConfigurationKeys, DefaultsAndPresetsAreAllowedThemselves) {
  for (const ConfigurationKey& key : configuration_keys()) {
    EXPECT_TRUE(key.default_text.empty() || key.accepts(key.default_text)) << key.name;
  }
  for (const Preset& preset : presets()) {
    EXPECT_EQ(message_of([&] { Configuration().apply_preset(preset.name); }), "");
  }
}

TEST(ConfigurationKeys, ExamplesAreAllowedThemselves) {
  for (const ConfigurationKey& key : configuration_keys()) {
    if (key.example.empty()) continue;
    const auto either = key.example.find(" or ");
    EXPECT_TRUE(key.accepts(key.example.substr(0, either))) << key.name;
    if (either != std::string::npos) {
      EXPECT_TRUE(key.accepts(key.example.substr(either + 4))) << key.name;
    }
  }
}

TEST_F(ConfigurationTest, StartsFromTheDefaultsInSi) {
  const Configuration configuration;
  EXPECT_EQ(configuration.length("telescope.diameter"), 0.5);
  EXPECT_EQ(configuration.length("telescope.wavelength"), 532e-9);
  EXPECT_EQ(configuration.optional_length("telescope.relay_beam_diameter"), std::nullopt);
  EXPECT_EQ(configuration.numbers("seeing.d_over_r0"), std::vector{4.0});
  EXPECT_EQ(configuration.integer("screens.count"), 16);
  EXPECT_EQ(configuration.seed("verify.seed"), 1000003u);
  EXPECT_THAT(configuration.lengths("sensor.planes"), ElementsAre(-180e3, 180e3, -47e3, 47e3));
  EXPECT_EQ(configuration.length("reconstruction.tolerance"), 1e-9);
  EXPECT_EQ(configuration.choice("reconstruction.stopping"), "difference");
  EXPECT_THAT(configuration.ramp("reconstruction.relaxation"), Pair(0.0, 0.0));
  EXPECT_FALSE(configuration.domain("search.z_near"));
  EXPECT_THAT(configuration.orders("search.order"), testing::IsEmpty());
  EXPECT_EQ(configuration.optional_time("search.time_limit"), std::nullopt);
  EXPECT_EQ(configuration.text("search.optimizer"), "auto");
  EXPECT_FALSE(configuration.is_set("screens.file"));
  for (const ConfigurationKey& key : configuration_keys()) {
    EXPECT_EQ(configuration.source(key.name), "by default") << key.name;
  }
}

TEST_F(ConfigurationTest, ReturnsWhatWasSetAndWhoSetIt) {
  Configuration configuration;
  configuration.set("telescope.relay_beam_diameter", " 10mm ", here);
  configuration.set("screens.seed", "18446744073709551615", here);
  configuration.set("reconstruction.relaxation", "0.5:-0.5", here);
  configuration.set("search.z1", "-200km:-5km", here);
  configuration.set("search.time_limit", "5min", here);
  EXPECT_THAT(configuration.optional_length("telescope.relay_beam_diameter"), Optional(0.01));
  EXPECT_EQ(configuration.value_text("telescope.relay_beam_diameter"), "10mm");
  EXPECT_EQ(configuration.seed("screens.seed"), 18446744073709551615u);
  EXPECT_THAT(configuration.ramp("reconstruction.relaxation"), Pair(0.5, -0.5));
  EXPECT_EQ(std::get<ValueRange>(configuration.domain("search.z1").value()).lower, -200e3);
  EXPECT_THAT(configuration.optional_time("search.time_limit"), Optional(300.0));
  EXPECT_EQ(configuration.source("search.z1"), here);
}

TEST_F(ConfigurationTest, SaysWhatIsAllowedInOneLine) {
  EXPECT_EQ(set_message("telescope.diameter", "-1"),
            "telescope.diameter = -1: a length from 0.0001 m to 1000 m in nm, um, mm, cm, m or "
            "km, such as 0.5m (on "
            "the command line)");
  EXPECT_EQ(set_message("reconstruction.stopping", "never"),
            "reconstruction.stopping = never: one of difference, rms_change (on the command line)");
  EXPECT_EQ(
      set_message("seeing.fwhm", "0.8m"),
      "seeing.fwhm = 0.8m: a number above 0 in arcsec, or several separated by commas, such as "
      "0.8 (on the command line)");
  EXPECT_EQ(set_message("screens.count", "1e2"),
            "screens.count = 1e2: a whole number from 1 to 1000000 (on the command line)");
  EXPECT_EQ(
      set_message("search.z_near", "5km:"),
      "search.z_near = 5km:: min:max or min:max:log, or a list separated by commas, of lengths "
      "in nm, um, mm, cm, m or km above 0, such as 5km:100km (on the command line)");
  EXPECT_EQ(set_message("sensor.planes", "47km,,3km"),
            "sensor.planes = 47km,,3km: lengths in nm, um, mm, cm, m or km, separated by commas, "
            "such as -180km,180km,-47km,47km (on the command line)");
  EXPECT_EQ(set_message("search.time_limit", "1d"),
            "search.time_limit = 1d: a time above 0 in us, ms, s, min or h, such as 90s or 30min "
            "(on the command line)");
  EXPECT_THAT(set_message("baseline.planes", "-60km,\n60km"),
              StartsWith("baseline.planes = -60km,?60km: lengths"));
  EXPECT_EQ(set_message("screens.file", "a\nb"),
            "screens.file = a?b: a path without #, such as screens.fits (on the command "
            "line)");
}

TEST_F(ConfigurationTest, RefusesWhatLiesOutsideTheBounds) {
  const std::vector<std::pair<std::string, std::string>> refused{
      {"telescope.diameter", "0"},
      {"telescope.diameter", "nan"},
      {"telescope.diameter", "1e400"},
      {"telescope.central_obscuration", "1"},
      {"telescope.central_obscuration", "-0.1"},
      {"seeing.d_over_r0", "0"},
      {"seeing.d_over_r0", "inf"},
      {"seeing.d_over_r0", "4,0"},
      {"seeing.d_over_r0", "4,"},
      {"seeing.fried_parameter", "10cm,-1cm"},
      {"screens.count", "0"},
      {"screens.count", "99999999999"},
      {"screens.seed", "-1"},
      {"screens.seed", "18446744073709551616"},
      {"detector.photons", "-1"},
      {"reconstruction.relaxation", "1"},
      {"reconstruction.relaxation", "-1"},
      {"reconstruction.relaxation", "0:1"},
      {"reconstruction.tolerance", "-1nm"},
      {"search.plane_count", "1"},
      {"search.plane_count", "7"},
      {"search.z_near", "-5km:5km"},
      {"search.z_far", "0:5km"},
      {"search.z1", "5km:-5km"},
      {"screens.file", "a # b"},
      {"screens.file", "a\tb"}};
  for (const auto& [key, value] : refused) {
    EXPECT_THAT(set_message(key, value), StartsWith(key + " = ")) << value;
  }
  for (const ConfigurationKey& key : configuration_keys()) {
    EXPECT_THAT(set_message(key.name, " "), StartsWith(key.name + " = (nothing): "));
    EXPECT_THAT(set_message(key.name, "a\x01 # b"), Not(HasSubstr("\x01"))) << key.name;
    EXPECT_NE(set_message(key.name, "a\x01 # b"), "") << key.name;
  }
}

TEST_F(ConfigurationTest, AcceptsTheBoundsThemselvesWhereTheyAreIncluded) {
  for (const auto& [key, value] : std::vector<std::pair<std::string, std::string>>{
           {"telescope.central_obscuration", "0"},
           {"telescope.central_obscuration", "0.999"},
           {"reconstruction.relaxation", "-0.999:0.999"},
           {"search.plane_count", "2"},
           {"search.plane_count", "6"},
           {"screens.seed", "0"},
           {"sensor.planes", "0"}}) {
    EXPECT_EQ(set_message(key, value), "");
  }
}

TEST_F(ConfigurationTest, SuggestsTheNearestOfTheKnownKeys) {
  EXPECT_EQ(file_message("[telescope]\ndiametr = 1\n").substr(0, 36),
            "telescope.diametr = 1: unknown key i");
  EXPECT_THAT(file_message("[telescope]\ndiametr = 1\n"),
              EndsWith("my.cfg, line 2; did you mean telescope.diameter?"));
  EXPECT_THAT(file_message("diameter = 1\n"), EndsWith("did you mean telescope.diameter?"));
  EXPECT_THAT(file_message("= 1\n"), StartsWith("(nothing) = 1: unknown key"));
}

TEST_F(ConfigurationTest, PaperPresetIsThePapersSetUp) {
  Configuration configuration;
  configuration.apply_preset("paper");
  EXPECT_EQ(configuration.choice("simulation.truth"), "matched");
  EXPECT_EQ(configuration.number("reconstruction.window"), 4.0);
  EXPECT_EQ(configuration.choice("reconstruction.stopping"), "rms_change");
  EXPECT_THAT(configuration.lengths("sensor.planes"), ElementsAre(-47e3, 47e3, -180e3, 180e3));
  EXPECT_EQ(configuration.source("sensor.planes"), "by --preset paper");
  EXPECT_EQ(configuration.length("telescope.diameter"), 0.5);
  EXPECT_EQ(configuration.length("telescope.wavelength"), 532e-9);
  EXPECT_EQ(configuration.numbers("seeing.d_over_r0"), std::vector{4.0});
  EXPECT_EQ(configuration.integer("detector.pupil_pixels"), 64);
  EXPECT_EQ(configuration.integer("screens.count"), 16);
  EXPECT_EQ(configuration.length("reconstruction.tolerance"), 1e-9);
  EXPECT_EQ(configuration.integer("reconstruction.max_loops"), 20);
}

TEST_F(ConfigurationTest, AnUnknownPresetIsAnsweredWithTheKnownOnes) {
  EXPECT_EQ(message_of([] { Configuration().apply_preset("papre"); }),
            "--preset = papre: the only one is paper");
}

TEST_F(ConfigurationTest, OneMeasureOfTheSeeingReplacesTheDefault) {
  const Configuration configuration = read("[seeing]\nfwhm = 0.8\n");
  EXPECT_EQ(configuration.numbers("seeing.fwhm"), std::vector{0.8});
  EXPECT_FALSE(configuration.is_set("seeing.d_over_r0"));
  EXPECT_THAT(configuration.dump(), HasSubstr("\n# d_over_r0 =\n"));
  EXPECT_THAT(Configuration().dump(), HasSubstr("\nd_over_r0 = 4\n"));
}

TEST_F(ConfigurationTest, TwoMeasuresOfTheSeeingAreRefusedAndBothNamed) {
  Configuration configuration;
  configuration.set("seeing.d_over_r0", "4", here);
  const std::string message = message_of([&] { configuration.set("seeing.fwhm", "0.8", here); });
  EXPECT_EQ(message,
            "seeing.fwhm = 0.8: set only one of seeing.d_over_r0, seeing.fried_parameter, "
            "seeing.fwhm (seeing.d_over_r0 is set to 4 on the command line)");
  EXPECT_THAT(file_message("[seeing]\nfwhm = 0.8\nfried_parameter = 12cm\n"),
              StartsWith("seeing.fried_parameter = 12cm: set only one of"));
}

TEST_F(ConfigurationTest, ALaterLayersMeasureOfTheSeeingReplacesAnEarlierOnes) {
  Configuration configuration = read("[seeing]\nd_over_r0 = 6\n");
  configuration.set("seeing.fwhm", "0.8", here);
  EXPECT_EQ(configuration.numbers("seeing.fwhm"), std::vector{0.8});
  EXPECT_FALSE(configuration.is_set("seeing.d_over_r0"));
}

TEST_F(ConfigurationTest, TheSameMeasureOfTheSeeingMayBeSetAgain) {
  Configuration configuration = read("[seeing]\nfwhm = 0.8\n");
  configuration.set("seeing.fwhm", "1.2", here);
  EXPECT_EQ(configuration.numbers("seeing.fwhm"), std::vector{1.2});
}

TEST_F(ConfigurationTest, ReadsSectionsDottedNamesCommentsAndForeignLineEnds) {
  const Configuration configuration = read(
      "\xEF\xBB\xBF# comment\r\n"
      "telescope.wavelength = 850nm\r\n"
      "\r\n"
      "  [telescope]  # comment\r\n"
      "diameter=8.2 m # comment\r\n"
      "[screens]\n"
      "file = /data/my = [best] screens.fits");
  EXPECT_EQ(configuration.length("telescope.wavelength"), 850e-9);
  EXPECT_EQ(configuration.length("telescope.diameter"), 8.2);
  EXPECT_EQ(configuration.text("screens.file"), "/data/my = [best] screens.fits");
  EXPECT_THAT(configuration.source("telescope.diameter"), EndsWith("my.cfg, line 5"));
}

TEST_F(ConfigurationTest, NamesFileAndLineOfWhatItCannotRead) {
  for (const char* line : {"diameter 0.5", "[telescope", "telescope]", "[telescope] 0.5", "\t!"}) {
    const std::string message = file_message(std::string("[screens]\ncount = 3\n") + line + "\n");
    EXPECT_THAT(message, AllOf(StartsWith("--config = "), HasSubstr("my.cfg: line 3, '"),
                               EndsWith("must be [section], key = value or # comment")));
  }
  EXPECT_THAT(file_message("[screens]\n\ncount = many\n"),
              AllOf(StartsWith("screens.count = many: a whole number from 1 to 1000000 (in "),
                    EndsWith("my.cfg, line 3)")));
  EXPECT_THAT(file_message("[screens]\ncount =\n"), StartsWith("screens.count = (nothing): "));
}

TEST_F(ConfigurationTest, RefusesAKeyTwiceInOneFile) {
  EXPECT_THAT(file_message("[screens]\ncount = 3\n\n[telescope]\n[screens]\ncount = 4\n"),
              AllOf(StartsWith("screens.count = 4: set twice in "),
                    EndsWith("my.cfg, lines 2 and 6; keep one of them")));
}

TEST_F(ConfigurationTest, NamesTheFileThatItCannotOpen) {
  EXPECT_EQ(message_of([] { Configuration().read_file("/no/such.cfg"); }),
            "--config = /no/such.cfg: cannot be read (No such file or directory); give the path of "
            "a configuration file");
  EXPECT_EQ(message_of([] { Configuration().read_file("/"); }),
            "--config = /: a directory; give the path of a configuration file");
}

TEST_F(ConfigurationTest, SaysOfAFileThatIsNoTextThatItIsNone) {
  EXPECT_THAT(file_message("[screens]\nSIMPLE \x01\x02\x7f"),
              EndsWith("my.cfg: line 2 is no text; give the path of a configuration file"));
}

TEST_F(ConfigurationTest, AMessageStaysOneLineWhateverTheFileHolds) {
  const std::string message = file_message("\t" + std::string(100000, 'x') + "= \r 5");
  EXPECT_THAT(message, AllOf(HasSubstr("unknown key"), Not(HasSubstr("\r"))));
  EXPECT_LT(message.size(), 1000u);
}

TEST_F(ConfigurationTest, ADumpReadsBackEqual) {
  Configuration paper;
  paper.apply_preset("paper");
  Configuration changed;
  changed.set("seeing.fried_parameter", "12.5 cm", here);
  changed.set("screens.file", "/data/my = [best] screens; 2.fits", here);
  changed.set("sensor.planes", "-47km , 47km", here);
  changed.set("search.z1", "-200km:-5km", here);
  changed.set("search.time_limit", "90", here);
  for (const Configuration& configuration : {Configuration(), paper, changed}) {
    const Configuration again = read(configuration.dump());
    EXPECT_EQ(again, configuration);
    EXPECT_EQ(again.dump(), configuration.dump());
  }
  EXPECT_NE(paper, Configuration());
  EXPECT_NE(changed, Configuration());
}

TEST_F(ConfigurationTest, ADumpDocumentsEveryKey) {
  const std::string dump = Configuration().dump();
  for (const ConfigurationKey& key : configuration_keys()) {
    EXPECT_THAT(dump, HasSubstr("# " + key.description + "\n"));
    EXPECT_THAT(dump, HasSubstr("\n[" + key.name.substr(0, key.name.find('.')) + "]\n"));
    EXPECT_THAT(dump, HasSubstr(key.name.substr(key.name.find('.') + 1) + " ="));
  }
  EXPECT_THAT(
      dump,
      HasSubstr("# Unit: m. Allowed: a length from 1e-09 m to 0.001 m in nm, um, mm, cm, m or km, "
                "such as 532nm. Default: 532nm.\nwavelength = 532nm\n"));
}

}  // namespace
}  // namespace nlcwfs
