// The finished runs of a reproduction, as its figures and claims ask for them.
#pragma once

#include "studies/reproduction/plane_map.hpp"
#include "studies/reproduction/study_setup.hpp"

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

/// By how much values are above others of the same wavefronts.
MeanAndError mean_difference(std::vector<double> values, const std::vector<double>& others);

/// The runs of one set-up, as its claims ask for them.
class SetupRuns {
 public:
  /// The finished runs of one set-up.
  SetupRuns(const ReproducedRuns& runs, StudySetup setup) : runs_(runs), setup_(setup) {}

  /// Which one that is.
  StudySetup setup() const { return setup_; }

  /// @param run  below its figure, without the set-up; empty where the set-up is all of its name
  const nlohmann::ordered_json& summary(std::string_view figure, std::string_view run) const {
    return runs_.summary(run_folder(figure, setup_, run));
  }

  /// Of four planes.
  PlaneMap map(int ratio) const;
  /// Of three planes at D/r0 = 4: "without-p3", "without-p1".
  PlaneMap three_plane_map(const std::string& name) const;

  /// The mean of a design at the paper's distances, D/r0 = 4.
  MeanAndError design(const std::string& name, const char* metric) const;
  /// By how much one of them is above that of four planes, wavefront by wavefront.
  MeanAndError above_four_planes(const std::string& name, const char* metric) const;

  /// A metric of each wavefront, of an evaluate or a convergence.
  std::vector<double> screens(std::string_view figure, std::string_view run,
                              const std::string& metric) const {
    return runs_.screens(run_folder(figure, setup_, run), metric);
  }

 private:
  const ReproducedRuns& runs_;
  StudySetup setup_;
};

}  // namespace nlcwfs
