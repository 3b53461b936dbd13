// Tests: Whole text files are read, of bounded size.
#include "results/tables/text_file.hpp"

#include "tests/scratch_folder.hpp"

#include <fstream>
#include <stdexcept>
#include <sys/stat.h>

#include <gmock/gmock.h>

namespace nlcwfs {
namespace {

using TextFile = ScratchFolder;

void expect_refused(const char* path, const char* why) {
  EXPECT_THAT([&] { (void)text_of_file(path, 10); },
              testing::ThrowsMessage<std::runtime_error>(why))
      << path;
}

TEST_F(TextFile, IsReadAsItIs) {
  const std::string text("a\0b\r\n\xff", 6);
  std::ofstream("text", std::ios::binary) << text;
  EXPECT_EQ(text_of_file("text"), text);
  std::ofstream("empty").flush();
  EXPECT_EQ(text_of_file("empty", 0), "");
}

TEST_F(TextFile, RefusesWhatMayNeverEnd) {
  expect_refused("missing", "No such file or directory");
  expect_refused(".", "it is no regular file");
  expect_refused("/dev/zero", "it is no regular file");
  ASSERT_EQ(mkfifo("pipe", 0600), 0);
  expect_refused("pipe", "it is no regular file");
}

TEST_F(TextFile, RefusesWhatIsTooLarge) {
  std::ofstream("eleven") << "12345678901";
  expect_refused("eleven", "it has 1.05e-05 MiB, and 9.54e-06 MiB are allowed");
  // Nothing is read of it.
  std::filesystem::resize_file("eleven", std::uintmax_t{20} << 30U);
  EXPECT_THAT(
      [] { (void)text_of_file("eleven"); },
      testing::ThrowsMessage<std::runtime_error>("it has 2.05e+04 MiB, and 256 MiB are allowed"));
}

}  // namespace
}  // namespace nlcwfs
