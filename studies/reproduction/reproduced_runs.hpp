#pragma once

#include "studies/reproduction/plan.hpp"
#include "studies/reproduction/plane_map.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace nlcwfs {

/// The finished runs of a reproduction. All throw std::runtime_error with path and cause where a
/// file cannot be read or has not what is asked for.
class ReproducedRuns {
 public:
  /// @param folder  of the reproduction
  explicit ReproducedRuns(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// A run's summary.json.
  const nlohmann::ordered_json& summary(const std::string& run) const;

  /// A metric of each wavefront, of an evaluate or a convergence.
  std::vector<double> screens(const std::string& run, const std::string& metric) const;

 private:
  std::filesystem::path folder_;
  mutable std::map<std::string, nlohmann::ordered_json> read_;
};

/// The runs of one set-up, as its claims ask for them.
class SetupRuns {
 public:
  /// The finished runs of one set-up.
  SetupRuns(const ReproducedRuns& runs, StudySetup setup) : runs_(runs), setup_(setup) {}

  /// @param run  below its figure, without the set-up; empty where the set-up is all of its name
  const nlohmann::ordered_json& summary(std::string_view figure, const std::string& run) const;

  /// Of four planes.
  PlaneMap map(int ratio) const;
  /// Of three planes at D/r0 = 4: "without-p3", "without-p1".
  PlaneMap three_plane_map(const std::string& name) const;

  /// The mean of a design at the paper's distances, D/r0 = 4.
  MeanAndError design(const std::string& name, const char* metric) const;
  /// By how much one of them is above another, wavefront by wavefront.
  MeanAndError design_difference(const std::string& name, const std::string& other,
                                 const char* metric) const;

  /// A metric of each wavefront, of an evaluate or a convergence.
  std::vector<double> screens(std::string_view figure, const std::string& run,
                              const std::string& metric) const;

 private:
  std::string path(std::string_view figure, const std::string& run) const;

  const ReproducedRuns& runs_;
  StudySetup setup_;
};

}  // namespace nlcwfs
