// Groups of configuration keys that several commands read.
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

/// Groups of configuration keys that several commands read.
namespace nlcwfs::keys {

/// Keys or sections.
using Keys = std::vector<std::string>;

/// What every command that knows a telescope reads.
inline const Keys site{"telescope", "seeing"};
/// What a simulation of one design takes besides.
inline const Keys simulation{"source",   "screens",        "sensor",
                             "detector", "reconstruction", "simulation"};
/// What judges a design.
inline const Keys judgement{"objective"};
/// What a search may vary, and how it does that.
inline const Keys space{"search.detector_window",
                        "search.exposure",
                        "search.initial_guess",
                        "search.layout",
                        "search.order",
                        "search.plane_count",
                        "search.precision",
                        "search.pupil_pixels",
                        "search.reconstruction_oversampling",
                        "search.reconstruction_window",
                        "search.relaxation",
                        "search.relaxation_end",
                        "search.relaxation_start",
                        "search.seed",
                        "search.time_limit",
                        "search.tolerance",
                        "search.z1",
                        "search.z2",
                        "search.z3",
                        "search.z4",
                        "search.z5",
                        "search.z6",
                        "search.z_far",
                        "search.z_near",
                        "search.z_third"};
/// What finds one best design in it.
inline const Keys search{"search", "baseline", "verify"};
/// How a design is simulated on screens that no search has seen.
inline const Keys fresh_screens{"verify.screens", "verify.seed", "verify.truth_factor"};

/// The groups one after the other.
inline Keys joined(std::initializer_list<Keys> groups) {
  Keys all;
  for (const Keys& group : groups) all.insert(all.end(), group.begin(), group.end());
  return all;
}

}  // namespace nlcwfs::keys
