// The arithmetic of H32f that runs over many values side by side, for three instruction sets.
#pragma once

#include "math/simd/SimdLevel.hpp"
#include "solvers/h32f/Forms.hpp"
#include "solvers/h32f/SampleTables.hpp"

namespace hybridgv {

struct FocalPose;
namespace correspondences {
struct RayMatch;
struct PointMatch;
}  // namespace correspondences

namespace solvers {

namespace h32f {

// Room for the samples of one call, and for the roots. All arrays are padded to a multiple of 8 entries, the widest vector; the
// entries beyond the count must be defined, and are computed along.
constexpr int kBatch = 48;

// Polynomials sum_i c[i][j] t^i with one sign change of their Bernstein coefficients on [0, 1].
struct PowerForms {
  double c[kDegree + 1][kBatch];
};

// Candidate solutions: hidden variable, direction (cos psi, sin psi), depth d.
struct Candidates {
  double e[kBatch], cosPsi[kBatch], sinPsi[kBatch], d[kBatch];
  double step[kBatch];  // size of the last Newton step
};

struct Kernel {
  // The 8x8 Dixon determinants at e[0 .. count-1].
  void (*determinants)(const Forms& forms, const double* e, int count, double* determinant);
  // Bernstein coefficients of all pieces from the samples.
  void (*bernsteinCoefficients)(const SampleTables& tables, const double* samples, PieceCoefficients& pieces);
  // The roots t[j] in [0, 1]; start values in t.
  void (*simpleRoots)(const PowerForms& forms, int count, double* t);
  // Makes the roots e[0 .. count-1] of the determinant as accurate as the determinant itself.
  void (*polishRoots)(const Forms& forms, int count, double* e);
  // From e to (psi, d) by the null vector of the Dixon matrix.
  void (*nullVectors)(const Forms& forms, int count, Candidates& candidates);
  // Newton's method on the three equations in (e, psi, d).
  void (*newton)(const Forms& forms, int count, Candidates& candidates);
};

// The version for the processor at hand.
const Kernel& kernel();
// The version for one level, which the processor must support.
const Kernel& kernel(math::SimdLevel level);

// The solver h32f with a kernel of choice.
int solve(const correspondences::RayMatch* rays, const correspondences::PointMatch* points, const Kernel& kernel,
          FocalPose* solutions);

}  // namespace h32f
}  // namespace solvers
}  // namespace hybridgv
