#include "solvers/one_centre/OneFocalDecomposition.hpp"

namespace hybridgv {
namespace solvers {
namespace one_centre {

using math::Pair;
using math::Vec3;

void OneFocalOrientation::Choice::add(bool first, Pair pp, Pair nn, Pair npt, Pair nat) {
  constexpr double kLeast = 1e-10 * 1e-10;  // sine^2 of the angle between t and p or a
  if (first) {
    sign = -signs(npt);
    valid = sign * sign > 0;
  }
  valid &= (sign * npt < 0) & (sign * nat < 0) & (npt * npt > kLeast * pp * nn) & (nat * nat > kLeast * nn);
}

OneFocalOrientation::OneFocalOrientation(const SixCorrespondences& six, const OneFocalDecomposition& decomposition) {
  const Rows<Pair>& r = decomposition.rotation;
  const Vec3<Pair>& t = decomposition.baselineInQuery;
  for (int k = 0; k < kSix; ++k) {
    const Vec3<double> q{six.x[k], six.y[k], six.z[k]};
    const Vec3<Pair> p{Pair{six.u[k], six.u[k]}, Pair{six.v[k], six.v[k]}, decomposition.focal};
    const Vec3<Pair> a{dot(r.f1, q), dot(r.f2, q), dot(r.f3, q)};
    const Vec3<Pair> n = cross(p, a), pt = cross(p, t), at = cross(a, t);
    const Pair pp = dot(p, p);
    choices_[0].add(k == 0, pp, dot(n, n), dot(n, pt), dot(n, at));
    // the other rotation: a' = 2 (t.a) t - a,  n' = 2 (t.a) p x t - n,  a' x t = -a x t
    const Vec3<Pair> other = 2 * dot(t, a) * pt - n;
    choices_[1].add(k == 0, pp, dot(other, other), dot(other, pt), -dot(other, at));
    if (!choices_[0].isAlive() && !choices_[1].isAlive()) return;
  }
}

bool OneFocalOrientation::motion(const OneFocalDecomposition& decomposition, int lane, OneFocalMotion& result) const {
  const int choice = choices_[0].valid[lane] != 0 ? 0 : 1;
  if (choices_[choice].valid[lane] == 0) return false;
  const auto column = [lane](const Vec3<Pair>& a) { return Eigen::Vector3d(a.x[lane], a.y[lane], a.z[lane]); };
  const double sign = choices_[choice].sign[lane];
  result.focalLength = decomposition.focal[lane];
  result.baseline = sign * column(decomposition.baseline);
  result.baselineInQuery = sign * column(decomposition.baselineInQuery);
  const Rows<Pair>& r = decomposition.rotation;
  result.rotation.transpose() << column(r.f1), column(r.f2), column(r.f3);
  if (choice == 1)
    result.rotation =
        (2 * result.baselineInQuery * (result.baselineInQuery.transpose() * result.rotation) - result.rotation).eval();
  return true;
}

}  // namespace one_centre
}  // namespace solvers
}  // namespace hybridgv
