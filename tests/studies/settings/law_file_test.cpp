// Tests: Scaling laws are read from files, and written.
#include "studies/settings/law_file.hpp"

#include "tests/message_of.hpp"
#include "tests/scratch_folder.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using Json = nlohmann::ordered_json;

/// A file without lines: four designs that follow power laws.
Json file_of_data() {
  Json data = Json::array();
  for (const double d_over_r0 : {3.0, 4.0, 6.0, 8.0}) {
    Json& row = data.emplace_back(Json{{"d_over_r0", d_over_r0}});
    for (const ScalingQuantity& quantity : scaling_quantities()) {
      row[std::string(quantity.name)] = {{"mean", 0.5 * d_over_r0},
                                         {"standard_error", 0.02 * d_over_r0}};
    }
  }
  return {{"conditions", {{"detector.pupil_pixels", "32"}}},
          {"data", data},
          {"law", {{"order", {3, 4, 1, 2}}}}};
}

LawFile parse(const Json& json) { return parse_law_file(json.dump(), "law.json"); }

TEST(LawFile, WithoutLinesIsFittedToItsData) {
  const LawFile file = parse(file_of_data());
  EXPECT_EQ(file.data.size(), 4u);
  EXPECT_EQ(file.data[1].fractional_loops.mean, 2.0);
  EXPECT_EQ(file.data[1].fractional_loops.standard_error, 0.08);
  EXPECT_EQ(file.conditions.integer("detector.pupil_pixels"), 32);
  EXPECT_THAT(file.law.order, ElementsAre(3, 4, 1, 2));
  EXPECT_NEAR(file.law.residual_wfe.slope, 1.0, 1e-7);
  EXPECT_NEAR(file.law.residual_wfe.predict(5.0).mean, 2.5, 1e-7);
}

TEST(LawFile, ComesBackAsItWasWritten) {
  LawFile file = parse(file_of_data());
  file.law.z_near_talbot.scatter = 0.1;  // so that the lines are not those of the data
  file.law.greatest_d_over_r0 = 7.0;
  const Json written = to_json(file);
  const LawFile read = parse(written);
  EXPECT_EQ(to_json(read), written);
  EXPECT_EQ(read.law.z_near_talbot.scatter, 0.1);
  EXPECT_EQ(read.law.greatest_d_over_r0, 7.0);
  EXPECT_EQ(read.conditions, file.conditions);
}

TEST(LawFile, TheBuiltInLawIsTheFitOfItsData) {
  Json json = Json::parse(built_in_law_text());
  const LawFile built_in = parse(json);
  json["law"] = {{"order", built_in.law.order}};
  const ScalingLaw fitted = parse(json).law;
  EXPECT_EQ(built_in.law.least_d_over_r0, fitted.least_d_over_r0);
  EXPECT_EQ(built_in.law.greatest_d_over_r0, fitted.greatest_d_over_r0);
  for (const ScalingQuantity& quantity : scaling_quantities()) {
    const LawLine& line = built_in.law.*quantity.line;
    const LawLine& expected = fitted.*quantity.line;
    EXPECT_NEAR(line.intercept, expected.intercept, 1e-6) << quantity.name;
    EXPECT_NEAR(line.slope, expected.slope, 1e-6) << quantity.name;
    EXPECT_NEAR(line.scatter, expected.scatter, 1e-6) << quantity.name;
    EXPECT_TRUE(line.covariance.isApprox(expected.covariance, 1e-6)) << quantity.name;
  }
}

/// The message that refuses the complete file after a member of it was replaced, or erased where
/// the new value is null.
std::string refusal_of(const std::string& pointer, const Json& value) {
  Json json = to_json(parse(file_of_data()));
  const Json::json_pointer member(pointer);
  if (value.is_null()) {
    json[member.parent_pointer()].erase(member.back());
  } else {
    json[member] = value;
  }
  return message_of([&] { parse(json); });
}

