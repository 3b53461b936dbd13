#include "results/performance_record.hpp"

#include <stdexcept>

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

ScreenPerformance from_record(const Json& record) {
  return {.wavefront = {.residual_wfe = record.at(0),
                        .wrapped_wfe = record.at(1),
                        .total_wfe = record.at(2),
                        .field_strehl = record.at(3),
                        .recovered_share = record.at(4)},
          .converged = record.at(5),
          .loops = record.at(6),
          .fractional_loops = record.at(7),
          .fft_count = record.at(8),
          .seconds = record.at(9),
          .data_seconds = record.at(10),
          .captured_energy = record.at(11).get<std::vector<double>>()};
}

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
    std::vector<Performance> performances;
    for (const Json& screens : Json::from_cbor(record)) {
      Performance& performance = performances.emplace_back();
      for (const Json& screen : screens) performance.screens.push_back(from_record(screen));
    }
    return performances;
  } catch (const Json::exception& error) {
    throw std::runtime_error(fmt::format("no record of performances: {}", error.what()));
  }
}

}  // namespace nlcwfs
