// Fuzzes FITS files.
#include "results/fits/fits_cube.hpp"
#include "tests/fuzz/fuzzer.hpp"
#include "tests/fuzz/memory_file.hpp"

#include <algorithm>
#include <string>

using namespace nlcwfs;

namespace {

void fill_block(std::string& file, char with) {
  constexpr std::size_t block = 2880;
  file.resize((file.size() + block - 1) / block * block, with);
}

/// The file that lines stand for: cards of the header up to an empty line, then the data. Changes
/// of a line keep the other cards where they must be.
std::string file_of_lines(std::string_view text) {
  std::string header;
  const auto add = [&header](std::string_view line) {
    constexpr std::size_t card = 80;
    const std::size_t start = header.size();
    header += line.substr(0, card);
    header.resize(start + card, ' ');
  };
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    if (line.empty()) break;
    add(line);
  }
  add("END");
  fill_block(header, ' ');
  std::string file = header.append(text);
  fill_block(file, '\0');
  return file;
}

void read_file(std::string_view contents) {
  const MemoryFile file(contents);
  for (const FitsGaps gaps : {FitsGaps::refused, FitsGaps::allowed}) {
    for (const FitsShape shape : {FitsShape::square, FitsShape::frames}) {
      is_accepted([&] { read_fits_cube(file.path(), "screens.file", gaps, shape); });
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view contents = text_of(data, size);
  read_file(contents);
  if (contents.substr(0, 81).find('\n') != std::string_view::npos) {
    read_file(file_of_lines(contents));
  }
  return 0;
}
