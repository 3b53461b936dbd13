// Tests: Numbers, lengths, times, ranges and lists are read.
#include "studies/settings/units.hpp"

#include "results/text/quantity_text.hpp"

#include <cmath>
#include <limits>
#include <locale>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

using testing::ElementsAre;
using testing::Optional;
using testing::Pair;

TEST(Units, ALengthWithAUnitIsTheSameDoubleAsItsSiLiteral) {
  EXPECT_EQ(parse_length("0.5"), 0.5);
  EXPECT_EQ(parse_length("0.5m"), 0.5);
  EXPECT_EQ(parse_length("532nm"), 532e-9);
  EXPECT_EQ(parse_length("1.55um"), 1.55e-6);
  EXPECT_EQ(parse_length("10mm"), 10e-3);
  EXPECT_EQ(parse_length("12.5cm"), 12.5e-2);
  EXPECT_EQ(parse_length("47km"), 47e3);
  EXPECT_EQ(parse_length("-180km"), -180e3);
  EXPECT_EQ(parse_length("+180km"), 180e3);
  EXPECT_EQ(parse_length("5e-7m"), 5e-7);
  EXPECT_EQ(parse_length(" 47 km "), 47e3);
}

TEST(Units, ALengthIsReadAsAWholeOrNotAtAll) {
  for (const char* text : {"", " ", "km", "47 parsec", "47kmh", "47km 3", "4 7km", "0x10", "1,5m",
                           "47KM", "--47km", "+-47km", "-+47km", "++1", "+", "-", "1e", "47k"}) {
    EXPECT_EQ(parse_length(text), std::nullopt) << text;
  }
}

TEST(Units, OnlyFiniteNumbersPass) {
  for (const char* text : {"nan", "inf", "-inf", "infinity", "NaN", "1e400", "-1e400", "nan(1)"}) {
    EXPECT_EQ(parse_number(text), std::nullopt) << text;
    EXPECT_EQ(parse_length(text), std::nullopt) << text;
    EXPECT_EQ(parse_time(text), std::nullopt) << text;
  }
  EXPECT_EQ(parse_length("1e308"), 1e308);
  EXPECT_EQ(parse_length("1e308km"), std::nullopt);
}

TEST(Units, NumbersIgnoreTheLocale) {
  struct DecimalComma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
  };
  const std::locale before = std::locale::global(std::locale(std::locale(), new DecimalComma));
  EXPECT_EQ(parse_number("0.5"), 0.5);
  EXPECT_EQ(parse_number("0,5"), std::nullopt);
  EXPECT_EQ(format_length(0.0125), "12.5 mm");
  std::locale::global(before);
}

TEST(Units, TimesHaveTheirUnits) {
  EXPECT_EQ(parse_time("90"), 90.0);
  EXPECT_EQ(parse_time("90s"), 90.0);
  EXPECT_EQ(parse_time("250ms"), 0.25);
  EXPECT_EQ(parse_time("250us"), 250e-6);
  EXPECT_EQ(parse_time("5min"), 300.0);
  EXPECT_EQ(parse_time("1.5h"), 5400.0);
  EXPECT_EQ(parse_time("5m"), std::nullopt);
  EXPECT_EQ(parse_time("1d"), std::nullopt);
}

TEST(Units, WholeNumbersAreExactAndStayInRange) {
  EXPECT_EQ(parse_integer("16"), 16);
  EXPECT_EQ(parse_integer("-3"), -3);
  EXPECT_EQ(parse_integer("2147483647"), 2147483647);
  for (const char* text : {"", "1.0", "1e3", "0x10", "16 screens", "2147483648", "-2147483649"}) {
    EXPECT_EQ(parse_integer(text), std::nullopt) << text;
  }
  EXPECT_EQ(parse_seed("0"), 0u);
  EXPECT_EQ(parse_seed("18446744073709551615"), std::numeric_limits<std::uint64_t>::max());
  for (const char* text : {"", "-1", "1.5", "18446744073709551616"}) {
    EXPECT_EQ(parse_seed(text), std::nullopt) << text;
  }
}

TEST(Units, ListsAllowSpacesButNoEmptyElement) {
  EXPECT_THAT(parse_lengths("-47km,47km"), Optional(ElementsAre(-47e3, 47e3)));
  EXPECT_THAT(parse_lengths(" -47km , 0.5 "), Optional(ElementsAre(-47e3, 0.5)));
  EXPECT_THAT(parse_lengths("3km"), Optional(ElementsAre(3e3)));
  for (const char* text : {"", ",", "1,", ",1", "1,,2", "1;2", "1 2", "1km,2parsec"}) {
    EXPECT_EQ(parse_lengths(text), std::nullopt) << text;
  }
}

TEST(Units, NumbersAreSeparatedByCommas) {
  EXPECT_THAT(parse_numbers(" 4 , 1e5,-3"), Optional(ElementsAre(4.0, 1e5, -3.0)));
  EXPECT_THAT(parse_numbers("0.5"), Optional(ElementsAre(0.5)));
  for (const char* text : {"", ",", "1,", ",1", "1,,2", "1;2", "1 2", "1,2m", "1,nan"}) {
    EXPECT_EQ(parse_numbers(text), std::nullopt) << text;
  }
}

