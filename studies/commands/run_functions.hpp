#pragma once

#include "studies/command_line/command_line.hpp"

namespace nlcwfs {

// The commands. Each reads the configuration, checks all of it before it makes the output folder,
// writes its results there and prints a short summary on standard output.
// They throw InputError for bad input and other exceptions for a run that failed.

/// One design's performance on the configured screens.
void run_evaluate(const CommandLine& command_line);

/// How one design's wavefront error falls from loop to loop.
void run_convergence(const CommandLine& command_line);

/// How much of single spatial frequencies one design recovers, and pairs of planes on the
/// configured distances do, beside what the Talbot effect and the photons let expect.
void run_response(const CommandLine& command_line);

/// The best design of the configured search, verified on fresh screens beside the baseline.
void run_optimize(const CommandLine& command_line);

/// The designs that no other betters in all of the configured objectives, verified on fresh
/// screens.
void run_trade(const CommandLine& command_line);

/// Every design of the configured grid, the best of them verified on fresh screens. A run that was
/// interrupted goes on with --resume.
void run_sweep(const CommandLine& command_line);

/// The best designs of a sweep and of a search, both on screens that neither has seen, and what it
/// took to find them.
void run_compare(const CommandLine& command_line);

/// The planes that the scaling law gives for the configured telescope and seeing, and what they are
/// predicted to reach; with --verify simulated too.
void run_advise(const CommandLine& command_line);

/// Every study of Letchev et al. 2022, and what their claims have come to. A run that was
/// interrupted goes on with --resume.
void run_reproduce(const CommandLine& command_line);

/// The page of an earlier run, again. Makes no output folder.
void run_report(const CommandLine& command_line);

/// How fast this machine is at the configuration. Makes an output folder only where the user named
/// one: its figures are of the moment.
void run_benchmark(const CommandLine& command_line);

/// A run's archive as flat tables.
void run_export(const CommandLine& command_line);

/// The scaling law of the best designs at several seeings.
void run_law(const CommandLine& command_line);

/// A design moved to another telescope at constant Fresnel numbers.
void run_scale(const CommandLine& command_line);

/// The wavefronts of measured detector frames, and how well what they predict agrees with what was
/// measured.
void run_reconstruct(const CommandLine& command_line);

/// Phase screens as a FITS cube, with their statistics.
void run_screens(const CommandLine& command_line);

}  // namespace nlcwfs
