// Tests: Lists of metrics with weights and bounds are read.
#include "studies/settings/metric_text.hpp"

#include "tests/message_of.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

TEST(MetricText, AnEmptyTextIsAnEmptyList) {
  EXPECT_TRUE(parse_terms("key", "").empty());
  EXPECT_TRUE(parse_penalties("key", " ").empty());
  EXPECT_TRUE(parse_limits("key", "").empty());
}

TEST(MetricText, ReadsTerms) {
  const auto terms = parse_terms("key", "latency_seconds:1e3, loops : -0.5");
  ASSERT_EQ(terms.size(), 2u);
  EXPECT_EQ(terms[0].metric.name, "latency_seconds");
  EXPECT_EQ(terms[0].weight, 1e3);
  EXPECT_EQ(terms[1].metric.name, "loops");
  EXPECT_EQ(terms[1].weight, -0.5);
}

TEST(MetricText, APenaltyNamesTheSideThatCosts) {
  const auto penalties = parse_penalties("key", "total_wfe_nm>30:0.1,captured_energy<0.9:10");
  ASSERT_EQ(penalties.size(), 2u);
  EXPECT_EQ(penalties[0].penalised.metric.name, "total_wfe_nm");
  EXPECT_EQ(penalties[0].penalised.excess(35.0), 5.0);
  EXPECT_EQ(penalties[0].penalised.excess(25.0), 0.0);
  EXPECT_EQ(penalties[0].weight, 0.1);
  EXPECT_EQ(penalties[1].penalised.excess(0.4), 0.5);
  EXPECT_EQ(penalties[1].penalised.excess(0.95), 0.0);
  EXPECT_EQ(penalties[1].weight, 10.0);
}

TEST(MetricText, ALimitNamesWhatMustHold) {
  const auto limits = parse_limits("key", "loops<8,field_strehl > 0.5");
  ASSERT_EQ(limits.size(), 2u);
  EXPECT_EQ(limits[0].metric.name, "loops");
  EXPECT_EQ(limits[0].excess(7.0), 0.0);
  EXPECT_EQ(limits[0].excess(8.0), 0.0);
  EXPECT_EQ(limits[0].excess(9.0), 1.0);
  EXPECT_EQ(limits[1].excess(0.25), 0.25);
  EXPECT_EQ(limits[1].excess(0.75), 0.0);
}

TEST(MetricText, AnUnknownMetricIsRefusedWithTheNearestAndAllThereAre) {
  const std::string message =
      message_of([] { (void)parse_limits("objective.limits", "loops<8,latncy_seconds<1e-3"); });
  EXPECT_THAT(message,
              AllOf(StartsWith("objective.limits = latncy_seconds<1e-3: there is no metric "
                               "latncy_seconds; did you mean latency_seconds? There are "),
                    HasSubstr("residual_wfe_nm, "), HasSubstr("error_budget_nm")));
}

TEST(MetricText, WhatIsNoEntryIsRefusedWithItsForm) {
  for (const char* text : {"loops", "loops:", "loops:x", "loops:1,", ",loops:1", "loops:1:2"}) {
    EXPECT_THAT(message_of([&] { (void)parse_terms("objective.terms", text); }),
                AllOf(StartsWith("objective.terms = "),
                      HasSubstr(": entries must be METRIC:WEIGHT, such as plane_count:0.05")))
        << text;
  }
  for (const char* text :
       {"loops>3", "loops:3", "loops>x:1", "loops>3:nan", "loops>3:-1", ">3:1"}) {
    EXPECT_THAT(message_of([&] { (void)parse_penalties("objective.penalties", text); }),
                StartsWith("objective.penalties = "))
        << text;
  }
  for (const char* text : {"loops", "loops:3", "loops<", "loops<3:1", "loops<<3", "loops<=3"}) {
    EXPECT_THAT(message_of([&] { (void)parse_limits("objective.limits", text); }),
                AllOf(StartsWith("objective.limits = "),
                      HasSubstr(": entries must be METRIC<BOUND or METRIC>BOUND, such as ")))
        << text;
  }
}

TEST(MetricText, ReadsMetricsEachOnce) {
  const auto metrics = parse_metrics("key", " loops,plane_count ");
  ASSERT_EQ(metrics.size(), 2u);
  EXPECT_EQ(metrics[0].name, "loops");
  EXPECT_EQ(metrics[1].name, "plane_count");
  EXPECT_THAT(message_of([] { (void)parse_metrics("key", "loops,plane_count,loops"); }),
              AllOf(StartsWith("key = loops,plane_count,loops: "), HasSubstr("loops is twice")));
  EXPECT_THAT(message_of([] { (void)parse_metrics("key", "loops,plane"); }),
              HasSubstr("did you mean plane_count?"));
  EXPECT_THAT(message_of([] { (void)parse_metrics("key", "loops,"); }), StartsWith("key = "));
}

}  // namespace
}  // namespace nlcwfs
