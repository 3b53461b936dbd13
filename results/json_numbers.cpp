#include "results/json_numbers.hpp"

#include <limits>

namespace nlcwfs {
namespace {

using Json = nlohmann::ordered_json;

void flatten(const Json& matrix, std::vector<double>& numbers) {
  if (matrix.is_array()) {
    for (const Json& element : matrix) flatten(element, numbers);
  } else {
    numbers.push_back(number_from_json(matrix));
  }
}

}  // namespace

double number_from_json(const Json& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

MeanAndError mean_from_json(const Json& json) {
  return {number_from_json(json.at("mean")), number_from_json(json.at("standard_error"))};
}

std::vector<double> numbers_from_json(const Json& matrix) {
  std::vector<double> numbers;
  flatten(matrix, numbers);
  return numbers;
}

}  // namespace nlcwfs