TEST(LawFile, IsRefusedWithTheNameOfTheField) {
  const auto expect_refused = [](const std::string& pointer, const Json& value,
                                 const std::string& field_and_value, const std::string& allowed) {
    EXPECT_THAT(refusal_of(pointer, value),
                AllOf(StartsWith("advise.law = law.json: " + field_and_value + ": "),
                      HasSubstr(allowed), Not(HasSubstr("\n"))));
  };
  const Json nothing = nullptr;
  for (const std::string member : {"conditions", "data", "law"}) {
    expect_refused("/" + member, nothing, member + " = (nothing)", "is missing");
    expect_refused("/" + member, 3, member + " = 3", "");
  }
  expect_refused("/lines", 3, "lines = 3", "unknown; an object with conditions, data, law");
  expect_refused("/conditions/detector.pixels", "3", "detector.pixels = 3", "unknown key");
  expect_refused("/conditions/screens.count", 16, "conditions.screens.count = 16", "in quotes");
  expect_refused("/conditions/screens.count", "none", "screens.count = none", "a whole number");

  expect_refused("/data", Json::array(), "data = 0 designs", "at least 4");
  expect_refused("/data/1", 4, "data[1] = 4", "an object with d_over_r0, z_near_talbot");
  expect_refused("/data/1/d_over_r0", nothing, "data[1].d_over_r0 = (nothing)", "is missing");
  expect_refused("/data/1/d_over_r0", "4", "data[1].d_over_r0 = \"4\"", "a number");
  expect_refused("/data/1/d_over_r0", -4, "data[1].d_over_r0 = -4", "above 0");
  expect_refused("/data/1/r0", 0.1, "data[1].r0 = 0.1", "unknown");
  expect_refused("/data/1/z_near_talbot", 0.5, "data[1].z_near_talbot = 0.5", "mean, standard");
  expect_refused("/data/1/z_near_talbot/mean", 0, "data[1].z_near_talbot.mean = 0", "above 0");
  expect_refused("/data/1/fractional_loops/standard_error", 0,
                 "data[1].fractional_loops.standard_error = 0", "of the mean");

  expect_refused("/law/order", nothing, "law.order = (nothing)", "is missing");
  expect_refused("/law/order", {1, 2, 3, 3}, "order = 1,2,3,3", "each of 1 (-near)");
  expect_refused("/law/order", {1, 2, 3, 4.5}, "law.order[3] = 4.5", "a whole number");
  expect_refused("/law/order", {1, 2, 3, 4000000000}, "law.order[3] = 4000000000",
                 "a whole number");
  expect_refused("/law/least_d_over_r0", 0, "law.least_d_over_r0 = 0", "above 0");
  expect_refused("/law/greatest_d_over_r0", 2, "law.greatest_d_over_r0 = 2", "above least");
  expect_refused("/law/greatest_d_over_r0", nothing, "law.greatest_d_over_r0 = (nothing)", "");
  expect_refused("/law/residual_wfe_wavelengths", nothing,
                 "law.residual_wfe_wavelengths = (nothing)", "is missing");
  expect_refused("/law/z_near_talbot/slope", nothing, "law.z_near_talbot.slope = (nothing)", "");
  expect_refused("/law/z_near_talbot/scatter", -0.1, "law.z_near_talbot.scatter = -0.1", "least 0");
  expect_refused("/law/z_near_talbot/covariance", {1.0, 1.0},
                 "law.z_near_talbot.covariance[0] = 1.0", "a list of 2");
  for (const Json& wrong : {Json{{1.0, 0.5}, {0.4, 1.0}}, Json{{1.0, 2.0}, {2.0, 1.0}},
                            Json{{-1.0, 0.0}, {0.0, 1.0}}}) {
    expect_refused("/law/z_near_talbot/covariance", wrong,
                   "law.z_near_talbot.covariance = " + wrong.dump(), "b^2 at most a c");
  }
  EXPECT_THAT(refusal_of("/law/fractional_loops/intercept", 1e3),
              AllOf(StartsWith("advise.law = law.json: law.fractional_loops = "),
                    HasSubstr("its value at D/r0 = 3 is inf")));
}

TEST(LawFile, IsRefusedWhereItIsNone) {
  for (const std::string text :
       {"", "{", "nan", "[]", R"({"command": "law"})", R"({"data": 1e999})", "\x01\n\xFF"}) {
    EXPECT_THAT(
        message_of([&] { parse_law_file(text, "my\nlaw"); }),
        AllOf(StartsWith("advise.law = my?law: is no law file; give "), Not(HasSubstr("\n"))))
        << text;
  }
}

using LawFileOnDisk = ScratchFolder;

TEST_F(LawFileOnDisk, IsReadOrRefused) {
  std::ofstream("law.json") << file_of_data();
  EXPECT_EQ(read_law_file("law.json").data.size(), 4u);
  EXPECT_THAT(message_of([] { read_law_file("missing.json"); }),
              StartsWith("advise.law = missing.json: cannot be read (No such file"));
  EXPECT_THAT(message_of([] { read_law_file("."); }), StartsWith("advise.law = .: a directory"));
}

}  // namespace
}  // namespace nlcwfs
