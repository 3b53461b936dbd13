// A reconstruction is held against the truth: wavefront errors and Strehl ratio.
#pragma once

#include "model/array.hpp"
#include "model/pupil.hpp"

namespace nlcwfs {

/// How well a reconstruction matches the true wavefront; lengths in m of optical path.
struct WavefrontMetrics {
  double residual_wfe = 0.0;  ///< RMS over the pupil of (unwrapped - true phase), piston removed
  double wrapped_wfe = 0.0;   ///< the same of arg(E_rec conj(E_true)): blind to 2 pi errors
  /// sqrt(residual^2 + unresolved^2), so never below the residual; unresolved: RMS over the pupil
  /// of what is missing of the truth where the reconstruction's samples hold its means and are
  /// interpolated linearly. (Interpolating the reconstruction itself would smooth its noise away.)
  double total_wfe = 0.0;
  double field_strehl = 0.0;     ///< field-estimated Strehl ratio, see field_estimated_strehl()
  double recovered_share = 0.0;  ///< see recovered_share()
};

/// The mean of `phase` over the mask: its piston.
double piston(const Image<double>& phase, const PupilMask& mask);

/// RMS over the mask of `phase` (rad), piston removed.
double piston_free_rms(const Image<double>& phase, const PupilMask& mask);

/// RMS over the mask of arg(field conj(reference)) (rad), less the argument of that product's mean:
/// the piston, found without unwrapping.
double wrapped_phase_rms(const Field<double>& field, const Field<double>& reference,
                         const PupilMask& mask);

/// S_F = |sum E_rec conj(E_true)|^2 / (sum |E_rec|^2 sum |E_true|^2) over the mask, 0 to 1;
/// 0 where a field is dark.
/// Source: Banet et al. 2017, as used by Letchev et al. 2022, section 4.
double field_estimated_strehl(const Field<double>& field, const Field<double>& truth,
                              const PupilMask& mask);

/// How much of the true phase is in the reconstructed one: the regression coefficient
/// sum(r t) / sum(t^2) over the mask, r and t being the reconstructed and the true phase less their
/// means; 1 is all of it. Of a sinusoid it is the recovered amplitude over the true one. 0 where
/// the truth is flat.
double recovered_share(const Image<double>& phase, const Image<double>& truth,
                       const PupilMask& mask);

/// The truth as the reconstruction's samples see it: averaged over blocks where these are coarser,
/// repeated where they are finer.
/// @param samples  wanted samples a side, a multiple or a divisor of the truth's
Image<double> truth_on_samples(const PhaseScreen& truth, Eigen::Index samples);

/// Brings a phase known over `mask` to another sampling of the same diameter: averaged over blocks
/// where that is coarser, interpolated linearly between samples of the mask where it is finer.
/// @param samples  wanted samples a side, a multiple or a divisor of the phase's
/// @return samples x samples; 0 where no sample of the mask is near
Image<double> resample_over_mask(const Image<double>& phase, const PupilMask& mask, int samples);

/// Compares a reconstruction with the truth.
/// @param field           reconstructed pupil field, n x n
/// @param unwrapped       its unwrapped phase, rad
/// @param mask            the reconstruction's pupil
/// @param truth           true phase, m x m samples, rad; m is a multiple or a divisor of n
/// @param truth_mask      the truth's pupil
/// @param wavelength      m
WavefrontMetrics measure_wavefront(const Field<double>& field, const Image<double>& unwrapped,
                                   const PupilMask& mask, const PhaseScreen& truth,
                                   const PupilMask& truth_mask, double wavelength);

}  // namespace nlcwfs
