// Several pictures are drawn at once.
#pragma once

#include "results/archive/output_folder.hpp"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace nlcwfs {

/// A picture of a run, before it is drawn.
struct PlannedPicture {
  std::string name;  ///< of its files, without .svg and .png
  /// Draws it at a path without .svg and .png; why there is none, or nothing where there is one.
  std::function<std::optional<std::string>(const std::filesystem::path& stem)> draw;
};

/// One that write_picture() draws.
template <class Picture>
PlannedPicture planned(std::string name, Picture picture) {
  return {std::move(name), [picture = std::move(picture)](const auto& stem) {
            return write_picture(picture, stem);
          }};
}

/// Draws pictures, several at a time.
/// @return a line for each reason why there are no pictures
std::vector<std::string> draw_pictures(const std::vector<PlannedPicture>& pictures,
                                       const OutputFolder& folder);

}  // namespace nlcwfs
