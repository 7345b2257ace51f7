// The three 2D-2D equations of H32f with the hidden variable e.
#pragma once

namespace hybridgv {
namespace solvers {
namespace h32f {

// With the depth d = e delta and w = 1 - e^2 the equation of ray j is
//
//     sqrt(w) (A cos psi + B sin psi) + K = 0,      A = e sum_b a_b(e) delta^b,  B and K alike,
//
//     a_b(e) = a[b][0][j] + a[b][1][j] e   + a[b][2][j] e^2,   a[0][2] = a[2][0] = 0,   and b_b(e) alike,
//     k_b(e) = k[b][0][j] + k[b][1][j] e w + k[b][2][j] e^2,   k[0][1] = k[2][0] = 0.
//
// The coefficients of each ray are scaled to unit length.
struct Forms {
  double a[3][3][3], b[3][3][3], k[3][3][3];  // [power of delta][coefficient][ray]
};

}  // namespace h32f
}  // namespace solvers
}  // namespace hybridgv
