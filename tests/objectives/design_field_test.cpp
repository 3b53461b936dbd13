// Tests: the fields of a design: their names, keys, words, units, and how they are read and set.
#include "objectives/design_field.hpp"

#include "objectives/design_space.hpp"

#include <set>

#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

TEST(DesignField, IsReadAsItWasSet) {
  for (const DesignField& field : design_fields()) {
    SCOPED_TRACE(field.key);
    SensorDesign design;
    for (const double value : {1.0, 0.0}) {
      field.set(design, value);
      EXPECT_EQ(field.get(design), value);
    }
    EXPECT_EQ(field.words.empty(), field.kind != VariableKind::categorical);
  }
}

/// Whatever a sensor has, so that none is left out of summaries, archives and configurations.
TEST(DesignField, TogetherTheyAreAllOfADesign) {
  std::set<std::string> texts{exact_text(SensorDesign())};
  std::size_t fields = 0;
  for (const DesignField& field : design_fields()) {
    if (field.summary.empty()) continue;  // others say it
    SensorDesign design;
    field.set(design, field.get(design) == 1.0 ? 0.0 : 1.0);
    texts.insert(exact_text(design));
    ++fields;
  }
  EXPECT_EQ(texts.size(), fields + 1) << "each changes the design in its own way";
  [[maybe_unused]] const auto& [planes, detector, reconstruction] = SensorDesign();
  [[maybe_unused]] const auto& [d1, d2, d3, d4, d5, d6] = detector;
  [[maybe_unused]] const auto& [r1, r2, r3, r4, r5, r6, r7, r8, r9, r10] = reconstruction;
  EXPECT_EQ(fields, 6U + 10U) << "as many as the structs have, which these bindings count";
}

TEST(DesignField, OfASearchAreKnownByTheirNames) {
  EXPECT_EQ(design_properties().size(), 10U);
  for (const DesignField& property : design_properties()) {
    EXPECT_EQ(find_design_property(property.variable), &property);
  }
  EXPECT_EQ(find_design_property("stopping"), nullptr);
  EXPECT_EQ(find_design_property(""), nullptr);
  EXPECT_EQ(unit_of_variable("tolerance"), "m");
  EXPECT_EQ(unit_of_variable("exposure"), "s");
  EXPECT_EQ(unit_of_variable("pupil_pixels"), "");
  EXPECT_EQ(unit_of_variable("z_near"), "m");
  EXPECT_EQ(unit_of_variable("order"), "");
  EXPECT_EQ(unit_of_variable("plane_count"), "");
}

}  // namespace
}  // namespace nlcwfs
