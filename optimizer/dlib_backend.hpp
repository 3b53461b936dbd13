// dlib's global search of mixed variables.
#pragma once

#include "optimizer/nlopt_backend.hpp"

#include <vector>

namespace nlcwfs {

/// Minimises the cost over all variables of all sub-spaces with dlib's global_function_search:
/// upper bounds from a piecewise Lipschitz model (MaxLIPO, Malherbe & Vayatis 2017, with the noise
/// terms of King 2017) alternate with a trust region round the best point (quadratic models, Powell
/// 2006); integer and categorical variables are whole numbers to it. Each sub-space begins with the
/// starts in it and a Latin hypercube (McKay, Beckman & Conover 1979) of one point more than it has
/// variables, at least 3. The run with the same arguments and a higher limit takes the same path.
///
/// Failures and designs that exceed limits are told to dlib as no worse than the worst cost of its
/// run so far: a Lipschitz model of penalties sees nothing else.
///
/// dlib's own time grows with the square of the evaluations: in all 0.1, 0.5, 5 and 20 s of one
/// core for 100, 300, 1000 and 2000 evaluations in 5 variables, two thirds of it in 2, twice in 10.
/// @param starts   may be empty
/// @param options  x_tolerance and initial_step play no part
/// @throws whatever the evaluator throws: SearchStopped, SearchFailed, exceptions of the observer
StageResult minimize_with_dlib(Evaluator& evaluator, const std::vector<SearchPoint>& starts,
                               const StageOptions& options);

}  // namespace nlcwfs
