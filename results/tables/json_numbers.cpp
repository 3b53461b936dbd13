// Numbers are read from JSON, where null is none.
#include "results/tables/json_numbers.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

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

int integer_from_json(const Json& json) {
  const double number = json.get<double>();
  // Before a conversion that is not defined for what an int cannot hold.
  if (std::trunc(number) != number || std::abs(number) > std::numeric_limits<int>::max()) {
    throw std::runtime_error(fmt::format("{} should be a whole number", json.dump()));
  }
  return static_cast<int>(number);
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
