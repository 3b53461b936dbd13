// Tests: CSV is written and read.
#include "results/tables/csv_table.hpp"

#include "tests/scratch_folder.hpp"

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace nlcwfs {
namespace {

TEST(CsvTable, IsAHeaderAndRowsOfEqualLength) {
  CsvTable table({"name", "length_m"});
  table.row().add("near").add(0.5);
  table.row().add("far").add(-2.0);
  EXPECT_EQ(table.text(), "name,length_m\nnear,0.5\nfar,-2\n");
}

TEST(CsvTable, WithoutRowsIsItsHeader) {
  EXPECT_EQ(CsvTable({"name", "length_m"}).text(), "name,length_m\n");
}

TEST(CsvTable, KeepsEmptyCells) {
  CsvTable table({"a", "b", "c"});
  table.row().add("").add(1.0).add("");
  table.row().add("").add("").add("x");
  EXPECT_EQ(table.text(), "a,b,c\n,1,\n,,x\n");
}

/// The cells of a text after RFC 4180, with \n as the line end.
std::vector<std::vector<std::string>> parsed(const std::string& text) {
  std::vector<std::vector<std::string>> rows{{""}};
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::string& cell = rows.back().back();
    if (quoted) {
      if (text[i] != '"') {
        cell += text[i];
      } else if (i + 1 < text.size() && text[i + 1] == '"') {
        cell += text[++i];
      } else {
        quoted = false;
      }
    } else if (text[i] == '"') {
      quoted = true;
    } else if (text[i] == ',') {
      rows.back().emplace_back();
    } else if (text[i] == '\n') {
      rows.push_back({""});
    } else {
      cell += text[i];
    }
  }
  rows.pop_back();
  return rows;
}

TEST(CsvTable, KeepsRowsOfOneEmptyCell) {
  CsvTable table({"a"});
  table.row().add("");
  table.row().add("");
  table.row().add("x");
  EXPECT_EQ(table.text(), "a\n\n\nx\n");
}

TEST(CsvTable, QuotesWhatWouldBeMistakenForItsOwnMarks) {
  const std::vector<std::string> words{"plain",          "two words", "a,b", "say \"hi\"", "\"",
                                       "line 1\nline 2", "tab\there", "\r",  ",\",\n\"\"", ""};
  CsvTable table(words);
  table.row();
  for (const std::string& word : words) table.add(word);
  EXPECT_EQ(parsed(table.text()), (std::vector{words, words}));
  EXPECT_EQ(table.text().substr(0, 32), "plain,two words,\"a,b\",\"say \"\"hi\"");
}

TEST(CsvTable, NumbersReadBackAsTheSameBits) {
  std::vector<double> numbers{0.0,     -0.0,  0.1,
                              1.0 / 3, 5e-9,  std::numeric_limits<double>::max(),
                              -1e-300, 1e300, std::numeric_limits<double>::denorm_min()};
  std::mt19937_64 generator(1);
  while (numbers.size() < 2000) {
    const auto number = std::bit_cast<double>(generator());
    if (std::isfinite(number)) numbers.push_back(number);
  }
  CsvTable table({"number"});
  for (const double number : numbers) table.row().add(number);
  const auto rows = parsed(table.text());
  ASSERT_EQ(rows.size(), numbers.size() + 1);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::string& cell = rows[i + 1].at(0);
    double read = 0.0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), read);
    EXPECT_TRUE(error == std::errc() && end == cell.data() + cell.size()) << cell;
    EXPECT_EQ(std::bit_cast<std::uint64_t>(read), std::bit_cast<std::uint64_t>(numbers[i])) << cell;
  }
}

TEST(CsvTable, WritesWhatIsNoFiniteNumberAsAWord) {
  CsvTable table({"number"});
  table.row().add(std::numeric_limits<double>::quiet_NaN());
  table.row().add(-std::numeric_limits<double>::infinity());
  EXPECT_EQ(table.text(), "number\nnan\n-inf\n");
}

using ReadCsv = ScratchFolder;

TEST_F(ReadCsv, IsTheInverse) {
  CsvTable table({"name", "value"});
  table.row().add("plain").add(0.1);
  table.row().add("with, \"marks\"\nand lines").add(-1e300);
  table.row().add("").add(2.0);
  std::ofstream("table.csv") << table.text();
  const std::vector<CsvRow> rows = read_csv("table.csv");
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].at("name"), "plain");
  EXPECT_EQ(rows[0].at("value"), "0.1");
  EXPECT_EQ(rows[1].at("name"), "with, \"marks\"\nand lines");
  EXPECT_EQ(rows[1].at("value"), "-1e+300");
  EXPECT_EQ(rows[2].at("name"), "");
}

TEST_F(ReadCsv, NamesTheFileThatItCannotRead) {
  const auto message = [](const char* path) {
    try {
      (void)read_csv(path);
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message("missing.csv"), "cannot read missing.csv: No such file or directory");
  std::ofstream("empty.csv").flush();
  EXPECT_EQ(message("empty.csv"), "cannot read empty.csv: it is empty");
  std::ofstream("broken.csv") << "a,b\n1,2\n3\n";
  EXPECT_EQ(message("broken.csv"), "cannot read broken.csv: line 3 has 1 cells, not 2");
}

}  // namespace
}  // namespace nlcwfs
