// The real roots of the resultant R26(e) of H32f in (-1, 1).
#pragma once

#include "solvers/h32f/Kernel.hpp"

namespace hybridgv {
namespace solvers {
namespace h32f {

// Writes the roots, and values that rounding does not tell from roots, to e; returns their number (at most kBatch).
//
// y(e) (see SampleTables.hpp) is sampled, interpolated by piecewise polynomials, and each piece is searched by Descartes' rule.
// The interpolant's error is measured in every instance: R26 has degree 26 and the 28 samples fit degree 27, so that the leading
// coefficient must vanish. Bernstein coefficients below the resulting tolerance may have either sign. A piece on which y does not
// exceed that band is sampled anew, which is accurate relative to the size of y there.
//
// Returns 0 if R vanishes identically (degenerate data).
int hiddenRoots(const Forms& forms, const Kernel& kernel, double* e);

}  // namespace h32f
}  // namespace solvers
}  // namespace hybridgv
