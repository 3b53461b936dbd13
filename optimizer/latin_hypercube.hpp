// Points that fill a space.
#pragma once

#include "optimizer/problem.hpp"

#include <vector>

#include <boost/random/mersenne_twister.hpp>

namespace nlcwfs {

/// Points that fill a sub-space: each variable's range is divided into as many equal parts as there
/// are points, and each part has one of them (McKay, Beckman & Conover 1979), here in its middle.
/// Discrete variables take their values equally often, as far as that goes.
/// @param count  at least 1
std::vector<SearchPoint> latin_hypercube(const SubSpace& space, int sub_space, int count,
                                         boost::random::mt19937_64& generator);

}  // namespace nlcwfs
