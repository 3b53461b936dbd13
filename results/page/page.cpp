// A run's data become one HTML page.
#include "results/page/page.hpp"

#include "results/page/page_files.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include <boost/algorithm/string/replace.hpp>
#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>

namespace nlcwfs {
namespace {

using Json = nlohmann::ordered_json;

std::string_view file_text(std::string_view name) {
  const auto files = page_files();
  const auto file = std::ranges::find(files, name, &PageFile::name);
  assert(file != files.end());
  return file->text;
}

/// What of a text is no HTML.
std::string html_text(std::string_view text) {
  std::string escaped(text);
  // The ampersand first: the others bring some in.
  boost::algorithm::replace_all(escaped, "&", "&amp;");
  boost::algorithm::replace_all(escaped, "<", "&lt;");
  boost::algorithm::replace_all(escaped, ">", "&gt;");
  boost::algorithm::replace_all(escaped, "\"", "&quot;");
  return escaped;
}

/// JSON for a script element, which a text of the data could end if `<` stood in it. In JSON, `<`
/// is found only inside of strings.
std::string script_text(const Json& data) {
  std::string text = data.dump(-1, ' ', false, Json::error_handler_t::replace);
  boost::algorithm::replace_all(text, "<", "\\u003c");
  return text;
}

/// Every script but the library's.
std::string own_scripts() {
  std::string scripts;
  for (const PageFile& file : page_files()) {
    if (file.name.ends_with(".js") && !file.name.starts_with("plotly/")) scripts += file.text;
  }
  return scripts;
}

/// The template with each {{name}} replaced; what comes in is not looked at again.
std::string filled(std::string_view text, const std::map<std::string_view, std::string>& values) {
  std::string result;
  for (auto open = text.find("{{"); open != std::string_view::npos; open = text.find("{{")) {
    const auto close = text.find("}}", open);
    result += text.substr(0, open);
    result += values.at(text.substr(open + 2, close - open - 2));
    text.remove_prefix(close + 2);
  }
  return result.append(text);
}

/// In base64, with zeros behind them up to whole groups of three.
std::string base64(std::vector<unsigned char> bytes) {
  using namespace boost::archive::iterators;
  using Iterator =
      base64_from_binary<transform_width<std::vector<unsigned char>::const_iterator, 6, 8>>;
  bytes.resize((bytes.size() + 2) / 3 * 3);
  return {Iterator(bytes.cbegin()), Iterator(bytes.cend())};
}

/// The mean of a block's finite values; NaN where there are none.
double finite_mean(const Image<double>& image, Eigen::Index row, Eigen::Index column,
                   Eigen::Index size) {
  double sum = 0.0;
  int count = 0;
  for (Eigen::Index i = row; i < std::min(row + size, image.rows()); ++i) {
    for (Eigen::Index j = column; j < std::min(column + size, image.cols()); ++j) {
      if (!std::isfinite(image(i, j))) continue;
      sum += image(i, j);
      ++count;
    }
  }
  return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

std::string page_of(std::string_view title, const Json& data) {
  return filled(file_text("page.html"),
                {{"title", html_text(title)},
                 {"style", std::string(file_text("page.css"))},
                 {"data", script_text(data)},
                 {"licence", std::string(file_text("plotly/LICENSE"))},
                 {"plotly", std::string(file_text("plotly/plotly-cartesian.min.js"))},
                 {"script", own_scripts()}});
}

Json page_image(const Image<double>& image, int most) {
  assert(image.size() > 0 && most > 0);
  const Eigen::Index block = (std::max(image.rows(), image.cols()) + most - 1) / most;
  const Eigen::Index rows = (image.rows() + block - 1) / block;
  const Eigen::Index columns = (image.cols() + block - 1) / block;
  std::vector<unsigned char> bytes;
  bytes.reserve(4 * static_cast<std::size_t>(rows * columns));
  for (Eigen::Index row = 0; row < rows; ++row) {
    for (Eigen::Index column = 0; column < columns; ++column) {
      const auto value = static_cast<float>(finite_mean(image, row * block, column * block, block));
      const auto bits = std::bit_cast<std::uint32_t>(value);
      for (int shift = 0; shift < 32; shift += 8) {
        bytes.push_back(static_cast<unsigned char>(bits >> shift));
      }
    }
  }
  return {{"rows", rows},
          {"columns", columns},
          {"samples_per_pixel", block},
          {"values", base64(std::move(bytes))}};
}

}  // namespace nlcwfs
