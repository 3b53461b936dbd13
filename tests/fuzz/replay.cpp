// Replays a corpus through a fuzzer.
#include "tests/fuzz/fuzzer.hpp"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace {

using Input = std::pair<std::string, std::string>;  // name and contents

std::vector<Input> inputs_in(const std::filesystem::path& folder) {
  std::vector<Input> inputs;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::ifstream file(entry.path(), std::ios::binary);
    inputs.emplace_back(entry.path().filename().string(),
                        std::string(std::istreambuf_iterator<char>(file), {}));
  }
  std::ranges::sort(inputs);
  return inputs;
}

/// Changes a few places of an input; the same seed gives the same changes everywhere.
class Mutator {
 public:
  std::string mutated(std::string text, const std::string& other) {
    for (std::size_t change = 0, changes = 1 + below(4); change < changes; ++change) {
      const std::size_t at = below(text.size() + 1);
      const std::size_t length = below(text.size() - at + 1) % 64;
      const std::size_t from = below(other.size() + 1);
      switch (below(5)) {
        case 0:
          text.replace(at, 1, 1, static_cast<char>(below(256)));
          break;
        case 1:
          text.erase(at, length);
          break;
        case 2:
          text.insert(at, text.substr(at, length));
          break;
        case 3:
          text.replace(at, length, other.substr(from, below(64)));
          break;
        default:
          text.resize(at);
      }
    }
    return text;
  }

  /// A whole number below a limit.
  std::size_t below(std::size_t limit) { return static_cast<std::size_t>(numbers_() % limit); }

 private:
  std::mt19937_64 numbers_{1};
};

}  // namespace

/// Gives a fuzzer the inputs of a folder and some like them, without libFuzzer.
int main(int argc, char** argv) {
  if (argc != 2) return 2;
  constexpr int mutations = 50;
  Mutator mutator;
  const std::vector<Input> inputs = inputs_in(argv[1]);
  for (const auto& [name, contents] : inputs) {
    for (int mutation = 0; mutation <= mutations; ++mutation) {
      const std::string& other = inputs[mutator.below(inputs.size())].second;
      const std::string input = mutation == 0 ? contents : mutator.mutated(contents, other);
      // Said before, as a fault may end the program.
      std::printf("%s, mutation %d\n", name.c_str(), mutation);
      std::fflush(stdout);
      try {
        // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast)
        LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
      } catch (const std::exception& error) {
        std::printf("escaped: %s\n", error.what());
        return 1;
      }
    }
  }
  return inputs.empty() ? 1 : 0;
}
