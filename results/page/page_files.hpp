// The scripts and styles of pages that the program has in itself.
#pragma once

#include <span>
#include <string_view>

namespace nlcwfs {

/// A file of the folder results/page, as the program was built with it.
struct PageFile {
  std::string_view name;  ///< below results/page: "page.html", "plotly/LICENSE"
  std::string_view text;  ///< the whole file
};

/// All that a page is made of; scripts in the order in which they run.
std::span<const PageFile> page_files();

}  // namespace nlcwfs
