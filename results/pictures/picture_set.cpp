// Several pictures are drawn at once.
#include "results/pictures/picture_set.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace nlcwfs {

std::vector<std::string> draw_pictures(const std::vector<PlannedPicture>& pictures,
                                       const OutputFolder& folder) {
  std::vector<std::optional<std::string>> reasons(pictures.size());
  tbb::parallel_for(std::size_t{0}, pictures.size(), [&](std::size_t i) {
    reasons[i] = pictures[i].draw(folder.file(pictures[i].name));
  });
  std::vector<std::string> notes;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    // Told with the first that has the same reason.
    if (!reasons[i] || std::find(reasons.begin(), reasons.begin() + std::ptrdiff_t(i),
                                 reasons[i]) != reasons.begin() + std::ptrdiff_t(i)) {
      continue;
    }
    std::string names;
    for (std::size_t j = i; j < pictures.size(); ++j) {
      if (reasons[j] != reasons[i]) continue;
      names += fmt::format("{}{}.svg", names.empty() ? "" : ", ", pictures[j].name);
    }
    notes.push_back(fmt::format("there is no {}: {}", names, *reasons[i]));
  }
  return notes;
}

}  // namespace nlcwfs
