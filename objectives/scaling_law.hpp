// A law is fitted to the best designs at several seeings.
#pragma once

#include "model/statistics.hpp"
#include "model/telescope.hpp"

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace nlcwfs {

/// The best symmetric four-plane design that was found at one D/r0, and what it reaches. Standard
/// errors are absolute, in the unit of the mean; those of the distances say how far a plane may
/// move before its design costs noticeably more.
struct ScalingDatum {
  double d_over_r0 = 0.0;             ///< pupil diameter over Fried parameter
  MeanAndError z_near_talbot{};       ///< near pair's |Z| over Z_T(r0) = 2 r0^2 / lambda
  MeanAndError far_fresnel_number{};  ///< far pair's D^2 / (lambda |Z|)
  MeanAndError residual_wfe{};        ///< wavelengths
  MeanAndError fractional_loops{};    ///< mean over the screens
};

/// A power law in D/r0: ln(value) = intercept + slope ln(D/r0).
struct LawLine {
  double intercept = 0.0;  ///< ln(value) at D/r0 = 1
  double slope = 0.0;      ///< the power of D/r0 that the value goes with
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of (intercept, slope)
  /// Standard deviation of ln(value) of single designs about the line, beyond their own standard
  /// errors.
  double scatter = 0.0;

  /// The value at a D/r0, with the standard error to expect of a single design there: the line's
  /// own, carried through the exponential to first order, and the scatter about the line.
  MeanAndError predict(double d_over_r0) const;
};

/// How a symmetric four-plane design follows the seeing. By constant Fresnel numbers D/r0 is all
/// that it can depend on, for one detector, reconstruction and cost.
struct ScalingLaw {
  /// The greatest D/r0 that a law is fitted to is at least so many times the smallest.
  static constexpr double least_reach = 1.1;

  LawLine z_near_talbot;            ///< of the ScalingDatum members of the same names
  LawLine far_fresnel_number;       ///< dimensionless
  LawLine residual_wfe;             ///< wavelengths
  LawLine fractional_loops;         ///< until the reconstruction ends
  double least_d_over_r0 = 0.0;     ///< of the designs that it was fitted to
  double greatest_d_over_r0 = 0.0;  ///< likewise
  /// Visiting order: 1 = -near, 2 = +near, 3 = -far, 4 = +far.
  std::array<int, 4> order{};

  /// Whether no fitted design reaches so far.
  bool extrapolates(double d_over_r0) const;

  /// The law's planes, signed distances in m in visiting order.
  /// @param fried_parameter  r0 at the telescope's wavelength, m
  /// @throws InputError where an extrapolation gives no design: the near pair behind the far one,
  ///         or planes beyond farthest_distance()
  std::vector<double> planes(const Telescope& telescope, double fried_parameter) const;
};

/// What a law has a line of.
struct ScalingQuantity {
  std::string_view name;              ///< as in files, with the unit where there is one
  MeanAndError ScalingDatum::*datum;  ///< where a datum has it
  LawLine ScalingLaw::*line;          ///< where the law has it
};

/// All of them: z_near_talbot, far_fresnel_number, residual_wfe_wavelengths, fractional_loops.
std::span<const ScalingQuantity> scaling_quantities();

/// Demands that an order has each of 1 to 4 once.
/// @throws InputError naming `order`
void validate_order(std::span<const int> order);

/// Fits each line by an M-estimator that a wrong datum hardly moves: Cauchy's loss with the
/// constant 2.385, which keeps 95 % of the efficiency on normal errors (Holland & Welsch 1977,
/// Commun. Stat. A 6, 813), on residuals in units of their error. That is the stated standard
/// error, times the residuals' robust standard deviation (the median of all but the two smallest
/// |residuals| over 0.6745, from a least absolute fit) where that is above 1: so the covariance
/// grows with the scatter, and is never below what the stated errors give. In refits of simulated
/// data its standard errors were 7 % (many data) to 40 % (four) larger than the refits' scatter.
/// @param data   at least 4, at 3 different D/r0 or more that reach over a factor of at least 1.1;
///               every value and its standard error above 0, the error at least 1e-6 of the value
///               and below it
/// @param order  each of 1 to 4 once, see ScalingLaw
/// @throws InputError naming what is not so, as `data[0].z_near_talbot.mean`
ScalingLaw fit_scaling_law(std::span<const ScalingDatum> data, const std::array<int, 4>& order);

}  // namespace nlcwfs
