// Groups of configuration keys that several commands read.
#pragma once

#include "studies/run/command.hpp"

#include <algorithm>
#include <initializer_list>

/// Groups of configuration keys that several commands read.
namespace nlcwfs::keys {

/// Keys or sections.
using Keys = decltype(Command::keys);

/// What every command that knows a telescope reads.
inline const Keys site{"telescope", "seeing"};
/// What a simulation of one design takes besides.
inline const Keys simulation{"source",   "screens",        "sensor",
                             "detector", "reconstruction", "simulation"};
/// What judges a design.
inline const Keys judgement{"objective"};
/// What a search may vary, and how it does that: the section search without what only the search of
/// one best design has.
inline Keys space() {
  const Keys others{"search.optimizer",     "search.budget",      "search.race",
                    "search.stagnation",    "search.target",      "search.cheap_budget",
                    "search.cheap_screens", "search.cheap_window"};
  Keys all;
  for (const ConfigurationKey& key : configuration_keys()) {
    const bool is_other = std::ranges::count(others, key.name) > 0;
    if (key.name.starts_with("search.") && !is_other) all.push_back(key.name);
  }
  return all;
}
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