TEST(ParseDomain, ReadsRangesAndLists) {
  const auto range = [](std::string_view text) {
    return std::get<ValueRange>(parse_domain(text, parse_length).value());
  };
  EXPECT_EQ(range("5km:100km").lower, 5e3);
  EXPECT_EQ(range("-5km : 100").upper, 100.0);
  EXPECT_EQ(range("5km:100km").scale, std::nullopt);
  EXPECT_EQ(range("5km:100km:log").scale, Scale::logarithmic);
  EXPECT_EQ(range("5km:100km: linear").scale, Scale::linear);
  EXPECT_EQ(std::get<std::vector<double>>(parse_domain("5km, -1", parse_length).value()),
            (std::vector{5e3, -1.0}));
  EXPECT_EQ(std::get<std::vector<double>>(parse_domain("7", parse_number).value()),
            (std::vector{7.0}));
  for (const char* text : {"", ":", "5km:", ":5km", "5km:5km", "6km:5km", "1:2:3", "1:2:log:3",
                           "1:2:", "1,,2", "1,2,", "a:b", "1:2,3"}) {
    EXPECT_FALSE(parse_domain(text, parse_length)) << text;
  }
}

TEST(ParseAxis, ReadsPlacesWithBothEnds) {
  const auto linear = parse_axis("5km:11km:4", parse_length).value();
  EXPECT_EQ(linear, (std::vector{5e3, 7e3, 9e3, 11e3}));
  const auto log = parse_axis("1:100:3:log", parse_number).value();
  EXPECT_EQ(log.front(), 1.0);
  EXPECT_NEAR(log[1], 10.0, 1e-12);
  EXPECT_EQ(log.back(), 100.0);
  EXPECT_EQ(parse_axis("-1:1:3", parse_number).value(), (std::vector{-1.0, 0.0, 1.0}));
  EXPECT_EQ(parse_axis("3,1,2", parse_number).value(), (std::vector{3.0, 1.0, 2.0}));
  for (const char* text : {"", "1:2", "1:2:1", "2:1:3", "1:2:x", "1:2:3:exp", "-1:1:3:log",
                           "0:1:3:log", "1:2:3:log:4", "1:2:1000000", "1,,2"}) {
    EXPECT_FALSE(parse_axis(text, parse_number)) << text;
  }
}

TEST(ParseOrders, ReadsOrdersOfNumberedPlanes) {
  EXPECT_EQ(parse_orders(" all "), std::vector<VisitingOrder>{});
  EXPECT_EQ(parse_orders("3412, 12"), (std::vector<VisitingOrder>{{3, 4, 1, 2}, {1, 2}}));
  EXPECT_TRUE(parse_orders("124"));
  EXPECT_TRUE(parse_orders("612345"));
  for (const char* text :
       {"", "1", "11", "13", "1235", "1237", "0123", "3412,", "34 12", "alle", "1234567", "-12"}) {
    EXPECT_FALSE(parse_orders(text)) << text;
  }
}

TEST(Units, BandsAreRangesOfWavelengths) {
  const auto bands = parse_bands("500nm:549nm, 632.8nm");
  ASSERT_TRUE(bands);
  ASSERT_EQ(bands->size(), 2u);
  EXPECT_EQ(bands->front(), (Band{500e-9, 549e-9}));
  EXPECT_EQ(bands->back(), (Band{632.8e-9, 632.8e-9}));
  for (const char* text : {"", "500nm:", ":500nm", "600nm:500nm", "500nm:600nm,", "1:2:3", "a:b"}) {
    EXPECT_EQ(parse_bands(text), std::nullopt) << text;
  }
}

TEST(WithLengths, ReplacesTheLengthsOfDomainsAndAxes) {
  const auto twice = [](std::string_view text) {
    return with_lengths(text, [](double length) { return 2.0 * length; });
  };
  EXPECT_EQ(twice("5km:10"), "10000:20");
  EXPECT_EQ(twice("5km:10km:24:log"), "10000:20000:24:log");
  EXPECT_EQ(twice("5km:10km:linear"), "10000:20000:linear");
  EXPECT_EQ(twice("-5km,10mm"), "-10000,0.02");
}

TEST(Units, ARampIsANumberOrTwo) {
  EXPECT_THAT(parse_ramp("-0.5"), Optional(Pair(-0.5, -0.5)));
  EXPECT_THAT(parse_ramp("0.5:-0.5"), Optional(Pair(0.5, -0.5)));
  for (const char* text : {"", ":", "0.5:", ":0.5", "0:0:0", "half"}) {
    EXPECT_EQ(parse_ramp(text), std::nullopt) << text;
  }
}

TEST(Units, LengthsAreWrittenInTheUnitThatReadsBest) {
  EXPECT_EQ(format_length(47e3), "47 km");
  EXPECT_EQ(format_length(-180e3), "-180 km");
  EXPECT_EQ(format_length(58740.6), "58.74 km");
  EXPECT_EQ(format_length(12345678.0), "12346 km");
  EXPECT_EQ(format_length(0.5), "500 mm");
  EXPECT_EQ(format_length(8.2), "8.2 m");
  EXPECT_EQ(format_length(532e-9), "532 nm");
  EXPECT_EQ(format_length(2e-10), "0.2 nm");
  EXPECT_EQ(format_length(0.0), "0 m");
}

TEST(Units, WhatIsWrittenIsReadBackToFourDigits) {
  // An irrational step meets every unit, both sides of its limits, and many leading digits.
  for (double length = 1e-11; length < 1e12; length *= std::numbers::phi) {
    for (const double signed_length : {length, -length}) {
      const std::string text = format_length(signed_length);
      const auto read = parse_length(text);
      ASSERT_TRUE(read) << text;
      EXPECT_NEAR(*read, signed_length, 5.001e-4 * length) << text;
    }
  }
}

}  // namespace
}  // namespace nlcwfs
