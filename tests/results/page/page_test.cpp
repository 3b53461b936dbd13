// Tests: A run's data become one HTML page.
#include "results/page/page.hpp"

#include "results/page/page_files.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

using Json = nlohmann::ordered_json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

/// What a browser's script finds in the page.
Json data_in(const std::string& page) {
  const std::string open = R"(<script type="application/json" id="data">)";
  const auto begin = page.find(open) + open.size();
  return Json::parse(page.substr(begin, page.find("</script", begin) - begin));
}

TEST(Page, HoldsEverythingThatItNeeds) {
  const std::string page = page_of("run", {{"command", "evaluate"}});
  for (const PageFile& file : page_files()) {
    if (file.name == "page.html") continue;
    EXPECT_THAT(page, HasSubstr(std::string(file.text))) << file.name;
  }
  EXPECT_THAT(page, HasSubstr("<title>run</title>"));
  EXPECT_THAT(page, Not(HasSubstr("{{title}}")));
  // What the page itself could load, apart from its icon of no bytes.
  EXPECT_EQ(count_of(page.substr(0, page.find("id=\"data\"")), "href="), 1u);
  EXPECT_EQ(count_of(page, "<link"), 1u);
  EXPECT_EQ(count_of(page, "<script src"), 0u);
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
}

TEST(Page, HostileTextsStayTexts) {
  const Json hostile{{"command", "</script><img src=x onerror=alert(1)>"},
                     {"<!--<script>", "{{style}} &lt; \"quoted\" \\ \u2028"},
                     {"list", {"</SCRIPT >", "]]>", "\n"}}};
  const std::string harmless_page = page_of("t", {{"command", "evaluate"}});
  const std::string page = page_of("</title><script>alert(1)</script>&\"", hostile);
  EXPECT_EQ(count_of(page, "<script"), count_of(harmless_page, "<script"));
  EXPECT_EQ(count_of(page, "</script"), count_of(harmless_page, "</script"));
  EXPECT_EQ(count_of(page, "<img"), count_of(harmless_page, "<img"));
  EXPECT_EQ(count_of(page, "<!--"), count_of(harmless_page, "<!--"));
  EXPECT_THAT(page, HasSubstr("<title>&lt;/title&gt;&lt;script&gt;alert(1)&lt;/script&gt;&amp;"));
  EXPECT_EQ(data_in(page), hostile);
}

TEST(Page, TakesTextsThatAreNotUnicode) {
  const Json data = data_in(page_of("t", {{"text", "before\xff\xfe after"}}));
  EXPECT_THAT(data.at("text").get<std::string>(),
              testing::AllOf(testing::StartsWith("before"), testing::EndsWith(" after")));
}

/// The inverse of page_image()'s `values`.
std::vector<float> decoded(const Json& image) {
  const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<unsigned char> bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char character : image.at("values").get<std::string>()) {
    bits = bits << 6 | static_cast<std::uint32_t>(alphabet.find(character));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<unsigned char>(bits >> count));
  }
  std::vector<float> values;
  const auto pixels = image.at("rows").get<std::size_t>() * image.at("columns").get<std::size_t>();
  for (std::size_t i = 0; i < pixels; ++i) {
    std::uint32_t word = 0;
    for (std::size_t byte = 4; byte-- > 0;) word = word << 8 | bytes.at(4 * i + byte);
    values.push_back(std::bit_cast<float>(word));
  }
  return values;
}

TEST(PageImage, KeepsASmallImageToTheLastBitOfAFloat) {
  for (const int samples : {1, 2, 3, 5}) {
    const Image<double> image = Image<double>::Random(samples, samples);
    const Json json = page_image(image, 5);
    EXPECT_EQ(json.at("rows"), samples);
    EXPECT_EQ(json.at("samples_per_pixel"), 1);
    const std::vector<float> values = decoded(json);
    for (int i = 0; i < samples * samples; ++i) {
      EXPECT_EQ(values[static_cast<std::size_t>(i)], static_cast<float>(image.data()[i]));
    }
  }
}

TEST(PageImage, AveragesBlocksOfALargeOne) {
  Image<double> image(4, 4);
  image << 1, 3, 10, 10,  //
      5, 7, 10, 10,       //
      0, 0, -1, 1,        //
      0, 0, 2, -2;
  const Json json = page_image(image, 3);
  EXPECT_EQ(json.at("samples_per_pixel"), 2);
  EXPECT_THAT(decoded(json), ElementsAre(4.0F, 10.0F, 0.0F, 0.0F));
}

TEST(PageImage, LeavesOutWhatHasNoValue) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Image<double> image(3, 3);
  image << nan, nan, 1,  //
      nan, nan, 3,       //
      nan, 8, 5;
  const std::vector<float> values = decoded(page_image(image, 2));
  ASSERT_EQ(values.size(), 4u);
  EXPECT_TRUE(std::isnan(values[0]));
  EXPECT_EQ(values[1], 2.0F);  // of the block's part that is there
  EXPECT_EQ(values[2], 8.0F);
  EXPECT_EQ(values[3], 5.0F);
}

}  // namespace
}  // namespace nlcwfs
