// Performances become bytes and back, to the last bit.
#include "results/archive/performance_record.hpp"

#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace nlcwfs {
namespace {

using Json = nlohmann::json;

Json to_record(const ScreenPerformance& screen) {
  const auto& [wavefront, converged, loops, fractional_loops, fft_count, seconds, data_seconds,
               captured_energy, residual_after_loops] = screen;
  const auto& [residual_wfe, wrapped_wfe, total_wfe, field_strehl, recovered_share] = wavefront;
  return {residual_wfe,     wrapped_wfe, total_wfe, field_strehl, recovered_share, converged, loops,
          fractional_loops, fft_count,   seconds,   data_seconds, captured_energy};
}

int integer(const Json& number) {
  if (!number.is_number_integer()) throw std::runtime_error("a count is no whole number");
  return number.get<int>();
}

ScreenPerformance from_record(const Json& record) {
  return {.wavefront = {.residual_wfe = record.at(0),
                        .wrapped_wfe = record.at(1),
                        .total_wfe = record.at(2),
                        .field_strehl = record.at(3),
                        .recovered_share = record.at(4)},
          .converged = record.at(5),
          .loops = integer(record.at(6)),
          .fractional_loops = record.at(7),
          .fft_count = integer(record.at(8)),
          .seconds = record.at(9),
          .data_seconds = record.at(10),
          .captured_energy = record.at(11).get<std::vector<double>>()};
}

/// Reads a record as it comes: performances of screens of values, of which the last is a list.
/// Whatever is nested deeper, of which a tree would end the stack, ends the reading.
// NOLINTNEXTLINE(bugprone-exception-escape): it may throw
class Reader : public nlohmann::json_sax<Json> {
 public:
  std::vector<Performance> performances;

  bool boolean(bool value) override { return add(value); }
  bool number_integer(number_integer_t value) override { return add(value); }
  bool number_unsigned(number_unsigned_t value) override { return add(value); }
  bool number_float(number_float_t value, const string_t& /*text*/) override { return add(value); }

  bool start_array(std::size_t /*elements*/) override {
    switch (++depth_) {
      case 1:
        return true;
      case 2:
        performances.emplace_back();
        return true;
      case 3:
        screen_ = Json::array();
        return true;
      case 4:
        screen_.push_back(Json::array());
        return true;
      default:
        return false;
    }
  }

  bool end_array() override {
    if (depth_-- == 3) performances.back().screens.push_back(from_record(screen_));
    return true;
  }

  bool null() override { return false; }
  bool string(string_t& /*value*/) override { return false; }
  bool binary(binary_t& /*value*/) override { return false; }
  bool start_object(std::size_t /*elements*/) override { return false; }
  bool key(string_t& /*value*/) override { return false; }
  bool end_object() override { return false; }
  bool parse_error(std::size_t /*position*/, const std::string& /*last_token*/,
                   const Json::exception& /*error*/) override {
    return false;
  }

 private:
  bool add(const Json& value) {
    if (depth_ < 3) return false;
    (depth_ == 3 ? screen_ : screen_.back()).push_back(value);
    return true;
  }

  int depth_ = 0;
  Json screen_;  // that is being read
};

}  // namespace

std::vector<std::uint8_t> performance_record(const std::vector<Performance>& performances) {
  Json record = Json::array();
  for (const Performance& performance : performances) {
    Json screens = Json::array();
    for (const ScreenPerformance& screen : performance.screens) {
      screens.push_back(to_record(screen));
    }
    record.push_back(std::move(screens));
  }
  return Json::to_cbor(record);
}

std::vector<Performance> performances_of(const std::vector<std::uint8_t>& record) {
  try {
    Reader reader;
    if (!Json::sax_parse(record, &reader, Json::input_format_t::cbor)) {
      throw std::runtime_error("it is damaged");
    }
    return std::move(reader.performances);
  } catch (const std::exception& error) {
    throw std::runtime_error(fmt::format("no record of performances: {}", error.what()));
  }
}

}  // namespace nlcwfs
