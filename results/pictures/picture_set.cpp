// Several pictures are drawn at once.
#include "results/pictures/picture_set.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/parallel_for.h>

namespace nlcwfs {

std::vector<std::string> draw_pictures(const std::vector<PlannedPicture>& pictures,
                                       const OutputFolder& folder) {
  std::vector<std::optional<std::string>> reasons(pictures.size());
  tbb::parallel_for(std::size_t{0}, pictures.size(), [&](std::size_t i) {
    reasons[i] = pictures[i].draw(folder.file(pictures[i].name));
  });
  std::vector<std::pair<std::string, std::vector<std::string>>> missing;  // reason and files
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    if (!reasons[i]) continue;
    auto found = std::ranges::find(missing, *reasons[i], &decltype(missing)::value_type::first);
    if (found == missing.end()) found = missing.insert(found, {*reasons[i], {}});
    found->second.push_back(pictures[i].name + ".svg");
  }
  std::vector<std::string> notes;
  for (const auto& [reason, files] : missing) {
    notes.push_back(fmt::format("there is no {}: {}", fmt::join(files, ", "), reason));
  }
  return notes;
}

}  // namespace nlcwfs
